//! Pictures as files: the format by the name, whole or not there.

use super::{Picture, png, svg};
use crate::files::{self, FileError};
use crate::provenance::Provenance;
use std::path::{Path, PathBuf};

/// Why there is no file.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The name says no format that pictures have.
    #[error("{}: a picture is an SVG or a PNG\n  help: end the name in `.svg` or `.png`", .0.display())]
    Format(PathBuf),
    /// The file could not be written.
    #[error(transparent)]
    File(#[from] FileError),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Svg,
    Png,
}

fn format(path: &Path) -> Result<Format, PictureError> {
    let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("svg") => Ok(Format::Svg),
        Some("png") => Ok(Format::Png),
        // A pipe has no name that could end in anything.
        None if std::fs::metadata(path).is_ok_and(|known| !known.is_file() && !known.is_dir()) => Ok(Format::Svg),
        _ => Err(PictureError::Format(path.to_owned())),
    }
}

/// Whether a picture could be written there, found out before the work whose result it is to show.
///
/// # Errors
/// The name says no format, or the place cannot be written.
pub fn check_name(path: &Path) -> Result<(), PictureError> {
    format(path)?;
    Ok(files::try_place(path)?)
}

/// Writes a picture as SVG or PNG, as the name says.
///
/// # Errors
/// The name says neither, or the file system refuses; what stood there is then untouched.
pub fn write(picture: &dyn Picture, path: &Path, provenance: &Provenance) -> Result<(), PictureError> {
    let bytes = match format(path)? {
        Format::Svg => svg::text(&picture.draw(), svg::Setting::File(provenance)).into_bytes(),
        Format::Png => png::bytes(&picture.draw(), provenance).map_err(|error| FileError::writing(path, error))?,
    };
    Ok(files::write(path, &bytes)?)
}
