//! Mutations of specs, the same for the same number: from one byte to whole tables of another file.
#![allow(unreachable_pub, reason = "a module of a test")]

/// A small generator of random numbers (splitmix64): a case is known by its number alone.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `bound`, which is not 0.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    pub fn pick<'a, T: ?Sized>(&mut self, items: &[&'a T]) -> &'a T {
        items[self.below(items.len())]
    }
}

/// Words of the language, of TOML, and what neither knows.
const TOKENS: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "[[",
    "]]",
    "\"",
    "'",
    "\"\"\"",
    "'''",
    "\\",
    "\\u0041",
    "\\U0010FFFF",
    "\\u0000",
    ",",
    "=",
    "==",
    ".",
    "..",
    "#",
    "^",
    "^-",
    "^(1/3)",
    "**",
    "*",
    "/",
    "/0",
    "+",
    "-",
    "--",
    "<=",
    ">",
    "<",
    "!=",
    "and",
    "or",
    "not",
    "1e999",
    "1e-999",
    "0.5",
    "0",
    "-1",
    "99999999999999999999",
    "9223372036854775807",
    "-9223372036854775808",
    "0x1F",
    "nan",
    "inf",
    "-inf",
    "true",
    "1979-05-27",
    "1_000",
    ".5",
    "5.",
    "if(",
    "d(",
    "dot(",
    "mean(",
    "abs(",
    "sign(",
    "min(",
    "max(",
    "sqrt(",
    "atan2(",
    "log(",
    "exp(",
    "cycle_max(",
    "start(",
    "end(",
    "integral(",
    "tau",
    "t",
    "pi",
    "n",
    "x",
    "v",
    "q_theta",
    "psi",
    "spectral_radius",
    "duration",
    " m",
    " [m/s]",
    " deg",
    " kg m^2",
    " [1/s]",
    "/(kg K)",
    " m^(1/2)",
    " m^99",
    "spec = 1",
    "name = \"x\"",
    "[state]",
    "[let]",
    "[section]",
    "[modes.a.flow]",
    "[functions]",
    "[measures]",
    "[use]",
    "use = [\"parts/spring.toml\"]",
    "[section.symmetry]",
    "[modes.a.mass]",
    "[problems.p]",
    "\n",
    "\r\n",
    "\r",
    "\t",
    "\0",
    "\u{1b}[31m",
    "\u{feff}",
    "\u{202e}",
    "é",
    "°",
    "µ",
    "Ω",
    "·",
    "%",
    "𝒙",
    "e\u{301}",
    "\u{200b}",
    "ﬁ",
    "\u{7f}",
    "\u{85}",
    "\u{2028}",
];

/// Makes case `number` from seeds, each a file's name and text, the first `right` of them without mistakes; the name and
/// the text of the case.
pub fn case(seeds: &[(String, String)], right: usize, number: u64) -> (String, String) {
    let random = &mut Random::new(number);
    // Mostly one slip in what is right: a second mistake can hide what the first would have led to.
    let among = if random.below(4) > 0 { right } else { seeds.len() };
    let (name, text) = &seeds[random.below(among)];
    let mut text = text.clone();
    let mutations = if random.below(2) == 0 { 1 } else { 1 + random.below(6) };
    for _ in 0..mutations {
        text = match random.below(12) {
            0 => bytes(text, random),
            1..=3 => token(text, random),
            4 => lines(text, random),
            5 => table(&text, random),
            6 => splice(&text, &seeds[random.below(seeds.len())].1, random),
            7 => expression(text, random),
            8 => exchange(&text, random),
            9 => nested(text, random),
            10 => number_in(text, random),
            _ => long_name(text, random),
        };
    }
    (name.clone(), text)
}

