//! The Arrow schema of a table, as Parquet files carry it under `ARROW:schema`: this is where readers (pyarrow, Polars, DuckDB) look
//! for the metadata of fields, here `unit` and `doc`.
//!
//! The value is a `Message` of Arrow's IPC format that holds a `Schema`, as a FlatBuffer, in Base64. Numbers of fields and of kinds
//! are those of `Schema.fbs` and `Message.fbs` in the Arrow format's specification (version V5).

use super::{Column, Table, Values};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flatbuffers::{
    FlatBufferBuilder, ForwardsUOffset, TableFinishedWIPOffset, UnionWIPOffset, VOffsetT, Vector, WIPOffset,
};

/// A table that is in the buffer.
type Written = WIPOffset<TableFinishedWIPOffset>;

/// `MetadataVersion::V5`.
const VERSION: i16 = 4;
/// `MessageHeader::Schema`.
const SCHEMA: u8 = 1;
/// `Type::Int`.
const INTEGER: u8 = 2;
/// `Type::FloatingPoint`.
const NUMBER: u8 = 3;
/// `Type::Utf8`.
const TEXT: u8 = 5;
/// `Precision::DOUBLE`.
const DOUBLE: i16 = 2;

/// Where entry number `index` of a table stands in its list of offsets.
const fn entry(index: VOffsetT) -> VOffsetT {
    4 + 2 * index
}

/// The value of `ARROW:schema`, with `metadata` (keys and values) for the file as a whole: some readers take it from here only.
pub(super) fn arrow_schema(table: &Table, metadata: &[(&str, &str)]) -> String {
    let mut buffer = FlatBufferBuilder::new();
    let fields: Vec<Written> = table.columns.iter().map(|column| field(&mut buffer, column)).collect();
    let fields = buffer.create_vector(&fields);
    let metadata = key_values(&mut buffer, metadata);
    let start = buffer.start_table();
    buffer.push_slot_always(entry(1), fields);
    buffer.push_slot_always(entry(2), metadata);
    let schema = buffer.end_table(start);
    let start = buffer.start_table();
    buffer.push_slot_always(entry(0), VERSION);
    buffer.push_slot_always(entry(1), SCHEMA);
    buffer.push_slot_always(entry(2), schema);
    let message = buffer.end_table(start);
    buffer.finish_minimal(message);
    let mut message = buffer.finished_data().to_vec();
    // Whole words of eight bytes, behind the mark of a message and its length.
    message.resize(message.len().next_multiple_of(8), 0);
    let length = u32::try_from(message.len()).unwrap_or(u32::MAX).to_le_bytes();
    STANDARD.encode([&[0xff; 4][..], &length, &message].concat())
}

fn field(buffer: &mut FlatBufferBuilder<'_>, column: &Column) -> Written {
    let metadata = key_values(buffer, &[("unit", column.unit().unwrap_or("1")), ("doc", &column.doc)]);
    let children = buffer.create_vector::<Written>(&[]);
    let name = buffer.create_string(&column.name);
    let (kind, of_kind) = kind(buffer, &column.values);
    let start = buffer.start_table();
    buffer.push_slot_always(entry(0), name);
    buffer.push_slot_always(entry(1), matches!(column.values, Values::Number(_)));
    buffer.push_slot_always(entry(2), kind);
    buffer.push_slot_always(entry(3), of_kind);
    buffer.push_slot_always(entry(5), children);
    buffer.push_slot_always(entry(6), metadata);
    buffer.end_table(start)
}

/// A list of `KeyValue`.
fn key_values<'b>(
    buffer: &mut FlatBufferBuilder<'b>,
    entries: &[(&str, &str)],
) -> WIPOffset<Vector<'b, ForwardsUOffset<TableFinishedWIPOffset>>> {
    let tables: Vec<Written> = entries
        .iter()
        .map(|(key, value)| {
            let (key, value) = (buffer.create_string(key), buffer.create_string(value));
            let start = buffer.start_table();
            buffer.push_slot_always(entry(0), key);
            buffer.push_slot_always(entry(1), value);
            buffer.end_table(start)
        })
        .collect();
    buffer.create_vector(&tables)
}

/// Which type of Arrow's, and its table.
fn kind(buffer: &mut FlatBufferBuilder<'_>, values: &Values) -> (u8, WIPOffset<UnionWIPOffset>) {
    let start = buffer.start_table();
    let kind = match values {
        Values::Number(_) => {
            buffer.push_slot_always(entry(0), DOUBLE);
            NUMBER
        }
        Values::Integer(_) => {
            buffer.push_slot_always(entry(0), 64_i32);
            buffer.push_slot_always(entry(1), true);
            INTEGER
        }
        Values::Text(_) => TEXT,
    };
    (kind, buffer.end_table(start).as_union_value())
}
