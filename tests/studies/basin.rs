//! Basins: which starts lead where.

use crate::common::json;
use crate::{at, done};
use std::fs;
