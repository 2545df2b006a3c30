//! Whole numbers as flags take them.

/// Reads a whole number; one that is written as a fraction or a power of ten is told how to write it.
pub(super) fn whole(text: &str) -> Result<usize, String> {
    if let Ok(number) = text.parse() {
        return Ok(number);
    }
    let known = text.parse::<f64>().ok().filter(|x| x.fract() == 0.0 && (0.0..1e15).contains(x));
    Err(match known {
        Some(number) => format!("not written as a whole number; write {number}"),
        None => "not a whole number from 0 on; write one in digits, such as 10".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::whole;

    #[test]
    fn whole_numbers_are_read_and_others_are_told_how_to_be_written() {
        assert_eq!(whole("1000"), Ok(1000));
        for (text, hint) in [("1e3", "write 1000"), ("7.0", "write 7"), ("1.5", "in digits"), ("-3", "in digits")] {
            assert!(whole(text).is_err_and(|message| message.ends_with(hint) || message.contains(hint)), "{text}");
        }
        for text in ["nan", "inf", "1e300", "", "ten"] {
            assert!(whole(text).is_err_and(|message| message.contains("in digits")), "{text}");
        }
    }
}
