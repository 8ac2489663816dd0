//! Data types that the file defines: DEFTYPEs, and the range types of CANFestival.

use super::{Datasheet, Field, SubObject};
use crate::key::KeyName;
use crate::section::SectionKind;
use crate::value::Value;
use edskit_types::{DataType, Index, ObjectCode, SubIndex};

/// How many definitions are followed from one to the next.
const MOST_STEPS: usize = 8;
/// The first index of range types: below it, DEFSTRUCTs are records.
const FIRST_RANGE: u16 = 0xA0;
/// The first index behind the data types.
const FIRST_OBJECT: u16 = 0x1000;

/// The data type of CiA 301 behind one that the file defines.
#[derive(Clone, Copy, Debug)]
pub struct ResolvedType<'a> {
    /// The type of the values.
    pub data_type: DataType,
    /// The lower limit of a range type, read by the data type.
    pub low: Option<Field<'a, Value<'a>>>,
    /// The upper limit of a range type, read by the data type.
    pub high: Option<Field<'a, Value<'a>>>,
}

impl Datasheet {
    /// The data type of CiA 301 that has the values of the type at `index`: that of a DEFTYPE, or that of a range type, of
    /// which sub-index 01h names the basic type and 02h and 03h the limits. `None` for one that the file does not define.
    ///
    /// ```
    /// use edskit_model::Datasheet;
    /// use edskit_types::{DataType, Index};
    /// let text = b"[A0]\nObjectType=6\n[A0sub1]\nDataType=5\nDefaultValue=3\n[A0sub2]\nDataType=3\nDefaultValue=-100\n";
    /// let sheet = Datasheet::parse(text);
    /// let resolved = sheet.resolve_type(Index(0xA0)).unwrap();
    /// assert_eq!(resolved.data_type, DataType::Integer16);
    /// assert_eq!(resolved.low.unwrap().known().unwrap().integer(DataType::Integer16, None), Ok(-100));
    /// ```
    pub fn resolve_type(&self, index: Index) -> Option<ResolvedType<'_>> {
        let mut next = index;
        let mut limits = [None, None];
        for _ in 0..MOST_STEPS {
            if let Some(data_type) = DataType::from_index(next) {
                let [low, high] = limits.map(|limit: Option<SubObject<'_>>| {
                    let entry = limit?.value()?.entry;
                    Some(entry.value(Some(data_type)))
                });
                return Some(ResolvedType { data_type, low, high });
            }
            let definition =
                self.section(SectionKind::Object(next)).and_then(|section| section.description());
            let code = definition.map(|definition| definition.object_code());
            next = match (code, self.sub_object(next, SubIndex(1))) {
                (Some(Some(ObjectCode::DefType)), None) => definition?.data_type()?.known().map(Index)?,
                (_, Some(basic)) if (FIRST_RANGE..FIRST_OBJECT).contains(&next.0) => {
                    for (limit, sub_index) in limits.iter_mut().zip([SubIndex(2), SubIndex(3)]) {
                        *limit = limit.or_else(|| self.sub_object(next, sub_index));
                    }
                    let named =
                        basic.filled(KeyName::ParameterValue).or_else(|| basic.filled(KeyName::DefaultValue));
                    Index(named?.unsigned().known()?)
                }
                _ => return None,
            };
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolved(text: &str, index: u16) -> Option<(DataType, Option<String>, Option<String>)> {
        let sheet = Datasheet::parse(text.as_bytes());
        let resolved = sheet.resolve_type(Index(index))?;
        let text = |field: Option<Field<'_, Value<'_>>>| field.map(|field| field.text().into_owned());
        Some((resolved.data_type, text(resolved.low), text(resolved.high)))
    }

    #[test]
    fn a_type_is_followed_to_one_of_cia_301() {
        let range = "[A0]\nObjectType=6\n[A0sub1]\nDefaultValue=0x4\n[A0sub2]\nDefaultValue=-5\n[A0sub3]\nDefaultValue=0x10\n";
        let limits = (DataType::Integer32, Some("-5".to_owned()), Some("0x10".to_owned()));
        assert_eq!(resolved(range, 0xA0), Some(limits.clone()));
        assert_eq!(
            resolved(&format!("{range}[A1]\nObjectType=6\n[A1sub1]\nDefaultValue=0xA0\n"), 0xA1),
            Some(limits)
        );
        assert_eq!(resolved("[B0]\n[B0sub1]\nDefaultValue=8\n", 0xB0), Some((DataType::Real32, None, None)));
        assert_eq!(
            resolved("[41]\nObjectType=5\nDataType=7\n", 0x41),
            Some((DataType::Unsigned32, None, None))
        );
    }

    #[test]
    fn what_defines_no_type() {
        for (text, index) in [
            ("", 0xA0),
            ("[A0]\nObjectType=6\n", 0xA0),
            ("[A0]\nObjectType=6\n[A0sub1]\nDefaultValue=x\n", 0xA0),
            ("[A0]\nObjectType=6\n[A0sub1]\nDefaultValue=0xA0\n", 0xA0),
            ("[40]\nObjectType=6\n[40sub1]\nDefaultValue=7\n", 0x40),
            ("[41]\nObjectType=5\nDataType=0x41\n", 0x41),
            ("[2000]\nObjectType=9\n[2000sub1]\nDefaultValue=7\n", 0x2000),
        ] {
            assert_eq!(resolved(text, index), None, "{text}");
        }
    }

    #[test]
    fn a_range_holds_for_whatever_has_the_type() {
        let text = "[A0]\nObjectType=6\n[A0sub1]\nDefaultValue=3\n[A0sub3]\nDefaultValue=100\n\
            [2000]\nDataType=0xA0\n[2001]\nObjectType=8\nDataType=0xA0\nCompactSubObj=2\n[2002]\nDataType=0xA0\nHighLimit=9\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let high = |index, sub_index| {
            let entry = sheet.dictionary_entry(Index(index), SubIndex(sub_index)).unwrap();
            assert_eq!(entry.data_type(), Some(DataType::Integer16));
            entry.limits()[1].unwrap().text().into_owned()
        };
        assert_eq!([high(0x2000, 0), high(0x2001, 2), high(0x2002, 0)], ["100", "100", "9"]);
    }
}