/// A place in a text where a character begins, or its end.
fn place(text: &str, random: &mut Random) -> usize {
    let mut at = random.below(text.len() + 1);
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Bytes changed, removed, doubled; what is no UTF-8 then becomes a replacement character.
fn bytes(text: String, random: &mut Random) -> String {
    let mut bytes = text.into_bytes();
    if !bytes.is_empty() {
        let at = random.below(bytes.len());
        let end = (at + 1 + random.below(30)).min(bytes.len());
        match random.below(4) {
            0 => bytes[at] = random.below(256) as u8,
            1 => bytes[at] ^= 1 << random.below(8),
            2 => drop(bytes.drain(at..end)),
            _ => {
                let copy = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                drop(bytes.splice(to..to, copy));
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn token(mut text: String, random: &mut Random) -> String {
    let at = place(&text, random);
    text.insert_str(at, random.pick(TOKENS));
    text
}

/// Lines removed, doubled, moved.
fn lines(text: String, random: &mut Random) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        return text;
    }
    let from = random.below(lines.len());
    let end = (from + 1 + random.below(5)).min(lines.len());
    let taken: Vec<&str> =
        if random.below(2) == 0 { lines[from..end].to_vec() } else { lines.drain(from..end).collect() };
    if random.below(3) > 0 {
        let to = random.below(lines.len() + 1);
        drop(lines.splice(to..to, taken));
    }
    lines.join("\n")
}

/// The tables of a text, each from its header on.
fn tables(text: &str) -> Vec<&str> {
    let mut starts: Vec<usize> = text.match_indices("\n[").map(|(at, _)| at + 1).collect();
    starts.insert(0, 0);
    starts.push(text.len());
    starts.windows(2).map(|pair| &text[pair[0]..pair[1]]).collect()
}

/// A table removed, doubled, moved, or with another one's header.
fn table(text: &str, random: &mut Random) -> String {
    let mut tables = tables(text);
    let at = random.below(tables.len());
    match random.below(4) {
        0 => drop(tables.remove(at)),
        1 => tables.push(tables[at]),
        2 => {
            let taken = tables.remove(at);
            tables.insert(random.below(tables.len() + 1), taken);
        }
        _ => {
            let header = tables[random.below(tables.len())].lines().next().unwrap_or("");
            let body = tables[at].split_once('\n').map_or("", |(_, body)| body);
            let whole = format!("{header}\n{body}");
            return tables.iter().enumerate().map(|(i, t)| if i == at { whole.as_str() } else { t }).collect();
        }
    }
    tables.concat()
}

/// A table of another file, or the one file's head and the other's tail.
fn splice(text: &str, other: &str, random: &mut Random) -> String {
    if random.below(2) == 0 {
        let all = tables(other);
        return format!("{text}\n{}", all[random.below(all.len())]);
    }
    let (head, tail) = (place(text, random), place(other, random));
    format!("{}{}", &text[..head], &other[tail..])
}

/// The insides of the strings of a text.
fn strings(text: &str) -> Vec<(usize, usize)> {
    let quotes: Vec<usize> = text.match_indices('"').map(|(at, _)| at).collect();
    quotes.chunks_exact(2).map(|pair| (pair[0] + 1, pair[1])).collect()
}

/// Something put into a string, or around it.
fn expression(text: String, random: &mut Random) -> String {
    let strings = strings(&text);
    if strings.is_empty() {
        return text;
    }
    let (start, end) = strings[random.below(strings.len())];
    let old = &text[start..end];
    let token = random.pick(TOKENS);
    let new = match random.below(5) {
        0 => token.to_owned(),
        1 => format!("{old} {token} {old}"),
        2 => format!("if({old} < {token}, {old}, {token})"),
        3 => format!("d({old}, {token})"),
        _ => format!("({old})^({token})"),
    };
    format!("{}{new}{}", &text[..start], &text[end..])
}

/// One string in the place of another.
fn exchange(text: &str, random: &mut Random) -> String {
    let strings = strings(text);
    if strings.is_empty() {
        return text.to_owned();
    }
    let ((start, end), (a, b)) = (strings[random.below(strings.len())], strings[random.below(strings.len())]);
    format!("{}{}{}", &text[..start], &text[a..b], &text[end..])
}

/// What opens many times, in a string or anywhere, and closes or not.
fn nested(mut text: String, random: &mut Random) -> String {
    let pairs = [
        ("(", ")"),
        ("[", "]"),
        ("{a=", "}"),
        ("-", ""),
        ("abs(", ")"),
        ("d(", ", x)"),
        ("not ", ""),
        ("x^", "2"),
        ("a.", "b"),
        ("if(x<1,", ",1)"),
        ("min(x,", ")"),
        ("dot(", ")"),
        ("1+", "1"),
        ("2^", "2"),
        ("10^10^", "1"),
        ("exp(", ")"),
    ];
    let (open, close) = pairs[random.below(pairs.len())];
    let depth = [3, 20, 100, 127, 129, 1000, 20_000][random.below(7)];
    let closed = if random.below(3) == 0 { 0 } else { depth };
    let all = format!("{}x{}", open.repeat(depth), close.repeat(closed));
    let strings = strings(&text);
    let at = if strings.is_empty() || random.below(3) == 0 {
        place(&text, random)
    } else {
        strings[random.below(strings.len())].0
    };
    text.insert_str(at, &all);
    text
}

/// A number in the place of one, or a digit more.
fn number_in(text: String, random: &mut Random) -> String {
    let digits: Vec<usize> = text.match_indices(|c: char| c.is_ascii_digit()).map(|(at, _)| at).collect();
    if digits.is_empty() {
        return text;
    }
    let at = digits[random.below(digits.len())];
    let long = "9".repeat([17, 40, 400, 5000][random.below(4)]);
    let numbers =
        ["0", "-0", "1e308", "1e-308", "1e400", "5e-324", "0.1", "1/3", "4503599627370497", "2147483648", &long];
    format!("{}{}{}", &text[..at], numbers[random.below(numbers.len())], &text[at + 1..])
}

/// A name that is much longer, everywhere.
fn long_name(text: String, random: &mut Random) -> String {
    let names: Vec<&str> =
        text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|name| !name.is_empty()).collect();
    if names.is_empty() {
        return text;
    }
    let name = names[random.below(names.len())];
    let new = match random.below(5) {
        0 => name.repeat([30, 1000][random.below(2)].min(1 + 20_000 / name.len())),
        1 => format!("{name}é"),
        2 => names[random.below(names.len())].to_owned(),
        3 => name.to_uppercase(),
        _ => random.pick(TOKENS).to_owned(),
    };
    if random.below(2) == 0 && text.len() * new.len() < 3_000_000 {
        return text.replace(name, &new);
    }
    text.replacen(name, &new, 1)
}
