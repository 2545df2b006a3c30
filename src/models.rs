//! The models compiled into this program: mounts what build.rs generated from `specs/`.

#![allow(missing_docs)] // generated code documents itself where it stands

include!(concat!(env!("OUT_DIR"), "/gaitc_models.rs"));

pub use generated::MODELS;
