//! For build scripts: the one part of the crate that knows files, the environment, and cargo.

use crate::{Naming, Problem, generate, module_name, settings};
use edskit_lint::{Linter, Profile, RuleSet};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf, absolute};
use std::sync::{Mutex, PoisonError};
use std::{env, fs};

/// Generates the dictionary of an EDS or DCF, whose path is seen from the package; for build scripts.
///
/// ```no_run
/// // in fn main() of build.rs
/// edskit_codegen::compile("eds/Device.eds");
/// ```
///
/// The module `device` lies in `$OUT_DIR/Device.rs` afterwards, and `edskit_runtime::include_dictionary!("Device")` takes
/// it in. A side-file `eds/Device.toml` is read where there is one, and noticed when it is made later. What makes the dictionary wrong or ambiguous becomes an
/// error of cargo and fails the build; everything else that the linter and the generator say becomes a warning of cargo.
/// `edskit.toml`, found upwards from the EDS, and comments `;edskit: allow(RULE)` count as in `edskit lint`.
pub fn compile(eds: impl AsRef<Path>) {
    Config::new().compile(eds);
}

/// [`compile`] with other than the usual settings.
///
/// ```no_run
/// // in fn main() of build.rs
/// edskit_codegen::Config::new().name("pump").runtime("::device_support::edskit_runtime").compile("eds/Device.eds");
/// ```
#[derive(Clone, Default, Debug)]
pub struct Config {
    name: Option<String>,
    side_file: Option<PathBuf>,
    runtime: Option<String>,
    out_dir: Option<PathBuf>,
    rules: Option<RuleSet>,
    allowed: Vec<String>,
}

impl Config {
    /// The usual settings.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// What the output is called, instead of the EDS's own name: the file without `.rs`, and in lower case with
    /// underscores the module.
    #[must_use]
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// The side-file, which then has to exist, instead of the one beside the EDS.
    #[must_use]
    pub fn side_file(mut self, path: impl Into<PathBuf>) -> Self {
        self.side_file = Some(path.into());
        self
    }

    /// The path of the crate `edskit-runtime` in the generated code, instead of `::edskit_runtime`.
    #[must_use]
    pub fn runtime(mut self, path: impl Into<String>) -> Self {
        self.runtime = Some(path.into());
        self
    }

    /// The folder of the output, instead of `OUT_DIR`.
    #[must_use]
    pub fn out_dir(mut self, path: impl Into<PathBuf>) -> Self {
        self.out_dir = Some(path.into());
        self
    }

    /// The rules that the EDS is held to, instead of those of `edskit.toml` or, without one, those that are on where nobody
    /// says anything.
    ///
    /// ```no_run
    /// use edskit_codegen::{Config, RuleSet, Severity};
    /// let mut rules = RuleSet::default();
    /// rules.set_severity("OBJ015", Severity::Error).unwrap();
    /// Config::new().rules(rules).compile("eds/Device.eds");
    /// ```
    #[must_use]
    pub fn rules(mut self, rules: RuleSet) -> Self {
        self.rules = Some(rules);
        self
    }

    /// Switches a rule off, by its code, its name, or a prefix of codes; a name that is none fails the build.
    ///
    /// ```no_run
    /// edskit_codegen::Config::new().allow("VAL003").allow("PDO").compile("eds/Device.eds");
    /// ```
    #[must_use]
    pub fn allow(mut self, rule: impl Into<String>) -> Self {
        self.allowed.push(rule.into());
        self
    }

    /// Generates the dictionary of an EDS or DCF as [`compile`] does.
    pub fn compile(&self, eds: impl AsRef<Path>) {
        // Cargo fails the build for each `cargo::error`, and shows these alone where the script itself ends well. Where
        // standard output is gone, there is nobody to tell.
        let _ = self.run(eds.as_ref(), env::var_os("OUT_DIR"), &mut io::stdout().lock());
    }

