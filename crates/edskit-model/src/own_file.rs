//! Files of edskit itself, which people give to the wrong command.

/// What a file of edskit is, that is no EDS, DCF or node list.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum OwnFile {
    /// Parameters of a device, TOML.
    Parameters,
    /// What happens to a running device, TOML.
    Scenario,
    /// `edskit.toml`.
    Settings,
    /// A profile of the linter, TOML.
    Profile,
    /// What an EDS cannot say, in a TOML file beside it.
    SideFile,
    /// A baseline of the linter, JSON.
    Baseline,
}

/// What begins a line of each kind of file: a key or the name of a table. No two kinds share one.
const MARKS: [(OwnFile, &[&str]); 5] = [
    (OwnFile::Parameters, &["device", "gateway", "governor", "governor.signals"]),
    (OwnFile::Scenario, &["step", "step.gateway", "step.governor", "step.engine", "step.read"]),
    (
        OwnFile::Settings,
        &[
            "select",
            "extend-select",
            "ignore",
            "profiles",
            "exclude",
            "fail-on",
            "baseline",
            "severity",
            "override",
            "override.severity",
        ],
    ),
    (OwnFile::Profile, &["device-profile", "object", "require"]),
    (OwnFile::SideFile, &["optional", "variable", "rpdo", "storage", "capacity", "unit", "extra"]),
];

impl OwnFile {
    /// Which of them a text is; `None` for anything else. Only keys and tables of one kind may stand in it, so that a
    /// damaged EDS is none.
    ///
    /// ```
    /// use edskit_model::own_file::OwnFile;
    /// assert_eq!(OwnFile::of("# pump room\n[gateway]\n427 = 5\n"), Some(OwnFile::Parameters));
    /// assert_eq!(OwnFile::of("[[step]]\nat = 1\n"), Some(OwnFile::Scenario));
    /// assert_eq!(OwnFile::of("[FileInfo]\n"), None);
    /// ```
    #[must_use]
    pub fn of(text: impl AsRef<[u8]>) -> Option<Self> {
        let text = text.as_ref();
        let text = text.strip_prefix("\u{FEFF}".as_bytes()).unwrap_or(text).trim_ascii_start();
        if text.starts_with(b"{") {
            let text = str::from_utf8(text).ok()?;
            let is_baseline =
                ["\"version\"", "\"files\"", "\"rule\"", "\"section\""].iter().all(|key| text.contains(key));
            return is_baseline.then_some(Self::Baseline);
        }
        let mut found = None;
        let mut in_table = false;
        // Line by line, because an EDS is known by its first one.
        for line in text.split(|&byte| byte == b'\n') {
            let line = str::from_utf8(line).ok()?.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let mark = match line.strip_prefix('[') {
                Some(header) => {
                    in_table = true;
                    Some(header.trim_start_matches('[').split(']').next().unwrap_or_default().trim())
                }
                // Keys inside of a table are any, and so are the lines of a list.
                None if in_table => None,
                None => line.split_once('=').map(|(key, _)| key.trim()),
            };
            let Some(mark) = mark.filter(|mark| is_key(mark)) else { continue };
            let kind = MARKS.iter().find(|(_, marks)| marks.contains(&mark)).map(|(kind, _)| *kind);
            match (kind, found) {
                // A profile has a name, as other files may have.
                (None, _) if mark == "name" && !in_table => {}
                (None, _) => return None,
                (Some(kind), None) => found = Some(kind),
                (Some(kind), Some(before)) if kind == before => {}
                // A scenario that names the device is still one.
                (Some(Self::Scenario), Some(Self::Parameters)) => found = Some(Self::Scenario),
                _ => return None,
            }
        }
        found
    }

    /// What is said where it was given instead of the `wanted` one; `None` where it is that.
    #[must_use]
    pub fn instead_of(self, wanted: Self) -> Option<String> {
        (self != wanted).then(|| self.told())
    }

    /// What it is, and which command takes it, in one sentence.
    #[must_use]
    pub fn told(self) -> String {
        format!("this is {}: {}", self.name(), self.command())
    }

    /// What it is.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parameters => "a parameter file of edskit",
            Self::Scenario => "a scenario of edskit",
            Self::Settings => "a file with settings of edskit",
            Self::Profile => "a profile of edskit",
            Self::SideFile => "a side-file of edskit",
            Self::Baseline => "a baseline of edskit",
        }
    }

    /// Which command takes it.
    #[must_use]
    pub const fn command(self) -> &'static str {
        match self {
            Self::Parameters => "`edskit config check` checks it, and `edskit run gateway --params` runs it",
            Self::Scenario => "`edskit run gateway --scenario` carries it out",
            Self::Settings => "`edskit lint --config` takes it",
            Self::Profile => "`edskit lint --profile` takes it",
            Self::SideFile => "`edskit generate` and `edskit run` read it beside its EDS",
            Self::Baseline => "`edskit lint --baseline` takes it",
        }
    }
}

fn is_key(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-.".contains(&byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_is_known_and_nothing_else() {
        for (text, kind) in [
            (
                "device = \"heinzmann-canopen-gateway\"\n[gateway]\n427 = 5\n[governor.signals]\n1 = \"u8\"\n",
                Some(OwnFile::Parameters),
            ),
            ("gateway = { 427 = 5 }\n", Some(OwnFile::Parameters)),
            ("[[step]]\nat = 1\n\n[step.gateway]\n427 = 2\n", Some(OwnFile::Scenario)),
            ("step = [{ at = 1 }]", Some(OwnFile::Scenario)),
            ("device = \"x\"\n[[step]]\n", Some(OwnFile::Scenario)),
            ("extend-select = [\"FIL008\"]\n[severity]\nOBJ016 = \"error\"\n", Some(OwnFile::Settings)),
            (
                "name = \"Pump rules\"\nobject = [\n    { index = 0x1017, name = \"heartbeat\" },\n]\n",
                Some(OwnFile::Profile),
            ),
            ("optional = [\"2009\"]\n[unit]\n\"1017\" = \"ms\"\n", Some(OwnFile::SideFile)),
            (
                "{\"version\": 1, \"files\": {\"a.eds\": [{\"rule\": \"SYN001\", \"section\": \"\", \"line\": \"\"}]}}",
                Some(OwnFile::Baseline),
            ),
            ("{\"message\": \"Not Found\"}", None),
            ("[FileInfo]\nFileName=a.eds\n", None),
            ("device=1\n[DeviceInfo]\n", None),
            ("[gateway]\n[1000]\n", None),
            ("hello", None),
            ("name = \"a\"\n", None),
            ("", None),
        ] {
            assert_eq!(OwnFile::of(text), kind, "{text}");
        }
    }
}
