//! A table as Apache Parquet: numbers as nullable doubles, counts as 64-bit integers, texts as UTF-8. Units and docs of the columns are in
//! the metadata of their fields (module `arrow_schema`), the provenance is in the file's, under the key `gaitc`. Not compressed, so
//! that every reader can read it.

use super::arrow_schema::arrow_schema;
use super::{Column, Table, Values};
use crate::provenance::{KEY, Provenance};
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{ColumnPath, Type};
use std::error::Error;
use std::ops::Range;
use std::sync::Arc;

/// Rows that a reader has to hold at a time.
const GROUP: usize = 1 << 20;

/// The whole file.
pub(super) fn bytes(table: &Table, provenance: &Provenance) -> Result<Vec<u8>, Box<dyn Error>> {
    let fields =
        table.columns.iter().map(|column| Ok(Arc::new(field(column)?))).collect::<Result<_, Box<dyn Error>>>()?;
    let schema = Type::group_type_builder("table").with_fields(fields).build()?;
    let mut file = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties(table, provenance)))?;
    for first in (0..table.rows()).step_by(GROUP) {
        let rows = first..(first + GROUP).min(table.rows());
        let mut group = file.next_row_group()?;
        for column in &table.columns {
            let Some(mut writer) = group.next_column()? else {
                return Err(format!("no place for column `{}`", column.name).into());
            };
            put(&mut writer, &column.values, rows.clone())?;
            writer.close()?;
        }
        group.close()?;
    }
    Ok(file.into_inner()?)
}

fn properties(table: &Table, provenance: &Provenance) -> WriterProperties {
    let origin = provenance.line();
    let schema = arrow_schema(table, &[(KEY, &origin)]);
    let metadata = vec![KeyValue::new(KEY.to_owned(), origin), KeyValue::new("ARROW:schema".to_owned(), schema)];
    let mut properties = WriterProperties::builder()
        .set_created_by(format!("gaitc version {}", Provenance::VERSION))
        .set_key_value_metadata(Some(metadata))
        .set_dictionary_enabled(false);
    for column in table.columns.iter().filter(|column| matches!(column.values, Values::Text(_))) {
        // Names repeat.
        properties = properties.set_column_dictionary_enabled(ColumnPath::from(column.name.as_str()), true);
    }
    properties.build()
}

fn field(column: &Column) -> Result<Type, Box<dyn Error>> {
    let field = |physical| Type::primitive_type_builder(&column.name, physical);
    let field = match column.values {
        Values::Number(_) => field(Physical::DOUBLE).with_repetition(Repetition::OPTIONAL),
        Values::Integer(_) => field(Physical::INT64).with_repetition(Repetition::REQUIRED),
        Values::Text(_) => field(Physical::BYTE_ARRAY)
            .with_logical_type(Some(LogicalType::String))
            .with_repetition(Repetition::REQUIRED),
    };
    Ok(field.build()?)
}

/// Writes some rows of a column; what is NaN has definition level 0 and no value.
fn put(writer: &mut SerializedColumnWriter<'_>, values: &Values, rows: Range<usize>) -> Result<(), Box<dyn Error>> {
    match values {
        Values::Number(values) => {
            let values = values.get(rows).unwrap_or_default();
            let levels: Vec<i16> = values.iter().map(|value| i16::from(!value.is_nan())).collect();
            let present: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
            writer.typed::<DoubleType>().write_batch(&present, Some(&levels), None)?;
        }
        Values::Integer(values) => {
            writer.typed::<Int64Type>().write_batch(values.get(rows).unwrap_or_default(), None, None)?;
        }
        Values::Text(values) => {
            let texts = values.get(rows).unwrap_or_default();
            let texts: Vec<ByteArray> = texts.iter().map(|text| ByteArray::from(text.as_str())).collect();
            writer.typed::<ByteArrayType>().write_batch(&texts, None, None)?;
        }
    }
    Ok(())
}
