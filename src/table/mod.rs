//! Tables of results: named columns with units, to be written as CSV or Parquet. Equal tables give equal bytes.

mod arrow_schema;
mod csv;
mod parquet;

use crate::files;
use crate::provenance::Provenance;
use std::error::Error;
use std::path::Path;

/// A table. All columns have the same length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// In the order in which they are written.
    pub columns: Vec<Column>,
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Unit of its values, e.g. `m/s`; empty where they have none. Values are in SI units.
    pub unit: String,
    /// For people.
    pub doc: String,
    /// One a row.
    pub values: Values,
}

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers; NaN is a value that is not there: an empty field, a null.
    Number(Vec<f64>),
    /// Counts.
    Integer(Vec<i64>),
    /// Names.
    Text(Vec<String>),
}

impl Values {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Number(values) => values.len(),
            Self::Integer(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Column {
    /// Its unit, unless its values have none.
    pub fn unit(&self) -> Option<&str> {
        Some(self.unit.as_str()).filter(|unit| !["", "1"].contains(unit))
    }

    /// Its name with the unit behind it in brackets, as in `climb_speed [m/s]`.
    pub fn label(&self) -> String {
        self.unit().map_or_else(|| self.name.clone(), |unit| format!("{} [{unit}]", self.name))
    }
}

impl Table {
    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Puts the rows of a table with the same columns behind its own.
    pub fn append(&mut self, rows: Self) {
        for (column, rows) in self.columns.iter_mut().zip(rows.columns) {
            match (&mut column.values, rows.values) {
                (Values::Number(values), Values::Number(rows)) => values.extend(rows),
                (Values::Integer(values), Values::Integer(rows)) => values.extend(rows),
                (Values::Text(values), Values::Text(rows)) => values.extend(rows),
                // Other columns are not the same ones; what then differ are the lengths, which is seen when the table is written.
                _ => {}
            }
        }
    }
}

/// As what a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Text, one row a line.
    Csv,
    /// Apache Parquet.
    Parquet,
}

impl Format {
    /// The format that a file name asks for.
    ///
    /// # Errors
    /// When it asks for none of these.
    pub fn of(path: &Path) -> Result<Self, String> {
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("parquet") => Ok(Self::Parquet),
            _ => Err(format!(
                "`{}` does not say what to write\n  help: tables are CSV or Parquet: let the name end in `.csv` or `.parquet`",
                path.display()
            )),
        }
    }
}

/// Writes a table, as its file name asks: whole, or not at all. The bytes depend on the table and its provenance alone.
///
/// # Errors
/// When the name ends neither in `.csv` nor in `.parquet`, when columns differ in length or share a name, or when the file cannot
/// be written.
pub fn write(table: &Table, path: &Path, provenance: &Provenance) -> Result<(), Box<dyn Error>> {
    Ok(files::write(path, &bytes(table, Format::of(path)?, provenance)?)?)
}

/// The bytes that [`write()`] writes.
///
/// # Errors
/// When columns differ in length or share a name.
pub fn bytes(table: &Table, format: Format, provenance: &Provenance) -> Result<Vec<u8>, Box<dyn Error>> {
    for (i, column) in table.columns.iter().enumerate() {
        if column.values.len() != table.rows() {
            return Err(
                format!("column `{}` has {} rows, not {}", column.name, column.values.len(), table.rows()).into()
            );
        }
        if table.columns.iter().take(i).any(|other| other.name == column.name) {
            return Err(format!("two columns are named `{}`", column.name).into());
        }
    }
    match format {
        Format::Csv => csv::bytes(table, provenance),
        Format::Parquet => parquet::bytes(table, provenance),
    }
}
