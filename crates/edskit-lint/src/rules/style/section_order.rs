use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Section, SectionKind};
use edskit_types::{Index, ObjectArea, SubIndex};

rule! {
    /// Sections are out of order
    ///
    /// ## What it does
    /// Reports a file whose `[FileInfo]` or `[DeviceInfo]` stands behind the objects, whose objects do not ascend
    /// within their list (mandatory, optional, manufacturer), or whose sub-objects do not follow their object in
    /// ascending order. Only the first such section is shown.
    ///
    /// ## Why is this bad
    /// People find an object by its place, and two versions of a file can be compared line by line only if the order
    /// is the same.
    ///
    /// ## Example
    /// ```eds
    /// [1018]
    /// ParameterName=Identity
    /// ObjectType=0x9
    ///
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    ///
    /// [1018]
    /// ParameterName=Identity
    /// ObjectType=0x9
    /// ```
    ///
    /// ## References
    /// Engineering judgement: CiA 306 v1.3, 4.2 allows any order; this one is that of its examples.
    pub(crate) static SECTION_ORDER = {
        code: "STY001",
        name: "section-order",
        group: Style,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let mut order = Order::default();
    let mut first: Option<(Section<'_>, String)> = None;
    let mut count = 0;
    for section in context.sheet.sections() {
        if let Some(before) = order.misplaced(section) {
            count += 1;
            first.get_or_insert((section, before));
        }
    }
    let Some((section, before)) = first else { return };
    let others = match count {
        1 => String::new(),
        2 => "; 1 more section is out of order".to_owned(),
        _ => format!("; {} more sections are out of order", count - 1),
    };
    report
        .add(section.span(), format!("`[{}]` belongs before {before}{others}", section.name()))
        .help("write information first, then each list with its objects in ascending order");
}

/// What stood before, as far as the order depends on it.
#[derive(Default)]
struct Order {
    /// Whether a list or an object was seen.
    has_objects: bool,
    /// The last object of each list.
    last: [Option<Index>; 3],
    /// The object whose sub-objects stand here, and the last of them.
    current: Option<(Index, Option<SubIndex>)>,
}

impl Order {
    /// What a section should stand before, if it should.
    fn misplaced(&mut self, section: Section<'_>) -> Option<String> {
        match section.kind() {
            SectionKind::FileInfo | SectionKind::DeviceInfo => {
                self.has_objects.then(|| "the objects".to_owned())
            }
            kind if kind.is_object_list() => {
                self.has_objects = true;
                None
            }
            SectionKind::Object(index) => {
                self.has_objects = true;
                self.current = Some((index, None));
                let last = &mut self.last[list(index)];
                let before = last.filter(|last| *last > index);
                *last = (*last).max(Some(index));
                before.map(|last| format!("`[{:X}]`", last.0))
            }
            SectionKind::SubObject(index, sub_index) => {
                self.has_objects = true;
                let before = match self.current {
                    Some((current, Some(last))) if current == index && last > sub_index => {
                        Some(format!("`[{:X}sub{:X}]`", index.0, last.0))
                    }
                    Some((current, _)) if current != index => {
                        // The sub-object of an object that stands elsewhere, or nowhere, which is OBJ010.
                        let is_described = section.sheet().object(index).is_some();
                        is_described.then(|| format!("`[{:X}]`, behind its own object", current.0))
                    }
                    _ => None,
                };
                if let Some((current, last)) = &mut self.current
                    && *current == index
                {
                    *last = (*last).max(Some(sub_index));
                }
                before
            }
            _ => None,
        }
    }
}

/// The list that an object belongs into.
fn list(index: Index) -> usize {
    match index.area() {
        _ if [Index::DEVICE_TYPE, Index::ERROR_REGISTER, Index::IDENTITY].contains(&index) => 0,
        ObjectArea::Manufacturer => 2,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(names: &[&str]) -> String {
        let text: String = names.iter().map(|name| format!("[{name}]\n")).collect();
        findings(&SECTION_ORDER, &text).join("|")
    }

    #[test]
    fn lists_ascend_each_for_itself() {
        let fine = [
            "FileInfo",
            "MandatoryObjects",
            "1000",
            "1018",
            "1018sub0",
            "1018sub4",
            "OptionalObjects",
            "1005",
            "6000",
            "2000",
        ];
        assert_eq!(found(&fine), "");
        assert_eq!(found(&["1005", "2000", "1000", "6000", "3000"]), "");
        assert_eq!(
            found(&["1006", "1005", "1004"]),
            "2:1 info: `[1005]` belongs before `[1006]`; 1 more section is out of order"
        );
        assert_eq!(found(&["1000", "FileInfo"]), "2:1 info: `[FileInfo]` belongs before the objects");
        assert_eq!(
            found(&["1018", "1018sub2", "1018subA", "1018sub4"]),
            "4:1 info: `[1018sub4]` belongs before `[1018subA]`"
        );
        assert_eq!(
            found(&["1018", "1019", "1018sub1"]),
            "3:1 info: `[1018sub1]` belongs before `[1019]`, behind its own object"
        );
        assert_eq!(found(&["1019", "1018sub1"]), "");
    }
}
