//! The cuts between the crates. The tables are the rule and its documentation: what is not in them is not allowed.

use cargo_metadata::{Dependency, DependencyKind, Metadata, MetadataCommand, Package};
use edskit_tests::rust_sources;
use std::fs;
use std::path::{Path, PathBuf};

/// What may be depended on besides crates of this workspace.
enum Libraries {
    /// Only these.
    Only(&'static [&'static str]),
    /// Any: a crate at the outer edge, which knows terminals, files and formats.
    Any,
}

use Libraries::{Any, Only};

/// Each crate with the crates of this workspace and the libraries that it may depend on.
const ALLOWED: &[(&str, &[&str], Libraries)] = &[
    ("edskit-types", &[], Only(&[])),
    ("edskit-model", &["edskit-types"], Only(&["encoding_rs", "ini_core", "serde"])),
    ("edskit-lint", &["edskit-types", "edskit-model"], Only(&["globset", "serde", "toml"])),
    ("edskit-devices", &["edskit-types", "edskit-runtime", "edskit-codegen"], Only(&["heapless"])),
    ("edskit-host", &["edskit-types", "edskit-runtime"], Any),
    ("edskit-runtime", &["edskit-types"], Only(&["embedded-can"])),
    (
        "edskit-codegen",
        &["edskit-types", "edskit-model", "edskit-lint", "edskit-runtime"],
        Only(&["askama", "serde", "toml"]),
    ),
    (
        "edskit",
        &[
            "edskit-types",
            "edskit-model",
            "edskit-lint",
            "edskit-devices",
            "edskit-codegen",
            "edskit-runtime",
            "edskit-host",
            // Only for tests that need the command itself.
            "edskit-tests",
        ],
        Any,
    ),
    (
        "edskit-tests",
        &[
            "edskit-types",
            "edskit-model",
            "edskit-lint",
            "edskit-devices",
            "edskit-runtime",
            "edskit-codegen",
            "edskit-host",
            "edskit",
        ],
        Any,
    ),
    ("edskit-tests-device", &["edskit-codegen", "edskit-runtime", "edskit-host"], Any),
    (
        "edskit-benches",
        &["edskit-types", "edskit-model", "edskit-lint", "edskit-runtime", "edskit-codegen", "edskit-tests"],
        Any,
    ),
    ("xtask", &[], Any),
];

/// What only the outer edge may name: files, the network, processes, clocks, the terminal.
const OUTER_WORDS: &[&str] = &[
    "std::env",
    "std::fs",
    "std::io",
    "std::net",
    "std::os",
    "std::path",
    "std::process",
    "std::thread",
    "std::time",
    "Instant::now",
    "SystemTime",
    "print!",
    "println!",
    "eprint!",
    "eprintln!",
];

/// The crates that run on a device. Of the workspace they depend on each other only; a build script may on more.
const DEVICE_CRATES: [&str; 3] = ["edskit-types", "edskit-runtime", "edskit-devices"];

/// The one file of a library that may: it is for build scripts, which read and write files and talk to cargo.
const BUILD_SCRIPT_FILE: &str = "edskit-codegen/src/compile.rs";

/// The files that may hold unsafe code: a critical section and an allocator are unsafe by their traits, and the code that
/// zencan-build generates holds some.
const UNSAFE_FILES: [&str; 2] = ["benches/node/zencan.rs", "tests/src/allocation.rs"];

#[test]
fn every_crate_depends_only_on_what_the_table_allows() {
    let metadata = metadata();
    for package in metadata.workspace_packages() {
        let (_, crates, libraries) = ALLOWED
            .iter()
            .find(|(name, ..)| package.name == *name)
            .unwrap_or_else(|| panic!("{}: give the crate a line in the table ALLOWED", package.name));
        for dependency in &package.dependencies {
            let name = dependency.name.as_str();
            let allowed = match (is_of_workspace(dependency), libraries) {
                // Also for tests: they belong to the crate that has both sides.
                (true, _) => crates.contains(&name),
                (false, Only(libraries)) => {
                    dependency.kind == DependencyKind::Development || libraries.contains(&name)
                }
                (false, Any) => true,
            };
            assert!(allowed, "{} must not depend on {name}", package.name);
        }
    }
}

#[test]
fn the_table_names_only_crates_that_exist() {
    let metadata = metadata();
    for (name, ..) in ALLOWED {
        assert!(metadata.workspace_packages().iter().any(|package| package.name == *name), "{name} is gone");
    }
}

