//! What is read otherwise than it is written, so that people can be told.

use super::{Datasheet, Entry, Section};
use crate::Span;
use crate::key::{KeyName, Shape};
use crate::meant::{Slip, Wanted};
use crate::section::SectionKind;
use crate::value::ValueError;

/// A value or a header that is written wrongly, and is read as it was certainly meant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Assumed {
    /// Where it stands.
    pub span: Span,
    /// What it is read as.
    pub text: String,
    /// What is wrong with it.
    pub reason: &'static str,
}

impl Datasheet {
    /// Everything that is read as it was meant rather than as it is written, in the order of the file.
    pub fn assumed(&self) -> Vec<Assumed> {
        let headers = self.sections().filter_map(|section| section.assumed());
        let values = self.entries().filter_map(|entry| entry.assumed());
        let mut all: Vec<_> = headers.chain(values).collect();
        all.sort_by_key(|assumed| assumed.span);
        all
    }
}

impl Section<'_> {
    fn assumed(self) -> Option<Assumed> {
        let name = self.name_span();
        let kind = self.kind();
        let reason = if self.has_decimal_sub_index() {
            "a sub-index is a hexadecimal number"
        } else if kind.is_misspelt(name.slice(self.sheet().document().to_bytes())) {
            "the name has only the digits of the index and of the sub-index"
        } else {
            return None;
        };
        Some(Assumed { span: name, text: kind.canonical_name()?, reason })
    }
}

impl Entry<'_> {
    fn assumed(self) -> Option<Assumed> {
        let section = self.section()?;
        let assumed = |text, reason| Some(Assumed { span: self.value_span(), text, reason });
        if section.kind().lists_indices() && self.key().name == KeyName::Item {
            let item = super::ListItem { number: self.key().number, index: self.unsigned() };
            if let Some(meant) = item.without_prefix() {
                return assumed(format!("0x{meant:04X}"), "hexadecimal numbers begin with `0x`");
            }
        }
        let name = self.key().name;
        if let SectionKind::SubObject(index, sub_index) = section.kind()
            && (index.is_rpdo_mapping() || index.is_tpdo_mapping())
            && (1..=64).contains(&sub_index.0)
            && matches!(name, KeyName::DefaultValue | KeyName::ParameterValue)
            && let Some(meant) = section.sheet().mapping_without_prefix(self.raw())
        {
            return assumed(format!("0x{:08X}", meant.0), "hexadecimal numbers begin with `0x`");
        }
        let Slip { text, reason, .. } = self.certain_slip(section)?;
        assumed(text, reason)
    }

    /// What was certainly meant in the place of a malformed value.
    fn certain_slip(self, section: Section<'_>) -> Option<Slip> {
        if self.is_empty() || section.kind() == SectionKind::Unknown {
            return None;
        }
        let failed = |result: Result<(), ValueError>| result.is_err();
        let name = self.key().name;
        let (is_wrong, wanted) = match section.kind().shape_of(name) {
            Shape::Unsigned(_) => (failed(self.number().value.map(drop)), self.wanted_number()),
            Shape::Flag => (failed(self.flag().value.map(drop)), Wanted::Flag),
            Shape::Access => (failed(self.access_type().value.map(drop)), Wanted::Access),
            Shape::ObjectCode => (failed(self.object_code().value.map(drop)), Wanted::ObjectCode),
            Shape::Value => {
                let data_type = section.value_type();
                (failed(self.value(data_type).value.map(drop)), Wanted::Value(data_type))
            }
            Shape::Text(_) | Shape::Edition | Shape::Time | Shape::Date | Shape::Special => return None,
        };
        is_wrong.then(|| self.slip(wanted))?.filter(|slip| slip.certain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read_otherwise_than_it_is_written() {
        let text = "[ManufacturerObjects]\n1=2000\n2=0x2001\n[2000h]\nParameterName=Object #1 ; x\nObjectType=VAR\n\
            DataType=0x0007 ; UNSIGNED32\nAccessType=R/W\nDefaultValue=UNKNOWN\nPDOMapping=0;\n[2001]\nDataType=7\n\
            DefaultValue=0x10\n[vendor]\nDataType=0x0x7\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let assumed: Vec<_> = sheet
            .assumed()
            .into_iter()
            .map(|assumed| {
                let place = sheet.document().position(assumed.span.start);
                format!("{place} {} as {}", sheet.text(assumed.span), assumed.text)
            })
            .collect();
        assert_eq!(
            assumed,
            [
                "2:3 2000 as 0x2000",
                "4:2 2000h as 2000",
                "6:12 VAR as 0x7",
                "7:10 0x0007 ; UNSIGNED32 as 0x0007",
                "8:12 R/W as rw",
                "10:12 0; as 0",
            ]
        );
    }
}
