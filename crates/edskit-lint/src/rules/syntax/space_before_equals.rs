use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, Span};

rule! {
    /// Blanks stand between a key and its `=`
    ///
    /// ## What it does
    /// Reports entries with blanks or tabs before the `=`. Blanks behind the `=` are allowed.
    ///
    /// ## Why is this bad
    /// The `=` must follow the key at once. Readers that keep to it do not find the key, because to them the blanks
    /// belong to it.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// DataType = 0x0007
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2 (the example of its clause 4.6.3.4.1 breaks the rule itself).
    pub(crate) static SPACE_BEFORE_EQUALS = {
        code: "SYN009",
        name: "space-before-equals",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let source = context.source();
    for line in context.odd_entries().map(Entry::line) {
        let equals = line.equals().start;
        if !matches!(source.get(equals.wrapping_sub(1) as usize), Some(b' ' | b'\t')) {
            continue;
        }
        let key = line.key(source);
        let blanks = Span::new(key.end, equals);
        report
            .add(blanks, format!("blanks stand between `{}` and its `=`", context.sheet.text(key)))
            .help("write `=` directly behind the key")
            .safe_fix("Delete the blanks", vec![Edit::delete(blanks)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn blanks_elsewhere_are_allowed() {
        let text = "[1000]\nDataType \t=7\nParameterName= a = b\n";
        assert_eq!(
            findings(&SPACE_BEFORE_EQUALS, text),
            ["2:9 warning: blanks stand between `DataType` and its `=`"]
        );
        assert_eq!(fixed(&SPACE_BEFORE_EQUALS, text), "[1000]\nDataType=7\nParameterName= a = b\n");
    }
}
