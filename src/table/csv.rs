//! A table as CSV (RFC 4180): first the provenance as one line of JSON behind `#`, then names with their units in brackets, then
//! the rows. A number has the fewest digits that give back its bits; one that is not there is an empty field.
//!
//! The line with `#` is skipped by NumPy and gnuplot by themselves, by pandas with `comment="#"` or `skiprows=1`.

use super::{Table, Values};
use crate::provenance::Provenance;
use std::error::Error;

/// The whole file.
pub(super) fn bytes(table: &Table, provenance: &Provenance) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut writer = csv::Writer::from_writer(format!("# {}\n", provenance.line()).into_bytes());
    writer.write_record(table.columns.iter().map(super::Column::label))?;
    for row in 0..table.rows() {
        for column in &table.columns {
            writer.write_field(field(&column.values, row))?;
        }
        writer.write_record(None::<&[u8]>)?;
    }
    Ok(writer.into_inner()?)
}

fn field(values: &Values, row: usize) -> String {
    match values {
        Values::Number(values) => number(values.get(row).copied().unwrap_or(f64::NAN)),
        Values::Integer(values) => values.get(row).map(i64::to_string).unwrap_or_default(),
        Values::Text(values) => values.get(row).cloned().unwrap_or_default(),
    }
}

/// With an exponent where that is shorter; always with a point or an exponent, so that it is no integer to a reader.
fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:?}") }
}
