//! Names that are made to become code do not.

use crate::compiler::Packages;
use edskit_codegen::{Naming, parse, render};
use proc_macro2::{TokenStream, TokenTree};
use std::fmt::Write;

/// Stands in each hostile name that has room for it, and must not stand outside comments and literals as it is.
const MARK: &str = "pwned";

/// Names, each for all places of one file where names can stand.
fn names() -> Vec<Vec<u8>> {
    let texts = [
        "*/ pub fn pwned() {} /*",
        "pwned\n*/ pub fn pwned() {}",
        "\"; pub fn pwned() {} //",
        "\\",
        "\\\" + pwned + \\\"",
        "pwned\\",
        "r#\"pwned\"#",
        "r#pwned",
        "fn",
        "Self",
        "_",
        "pub static mut PWNED: u32 = 0;",
        "#![allow(pwned)]",
        "#[doc = \"pwned\"]",
        "` pwned ` [`pwned`] ``pwned",
        "[pwned] [pwned](pwned) http://pwned.example",
        "{{ pwned }} {pwned} {} {0} {% pwned %}",
        "\u{202E}pwned\u{202C} \u{2066}pwned\u{2069}",
        "\0pwned\u{1}\u{7F}\u{85}",
        "pwned\u{2028}pub fn pwned() {}\u{2029}",
        "<script>pwned</script> <pwned",
        "//! pwned",
        "'pwned b'pwned' '",
        "macro_rules! pwned { () => { compile_error!() } }",
        "$crate::pwned!()",
        "\u{1F600} \u{1F680}",
        "OBJECT_2000_01",
        "ENTRIES Dictionary",
        "2000",
        "",
        "\\u{22}; pub fn pwned() {} \\x22",
        "\u{FEFF}\u{200B}pwned\u{E0001}",
        "include!(\"pwned\");\rmod pwned;",
    ];
    let mut names: Vec<Vec<u8>> = texts.iter().map(|text| text.as_bytes().to_vec()).collect();
    names.push(b"pwned \xFF\xFE\x80 M\xFCller".to_vec());
    names.push("pwned ".repeat(100_000).into_bytes());
    names
}

/// A file with a name in every place where a name can stand.
fn eds(name: &[u8]) -> Vec<u8> {
    let parts: [&[u8]; 7] = [
        b"[DeviceInfo]\nProductName=",
        b"\n[2000]\nObjectType=9\nParameterName=",
        b"\n[2000sub1]\nDataType=5\nAccessType=rw\nParameterName=",
        b"\n[2001]\nObjectType=8\nDataType=5\nAccessType=rw\nCompactSubObj=2\nParameterName=",
        b"\n[2001Name]\nNrOfEntries=1\n2=",
        b"\n[2002]\nDataType=9\nAccessType=const\nParameterName=Text\nDefaultValue=",
        b"\n[1A00]\nObjectType=9\n[1A00sub0]\nDataType=5\nAccessType=rw\nDefaultValue=1\n[1A00sub1]\nDataType=7\n\
          AccessType=rw\nDefaultValue=0x20030008\n[2003]\nDataType=5\nAccessType=ro\nPDOMapping=1\nParameterName=",
    ];
    // The text behind DefaultValue is a value: only as much of it as a dictionary has room for.
    let value = &name[..name.len().min(1000)];
    let names = [name, name, name, name, name, value, name];
    parts.iter().zip(names).flat_map(|(part, name)| [part, name].concat()).chain(*b"\n").collect()
}