    /// Writes what cargo is to know into `cargo`.
    fn run(&self, eds: &Path, out_dir: Option<OsString>, cargo: &mut dyn Write) -> io::Result<()> {
        let naming = self.naming(eds);
        let inputs = match self.read(eds, Path::new(&naming.side_file), cargo)? {
            Ok(inputs) => inputs,
            Err(message) => return say(cargo, "error", &message),
        };
        let linter = match self.linter(eds, cargo)? {
            Ok(linter) => linter,
            Err(message) => return say(cargo, "error", &message),
        };
        let line = |problem: &Problem| problem.line(&naming.eds, &naming.side_file).to_string();
        let generated = match generate(&inputs.eds, inputs.side_file.as_deref(), &naming, &linter) {
            Ok(generated) => generated,
            Err(problems) => {
                return problems.iter().try_for_each(|problem| say(cargo, "error", &line(problem)));
            }
        };
        for problem in &generated.warnings {
            say(cargo, "warning", &line(problem))?;
        }
        let Some(folder) = self.out_dir.clone().or_else(|| out_dir.map(PathBuf::from)) else {
            let message =
                "OUT_DIR is not set: call this in a build script, or name a folder with Config::out_dir";
            return say(cargo, "error", message);
        };
        let path = folder.join(self.file_name(eds));
        let source = Source::new(eds, &naming.side_file);
        if let Some(other) = source.in_the_way(&path, &generated.code) {
            let (eds, path, other) = (eds.display(), path.display(), other.display());
            let message = format!(
                "{eds}: {path} is the dictionary of {other} already; give one of them a name of its own with Config::name"
            );
            return say(cargo, "error", &message);
        }
        match write_if_changed(&path, &generated.code) {
            Ok(_) => Ok(()),
            Err(error) => say(cargo, "error", &format!("{}: {error}", path.display())),
        }
    }

    /// The linter with the rules that hold for the EDS.
    fn linter(&self, eds: &Path, cargo: &mut dyn Write) -> io::Result<Result<Linter, String>> {
        let mut profiles = Vec::new();
        let mut rules = self.rules.clone().unwrap_or_default();
        let whole = absolute(eds).unwrap_or_else(|_| eds.to_path_buf());
        let candidates = whole.ancestors().skip(1).map(|folder| (folder, folder.join(settings::FILE_NAME)));
        let found = candidates.into_iter().find(|(_, path)| self.rules.is_none() && path.is_file());
        if let Some((folder, path)) = found {
            say(cargo, "rerun-if-changed", &path.to_string_lossy())?;
            let wrong = |error: &dyn core::fmt::Display| Ok(Err(format!("{}:{error}", path.display())));
            let text = match fs::read_to_string(&path) {
                Ok(text) => text,
                Err(error) => return wrong(&error),
            };
            let relative = whole.strip_prefix(folder).unwrap_or(&whole).to_string_lossy().replace('\\', "/");
            let said = match settings::rules_for(&text, &relative) {
                Ok(said) => said,
                Err(error) => return wrong(&error),
            };
            rules = said.rules;
            for name in said.profiles {
                let path = folder.join(name);
                say(cargo, "rerun-if-changed", &path.to_string_lossy())?;
                let read = fs::read_to_string(&path).map_err(|error| error.to_string());
                match read.and_then(|text| Profile::parse(&text).map_err(|error| error.to_string())) {
                    Ok(profile) => profiles.push(profile),
                    Err(error) => return Ok(Err(format!("{}: {error}", path.display()))),
                }
            }
        }
        for selector in &self.allowed {
            if let Err(error) = rules.ignore(selector) {
                return Ok(Err(format!("Config::allow: {error}")));
            }
        }
        Ok(Ok(Linter::new(rules).with_profiles(profiles)))
    }

    fn naming(&self, eds: &Path) -> Naming {
        let mut naming = Naming::of(&eds.to_string_lossy());
        if let Some(name) = &self.name {
            naming.module = module_name(name);
        }
        if let Some(side_file) = &self.side_file {
            naming.side_file = side_file.to_string_lossy().into_owned();
        }
        if let Some(runtime) = &self.runtime {
            naming.runtime.clone_from(runtime);
        }
        naming
    }

