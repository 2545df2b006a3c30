//! Back ends: code from validated models.

pub mod rust;
