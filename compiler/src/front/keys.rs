//! The keys of each table of the language: what the reader accepts, and what the JSON Schema describes.

/// All keys of a spec.
pub(crate) const SPEC: &[&str] = &[
    "spec",
    "name",
    "title",
    "source",
    "use",
    "parameters",
    "state",
    "memory",
    "let",
    "functions",
    "modes",
    "transitions",
    "surfaces",
    "section",
    "measures",
    "problems",
    "drawing",
    "published",
];

/// Those that only a spec can have, and why.
pub(crate) const OF_SPECS_ONLY: &[(&str, &str)] = &[
    ("name", "only a model has a name; a part is known by its file"),
    ("transitions", "what a machine does at an event is said in the spec that uses the part"),
    ("surfaces", "where a map begins is said in the spec that uses the part"),
    ("section", "where a map begins is said in the spec that uses the part"),
];

/// Of `[use.ROLE]`.
pub(crate) const USE: &[&str] = &["part", "rename", "set", "fix"];
/// Of a parameter.
pub(crate) const PARAMETER: &[&str] = &["value", "range", "doc"];
/// Of a state.
pub(crate) const STATE: &[&str] = &["unit", "doc", "modes"];
/// Of a memory.
pub(crate) const MEMORY: &[&str] = &["initial", "doc"];
/// Of a function.
pub(crate) const FUNCTION: &[&str] = &["args", "expr", "doc"];
/// Of `[modes.NAME]`.
pub(crate) const MODE: &[&str] = &["flow", "mass", "doc"];
/// Of `[transitions.NAME]`.
pub(crate) const TRANSITION: &[&str] = &["from", "to", "guard", "direction", "when", "reset", "also_zero", "doc"];
/// In which a guard passes through zero.
pub(crate) const DIRECTIONS: &[&str] = &["falling", "rising", "either"];
/// Of `[surfaces.NAME]`.
pub(crate) const SURFACE: &[&str] = &["mode", "guard", "direction", "doc"];
/// Of `[section]`.
pub(crate) const SECTION: &[&str] = &["after", "before", "at", "coordinates", "embed", "start", "symmetry", "doc"];
/// Of a measure.
pub(crate) const MEASURE: &[&str] = &["expr", "unit", "doc"];
/// Of `[drawing]`.
pub(crate) const DRAWING: &[&str] = &["velocity", "points", "links", "panels"];
/// Of a point of `[drawing.points]`.
pub(crate) const DRAWN_POINT: &[&str] = &["at", "modes", "held", "doc"];
/// Of `[published.NAME]`.
pub(crate) const PUBLISHED: &[&str] = &["doc", "source", "set", "start", "measures", "section", "spread"];
/// The most maps that one gait can be made of: longer periods are not gaits that anybody could tell from chaos.
pub const LONGEST_PERIOD: usize = 1000;
/// The most parameters that a problem can be robust over: more have more scenarios than anybody would wait for.
pub const MOST_ROBUST: usize = 12;
/// Of `[problems.NAME]`.
pub(crate) const PROBLEM: &[&str] =
    &["doc", "default", "maximize", "minimize", "vary", "robust", "subject_to", "period"];
