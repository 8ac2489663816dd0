use super::*;
use proptest::prelude::*;

/// What a text certainly means.
fn certain(text: &str, wanted: Wanted) -> Option<String> {
    of(text.as_bytes(), wanted).filter(|slip| slip.certain).map(|slip| slip.text)
}

const U32: Wanted = Wanted::Value(Some(DataType::Unsigned32));
const REAL: Wanted = Wanted::Value(Some(DataType::Real32));
const BOOLEAN: Wanted = Wanted::Value(Some(DataType::Boolean));
const OCTETS: Wanted = Wanted::Value(Some(DataType::OctetString));
const TIME: Wanted = Wanted::Value(Some(DataType::TimeOfDay));

#[test]
fn every_shape_has_its_meaning() {
    for (text, wanted, meant) in [
        ("0x0007 ; UNSIGNED32", Wanted::DataType, "0x0007"),
        ("0x0007;UNSIGNED32", Wanted::DataType, "0x0007"),
        ("0x0007\t# UNSIGNED32", Wanted::DataType, "0x0007"),
        ("0x0007 // UNSIGNED32", Wanted::DataType, "0x0007"),
        ("0x0007 /* UNSIGNED32 */", Wanted::DataType, "0x0007"),
        ("0x0007 (UNSIGNED32)", Wanted::DataType, "0x0007"),
        ("5 -- five", Wanted::Number, "5"),
        ("5;", Wanted::Number, "5"),
        ("5,", Wanted::Number, "5"),
        ("0x10 ;;", Wanted::Number, "0x10"),
        ("\"0x0x10\"; twice", Wanted::Number, "0x10"),
        ("10h ; sixteen", U32, "0x10"),
        ("16#1A", U32, "0x1A"),
        ("16#1A ; hex", U32, "0x1A"),
        ("0x1234 5678", U32, "0x12345678"),
        ("1F80", U32, "0x1F80"),
        ("NODEID + 0x180", U32, "$NODEID+0x180"),
        ("180h+{NodeID} ; TPDO1", U32, "$NODEID+0x180"),
        ("$NODEID+0x200;", U32, "$NODEID+0x200"),
        ("\"$NodeId + 512\"", U32, "$NodeId + 512"),
        ("UNSIGNED8", Wanted::DataType, "0x0005"),
        ("WORD", Wanted::DataType, "0x0006"),
        ("0x0006 - UNSIGNED16", Wanted::DataType, "0x0006"),
        ("7: UNSIGNED32", Wanted::DataType, "7"),
        ("0x0007 UNSIGNED32", Wanted::DataType, "0x0007"),
        ("Visible String 0x0009", Wanted::DataType, "0x0009"),
        ("Visible String", Wanted::DataType, "0x0009"),
        ("uint16_t", Wanted::DataType, "0x0006"),
        ("I32", Wanted::DataType, "0x0004"),
        ("REAL64", Wanted::DataType, "0x0011"),
        ("float", Wanted::DataType, "0x0008"),
        ("07h", Wanted::DataType, "0x07"),
        ("000F", Wanted::DataType, "0x000F"),
        ("RECORD ; of four", Wanted::ObjectCode, "0x9"),
        ("9;", Wanted::ObjectCode, "9"),
        ("R/W", Wanted::Access, "rw"),
        ("Read Only", Wanted::Access, "ro"),
        ("read-write", Wanted::Access, "rw"),
        ("\"const\"", Wanted::Access, "const"),
        ("rww,", Wanted::Access, "rww"),
        ("ro;fixed", Wanted::Access, "ro"),
        ("wo ; \u{FFFD}", Wanted::Access, "wo"),
        ("TRUE", Wanted::Flag, "1"),
        ("0;", Wanted::Flag, "0"),
        ("\"1\"", Wanted::Flag, "1"),
        ("off ; not mappable", Wanted::Flag, "0"),
        ("yes", BOOLEAN, "1"),
        ("false;", BOOLEAN, "0"),
        ("1,5", REAL, "1.5"),
        ("1.5f ; factor", REAL, "1.5"),
        ("2.5;", REAL, "2.5"),
        ("01 0a FF", OCTETS, "010aFF"),
        ("0x0102", OCTETS, "0102"),
        ("0102 ; two", OCTETS, "0102"),
        ("365 43200000 ; noon", TIME, "365 43200000"),
        ("5 ; five", Wanted::Value(None), "5"),
        ("$NODEID+1 ; next", Wanted::Value(None), "$NODEID+1"),
    ] {
        assert_eq!(certain(text, wanted).as_deref(), Some(meant), "{text} for {wanted:?}");
    }
}

#[test]
fn where_more_than_one_thing_can_be_meant_nothing_is() {
    for (text, wanted) in [
        ("UNKNOWN", Wanted::Access),
        ("ro/rw", Wanted::Access),
        ("x", Wanted::Access),
        ("1A0", U32),
        ("1e3", U32),
        ("1,5", U32),
        ("1 2", U32),
        ("100 ms", U32),
        ("$NODEID*2", U32),
        ("five ; 5", U32),
        ("; 5", U32),
        ("", U32),
        ("2", Wanted::Flag),
        ("maybe", Wanted::Flag),
        ("0x10", Wanted::ObjectCode),
        ("UNSIGNED7", Wanted::DataType),
        ("struct", Wanted::DataType),
        ("0x0006 - UNSIGNED32", Wanted::DataType),
        ("0x0007 UNSIGNED", Wanted::DataType),
        ("INT", Wanted::DataType),
        ("U", Wanted::DataType),
        ("1,5,2", REAL),
        ("high", REAL),
        ("0A1", OCTETS),
        ("01 2", OCTETS),
        ("12:30", TIME),
        ("1 day", TIME),
        ("hello", Wanted::Value(None)),
    ] {
        assert_eq!(certain(text, wanted), None, "{text} for {wanted:?}");
    }
}

#[test]
fn octets_are_decoded_whatever_stands_between_them() {
    let sheet = crate::Datasheet::parse(
        b"[2000]\nDataType=0xA\nDefaultValue=0x01 02\t\"0AfF\" ; four\n[2001]\nDataType=0xA\nDefaultValue=\"0102\"\n",
    );
    let bytes = |index| {
        let value = sheet.object(edskit_types::Index(index)).unwrap().default_value().unwrap();
        assert!(value.value.is_err());
        let Some(Value::Octets(digits)) = value.known() else { return Vec::new() };
        crate::octets(digits).collect::<Vec<_>>()
    };
    assert_eq!(bytes(0x2001), [1, 2]);
    assert!(bytes(0x2000).is_empty(), "quotes inside are no separators");
}

proptest! {
    #[test]
    fn what_is_meant_is_what_is_wanted(text in "[$NODEIDnodeid+ 0-9a-fxXhrwo;,\"'/#(){}.-]{0,24}", position in 0..9_usize) {
        let wanted = [
            Wanted::Number, Wanted::DataType, Wanted::ObjectCode, Wanted::Flag, Wanted::Access, U32, REAL, OCTETS,
            Wanted::Value(None),
        ][position];
        if let Some(slip) = of(text.as_bytes(), wanted) {
            prop_assert!(wanted.is_met_by(&slip.text), "{} for {text}", slip.text);
        }
    }

    #[test]
    fn any_bytes_have_an_answer(raw in proptest::collection::vec(any::<u8>(), 0..60)) {
        let _ = of(&raw, U32);
        let _ = of(&raw, OCTETS);
    }
}
