//! Columns of a study's table, and its rows.

use crate::load::Loaded;
use crate::table::{Column, Table, Values};
use gaitc_compiler::front::si_unit_like;

/// One value of a row.
pub(super) enum Cell {
    Number(f64),
    Integer(i64),
    Text(&'static str),
}

/// A table without rows that grows column by column; names stay apart.
#[derive(Default)]
pub(super) struct Columns(Table);

impl Columns {
    /// A column of numbers, counts or names: `values` is empty. Where another column has the name already, `kind` is put behind it.
    fn add(&mut self, (name, kind): (&str, &str), unit: &str, doc: &str, values: Values) {
        let taken = |name: &str| self.0.columns.iter().any(|column| column.name == name);
        let mut name = name.to_owned();
        while taken(&name) {
            name += kind;
        }
        self.0.columns.push(Column { name, unit: unit.to_owned(), doc: doc.to_owned(), values });
    }

    pub(super) fn number(&mut self, name: (&str, &str), unit: &str, doc: &str) {
        self.add(name, unit, doc, Values::Number(Vec::new()));
    }

    pub(super) fn integer(&mut self, name: &str, doc: &str) {
        self.add((name, "_"), "", doc, Values::Integer(Vec::new()));
    }

    pub(super) fn text(&mut self, name: &str, doc: &str) {
        self.add((name, "_"), "", doc, Values::Text(Vec::new()));
    }

    pub(super) fn parameters(&mut self, loaded: &Loaded, indices: impl IntoIterator<Item = usize>) {
        for i in indices {
            let p = &loaded.spec.parameters[i];
            self.number((&p.name, "_parameter"), &si_unit_like(p.dimension, &p.unit), &p.doc);
        }
    }

    /// The section coordinates, with `suffix` behind their names.
    pub(super) fn section(&mut self, loaded: &Loaded, suffix: &str) {
        for &i in loaded.coordinates() {
            let state = &loaded.spec.states[i];
            let name = format!("{}{suffix}", state.name);
            self.number((&name, "_section"), &si_unit_like(state.dimension, &state.unit), &state.doc);
        }
    }

    pub(super) fn measures(&mut self, loaded: &Loaded) {
        for m in &loaded.spec.measures {
            self.number((&m.name, "_measure"), &si_unit_like(m.dimension, &m.unit), &m.doc);
        }
    }

    /// The table, without rows.
    pub(super) fn table(self) -> Table {
        self.0
    }
}

/// A table with these columns and rows.
pub(super) fn with_rows(columns: &Table, rows: Vec<Vec<Cell>>) -> Table {
    let mut table = columns.clone();
    for row in rows {
        for (column, cell) in table.columns.iter_mut().zip(row) {
            match (&mut column.values, cell) {
                (Values::Number(values), Cell::Number(value)) => values.push(value),
                (Values::Integer(values), Cell::Integer(value)) => values.push(value),
                (Values::Text(values), Cell::Text(value)) => values.push(value.to_owned()),
                // Lengths differ then, which is an error when the table is written.
                _ => {}
            }
        }
    }
    table
}

/// Numbers of a table's column.
pub(super) fn numbers<'t>(table: &'t Table, name: &str) -> Option<&'t [f64]> {
    let column = table.columns.iter().find(|column| column.name == name)?;
    if let Values::Number(values) = &column.values { Some(values) } else { None }
}

/// Integers of a table's column.
pub(super) fn integers<'t>(table: &'t Table, name: &str) -> Option<&'t [i64]> {
    let column = table.columns.iter().find(|column| column.name == name)?;
    if let Values::Integer(values) = &column.values { Some(values) } else { None }
}

/// Texts of a table's column.
pub(super) fn texts<'t>(table: &'t Table, name: &str) -> Option<&'t [String]> {
    let column = table.columns.iter().find(|column| column.name == name)?;
    if let Values::Text(values) = &column.values { Some(values) } else { None }
}
