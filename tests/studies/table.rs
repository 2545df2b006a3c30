//! Tables as files: every bit comes back, units and provenance are in the metadata, and equal tables are equal bytes.

use gaitc::provenance::Provenance;
use gaitc::table::{Column, Format, Table, Values, bytes, write};
use parquet::basic::LogicalType;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::Field;
use std::fs::{self, File};
use std::path::Path;

fn provenance() -> Provenance {
    let run = toml::toml! {
        command = "sweep"
        over = ["psi=1..45 deg:3"]
    };
    Provenance { model: "a_model".to_owned(), fingerprint: "f00d".to_owned(), spec: "5bec".to_owned(), run }
}

const NUMBERS: [f64; 6] = [0.1, -0.0, f64::NAN, 5e-324, -1.797_693_134_862_315_7e308, 1e22];

fn table() -> Table {
    let column = |name: &str, unit: &str, doc: &str, values| Column {
        name: name.to_owned(),
        unit: unit.to_owned(),
        doc: doc.to_owned(),
        values,
    };
    let texts = ["converged", "a \"quoted\", text", "", "ü", "line\nbreak", "converged"];
    Table {
        columns: vec![
            column("point", "", "Number of the point.", Values::Integer(vec![0, 1, -2, i64::MAX, i64::MIN, 5])),
            column("climb_speed", "m/s", "How fast it climbs.", Values::Number(NUMBERS.to_vec())),
            column("status", "", "Whether there is a gait.", Values::Text(texts.map(str::to_owned).to_vec())),
            column("cost", "1", "", Values::Number(vec![f64::NAN; 6])),
        ],
    }
}

/// Writes a table as Parquet, and opens it.
fn read(table: &Table) -> SerializedFileReader<File> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.parquet");
    write(table, &path, &provenance()).unwrap();
    SerializedFileReader::new(File::open(path).unwrap()).unwrap()
}

#[test]
fn csv_gives_back_every_bit() {
    let text = String::from_utf8(bytes(&table(), Format::Csv, &provenance()).unwrap()).unwrap();
    let (first, rest) = text.split_once('\n').unwrap();
    let origin: serde_json::Value = serde_json::from_str(first.strip_prefix("# ").unwrap()).unwrap();
    assert_eq!((&origin["model"], &origin["run"]["over"][0]), (&"a_model".into(), &"psi=1..45 deg:3".into()));
    let mut reader = csv::Reader::from_reader(rest.as_bytes());
    assert_eq!(reader.headers().unwrap(), vec!["point", "climb_speed [m/s]", "status", "cost"]);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 6);
    for (row, number) in rows.iter().zip(NUMBERS) {
        if number.is_nan() {
            assert_eq!(&row[1], "");
        } else {
            assert_eq!(row[1].parse::<f64>().unwrap().to_bits(), number.to_bits(), "{row:?}");
        }
    }
    assert_eq!((&rows[1][2], &rows[4][2], &rows[4][0]), ("a \"quoted\", text", "line\nbreak", "-9223372036854775808"));
    assert!(rows.iter().all(|row| row[1].len() < 25), "exponents where they are shorter");
}

#[test]
fn parquet_gives_back_every_bit_with_units() {
    assert_eq!(
        bytes(&table(), Format::Parquet, &provenance()).unwrap(),
        bytes(&table(), Format::Parquet, &provenance()).unwrap()
    );
    let reader = read(&table());
    let metadata = reader.metadata().file_metadata();
    let schema = metadata.schema_descr();
    assert_eq!(schema.column(2).logical_type_ref(), Some(&LogicalType::String));
    let of = |key: &str| {
        let known = metadata.key_value_metadata().unwrap().iter().find(|entry| entry.key == key).unwrap();
        known.value.clone().unwrap()
    };
    assert_eq!(of("gaitc"), provenance().line());
    let arrow = base64::Engine::decode(&base64::engine::general_purpose::STANDARD, of("ARROW:schema")).unwrap();
    let holds = |text: &[u8]| arrow.windows(text.len()).any(|part| part == text);
    assert!(holds(b"unit") && holds(b"m/s") && holds(b"How fast it climbs.") && arrow.len() % 8 == 0);
    for (i, row) in reader.get_row_iter(None).unwrap().enumerate() {
        let fields: Vec<(String, Field)> =
            row.unwrap().get_column_iter().map(|(n, f)| (n.clone(), f.clone())).collect();
        assert_eq!(
            fields.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
            ["point", "climb_speed", "status", "cost"]
        );
        match &fields[1].1 {
            Field::Double(value) => assert_eq!(value.to_bits(), NUMBERS[i].to_bits()),
            other => assert!(NUMBERS[i].is_nan() && *other == Field::Null, "{other:?}"),
        }
        let Values::Text(texts) = &table().columns[2].values else { unreachable!() };
        assert_eq!(fields[2].1, Field::Str(texts[i].clone()));
        assert_eq!(fields[3].1, Field::Null);
    }
}

#[test]
fn a_table_may_be_empty_and_long() {
    let none = Table { columns: vec![Column { values: Values::Number(Vec::new()), ..table().columns[1].clone() }] };
    let count = (1 << 20) + 3;
    let long = (0..count).map(|i| i as f64).collect();
    let long = Table { columns: vec![Column { values: Values::Number(long), ..table().columns[1].clone() }] };
    for (table, rows) in [(none, 0), (long, count)] {
        let reader = read(&table);
        assert_eq!(reader.metadata().file_metadata().num_rows(), rows as i64);
    }
}

#[test]
fn what_is_no_table_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |table: &Table, name: &str, expected: &str| {
        let message = write(table, &folder.path().join(name), &provenance()).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    };
    refused(&table(), "table.txt", "`.csv` or `.parquet`");
    refused(&table(), "table", "`.csv` or `.parquet`");
    let mut twice = table();
    twice.columns[1].name = "point".to_owned();
    refused(&twice, "table.csv", "two columns are named `point`");
    let mut ragged = table();
    ragged.columns[3].values = Values::Number(vec![1.0]);
    refused(&ragged, "table.parquet", "has 1 rows, not 6");
    refused(&table(), "no/such/folder.csv", "no such folder");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    write(&table(), &folder.path().join("Table.PARQUET"), &provenance()).unwrap();
}

/// The file that a link names is written, also where it is not there yet; the link stays.
#[cfg(unix)]
#[test]
fn links_are_written_through() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("data")).unwrap();
    symlink("data/file.csv", at("one.csv")).unwrap();
    symlink(at("one.csv"), at("two.csv")).unwrap();
    for link in ["two.csv", "one.csv"] {
        gaitc::files::try_place(&at(link)).unwrap();
        gaitc::files::write(&at(link), link.as_bytes()).unwrap();
        assert_eq!(fs::read_to_string(at("data/file.csv")).unwrap(), link);
        assert!(fs::symlink_metadata(at("one.csv")).unwrap().is_symlink());
        assert!(fs::symlink_metadata(at("two.csv")).unwrap().is_symlink());
    }
    assert_eq!(fs::read_dir(at("data")).unwrap().count(), 1, "nothing is left beside the file");
    symlink("round.csv", at("round.csv")).unwrap();
    symlink("nowhere/file.csv", at("lost.csv")).unwrap();
    for link in ["round.csv", "lost.csv"] {
        assert!(gaitc::files::try_place(&at(link)).is_err() && gaitc::files::write(&at(link), b"x").is_err(), "{link}");
        assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink());
    }
    assert!(!Path::new("nowhere").exists());
}
