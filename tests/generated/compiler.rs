//! Packages of tests, compiled by cargo.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of packages that use the crates of this repository, below the folder of build results.
pub(crate) struct Packages {
    folder: PathBuf,
    names: Vec<String>,
}

impl Packages {
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        // What an earlier run may have left.
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("the folder can be made");
        Self { folder, names: Vec::new() }
    }

    /// A device's package whose library is made of these modules. Nothing in it may give a warning.
    pub(crate) fn add_library<'a>(&mut self, name: &str, modules: impl IntoIterator<Item = &'a str>) {
        let lints = "#![no_std]\n#![deny(warnings, missing_docs, rustdoc::all)]\n#![forbid(unsafe_code)]\n";
        let modules: String = modules.into_iter().collect();
        self.add(name, "", &[("src/lib.rs", &format!("//! A test.\n{lints}{modules}"))]);
    }

    /// A package with these dependencies besides the runtime, and these files.
    pub(crate) fn add(&mut self, name: &str, dependencies: &str, files: &[(&str, &str)]) {
        let runtime = dependency("edskit-runtime");
        let head = format!("[package]\nname = \"{name}\"\nedition = \"2024\"\nrust-version = \"1.88\"\n");
        let manifest = format!("{head}\n[dependencies]\n{runtime}\n{dependencies}");
        self.write(&format!("{name}/Cargo.toml"), &manifest);
        for (path, text) in files {
            self.write(&format!("{name}/{path}"), text);
        }
        self.names.push(name.to_owned());
    }

    /// Runs `cargo` in the folder.
    pub(crate) fn cargo(&self, arguments: &[&str]) -> Output {
        let members: Vec<String> = self.names.iter().map(|name| format!("{name:?}")).collect();
        self.write(
            "Cargo.toml",
            &format!("[workspace]\nresolver = \"3\"\nmembers = [{}]\n", members.join(", ")),
        );
        let lock = fs::read_to_string(edskit_tests::root().join("Cargo.lock")).expect("there is a lock file");
        self.write("Cargo.lock", &lock);
        let mut command = Command::new(env!("CARGO"));
        command.args(arguments).arg("--offline").current_dir(&self.folder);
        // Results are shared between the tests, and not with the build that runs them.
        command.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).join("target"));
        command.env("CARGO_PROFILE_DEV_DEBUG", "0").env("CARGO_INCREMENTAL", "0");
        command.env("CARGO_TERM_COLOR", "never").env_remove("RUSTFLAGS");
        command.output().expect("cargo runs")
    }

    /// Runs a command of cargo over every package, and says what the compiler says where it does not like one.
    pub(crate) fn all(&self, command: &str) {
        let output = self.cargo(&[command, "--workspace"]);
        assert!(output.status.success(), "{}", stderr(&output));
    }

    pub(crate) fn write(&self, path: &str, text: &str) {
        let path = self.folder.join(path);
        fs::create_dir_all(path.parent().expect("a file has a folder")).expect("the folder can be made");
        fs::write(path, text).expect("the file can be written");
    }

    /// What cargo printed, without the folder's own path and what other tests are to blame for.
    pub(crate) fn clean(&self, output: &Output) -> String {
        let text = stderr(output).replace(self.folder.to_str().expect("the path is UTF-8"), "<folder>");
        let is_waiting = |line: &&str| line.trim_start().starts_with("Blocking waiting");
        text.lines().filter(|line| !is_waiting(line)).flat_map(|line| [line, "\n"]).collect()
    }
}

/// A crate of this repository as a dependency.
pub(crate) fn dependency(name: &str) -> String {
    let path = edskit_tests::root().join("crates").join(name);
    format!("{name} = {{ path = {path:?} }}\n")
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