/// The code of the file, with the name in the side-file and in the path of the EDS too.
fn code(number: usize, name: &[u8]) -> String {
    let text = String::from_utf8_lossy(name);
    let unit: String = text.chars().take(1000).fold(String::new(), |mut unit, character| {
        write!(unit, "\\U{:08X}", u32::from(character)).expect("a string can be written to");
        unit
    });
    let side_file = format!(
        "[unit]\n'2000-2003' = \"{unit}\"\n[[extra]]\nentries = '2000sub2-3'\nname = \"{unit}\"\n\
         data-type = 'REAL64'\naccess = 'rw'\n"
    );
    let layout = parse(&eds(name), Some(&side_file)).expect("a hostile file can be laid out");
    let path: String = text.chars().take(100).collect();
    let naming = Naming { module: format!("file_{number}"), ..Naming::of(&format!("{path}.eds")) };
    render(&layout, &naming)
}

/// The tokens of the code. Literals, documentation comments among them, are left out; so are the names behind `const`,
/// which are made from names of the EDS.
fn tokens(code: &str) -> Vec<String> {
    let stream: TokenStream = code.parse().expect("the code has tokens");
    let mut tokens = Vec::new();
    flatten(stream, &mut tokens);
    tokens
}

fn flatten(stream: TokenStream, tokens: &mut Vec<String>) {
    for token in stream {
        match token {
            TokenTree::Group(group) => {
                tokens.push(format!("{:?}", group.delimiter()));
                flatten(group.stream(), tokens);
                tokens.push("end".to_owned());
            }
            TokenTree::Literal(_) => tokens.push("literal".to_owned()),
            TokenTree::Ident(name) if tokens.last().is_some_and(|last| last == "const") && name != "fn" => {
                assert!(is_plain_constant(&name.to_string()), "{name}");
                tokens.push("name".to_owned());
            }
            other => tokens.push(other.to_string()),
        }
    }
}

fn is_plain_constant(name: &str) -> bool {
    name.bytes().all(|byte| byte.is_ascii_uppercase() || byte.is_ascii_digit() || byte == b'_')
}

/// The tokens without what depends on the length of texts: the bytes of images.
fn without_bytes(tokens: Vec<String>) -> Vec<String> {
    let mut shorter: Vec<String> = Vec::with_capacity(tokens.len());
    for token in tokens {
        let before = shorter.len().checked_sub(2).map(|at| (&*shorter[at], &*shorter[at + 1]));
        if before == Some(("literal", ",")) && (token == "literal" || token == ",") {
            if token == "literal" {
                shorter.truncate(shorter.len() - 2);
            } else {
                continue;
            }
        }
        shorter.push(token);
    }
    shorter
}

#[test]
fn hostile_names_stay_in_comments_and_literals() {
    let tame = without_bytes(tokens(&code(0, b"tame")));
    let names = names();
    assert!(names.len() >= 30);
    let codes: Vec<String> = names.iter().enumerate().map(|(number, name)| code(number, name)).collect();
    for (number, code) in codes.iter().enumerate() {
        let mut found = without_bytes(tokens(code));
        for token in &mut found {
            assert!(!token.contains(MARK), "{token}");
            if *token == format!("file_{number}") {
                "file_0".clone_into(token);
            }
        }
        if found != tame {
            let at = found.iter().zip(&tame).position(|(found, tame)| found != tame);
            panic!("name {number}: {at:?} {:?}", at.map(|at| &found[at.saturating_sub(5)..at + 5]));
        }
    }
    let many = format!(
        "{}",
        (0x2000..0x2000 + 10_000).fold(String::new(), |mut eds, index| {
            write!(eds, "[{index:X}]\nParameterName=pwned\nDataType=5\nAccessType=rw\n")
                .expect("a string can be written to");
            eds
        })
    );
    let many = render(&parse(many.as_bytes(), None).expect("it can be laid out"), &Naming::of("many.eds"));
    assert!(tokens(&many).iter().all(|token| !token.contains(MARK)));

    let mut packages = Packages::new("hostile");
    packages.add_library("names", codes.iter().map(String::as_str));
    packages.add_library("equal-names", [many.as_str()]);
    packages.check();
    let output = packages.cargo(&["doc", "--workspace", "--no-deps"]);
    assert!(output.status.success(), "{}", packages.clean(&output));
}
