//! A chunk as a file: the values of some rows, to the last bit.
//!
//! Layout: a line that names the format; the hash of the study; number of the chunk, number of rows (64 bits, little-endian as all
//! that follows); column by column the values (doubles and integers with 8 bytes, texts with their length before them); last the
//! SHA-256 of everything before it.

use super::manifest::Manifest;
use crate::table::{Table, Values};
use sha2::{Digest as _, Sha256};

const HEAD: &[u8] = b"gaitc chunk 1\n";
const HASH: usize = 32;

/// The bytes of a chunk.
pub(super) fn encode(manifest: &Manifest, number: u64, rows: &Table) -> Vec<u8> {
    let mut bytes = HEAD.to_vec();
    bytes.extend(manifest.hash());
    bytes.extend(number.to_le_bytes());
    bytes.extend((rows.rows() as u64).to_le_bytes());
    for column in &rows.columns {
        match &column.values {
            // One NaN of many: which one an operation gives is up to the processor.
            Values::Number(values) => {
                let canonical = |v: &f64| if v.is_nan() { f64::NAN } else { *v };
                bytes.extend(values.iter().flat_map(|v| canonical(v).to_le_bytes()));
            }
            Values::Integer(values) => bytes.extend(values.iter().flat_map(|v| v.to_le_bytes())),
            Values::Text(values) => {
                for text in values {
                    bytes.extend((text.len() as u64).to_le_bytes());
                    bytes.extend(text.as_bytes());
                }
            }
        }
    }
    let hash: [u8; HASH] = Sha256::digest(&bytes).into();
    bytes.extend(hash);
    bytes
}

/// The rows of a chunk; `None` where the bytes are not those of this chunk of this study.
pub(super) fn decode(manifest: &Manifest, number: u64, bytes: &[u8]) -> Option<Table> {
    let (body, hash) = bytes.split_at_checked(bytes.len().checked_sub(HASH)?)?;
    if Sha256::digest(body).as_slice() != hash {
        return None;
    }
    let mut rest = Rest(body.strip_prefix(HEAD)?.strip_prefix(&manifest.hash())?);
    let expected = manifest.rows(number);
    let rows = expected.end - expected.start;
    if rest.integer()? != number || rest.integer()? != rows {
        return None;
    }
    let mut table = manifest.table();
    for column in &mut table.columns {
        for _ in 0..rows {
            match &mut column.values {
                Values::Number(values) => values.push(f64::from_le_bytes(rest.word()?)),
                Values::Integer(values) => values.push(i64::from_le_bytes(rest.word()?)),
                Values::Text(values) => {
                    let length = usize::try_from(rest.integer()?).ok()?;
                    values.push(String::from_utf8(rest.take(length)?.to_vec()).ok()?);
                }
            }
        }
    }
    rest.0.is_empty().then_some(table)
}

/// What has not been read yet.
struct Rest<'b>(&'b [u8]);

impl<'b> Rest<'b> {
    fn take(&mut self, length: usize) -> Option<&'b [u8]> {
        let (first, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(first)
    }

    fn word(&mut self) -> Option<[u8; 8]> {
        self.take(8)?.try_into().ok()
    }

    fn integer(&mut self) -> Option<u64> {
        self.word().map(u64::from_le_bytes)
    }
}
