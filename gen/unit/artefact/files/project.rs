//! The project of the tool that synthesises for the device of a design. Tools that do not know the device get none: they
//! would synthesise for another part than the one that the design is pipelined for.

/// A project, as the README of a design lists it.
pub struct Project {
    /// Where it is.
    pub folder: String,
    /// The tool and its releases.
    pub tool: &'static str,
    /// The part as the tool writes it.
    pub part: String,
    /// How it is started, in its folder.
    pub how: String,
}
