//! The files beside the one that is linted.

use edskit_model::Datasheet;
use std::rc::Rc;

/// The files beside the one that is linted, which a caller with a file system can offer.
///
/// A nodelist.cpj names DCFs, and a DCF names files that go into or come out of a device. Checks that need those stay
/// silent without this. Names are relative to the folder of the linted file, with `/` or `\` between their parts, as
/// the file writes them.
pub trait Neighbours {
    /// Whether there is such a file; `None` where that cannot be told.
    fn exists(&self, relative: &str) -> Option<bool>;

    /// The file, read; `None` where there is none, or it cannot be read.
    fn sheet(&self, relative: &str) -> Option<Rc<Datasheet>>;
}
