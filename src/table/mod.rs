//! Tables of results: named columns with units, to be written as CSV, Parquet or JSON.

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
