//! Files of edskit itself, given to a command that does not take them.

use edskit::Exit;
use edskit_tests::{Folder, edskit};

const PARAMETERS: &str = "device = \"heinzmann-canopen-gateway\"\n[gateway]\n427 = 5\n";
const SCENARIO: &str = "[[step]]\nat = 1\nnmt = \"start\"\n";
const SETTINGS: &str = "extend-select = [\"FIL008\"]\n[severity]\nOBJ016 = \"error\"\n";
const PROFILE: &str =
    "name = \"Pump rules 3\"\nobject = [\n    { index = 0x1017, name = \"heartbeat\" },\n]\n";
const SIDE_FILE: &str = "optional = [\"2009\"]\n[unit]\n\"1017\" = \"ms\"\n";
const BASELINE: &str = "{\n  \"version\": 1,\n  \"files\": {\n    \"a.eds\": [\n      { \"rule\": \"SYN001\", \"section\": \"\", \"line\": \"\", \"count\": 1 }\n    ]\n  }\n}\n";
const EDS: &str = "[FileInfo]\nFileName=a.eds\n[DeviceInfo]\nVendorName=x\n";

/// Each kind with the command that takes it.
const KINDS: [(&str, &str, &str); 6] = [
    ("parameters.toml", PARAMETERS, "`edskit config check`"),
    ("scenario.toml", SCENARIO, "`edskit run gateway --scenario`"),
    ("edskit.toml", SETTINGS, "`edskit lint --config`"),
    ("profile.toml", PROFILE, "`edskit lint --profile`"),
    ("side-file.toml", SIDE_FILE, "`edskit generate`"),
    ("baseline.json", BASELINE, "`edskit lint --baseline`"),
];

#[test]
fn the_right_command_is_named() {
    let folder = Folder::new("own-files");
    let written = folder.write("generated/x", "");
    let generated = written.trim_end_matches("/x");
    for (name, text, command) in KINDS {
        let path = folder.write(name, text);
        let commands: [&[&str]; 8] = [
            &["lint", "--isolated", &path],
            &["show", &path],
            &["fmt", &path],
            &["generate", &path, "-o", generated],
            &["run", &path],
            &["monitor", "--eds", &path],
            &["config", "check", &path],
            &["run", "gateway", "--scenario", &path, "--simulate", "1"],
        ];
        for arguments in commands {
            let takes_it = (name, arguments[0]) == ("parameters.toml", "config")
                || name == "scenario.toml" && arguments.contains(&"--scenario");
            let output = edskit(arguments);
            let all = output.all();
            if takes_it {
                assert_eq!(output.exit, Exit::Clean, "{all}");
                continue;
            }
            assert_ne!(output.exit, Exit::Clean, "{arguments:?}: {all}");
            assert!(all.contains(command), "{arguments:?}: {all}");
        }
        assert_eq!(String::from_utf8(folder.read(name)).unwrap(), text, "{name} is left alone");
    }
}

#[test]
fn options_name_it_too() {
    let folder = Folder::new("own-files-options");
    let eds = folder.write("a.eds", EDS);
    let output = folder.write("generated/x", "");
    let generated = output.trim_end_matches("/x");
    for (name, text, command) in KINDS {
        let path = folder.write(&format!("of-{name}"), text);
        for (option, wanted) in [
            (&["lint", &eds, "--config", &path][..], "edskit.toml"),
            (&["lint", "--isolated", &eds, "--profile", &path], "profile.toml"),
            (&["lint", "--isolated", &eds, "--baseline", &path], "baseline.json"),
            (&["generate", &eds, "-o", generated, "--side-file", &path], "side-file.toml"),
            (&["run", "gateway", "--simulate", "1", "--params", &path], "parameters.toml"),
        ] {
            let all = edskit(option).all();
            assert_eq!(all.contains(command), name != wanted, "{option:?}: {all}");
        }
    }
}

#[test]
fn an_eds_is_no_parameter_file_and_no_scenario() {
    let folder = Folder::new("own-files-eds");
    let path = folder.write("a.eds", EDS);
    for arguments in [
        &["config", "check", &path][..],
        &["config", "dcf", &path],
        &["config", "export", &path],
        &["run", "gateway", "--params", &path, "--simulate", "1"],
        &["run", "gateway", "--scenario", &path, "--simulate", "1"],
        &["config", "import", &path],
    ] {
        let output = edskit(arguments);
        assert_eq!(output.exit, Exit::Findings, "{arguments:?}");
        let all = output.all();
        assert!(all.contains("`edskit lint`") && all.matches("GWC").count() == 1, "{arguments:?}: {all}");
    }
}
