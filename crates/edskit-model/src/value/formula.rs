//! `$NODEID+0x180`: values that depend on the node-ID, kept symbolic.

use super::number::{Number, NumberError, NumberErrorKind, Radix};
use crate::Span;
use core::fmt;
use edskit_types::NodeId;

const VARIABLE: &[u8] = b"$NODEID";

/// The sum of the node-ID and constants (CiA 306 v1.3, 4.3: `$NODEID { "+" number }`).
///
/// Terms are read in any order, any case and with blanks between them, because readers and writers in use differ;
/// how the text deviates from the specification is kept for the linter.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Formula {
    offset: u64,
    style: FormulaStyle,
}

/// How a formula is written.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct FormulaStyle {
    /// A number stands before `$NODEID`: by CiA 306 the text then counts as no formula.
    pub variable_not_first: bool,
    /// `$NODEID` is not all upper case.
    pub variable_case: bool,
    /// Blanks stand between the terms.
    pub blanks: bool,
    /// A constant is written in decimal (CANFestival reads it as hexadecimal).
    pub decimal: bool,
}

impl Formula {
    /// Whether a text is meant as a formula: it holds a `$`, or names the variable without one at its start or end.
    #[inline]
    pub fn is_meant(text: &[u8]) -> bool {
        text.contains(&b'$')
    }

    /// Reads a whole text as one formula.
    ///
    /// ```
    /// use edskit_model::Formula;
    /// use edskit_types::NodeId;
    /// let formula = Formula::parse(b"$NODEID+0x80000200").unwrap();
    /// assert_eq!(formula.evaluate(NodeId::new(5).unwrap()), Some(0x8000_0205));
    /// ```
    ///
    /// # Errors
    /// What is wrong, and at which bytes.
    pub fn parse(text: &[u8]) -> Result<Self, FormulaError> {
        let mut formula = Formula { offset: 0, style: FormulaStyle::default() };
        let mut variables = 0;
        let mut start = 0;
        for (position, term) in text.split(|&byte| byte == b'+').enumerate() {
            let end = start + term.len();
            let trimmed = term.trim_ascii();
            formula.style.blanks |= trimmed.len() != term.len();
            let lead = term.len() - term.trim_ascii_start().len();
            let at = |offset: usize, len: usize| {
                let begin = (start + lead + offset) as u32;
                Span::new(begin, begin + len as u32)
            };
            if trimmed.first() == Some(&b'$') {
                let name = trimmed.get(..VARIABLE.len()).filter(|name| name.eq_ignore_ascii_case(VARIABLE));
                let Some(name) = name else {
                    return Err(FormulaError {
                        kind: FormulaErrorKind::Variable,
                        span: at(0, trimmed.len()),
                    });
                };
                if let rest @ [_, ..] = &trimmed[VARIABLE.len()..] {
                    return Err(FormulaError {
                        kind: FormulaErrorKind::Operator,
                        span: at(VARIABLE.len(), rest.len()),
                    });
                }
                variables += 1;
                if variables > 1 {
                    return Err(FormulaError {
                        kind: FormulaErrorKind::TwoVariables,
                        span: at(0, trimmed.len()),
                    });
                }
                formula.style.variable_not_first = position > 0;
                formula.style.variable_case = name != VARIABLE;
            } else {
                let error = |error: NumberError| FormulaError {
                    kind: FormulaErrorKind::Term(error.kind),
                    span: at(0, trimmed.len()),
                };
                let number = Number::parse(trimmed).map_err(error)?;
                formula.style.decimal |= number.radix() == Radix::Decimal && number.value() != 0;
                formula.offset = number
                    .to::<u64>()
                    .and_then(|value| formula.offset.checked_add(value))
                    .ok_or(FormulaError { kind: FormulaErrorKind::Overflow, span: at(0, trimmed.len()) })?;
            }
            start = end + 1;
        }
        if variables == 0 {
            let span = Span::new(0, text.len() as u32);
            return Err(FormulaError { kind: FormulaErrorKind::NoVariable, span });
        }
        Ok(formula)
    }

    /// The sum of the constants.
    #[inline]
    pub fn offset(self) -> u64 {
        self.offset
    }

    /// How it is written.
    pub fn style(self) -> FormulaStyle {
        self.style
    }

    /// The value for a node-ID; `None` above 64 bits.
    #[inline]
    pub fn evaluate(self, node_id: NodeId) -> Option<u64> {
        self.offset.checked_add(u64::from(node_id.get()))
    }
}

