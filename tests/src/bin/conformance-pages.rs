//! Writes the pages in `docs/conformance/` again; `cargo xtask docs` calls it.

use edskit_tests::conformance::{Page, device, device_names, evidence};
use edskit_tests::root;
use std::fs;
use std::io::{self, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    match device_names().iter().try_for_each(|name| write(name)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problems) => {
            // Nobody is left to tell where standard error is gone.
            let _ = writeln!(io::stderr(), "{problems}");
            ExitCode::FAILURE
        }
    }
}

fn write(name: &str) -> Result<(), String> {
    let device = device(name)?;
    let page = Page::new(name, &device, &evidence(&device)?)?;
    let path = root().join(format!("docs/conformance/{name}.md"));
    fs::write(&path, page.text).map_err(|error| format!("{}: {error}", path.display()))
}
