//! What a study is: enough to tell whether two folders hold parts of the same one.

use crate::provenance::Provenance;
use crate::table::{Column, Table, Values};
use gaitc_compiler::front::shortened;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// The layout of folders and chunks that this program reads and writes.
const FORMAT: u32 = 1;

/// More points than this are no study of one table.
pub const MOST_POINTS: u64 = 10_000_000;

/// Which study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A gait or an optimum at each point.
    Sweep,
    /// Where each start leads.
    Basin,
}

impl Kind {
    /// Its name, which is that of its command and of its tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sweep => "sweep",
            Self::Basin => "basin",
        }
    }
}

/// A part of a study: the chunks whose number is `index - 1` modulo `count`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// From 1.
    pub index: u64,
    /// How many shards there are.
    pub count: u64,
}

/// All of it.
impl Default for Shard {
    fn default() -> Self {
        Self { index: 1, count: 1 }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').map(|(index, count)| (index.trim().parse(), count.trim().parse()));
        match parts {
            Some((Ok(index), Ok(count))) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("a shard is `I/N` with I from 1 to N, as in `2/8`".to_owned()),
        }
    }
}

/// The type of a column's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Type {
    /// Doubles.
    Number,
    /// 64-bit integers.
    Integer,
    /// Texts.
    Text,
}

/// A column without its values.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Head {
    name: String,
    unit: String,
    doc: String,
    r#type: Type,
}

impl Head {
    /// Of a column.
    fn of(column: &Column) -> Self {
        let r#type = match column.values {
            Values::Number(_) => Type::Number,
            Values::Integer(_) => Type::Integer,
            Values::Text(_) => Type::Text,
        };
        Self { name: column.name.clone(), unit: column.unit.clone(), doc: column.doc.clone(), r#type }
    }

    /// The column, without values.
    fn column(&self) -> Column {
        let values = match self.r#type {
            Type::Number => Values::Number(Vec::new()),
            Type::Integer => Values::Integer(Vec::new()),
            Type::Text => Values::Text(Vec::new()),
        };
        Column { name: self.name.clone(), unit: self.unit.clone(), doc: self.doc.clone(), values }
    }
}

/// What a study is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    format: u32,
    /// Which study.
    pub kind: Kind,
    /// How many points.
    pub points: u64,
    /// How many of them make a chunk; the last may be shorter.
    pub chunk: u64,
    /// Which of them are in this folder.
    #[serde(default)]
    pub shard: Shard,
    columns: Vec<Head>,
    /// Version, model, fingerprint, run.
    provenance: Value,
}

impl Manifest {
    /// The manifest of a study whose chunks have the columns of `table` (its rows do not matter).
    pub fn new(kind: Kind, table: &Table, points: u64, provenance: &Provenance) -> Self {
        let columns = table.columns.iter().map(Head::of).collect();
        let (chunk, shard, provenance) = (points.max(1), Shard::default(), provenance.json());
        Self { format: FORMAT, kind, points, chunk, shard, columns, provenance }
    }

    /// A table with the columns of the chunks and no rows.
    pub fn table(&self) -> Table {
        Table { columns: self.columns.iter().map(Head::column).collect() }
    }

    /// How many chunks the whole study has.
    pub fn chunks(&self) -> u64 {
        self.points.div_ceil(self.chunk.max(1))
    }

    /// The points of a chunk.
    pub fn rows(&self, chunk: u64) -> Range<u64> {
        let first = chunk.saturating_mul(self.chunk).min(self.points);
        first..first.saturating_add(self.chunk).min(self.points)
    }

    /// The numbers of the chunks of this shard.
    pub fn own(&self) -> impl Iterator<Item = u64> + use<> {
        let step = usize::try_from(self.shard.count.max(1)).unwrap_or(usize::MAX);
        (self.shard.index.saturating_sub(1)..self.chunks()).step_by(step)
    }

    /// Whether a chunk is one of this shard.
    pub fn owns(&self, chunk: u64) -> bool {
        chunk < self.chunks() && chunk % self.shard.count.max(1) == self.shard.index.saturating_sub(1)
    }

