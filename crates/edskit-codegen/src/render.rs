//! From a layout to Rust.

mod handles;
mod renamed;
mod view;

use crate::Layout;
use askama::Template;
pub(crate) use handles::{Called, called};
pub(crate) use renamed::renamed;
use view::View;

/// How the generated code is named, and what it names.
#[derive(Clone, Debug)]
pub struct Naming {
    /// The module, which must be an identifier; [`module_name`](crate::module_name) makes one.
    pub module: String,
    /// The EDS as messages name it: its path as seen from the package.
    pub eds: String,
    /// The side-file as messages name it.
    pub side_file: String,
    /// The path of the crate `edskit-runtime`: `::edskit_runtime` unless it is re-exported elsewhere.
    pub runtime: String,
}

impl Naming {
    /// The names for an EDS at this path: the module after its file name, the side-file beside it.
    ///
    /// ```
    /// let naming = edskit_codegen::Naming::of("eds/Device.eds");
    /// assert_eq!((&*naming.module, &*naming.side_file), ("device", "eds/Device.toml"));
    /// ```
    #[must_use]
    pub fn of(eds: &str) -> Self {
        let file_name = file_name(eds);
        let stem = file_name.rsplit_once('.').map_or(file_name, |(stem, _)| stem);
        let end = eds.len() - file_name.len() + stem.len();
        Self {
            module: crate::module_name(stem),
            eds: eds.to_owned(),
            side_file: format!("{}.toml", &eds[..end]),
            runtime: "::edskit_runtime".to_owned(),
        }
    }
}

/// The name of the file at a path. Generated code has no more of the path: it is the same wherever the file lies.
pub(crate) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or_default()
}

/// The Rust code of a dictionary: one module.
///
/// Names of the EDS stand in comments only, and identifiers are made from their letters and digits.
#[must_use]
pub fn render(layout: &Layout, naming: &Naming) -> String {
    render_called(layout, naming, called(layout))
}

/// The same with names that are known.
pub(crate) fn render_called(layout: &Layout, naming: &Naming, called: Vec<Called>) -> String {
    // Neither the view's types nor a string fail to be written.
    View::new(layout, naming, called)
        .render()
        .map(|code| code + "\n")
        .unwrap_or_else(|error| format!("compile_error!({:?});\n", error.to_string()))
}

#[cfg(test)]
mod tests;
