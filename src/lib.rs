//! gaitc.
