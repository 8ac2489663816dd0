use super::*;

fn error(text: &str) -> String {
    Profile::parse(text).unwrap_err().to_string()
}

#[test]
fn the_profiles_of_the_crate_can_be_read() {
    let names: Vec<_> = BUILT_IN.iter().map(|profile| profile.name.as_str()).collect();
    assert_eq!(names, ["CiA 301", "CiA 302", "CiA 401", "CiA 402", "CiA 404", "CiA 406", "CiA 410"]);
    for profile in BUILT_IN.iter() {
        for (position, object) in profile.objects.iter().enumerate() {
            let next = profile.objects.get(position + 1);
            assert!(next.is_none_or(|next| next.indices.start() > object.indices.end()), "{object:?}");
            let area = *object.indices.start() >= 0x6000;
            assert_eq!(area, profile.device_profile.is_some(), "{object:?}");
            assert!(!object.codes.is_empty() && !object.name.is_empty(), "{object:?}");
            let has_subs = object.codes.iter().any(|code| code.has_sub_objects());
            assert!(has_subs || object.subs.is_empty() && object.highest.is_none(), "{object:?}");
        }
    }
}

#[test]
fn objects_are_found_alone_and_in_ranges() {
    let profile = &BUILT_IN[0];
    let name = |index| profile.object(Index(index)).map(|object| object.name.as_str());
    assert_eq!(name(0x1000), Some("device type"));
    assert_eq!(name(0x1200), Some("default SDO server parameter"));
    assert_eq!((name(0x1201), name(0x127F)), (Some("SDO server parameter"), Some("SDO server parameter")));
    assert_eq!(name(0x1BFF), Some("TPDO mapping parameter"));
    assert_eq!((name(0x0000), name(0x1004), name(0x1300), name(0xFFFF)), (None, None, None, None));
}

#[test]
fn sub_objects_have_what_the_object_says() {
    let identity = BUILT_IN[0].object(Index(0x1018)).unwrap();
    assert_eq!(identity.subs[3].attributes.types, [DataType::Unsigned32.index()]);
    let history = BUILT_IN[0].object(Index(0x1003)).unwrap();
    assert!(history.subs[0].attributes.allows(AccessType::Rw) && history.subs[0].attributes.types.is_empty());
    assert!(!history.subs[1].attributes.allows(AccessType::Rw));
    assert_eq!(history.subs[0].attributes.mappable, Some(false));
}

#[test]
fn rights_are_compared_as_sdo_sees_them() {
    let attributes = |access: &[AccessType]| Attributes { access: access.to_vec(), ..Attributes::default() };
    assert!(attributes(&[AccessType::Const]).allows(AccessType::Ro));
    assert!(attributes(&[AccessType::Rw]).allows(AccessType::Rww));
    assert!(!attributes(&[AccessType::Rw]).allows(AccessType::Wo));
    assert!(!attributes(&[AccessType::Ro]).allows(AccessType::Rwr));
    assert!(attributes(&[]).allows(AccessType::Wo));
}

#[test]
fn errors_say_what_and_where() {
    let object = |line: &str| error(&format!("name = 'x'\n[[object]]\nindex = 1\nname = 'y'\n{line}\n"));
    assert_eq!(object("code = 'VARR'"), "5:8: `VARR` is no object code; did you mean `VAR`?");
    assert_eq!(object("code = ['VAR', 'x']"), "5:16: `x` is no object code");
    assert_eq!(object("type = 0x260"), "5:8: data types have the indices 0001h to 025Fh");
    assert_eq!(object("access = ['rw', 'read']"), "5:17: `read` is no access type");
    assert_eq!(object("values = [1, [3, 2]]"), "5:14: the last one of the range lies before the first one");
    assert_eq!(object("values = [[1, 2, 3]]"), "5:11: a range is written `[first, last]`");
    assert_eq!(object("default = '$NODE+1'"), "5:11: the only variable is $NODEID");
    assert_eq!(
        object("default = true"),
        "5:11: invalid type: boolean `true`, expected a number or a formula such as \"$NODEID+0x80\""
    );
    assert_eq!(object("sub = [{ index = 1 }, { index = [1, 2] }]"), "5:33: sub-index 01h is described twice");
    assert_eq!(object("sub = [{ index = 256 }]"), "5:18: invalid value: integer `256`, expected u8");
    assert_eq!(
        object("sub = [{ index = [1, 2], mandatory = true }]"),
        "5:38: a range cannot be mandatory; describe what is mandatory alone"
    );
    assert!(object("acess = 'rw'").starts_with("5:1: unknown field `acess`, expected one of"));
    assert_eq!(object("[[object]]\nindex = [0, 9]\nname = 'z'"), "6:9: 0001h is described twice");
    assert_eq!(
        error("name = 'x'\ndevice-profile = 70000\n"),
        "2:18: invalid value: integer `70000`, expected u16"
    );
    assert_eq!(error("device-profile = 1\n"), "1:1: missing field `name`");
    assert_eq!(
        error("name = 'x'\n[[require]]\nname = 'y'\nany-of = []\n"),
        "4:10: at least one index is needed"
    );
    assert_eq!(
        error("name = 'x'\n[[require]]\nname = 'y'\ndevice-type-bit = 32\nany-of = [1]\n"),
        "4:19: 1000h has the bits 0 to 31"
    );
    assert!(error("name = 'x\n").starts_with("1:"));
}

#[test]
fn a_column_counts_characters() {
    assert_eq!(error("name = 'ä' 5\n").split(':').nth(1), Some("12"));
}
