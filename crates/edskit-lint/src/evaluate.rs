//! What a value is on the device: ParameterValue before DefaultValue, formulas at a node-ID.

use crate::{Context, FileKind, Variable};
use edskit_model::{Datasheet, Entry, Field, KeyName, Object, SectionKind, Span, Value};
use edskit_types::{CobId, DataType, Index, NodeId, SubIndex};

/// The node-IDs that values are evaluated at, in ascending order: the one that a DCF commissions, else the lowest and
/// the highest.
pub(crate) fn node_ids(context: &Context<'_>) -> impl Iterator<Item = NodeId> + Clone {
    let pair = match commissioned(context) {
        Some(node_id) => [Some(node_id), None],
        None => [Some(NodeId::MIN), Some(NodeId::MAX)],
    };
    pair.into_iter().flatten()
}

/// The node-ID that a DCF commissions.
pub(crate) fn commissioned(context: &Context<'_>) -> Option<NodeId> {
    if context.kind == FileKind::Dcf { context.sheet.commissioned_node_id() } else { None }
}

/// The value of a dictionary entry that counts, readable as an integer, with its place in the file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effective<'a> {
    /// The entry that holds it: ParameterValue, DefaultValue, an entry of `[xxxxValue]`, or CompactSubObj.
    pub(crate) entry: Entry<'a>,
    value: Value<'a>,
    data_type: DataType,
}

impl<'a> Effective<'a> {
    /// The value of `object` at `sub_index`, 00h for a VAR; `None` where the file says none or nothing readable, which
    /// is the matter of other rules.
    pub(crate) fn of(object: Object<'a>, sub_index: u8) -> Option<Self> {
        let entry = object.dictionary_entry(SubIndex(sub_index))?;
        // Of a type that CiA 301 does not define, a number counts as it is written.
        let data_type = entry.data_type().unwrap_or(DataType::Unsigned64);
        Self::new(entry.value_field()?, data_type)
    }

    /// The value that a field holds.
    pub(crate) fn new(field: Field<'a, Value<'a>>, data_type: DataType) -> Option<Self> {
        let value = field.known()?;
        matches!(value, Value::Boolean(_) | Value::Integer(_) | Value::Formula(_)).then_some(Self {
            entry: field.entry,
            value,
            data_type,
        })
    }

    /// The integer at a node-ID; `None` where it does not fit its data type.
    pub(crate) fn at(self, node_id: NodeId) -> Option<i128> {
        self.value.integer(self.data_type, Some(node_id)).ok()
    }

    /// The same, as a type that it must fit: `u32`, `u16`, `u8`.
    pub(crate) fn unsigned_at<T: TryFrom<i128>>(self, node_id: NodeId) -> Option<T> {
        T::try_from(self.at(node_id)?).ok()
    }

    /// The value as a COB-ID at a node-ID.
    pub(crate) fn cob_id_at(self, node_id: NodeId) -> Option<CobId> {
        self.unsigned_at(node_id).map(CobId)
    }

    /// The integer where it does not depend on the node-ID.
    pub(crate) fn constant<T: TryFrom<i128>>(self) -> Option<T> {
        T::try_from(self.value.integer(self.data_type, None).ok()?).ok()
    }

    /// Whether the value is a formula.
    pub(crate) fn depends_on_node_id(self) -> bool {
        matches!(self.value, Value::Formula(_))
    }

    /// Where the value stands.
    pub(crate) fn span(self) -> Span {
        self.entry.value_span()
    }
}

/// Every value that a variable says: DefaultValue, ParameterValue, and the entries of `[xxxxValue]` of a compact object.
pub(crate) fn stated<'a>(
    context: &'a Context<'_>,
    variable: &Variable<'a>,
) -> impl Iterator<Item = Effective<'a>> {
    let data_type = variable.standard_type.unwrap_or(DataType::Unsigned64);
    let is_compact = variable.is_compact();
    let own = if is_compact || variable.holds_value() {
        [variable.default_value, variable.parameter_value]
    } else {
        [None, None]
    };
    let values = SectionKind::CompactValues(variable.index);
    let list = is_compact.then(|| context.sheet.section(values)).flatten();
    let listed = list.into_iter().flat_map(|list| list.all_numbered(KeyName::Item));
    let listed = listed.map(move |entry| entry.value(Some(data_type)));
    own.into_iter().flatten().chain(listed).filter_map(move |field| Effective::new(field, data_type))
}