impl fmt::Display for Formula {
    /// The canonical spelling.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.offset {
            0 => f.write_str("$NODEID"),
            offset => write!(f, "$NODEID+0x{offset:X}"),
        }
    }
}

/// Why a text is not a formula, and where.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct FormulaError {
    /// What is wrong.
    pub kind: FormulaErrorKind,
    /// The bytes of the text that are wrong.
    pub span: Span,
}

/// What keeps a text from being a formula.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum FormulaErrorKind {
    /// A `$` that does not begin `$NODEID`.
    Variable,
    /// Something else than `+` behind `$NODEID`.
    Operator,
    /// `$NODEID` a second time.
    TwoVariables,
    /// No `$NODEID` at the start of a term.
    NoVariable,
    /// A term that is not a number.
    Term(NumberErrorKind),
    /// The sum has more than 64 bits, or a term is negative.
    Overflow,
}

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            FormulaErrorKind::Variable => f.write_str("the only variable is $NODEID"),
            FormulaErrorKind::Operator => f.write_str("only `+` may follow $NODEID"),
            FormulaErrorKind::TwoVariables => f.write_str("$NODEID stands twice"),
            FormulaErrorKind::NoVariable => f.write_str("$NODEID does not stand as a term of its own"),
            FormulaErrorKind::Term(NumberErrorKind::Empty) => f.write_str("a term is missing beside `+`"),
            FormulaErrorKind::Term(kind) => {
                write!(f, "a term is not a number: {}", NumberError { kind, offset: 0 })
            }
            FormulaErrorKind::Overflow => f.write_str("the sum does not fit 64 bits"),
        }
    }
}

impl core::error::Error for FormulaError {}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parse(text: &str) -> Formula {
        Formula::parse(text.as_bytes()).unwrap()
    }

    fn error(text: &str) -> (FormulaErrorKind, Span) {
        let error = Formula::parse(text.as_bytes()).unwrap_err();
        (error.kind, error.span)
    }

    #[test]
    fn any_order_case_and_spacing_is_understood() {
        for text in ["$NODEID+0x180", "0x180+$NODEID", "$nodeid + 0x180", "$NodeID+0x100+0x80", "384+$NODEID"]
        {
            assert_eq!(parse(text).offset(), 0x180, "{text}");
        }
        assert_eq!(parse("$NODEID").offset(), 0);
        assert_eq!(parse("$NODEID+0x180").style(), FormulaStyle::default());
        assert!(parse("0x180+$NODEID").style().variable_not_first);
        assert!(parse("$NodeId").style().variable_case);
        assert!(parse("$NODEID + 0x1").style().blanks);
        assert!(parse("$NODEID+384").style().decimal);
    }

    #[test]
    fn junk_is_named_and_placed() {
        assert_eq!(error("$NODEID*2+0x180"), (FormulaErrorKind::Operator, Span::new(7, 9)));
        assert_eq!(error("$NODE+1"), (FormulaErrorKind::Variable, Span::new(0, 5)));
        assert_eq!(error("$NODEID+$NODEID"), (FormulaErrorKind::TwoVariables, Span::new(8, 15)));
        assert_eq!(error("$NODEID+"), (FormulaErrorKind::Term(NumberErrorKind::Empty), Span::new(8, 8)));
        assert_eq!(error("0x180"), (FormulaErrorKind::NoVariable, Span::new(0, 5)));
        assert_eq!(error("$NODEID+0xFFFFFFFFFFFFFFFF+1").0, FormulaErrorKind::Overflow);
    }

    #[test]
    fn evaluation_is_checked() {
        let node_id = NodeId::new(127).unwrap();
        assert_eq!(parse("$NODEID+0x80000180").evaluate(node_id), Some(0x8000_01FF));
        assert_eq!(parse("$NODEID+0xFFFFFFFFFFFFFFFF").evaluate(node_id), None);
    }

    #[test]
    fn a_very_long_sum_needs_no_stack() {
        let text = format!("$NODEID{}", "+1".repeat(500_000));
        assert_eq!(parse(&text).offset(), 500_000);
    }

    proptest! {
        #[test]
        fn never_panics(text in "[$NODEIDnodeid+ 0-9x*-]{0,40}") {
            let _ = Formula::parse(text.as_bytes());
        }
    }
}
