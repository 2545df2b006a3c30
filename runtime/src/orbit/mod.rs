//! Periodic orbits.