    /// The manifest of the whole study.
    pub fn whole(&self) -> Self {
        Self { shard: Shard::default(), ..self.clone() }
    }

    /// How many points the chunks of this shard have.
    pub fn own_points(&self) -> u64 {
        self.own().map(|chunk| self.rows(chunk)).map(|rows| rows.end - rows.start).sum()
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        // All keys are strings: this cannot fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// A hash of what is studied, the same for all shards.
    pub fn hash(&self) -> [u8; 32] {
        Sha256::digest(self.whole().text()).into()
    }

    /// Reads a file.
    ///
    /// # Errors
    /// In words, when it is no manifest, or one that this program does not understand.
    pub fn read(text: &str) -> Result<Self, String> {
        let manifest: Self = serde_json::from_str(text).map_err(|error| format!("it is damaged: {error}"))?;
        if manifest.format != FORMAT {
            return Err(format!("it has format {}, this program reads format {FORMAT}", manifest.format));
        }
        let Shard { index, count } = manifest.shard;
        if manifest.points > MOST_POINTS || manifest.chunk == 0 || index == 0 || index > count {
            return Err("it is damaged: chunks or shards are impossible".to_owned());
        }
        Ok(manifest)
    }

    /// What made the study.
    ///
    /// # Errors
    /// In words, when the file does not say so.
    pub fn provenance(&self) -> Result<Provenance, String> {
        let text = |key: &str| self.provenance.get(key).and_then(Value::as_str).map(str::to_owned);
        let run = self.provenance.get("run").map(toml::Table::try_from);
        match (text("model"), text("fingerprint"), run) {
            (Some(model), Some(fingerprint), Some(Ok(run))) => {
                Ok(Provenance { model, fingerprint, spec: text("spec").unwrap_or_default(), run })
            }
            _ => Err("it is damaged: it does not say what made the study".to_owned()),
        }
    }

    /// The first thing in which another study differs, in words; `None` where it is the same (shards may differ).
    pub fn difference(&self, other: &Self) -> Option<String> {
        let own = serde_json::to_value(self.whole()).unwrap_or_default();
        let others = serde_json::to_value(other.whole()).unwrap_or_default();
        // The run says it best.
        let run = |value: &Value| value.pointer("/provenance/run").cloned().unwrap_or_default();
        let program = |value: &Value| value.pointer("/provenance/version").cloned().unwrap_or_default();
        let found = difference("", &run(&own), &run(&others));
        found.or_else(|| difference("version", &program(&own), &program(&others))).or_else(|| {
            // Hashes tell people nothing.
            match difference("", &own, &others)? {
                hash if hash.starts_with("`provenance.") => Some("the spec has been edited in between".to_owned()),
                other => Some(other),
            }
        })
    }
}

fn difference(path: &str, a: &Value, b: &Value) -> Option<String> {
    if a == b {
        return None;
    }
    // Of lists (the columns of a table, a flag that was given twice) the first entry that differs says it.
    if let (Value::Array(a), Value::Array(b)) = (a, b) {
        let entry = |list: &[Value], i: usize| list.get(i).cloned().unwrap_or_default();
        return (0..a.len().max(b.len())).find_map(|i| {
            let (a, b) = (entry(a, i), entry(b, i));
            let name = a.get("name").or_else(|| b.get("name")).and_then(Value::as_str);
            let path = name.map_or_else(|| path.to_owned(), |name| format!("{path}.{}", shortened(name)));
            difference(&path, &a, &b)
        });
    }
    if let (Value::Object(a), Value::Object(b)) = (a, b) {
        let inner = |key: &String| {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            difference(&path, a.get(key).unwrap_or(&Value::Null), b.get(key).unwrap_or(&Value::Null))
        };
        return a.keys().chain(b.keys()).find_map(inner);
    }
    let show = |value: &Value| match value {
        Value::Null => "nothing".to_owned(),
        Value::Object(_) | Value::Array(_) => "an entry".to_owned(),
        Value::String(text) => format!("\"{}\"", shortened(text)),
        value => value.to_string(),
    };
    Some(format!("`{path}` is {} there, {} here", show(a), show(b)))
}
