use super::*;

/// An object of a configured device, to which nothing is added.
const EDS: &str =
    "[1017]\nParameterName=Heartbeat\nObjectType=7\nDataType=6\nAccessType=rw\n[DeviceComissioning]\n";

/// A folder of one test, gone when the test is.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = env::temp_dir().join(format!("edskit-codegen-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).unwrap();
        path
    }

    /// What cargo is told, with the folder's own path taken out.
    fn run(&self, config: &Config, eds: &Path) -> String {
        let mut told = Vec::new();
        config.run(eds, Some(self.0.join("out").into()), &mut told).unwrap();
        String::from_utf8(told).unwrap().replace(self.0.to_str().unwrap(), "<folder>")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind harms nobody.
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn without_rules() -> Config {
    Config::new().rules(RuleSet::none())
}

#[test]
fn inputs_and_output_are_named_after_the_eds() {
    let folder = Folder::new("named");
    let eds = folder.write("MyPump.eds", EDS);
    assert_eq!(
        folder.run(&without_rules(), &eds),
        "cargo::rerun-if-changed=<folder>/MyPump.eds\ncargo::rerun-if-changed=<folder>\n"
    );
    folder.write("MyPump.toml", "[unit]\n'1017' = 'ms'\n");
    assert_eq!(
        folder.run(&without_rules(), &eds),
        "cargo::rerun-if-changed=<folder>/MyPump.eds\ncargo::rerun-if-changed=<folder>/MyPump.toml\n"
    );
    let code = fs::read_to_string(folder.0.join("out/MyPump.rs")).unwrap();
    assert!(code.contains("pub mod my_pump {") && code.contains(", rw, in `ms`."), "{code}");
}

#[test]
fn a_side_file_is_noticed_when_it_is_made() {
    for (eds, place) in [
        ("eds/Pump.eds", "eds"),
        ("./eds/Pump.eds", "./eds"),
        ("../Pump.eds", ".."),
        ("/pumps/Pump.eds", "/pumps"),
        ("Pump.eds", "Pump.toml"),
        ("./Pump.eds", "Pump.toml"),
    ] {
        assert_eq!(place_of_later(Path::new(eds), Path::new("Pump.toml")), Path::new(place), "{eds}");
    }
}

#[test]
fn two_files_of_one_name_do_not_take_each_others_place() {
    let folder = Folder::new("twice");
    fs::create_dir_all(folder.0.join("other")).unwrap();
    let eds = folder.write("Drive.eds", EDS);
    let other = folder.write("other/drive.eds", &EDS.replace("1017", "2017"));
    assert!(!folder.run(&without_rules(), &eds).contains("error"));
    let code = || fs::read_to_string(folder.0.join("out/Drive.rs")).unwrap();
    let first = code();
    let told = folder.run(&without_rules(), &other);
    let place =
        "<folder>/other/drive.eds: <folder>/out/drive.rs is the dictionary of <folder>/Drive.eds already";
    assert!(told.contains(&format!("cargo::error={place}; give one of them a name")), "{told}");
    assert!(!folder.0.join("out/drive.rs").exists());
    assert!(!folder.run(&without_rules().name("Other"), &other).contains("error"));
    assert!(folder.0.join("out/Other.rs").exists());
    // The same file again, changed meanwhile, is no other one.
    folder.write("Drive.eds", &EDS.replace("1017", "3017"));
    assert!(!folder.run(&without_rules(), &eds).contains("error"));
    assert_ne!(code(), first);
    // Nor is there anything to lose where both are equal.
    let equal = folder.write("other/Drive.eds", &fs::read_to_string(&eds).unwrap());
    assert!(!folder.run(&without_rules(), &equal).contains("error"));
}

#[test]
fn settings_name_what_is_written() {
    let folder = Folder::new("settings");
    let eds = folder.write("a.eds", EDS);
    let side_file = folder.write("other.toml", "");
    let config = without_rules()
        .name("Drive")
        .side_file(&side_file)
        .runtime("::support::runtime")
        .out_dir(folder.0.join("elsewhere"));
    let told = folder.run(&config, &eds);
    assert!(told.ends_with("cargo::rerun-if-changed=<folder>/other.toml\n"), "{told}");
    let code = fs::read_to_string(folder.0.join("elsewhere/Drive.rs")).unwrap();
    assert!(code.contains("pub mod drive {") && code.contains("use ::support::runtime::{"), "{code}");
}

#[test]
fn findings_are_told_with_their_place() {
    let folder = Folder::new("findings");
    let eds = folder.write("a.eds", &EDS.replace("rw\n", "rw\nDefaultValue=70000\n"));
    let errors = folder.run(&Config::new(), &eds);
    assert!(errors.contains("cargo::error=<folder>/a.eds:6:14: VAL002 "), "{errors}");
    assert!(!errors.contains("DEV001") && !folder.0.join("out/a.rs").exists(), "{errors}");
    folder.write("a.eds", EDS);
    let told = folder.run(&Config::new(), &eds);
    assert!(
        told.contains("cargo::warning=<folder>/a.eds:1:1: DEV001 ") && !told.contains("cargo::error"),
        "{told}"
    );
    assert!(folder.0.join("out/a.rs").exists());
    let mut rules = RuleSet::none();
    rules.select("STY").unwrap();
    folder.write("a.eds", &EDS.replace("rw\n", "rw\nLowLimit=$NODEID\n"));
    folder.write("a.toml", "[unit]\n'2000' = 'V'\n");
    let warnings = folder.run(&Config::new().rules(rules), &eds);
    assert!(warnings.contains("cargo::warning=<folder>/a.eds:6:10: GEN a limit that depends"), "{warnings}");
    assert!(
        warnings.contains("cargo::warning=<folder>/a.toml:2:1: GEN the dictionary has no such"),
        "{warnings}"
    );
}

#[test]
fn what_cannot_be_read_or_written_is_an_error() {
    let folder = Folder::new("unreadable");
    let told = folder.run(&without_rules(), &folder.0.join("none.eds"));
    assert!(told.contains("cargo::error=<folder>/none.eds: "), "{told}");
    let eds = folder.write("a.eds", EDS);
    folder.write("a.toml", "unit = 1\n");
    assert!(
        folder.run(&without_rules(), &eds).contains("cargo::error=<folder>/a.toml:1:8: GEN invalid type")
    );
    let told = folder.run(&without_rules().side_file(folder.0.join("none.toml")), &eds);
    assert!(told.contains("cargo::error=<folder>/none.toml: "), "{told}");
    folder.write("a.toml", "");
    let file = folder.write("file", "");
    assert!(folder.run(&without_rules().out_dir(file), &eds).contains("cargo::error="));
    let mut told = Vec::new();
    without_rules().run(&eds, None, &mut told).unwrap();
    assert!(String::from_utf8(told).unwrap().contains("cargo::error=OUT_DIR is not set"));
}

#[test]
fn an_unchanged_file_is_not_written_again() {
    let folder = Folder::new("unchanged");
    let path = folder.write("a.rs", "text");
    let before = fs::metadata(&path).unwrap().modified().unwrap();
    assert!(!write_if_changed(&path, "text").unwrap());
    assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), before);
    assert!(write_if_changed(&path, "other").unwrap());
    assert_eq!(fs::read_to_string(&path).unwrap(), "other");
}