/// The value that counts at `index` and `sub_index`, 00h for a VAR.
pub(crate) fn effective(sheet: &Datasheet, index: Index, sub_index: u8) -> Option<Effective<'_>> {
    Effective::of(sheet.object(index)?, sub_index)
}

/// The device type at `index`, 1000h or that of a logical device. No configuration can change what a device is, so the
/// DefaultValue comes first.
pub(crate) fn device_type(sheet: &Datasheet, index: Index) -> Option<Effective<'_>> {
    let object = sheet.object(index)?;
    let field = object.default_value().or_else(|| object.parameter_value())?;
    Effective::new(field, object.standard_type().unwrap_or(DataType::Unsigned64))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn context<'a>(sheet: &'a Datasheet, kind: FileKind) -> Context<'a> {
        Context::new(sheet, kind, None)
    }

    fn numbers(text: &str, kind: FileKind) -> Vec<u8> {
        let sheet = Datasheet::parse(text.as_bytes());
        node_ids(&context(&sheet, kind)).map(NodeId::get).collect()
    }

    #[test]
    fn a_dcf_has_one_node_id_and_an_eds_two() {
        let text = "[DeviceComissioning]\nNodeID=0x10\n";
        assert_eq!(numbers(text, FileKind::Dcf), [16]);
        assert_eq!(numbers(text, FileKind::Eds), [1, 127]);
        assert_eq!(numbers("[DeviceComissioning]\nNodeID=128\n", FileKind::Dcf), [1, 127]);
        assert_eq!(numbers("[1000]\n", FileKind::Dcf), [1, 127]);
    }

    #[test]
    fn the_value_of_a_dcf_comes_before_the_default() {
        let text = "[1800]\nObjectType=9\n[1800sub1]\nDataType=7\nDefaultValue=$NODEID+0x180\n[1800sub2]\nDataType=5\nDefaultValue=1\nParameterValue=0xFE\n[1800sub3]\nDataType=6\nDefaultValue=1\nParameterValue=x\n[1A00]\nObjectType=9\nDataType=7\nDefaultValue=5\nCompactSubObj=2\n[1A00Value]\nNrOfEntries=1\n2=0x60000108\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let value = |index, sub_index| effective(&sheet, Index(index), sub_index);
        let cob_id = value(0x1800, 1).unwrap();
        assert_eq!(cob_id.cob_id_at(NodeId::MAX), Some(CobId(0x1FF)));
        assert_eq!((cob_id.depends_on_node_id(), cob_id.constant::<u32>()), (true, None));
        let kind = value(0x1800, 2).unwrap();
        assert_eq!((kind.constant(), kind.span().slice(text.as_bytes())), (Some(0xFE_u8), &b"0xFE"[..]));
        assert!(value(0x1800, 3).is_none(), "what cannot be read is not replaced by the default");
        assert!(value(0x1800, 4).is_none() && value(0x1801, 1).is_none());
        let compact = [0, 1, 2].map(|sub_index| value(0x1A00, sub_index).unwrap().constant::<u32>());
        assert_eq!(compact, [Some(2), Some(5), Some(0x6000_0108)]);
    }

    #[test]
    fn a_configuration_does_not_change_the_device_type() {
        let text = b"[1000]\nDataType=7\nDefaultValue=0x192\nParameterValue=0\n[6FFF]\nDataType=7\nParameterValue=1\n";
        let sheet = Datasheet::parse(text);
        let number = |index| device_type(&sheet, Index(index)).and_then(Effective::constant::<u32>);
        assert_eq!([number(0x1000), number(0x6FFF), number(0x67FF)], [Some(0x192), Some(1), None]);
    }

    #[test]
    fn only_what_fits_its_type_counts() {
        let text = "[1017]\nDataType=6\nDefaultValue=0x10000\n[1014]\nDataType=0x7\nDefaultValue=$NODEID+0xFFFFFFFF\n[1008]\nDataType=9\nDefaultValue=5\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let value = |index| effective(&sheet, Index(index), 0);
        assert_eq!(value(0x1017).unwrap().at(NodeId::MIN), None);
        assert_eq!(value(0x1014).unwrap().cob_id_at(NodeId::MIN), None);
        assert!(value(0x1008).is_none());
    }
}
