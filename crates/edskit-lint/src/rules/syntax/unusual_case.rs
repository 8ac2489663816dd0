use super::repeats;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Key, KeyName, Section, SectionKind, Span};
use std::collections::{HashMap, HashSet};

rule! {
    /// A name is written in another case than CiA 306 writes it
    ///
    /// ## What it does
    /// Reports keys and names of sections whose case differs from that of CiA 306, such as `parameterName` or
    /// `[mandatoryObjects]`. Each name gives one finding for the file. Hexadecimal digits may have either case, and
    /// `[1018Sub1]` is read by all.
    ///
    /// ## Why is this bad
    /// Case makes no difference by the standard, but it does to readers in use: python-canopen looks for the names as
    /// the standard writes them. Without `ParameterName`, `DataType`, `AccessType` or `Line1` it refuses the whole file;
    /// other entries it does not see.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// parameterName=Device type
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2; engineering judgement: the readers in use.
    pub(crate) static UNUSUAL_CASE = {
        code: "SYN029",
        name: "unusual-case",
        group: Syntax,
        severity: Info,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

/// What is found of one name.
struct Unusual {
    /// Where it stands first.
    first: Span,
    /// As CiA 306 writes it there.
    usual: String,
    is_section: bool,
    edits: Vec<Edit>,
}

fn check(context: &Context<'_>, report: &mut Report) {
    let source = context.source();
    // Keys by their name without a number, sections by what follows their index.
    let mut found: Vec<Unusual> = Vec::new();
    let mut places: HashMap<(bool, String), usize> = HashMap::new();
    let mut add = |is_section: bool, group: String, span: Span, usual: String| {
        let place = *places.entry((is_section, group)).or_insert(found.len());
        if place == found.len() {
            found.push(Unusual { first: span, usual: usual.clone(), is_section, edits: Vec::new() });
        }
        found[place].edits.push(Edit::replace(span, usual));
    };
    let repeated: HashSet<SectionKind> =
        repeats::of_cia_306(context).map(|(_, again)| again.kind()).collect();
    for section in context.sheet.sections() {
        // What stands twice is the matter of SYN013 and SYN014: in one case it would stand twice for all readers.
        if let Some(usual) = usual_name(section, source).filter(|_| !repeated.contains(&section.kind())) {
            add(true, stem(section.kind(), &usual), section.name_span(), usual);
        }
    }
    let mut counts: Option<(Span, HashMap<Key, usize>)> = None;
    for entry in context.sheet.unusual_keys() {
        let Some(section) = entry.section() else { continue };
        let header = section.span();
        if counts.as_ref().is_none_or(|(counted, _)| *counted != header) {
            let mut keys = HashMap::new();
            section.keys().for_each(|key| *keys.entry(key).or_default() += 1);
            counts = Some((header, keys));
        }
        let is_alone = counts.as_ref().is_some_and(|(_, keys)| keys.get(&entry.key()) == Some(&1));
        let (name, written) = (entry.key().name, entry.key_span());
        if let Some(usual) = usual_key(name, written.slice(source)).filter(|_| is_alone) {
            add(false, name.spelling().to_owned(), written, usual);
        }
    }
    for Unusual { first, usual, is_section, edits } in found {
        let (open, close) = if is_section { ("[", "]") } else { ("", "") };
        let more = match edits.len() - 1 {
            0 => String::new(),
            1 => ", and once more in this file".to_owned(),
            more => format!(", and {more} times more in this file"),
        };
        let message = format!(
            "`{open}{}{close}` is `{open}{usual}{close}` in CiA 306{more}; readers that heed case do not find it",
            context.sheet.text(first)
        );
        report
            .add(first, message)
            .help(format!("write `{open}{usual}{close}`; python-canopen is such a reader"))
            .safe_fix("Write the names as CiA 306 does", edits);
    }
}

/// What the names of sections of one kind have in common: all but their numbers.
fn stem(kind: SectionKind, usual: &str) -> String {
    match (kind, kind.index()) {
        (SectionKind::SubObject(..), _) => "sub".to_owned(),
        (_, Some(_)) => usual.trim_start_matches(|c: char| c.is_ascii_hexdigit()).to_owned(),
        _ => usual.chars().filter(|c| !c.is_ascii_digit()).collect(),
    }
}

/// A key as CiA 306 writes it, where only its case differs; the digits of a number stay.
fn usual_key(name: KeyName, text: &[u8]) -> Option<String> {
    let spelling = name.spelling();
    let text = std::str::from_utf8(text).ok()?;
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_hexdigit());
    let usual = match text.get(..4) {
        // `Node12Present`
        Some(node)
            if node.eq_ignore_ascii_case("Node") && text.len() > 4 && !spelling.starts_with("Node") =>
        {
            let number = text[4..].split_at_checked(text.len().checked_sub(4 + spelling.len())?)?.0;
            format!("Node{number}{spelling}")
        }
        _ => {
            let number = text.get(spelling.len()..).filter(|number| digits(number))?;
            format!("{spelling}{number}")
        }
    };
    (usual != text && usual.eq_ignore_ascii_case(text)).then_some(usual)
}

/// The name of a section as CiA 306 writes it, where only its case differs. Its numbers stay as they are.
fn usual_name(section: Section<'_>, source: &[u8]) -> Option<String> {
    let kind = section.kind();
    let header = &source[section.line().span().start as usize..];
    let is_usual =
        matches!(header.get(5..8), Some(b"sub" | b"Sub")) && matches!(kind, SectionKind::SubObject(..));
    if is_usual || matches!(kind, SectionKind::Object(_) | SectionKind::Unknown) {
        return None;
    }
    let name = section.name_span().slice(source);
    if let SectionKind::SubObject(..) = kind {
        let word = name.iter().position(|byte| byte.eq_ignore_ascii_case(&b's'))?;
        return (&name[word + 1..word + 3] != b"ub").then(|| {
            let (index, digits) = (&name[..word], &name[word + 3..]);
            format!("{}sub{}", String::from_utf8_lossy(index), String::from_utf8_lossy(digits))
        });
    }
    let usual = kind.canonical_name()?;
    let text = std::str::from_utf8(name).ok()?;
    if !usual.eq_ignore_ascii_case(text) {
        // Zeros and `0x` are the matter of SYN016, the other spelling of [DeviceComissioning] that of DCF007.
        return None;
    }
    // The case of hexadecimal digits in front makes no difference.
    let digits = match kind.index() {
        Some(index) => format!("{:X}", index.0).len(),
        None => 0,
    };
    let usual = format!("{}{}", &text[..digits], &usual[digits..]);
    let is_module = matches!(kind, SectionKind::Module(..));
    let differs = if is_module { !is_same_but_for_digits(&usual, text) } else { usual != text };
    differs.then_some(usual)
}

/// Whether two names of one module's section differ at most in the case of the digits at their end.
fn is_same_but_for_digits(usual: &str, text: &str) -> bool {
    let word = |name: &str| name.trim_end_matches(|c: char| c.is_ascii_hexdigit()).to_owned();
    word(usual) == word(text) || usual == text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed};

    #[test]
    fn keys_are_found_once_each_and_mended_everywhere() {
        let text = "[FileInfo]\nEDSversion=4.0\n[1000]\nparameterName=a\n[1018Sub1]\nparametername=b\nDataType=7\n[Comments]\nLines=1\nline1=x\n[DummyUsage]\ndummy0001=0\n[MandatoryObjects]\nsupportedObjects=1\n1=0x1000\n";
        assert_eq!(
            findings(&UNUSUAL_CASE, text),
            [
                "2:1 info: `EDSversion` is `EDSVersion` in CiA 306; readers that heed case do not find it",
                "4:1 info: `parameterName` is `ParameterName` in CiA 306, and once more in this file; readers that heed case do not find it",
                "10:1 info: `line1` is `Line1` in CiA 306; readers that heed case do not find it",
                "12:1 info: `dummy0001` is `Dummy0001` in CiA 306; readers that heed case do not find it",
                "14:1 info: `supportedObjects` is `SupportedObjects` in CiA 306; readers that heed case do not find it",
            ]
        );
        let mended = text
            .replace("EDSversion", "EDSVersion")
            .replace("parameterName", "ParameterName")
            .replace("parametername", "ParameterName")
            .replace("line1", "Line1")
            .replace("dummy", "Dummy")
            .replace("supported", "Supported");
        assert_eq!(fixed(&UNUSUAL_CASE, text), mended);
        let nodes = "[Topology]\nNODE1Present=1\nnode12dcfname=a.dcf\nNode2Name=b\n";
        assert_eq!(findings_in(&UNUSUAL_CASE, "a.cpj", nodes.as_bytes()).len(), 2);
    }

    #[test]
    fn what_stands_twice_is_left_to_other_rules() {
        let text = "[1000]\nParameterName=a\nparametername=b\n[FileInfo]\n[fileinfo]\n";
        assert_eq!(findings(&UNUSUAL_CASE, text), [""; 0]);
    }

    #[test]
    fn sections_too_but_not_those_that_all_read() {
        let text = "[fileinfo]\n[1018SUB1]\n[1018sUb2]\n[1a00Sub1]\n[1a00sub2]\n[1a00VALUE]\n[1a01value]\n[m1moduleInfo]\n[M1Fixed1a00]\n[ToolX]\n[TOOL1]\n[1000]\n[0x1001]\n";
        let names: Vec<String> = findings(&UNUSUAL_CASE, text)
            .iter()
            .map(|finding| finding.split('`').take(4).collect::<Vec<_>>().join("`"))
            .collect();
        assert_eq!(
            names,
            [
                "1:2 info: `[fileinfo]` is `[FileInfo]",
                "2:2 info: `[1018SUB1]` is `[1018sub1]",
                "6:2 info: `[1a00VALUE]` is `[1a00Value]",
                "8:2 info: `[m1moduleInfo]` is `[M1ModuleInfo]",
                "11:2 info: `[TOOL1]` is `[Tool1]",
            ]
        );
        assert_eq!(
            fixed(&UNUSUAL_CASE, text),
            "[FileInfo]\n[1018sub1]\n[1018sub2]\n[1a00Sub1]\n[1a00sub2]\n[1a00Value]\n[1a01Value]\n[M1ModuleInfo]\n[M1Fixed1a00]\n[ToolX]\n[Tool1]\n[1000]\n[0x1001]\n"
        );
    }
}
