//! The codes of all diagnostics. Each has an entry in `docs/errors.md` and at least one test.

macro_rules! codes {
    ($($variant:ident $text:literal $title:literal;)*) => {
        /// What kind of problem a diagnostic reports.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[allow(missing_docs)] // the titles below say it
        pub enum Code { $($variant,)* }

        impl Code {
            /// All codes, in order.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// As printed, e.g. `E0201`.
            pub const fn as_str(self) -> &'static str {
                match self { $(Self::$variant => $text,)* }
            }

            /// One line that says what the code stands for.
            pub const fn title(self) -> &'static str {
                match self { $(Self::$variant => $title,)* }
            }
        }
    };
}

codes! {
    Toml "E0001" "the file is not valid TOML";
    File "E0002" "the file cannot be read as a spec";
    UnknownKey "E0003" "unknown key or table";
    MissingKey "E0004" "a key or table is missing";
    WrongType "E0005" "a value has the wrong type";
    BadValue "E0006" "a value is not one of those that the key takes";
    NameMismatch "E0008" "the model's name and the file's name differ";
    TooLarge "E0009" "a table has too many entries";
    PartFile "E0010" "a part cannot be found or read";
    PartTable "E0011" "a part has what only a spec can have";
    PartCycle "E0012" "parts that use each other";
    PartUse "E0013" "a part does not have what its user changes";
    Syntax "E0101" "an expression cannot be read";
    Number "E0102" "a number cannot be read";
    TooComplex "E0103" "an expression is too long or nested too deeply";
    Unit "E0104" "unknown or malformed unit";
    Arguments "E0105" "wrong number of arguments";
    Condition "E0106" "a condition where a number is expected, or the reverse";
    NotConstant "E0107" "a quantity is not constant";
    NotFinite "E0108" "a constant is not a finite number";
    UndefinedName "E0201" "undefined name";
    UndefinedFunction "E0202" "undefined function";
    DefinedTwice "E0203" "a name is defined twice";
    ReservedName "E0204" "a name belongs to the language";
    InvalidName "E0205" "not a valid name";
    Cycle "E0206" "definitions that need each other";
    NotAvailable "E0207" "a quantity has no value in this place";
    WrongKind "E0208" "a function used as a value, or a value called as a function";
    WithRespectTo "E0209" "not a variable to differentiate with respect to";
    Clash "E0301" "two sides have different dimensions";
    EquationDimension "E0302" "an equation has the wrong dimension";
    NotDimensionless "E0303" "an argument must be dimensionless";
    Exponent "E0304" "an exponent of something with a dimension must be a constant fraction";
    MissingUnit "E0305" "a unit is missing or has the wrong dimension";
    DimensionOverflow "E0306" "the exponent of a dimension is out of range";
    MissingEquation "E0401" "a state has no equation";
    UnknownReference "E0402" "a mode, transition, state or parameter that does not exist";
    GuardConstant "E0403" "a guard that can never cross zero";
    Range "E0404" "a range is empty or excludes the value";
    GivenTwice "E0405" "something is given twice";
    MemoryNotInteger "E0406" "a memory would not stay an integer";
    SuperfluousEquation "E0407" "an equation that does not belong here";
    ConstraintForm "E0408" "not a constraint";
    ProblemForm "E0409" "a problem needs exactly one objective and something to vary";
    Mass "E0410" "a mass matrix that is singular everywhere";
    NoReturn "E0411" "no run comes back to the section";
    ClockOnSection "E0412" "the time since the last transition is not known on the section";
    OffSection "E0413" "the embedding does not lie on the section";
    Unused "W0001" "something is defined and never used";
    ZeroDerivative "W0002" "a derivative that is always zero";
    Unreachable "W0003" "a mode that no run reaches";
    NoInvolution "W0004" "a symmetry that is not its own inverse";
    NotInvariant "W0005" "the model is not invariant under its symmetry";
    HeldMoves "W0006" "a held point moves";
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.as_str())
    }
}
