//! Studies: questions about many gaits at once. They see a model only through its return map.

pub mod continuation;
