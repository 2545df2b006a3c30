//! From the rows of all chunks to the table of a study: what can only be said when all points are known.

use super::manifest::Kind;
use crate::table::{Column, Table, Values};
use gaitc_runtime::study::basin::Gaits;

/// The table of a study from its chunks' rows, in the order of the points.
pub fn finish(kind: Kind, rows: Table) -> Table {
    match kind {
        Kind::Sweep => rows,
        Kind::Basin => number_gaits(rows),
    }
}

/// Adds to a basin which starts lead to the same gait: numbers from 1 in the order of the points, 0 where there is none. Behind the
/// column `steps` stand the coordinates of the gaits.
fn number_gaits(mut table: Table) -> Table {
    let (Some(period), Some(steps)) = (position(&table, "period"), position(&table, "steps")) else {
        return table;
    };
    let coordinates: Vec<&Vec<f64>> =
        table.columns.iter().skip(steps + 1).filter_map(|column| numbers(&column.values)).collect();
    let mut gaits = Gaits::default();
    let Values::Integer(periods) = &table.columns[period].values else { return table };
    let number = |(row, period): (usize, &i64)| {
        let at: Vec<f64> = coordinates.iter().filter_map(|column| column.get(row).copied()).collect();
        let period = usize::try_from(*period).ok().filter(|period| *period > 0);
        period.map_or(0, |period| i64::try_from(gaits.number(period, &at)).unwrap_or(i64::MAX))
    };
    let numbers = periods.iter().enumerate().map(number).collect();
    let doc = "Which gait it settles on: equal numbers, the same gait; 0 where on none.".to_owned();
    let column = Column { name: "gait".to_owned(), unit: String::new(), doc, values: Values::Integer(numbers) };
    table.columns.insert(period, column);
    table
}

fn position(table: &Table, name: &str) -> Option<usize> {
    table.columns.iter().position(|column| column.name == name)
}

fn numbers(values: &Values) -> Option<&Vec<f64>> {
    match values {
        Values::Number(values) => Some(values),
        _ => None,
    }
}
