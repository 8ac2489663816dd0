//! What is timed: the stages from bytes to findings.

use edskit_lint::{FileKind, Linter, RuleSet};
use edskit_model::{Datasheet, Document};
use std::hint::black_box;
use std::path::Path;

/// The files that are read in one pass.
pub struct Input {
    files: Vec<File>,
}

struct File {
    name: String,
    bytes: Vec<u8>,
    /// The bytes for a lexer that takes nothing but UTF-8, as long as they are.
    text: String,
}

impl Input {
    /// The EDS and DCF files of a folder.
    ///
    /// # Panics
    /// Where the folder or a file cannot be read.
    pub fn of_folder(folder: &Path) -> Self {
        let files = edskit_tests::files(folder, &["eds", "dcf"]);
        Self { files: files.into_iter().map(|file| File::new(file.name, file.bytes)).collect() }
    }

    /// The corpus, or where it is missing the files of the project.
    ///
    /// # Panics
    /// Where a folder or a file cannot be read.
    pub fn corpus() -> Self {
        let root = edskit_tests::root();
        match edskit_tests::shared("the benchmark of the corpus") {
            Some(shared) => Self::of_folder(&shared.join("corpus/files")),
            None => {
                let folders = ["eds", "tests/fixtures"].map(|folder| Self::of_folder(&root.join(folder)));
                Self { files: folders.into_iter().flat_map(|input| input.files).collect() }
            }
        }
    }

    /// One file.
    pub fn of_file(name: &str, bytes: Vec<u8>) -> Self {
        Self { files: vec![File::new(name.to_owned(), bytes)] }
    }

    /// Whether there is no file.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// The bytes of all files.
    pub fn bytes(&self) -> u64 {
        self.files.iter().map(|file| file.bytes.len() as u64).sum()
    }
}

impl File {
    fn new(name: String, bytes: Vec<u8>) -> Self {
        let text = match String::from_utf8(bytes.clone()) {
            Ok(text) => text,
            Err(_) => {
                bytes.iter().map(|&byte| if byte.is_ascii() { char::from(byte) } else { '?' }).collect()
            }
        };
        Self { name, bytes, text }
    }
}

/// A stage on the way from bytes to findings. Each one contains those before it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stage {
    /// Bare iteration of the lexer, the measure of all others.
    IniCore,
    /// To the lossless text.
    Document,
    /// To the typed reading.
    Datasheet,
    /// To the findings of the rules that are on by default.
    Lint,
    /// To the findings of all rules.
    LintAll,
}

impl Stage {
    /// Every stage in order.
    pub const ALL: [Self; 5] = [Self::IniCore, Self::Document, Self::Datasheet, Self::Lint, Self::LintAll];

    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::IniCore => "ini_core",
            Self::Document => "document",
            Self::Datasheet => "datasheet",
            Self::Lint => "lint",
            Self::LintAll => "lint, all rules",
        }
    }

    /// Takes all files of `input` through the stage, one after the other.
    pub fn run(self, input: &Input) {
        let rules = if self == Self::LintAll { RuleSet::all() } else { RuleSet::default() };
        let linter = Linter::new(rules);
        for file in &input.files {
            match self {
                Self::IniCore => ini_core::Parser::new(&file.text).for_each(|item| {
                    black_box(item);
                }),
                Self::Document => {
                    black_box(Document::parse(&file.bytes));
                }
                Self::Datasheet => {
                    black_box(Datasheet::parse(&file.bytes));
                }
                Self::Lint | Self::LintAll => {
                    let sheet = Datasheet::parse(&file.bytes);
                    black_box(linter.lint(&sheet, FileKind::of(&file.name), Some(&file.name)));
                }
            }
        }
    }
}