/// An object of a configured device with a value that does not fit.
const TOO_LARGE: &str = "[2000]\nParameterName=x\nObjectType=7\nDataType=5\nAccessType=rw\nDefaultValue=300\n[DeviceComissioning]\n";

#[test]
fn what_is_allowed_does_not_stop_the_build() {
    let folder = Folder::new("allowed");
    let eds = folder.write("a.eds", TOO_LARGE);
    let is_built = |config: &Config| {
        let told = folder.run(config, &eds);
        assert_eq!(told.contains("cargo::error"), !folder.0.join("out/a.rs").exists(), "{told}");
        let is_built = fs::remove_file(folder.0.join("out/a.rs")).is_ok();
        (is_built, told)
    };
    let (built, told) = is_built(&Config::new());
    assert!(!built && told.contains("cargo::error=<folder>/a.eds:6:14: VAL002 "), "{told}");
    let (built, told) = is_built(&Config::new().allow("VAL002"));
    assert!(built && told.contains("cargo::warning=<folder>/a.eds:6:14: GEN `300` is left out"), "{told}");
    let (built, told) = is_built(&Config::new().allow("VAL999"));
    assert!(!built && told.contains("cargo::error=Config::allow: there is no rule `VAL999`"), "{told}");
    folder.write("a.eds", &TOO_LARGE.replace("[2000]", ";edskit: allow(VAL002) known\n[2000]"));
    assert!(is_built(&Config::new()).0);
    folder.write("a.eds", TOO_LARGE);
    folder.write("edskit.toml", "[severity]\nVAL002 = 'warning'\n");
    let (built, told) = is_built(&Config::new());
    assert!(built && told.contains("cargo::rerun-if-changed=<folder>/edskit.toml\n"), "{told}");
    assert!(!is_built(&Config::new().rules(RuleSet::default())).0, "rules of the build script come first");
    folder.write("edskit.toml", "ignore = ['VAL002']\n[severity]\nOBJ003 = 'error'\n");
    assert!(is_built(&Config::new()).0);
    folder.write("edskit.toml", "ignore = 5\n");
    let (built, told) = is_built(&Config::new());
    assert!(!built && told.contains("cargo::error=<folder>/edskit.toml:1: invalid type"), "{told}");
}