#[test]
fn every_crate_takes_lints_licence_and_toolchain_from_the_workspace() {
    for package in metadata().workspace_packages() {
        let manifest = read(package.manifest_path.as_std_path());
        for wanted in [
            "[lints]\nworkspace = true",
            "license.workspace = true",
            "edition.workspace = true",
            "rust-version.workspace = true",
        ] {
            assert!(manifest.contains(wanted), "{}: the manifest lacks {wanted:?}", package.name);
        }
        assert_eq!(package.license.as_deref(), Some("MIT OR Apache-2.0"), "{}", package.name);
        assert!(package.description.is_some(), "{}: the manifest lacks a description", package.name);
    }
}

#[test]
fn libraries_open_no_file_print_nothing_and_know_no_clock() {
    for package in libraries(&metadata()) {
        for (path, text) in rust_sources(&source_folder(package)) {
            if path.ends_with(BUILD_SCRIPT_FILE) || path.ends_with("edskit-codegen/src/compile/tests.rs") {
                continue;
            }
            for (number, line) in text.lines().enumerate() {
                let code = line.split("//").next().unwrap_or_default();
                for word in OUTER_WORDS {
                    assert!(!has_word(code, word), "{}:{}: {word}", path.display(), number + 1);
                }
            }
        }
    }
}

#[test]
fn crates_for_devices_need_neither_std_nor_an_allocator() {
    for package in device_crates(&metadata()) {
        for (path, text) in rust_sources(&source_folder(package)) {
            let is_root = path.ends_with("src/lib.rs");
            assert!(!is_root || text.contains("#![no_std]\n"), "{} lacks #![no_std]", path.display());
            assert!(!text.contains("extern crate alloc"), "{}: no allocation", path.display());
        }
    }
}

#[test]
fn crates_for_devices_depend_on_the_desk_half_in_build_scripts_only() {
    for package in device_crates(&metadata()) {
        for dependency in package.dependencies.iter().filter(|dependency| is_of_workspace(dependency)) {
            let name = dependency.name.as_str();
            let is_of_build_script = dependency.kind == DependencyKind::Build;
            assert!(
                is_of_build_script || DEVICE_CRATES.contains(&name),
                "{} must not depend on {name}, but its build script may",
                package.name
            );
        }
    }
}

/// The workspace denies unsafe code, so it takes an `allow` to write some.
#[test]
fn unsafe_code_stands_in_few_files_only() {
    let root = edskit_tests::root();
    let mut found = Vec::new();
    for folder in ["crates", "tests", "benches"] {
        for (path, text) in rust_sources(&root.join(folder)) {
            if text.lines().any(|line| has_word(line, "unsafe_code") && !line.contains("forbid")) {
                found.push(path.strip_prefix(&root).expect("sources are in the repository").to_owned());
            }
        }
    }
    found.retain(|path| path != Path::new(file!()));
    found.sort();
    assert_eq!(found, UNSAFE_FILES.map(PathBuf::from));
}

fn metadata() -> Metadata {
    let mut command = MetadataCommand::new();
    command.current_dir(edskit_tests::root()).no_deps();
    command.exec().expect("cargo metadata runs")
}

fn is_of_workspace(dependency: &Dependency) -> bool {
    dependency.path.is_some()
}

/// The crates of the table that have a fixed list of libraries.
fn libraries(metadata: &Metadata) -> Vec<&Package> {
    let is_library = |package: &&Package| {
        ALLOWED.iter().any(|(name, _, libraries)| package.name == *name && matches!(libraries, Only(_)))
    };
    let libraries: Vec<&Package> = metadata.workspace_packages().into_iter().filter(is_library).collect();
    assert_eq!(libraries.len(), 6);
    libraries
}

fn device_crates(metadata: &Metadata) -> Vec<&Package> {
    let is_on_device = |package: &&Package| DEVICE_CRATES.contains(&package.name.as_str());
    let packages: Vec<&Package> = metadata.workspace_packages().into_iter().filter(is_on_device).collect();
    assert_eq!(packages.len(), DEVICE_CRATES.len());
    packages
}

fn source_folder(package: &Package) -> PathBuf {
    package.manifest_path.parent().expect("a manifest lies in a folder").join("src").into_std_path_buf()
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Whether `word` stands in `line` and is not a part of a longer word.
fn has_word(line: &str, word: &str) -> bool {
    let is_part = |character: char| character.is_alphanumeric() || character == '_';
    line.match_indices(word).any(|(start, _)| {
        let before = line[..start].chars().next_back();
        let after = line[start + word.len()..].chars().next();
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}
