//! Pictures of a terminal for the README, made of what the command line really prints.

use crate::edskit;
use anstyle_svg::{Term, WIN10_CONSOLE};

/// A picture in `docs/pictures/`.
pub struct Picture {
    /// The file's name.
    pub file_name: &'static str,
    /// The arguments of `edskit`, in the folder `tests/`.
    pub arguments: &'static [&'static str],
}

/// Every picture.
pub const PICTURES: [Picture; 3] = [
    Picture {
        file_name: "lint-eds.svg",
        arguments: &["lint", "--ignore", "OBJ016", "fixtures/CANopenGateway.published.eds"],
    },
    Picture { file_name: "lint-dcf.svg", arguments: &["lint", "fixtures/broken.dcf"] },
    Picture {
        file_name: "config-check.svg",
        arguments: &["config", "check", "fixtures/gateway/node-2.toml"],
    },
];

impl Picture {
    /// The picture as SVG: the command, and what it prints.
    pub fn render(&self) -> String {
        let output = edskit(&[self.arguments, &["--color", "always"]].concat());
        let screen = format!("$ edskit {}\n\n{}", self.arguments.join(" "), output.stdout);
        let mut svg = Term::new().palette(WIN10_CONSOLE).render_svg(&screen);
        svg.truncate(svg.trim_end().len());
        svg.push('\n');
        svg
    }
}