#[test]
fn whoever_wants_an_error_gets_one() {
    let folder = Folder::new("wanted");
    let text = TOO_LARGE.replace("300", "3");
    let eds = folder.write("a.eds", &text.replace("ParameterName=x", "ParameterName=\u{e4}"));
    assert!(!folder.run(&Config::new(), &eds).contains("cargo::error"));
    folder.write("edskit.toml", "[[override]]\nfiles = ['*.eds']\nseverity = { SYN001 = 'error' }\n");
    assert!(folder.run(&Config::new(), &eds).contains("cargo::error=<folder>/a.eds:2:15: SYN001 "));
}

#[test]
fn a_mistake_that_does_not_hinder_changes_no_code() {
    let folder = Folder::new("equal");
    let right = "[2000]\nParameterName=x\nObjectType=8\nSubNumber=3\n\
        [2000sub0]\nParameterName=n\nObjectType=7\nDataType=5\nAccessType=ro\nDefaultValue=2\n\
        [2000sub1]\nParameterName=a\nObjectType=7\nDataType=5\nAccessType=rw\nDefaultValue=7\n\
        [2000sub2]\nParameterName=b\nObjectType=7\nDataType=6\nAccessType=rw\nDefaultValue=8\n[DeviceComissioning]\n";
    let code = |text: &str| {
        let eds = folder.write("a.eds", text);
        let told = folder.run(&Config::new(), &eds);
        assert!(told.contains("cargo::warning") && !told.contains("cargo::error"), "{told}");
        fs::read_to_string(folder.0.join("out/a.rs")).unwrap()
    };
    let of_right = code(right);
    for (is, becomes) in [
        ("ObjectType=8", "ObjectType=0x8 ; ARRAY"),
        ("SubNumber=3", "SubNumber=9"),
        ("DataType=6", "DataType=0x0x6"),
        ("DataType=6", "DataType=UNSIGNED16"),
        ("AccessType=rw", "AccessType=R/W"),
        ("DefaultValue=8", "DefaultValue=8; eight"),
        ("DefaultValue=7", "DefaultValue=07h"),
        ("[2000sub2]", "[2000hsub02]"),
        ("[2000sub0]", "[2000 sub0]"),
    ] {
        assert_eq!(code(&right.replace(is, becomes)), of_right, "{becomes}");
    }
}