    /// `Device.rs`
    fn file_name(&self, eds: &Path) -> OsString {
        let stem = || eds.file_stem().unwrap_or_default().to_owned();
        let mut name = self.name.as_ref().map_or_else(stem, OsString::from);
        name.push(".rs");
        name
    }

    /// Reads the inputs and says that the script depends on them.
    fn read(
        &self,
        eds: &Path,
        side_file: &Path,
        cargo: &mut dyn Write,
    ) -> io::Result<Result<Inputs, String>> {
        let wrong = |path: &Path, error: io::Error| Err(format!("{}: {error}", path.display()));
        say(cargo, "rerun-if-changed", &eds.to_string_lossy())?;
        let eds_bytes = match fs::read(eds) {
            Ok(bytes) => bytes,
            Err(error) => return Ok(wrong(eds, error)),
        };
        if self.side_file.is_none() && !side_file.exists() {
            say(cargo, "rerun-if-changed", &place_of_later(eds, side_file).to_string_lossy())?;
            return Ok(Ok(Inputs { eds: eds_bytes, side_file: None }));
        }
        say(cargo, "rerun-if-changed", &side_file.to_string_lossy())?;
        Ok(match fs::read_to_string(side_file) {
            Ok(text) => Ok(Inputs { eds: eds_bytes, side_file: Some(text) }),
            Err(error) => wrong(side_file, error),
        })
    }
}

struct Inputs {
    eds: Vec<u8>,
    side_file: Option<String>,
}

/// What cargo has to look at in order to notice a side-file that is made later. A file that does not exist makes every build
/// begin anew, but the folder of the EDS changes when it is made. The package's own folder cannot be looked at instead: what
/// cargo builds lies in it.
fn place_of_later<'a>(eds: &'a Path, side_file: &'a Path) -> &'a Path {
    let folder = eds.parent().filter(|folder| folder.components().any(|part| part != Component::CurDir));
    folder.unwrap_or(side_file)
}

/// What a dictionary was made from.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Source {
    eds: PathBuf,
    side_file: PathBuf,
}

/// What this build script has written, by its path in small letters, since some file systems do not tell them apart.
static WRITTEN: Mutex<BTreeMap<String, (Source, String)>> = Mutex::new(BTreeMap::new());

impl Source {
    fn new(eds: &Path, side_file: &str) -> Self {
        let whole = |path: &Path| absolute(path).unwrap_or_else(|_| path.to_path_buf());
        Self { eds: whole(eds), side_file: whole(Path::new(side_file)) }
    }

    /// The EDS whose dictionary the same script has written there, if that is another one; else the place is this one's.
    fn in_the_way(self, path: &Path, code: &str) -> Option<PathBuf> {
        let mut written = WRITTEN.lock().unwrap_or_else(PoisonError::into_inner);
        let key = path.to_string_lossy().to_lowercase();
        match written.get(&key) {
            Some((source, other)) if *source != self && other != code => Some(source.eds.clone()),
            _ => {
                written.insert(key, (self, code.to_owned()));
                None
            }
        }
    }
}

/// One instruction for cargo, which is one line: `cargo::warning=..`.
fn say(cargo: &mut dyn Write, key: &str, value: &str) -> io::Result<()> {
    let value: String = value.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    writeln!(cargo, "cargo::{key}={value}")
}

/// Writes a file unless it holds that text already: what depends on it is then not built again. Says whether it was
/// written.
///
/// # Errors
/// Where the file or its folder cannot be written.
pub fn write_if_changed(path: &Path, text: &str) -> io::Result<bool> {
    if fs::read(path).is_ok_and(|present| present == text.as_bytes()) {
        return Ok(false);
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, text)?;
    Ok(true)
}

#[cfg(test)]
mod tests;
