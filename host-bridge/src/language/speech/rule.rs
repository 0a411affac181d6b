//! What may be said, as a rule over words; and its text as JSGF has it.

use std::fmt;

/// What may be said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    /// A phrase, words with a space between them.
    Phrase(String),
    /// One after another.
    All(Vec<Rule>),
    /// One of them.
    Any(Vec<Rule>),
    /// This, or nothing.
    Maybe(Box<Rule>),
}

impl Rule {
    /// One of these phrases; `None` without any.
    #[must_use]
    pub fn any_of(phrases: &[String]) -> Option<Self> {
        let rules: Vec<_> = phrases.iter().cloned().map(Self::Phrase).collect();
        (!rules.is_empty()).then_some(Self::Any(rules))
    }

    /// One of these phrases, or nothing.
    #[must_use]
    pub fn maybe_of(phrases: &[String]) -> Option<Self> {
        Self::any_of(phrases).map(|any| Self::Maybe(Box::new(any)))
    }

    /// The whole grammar in the Java Speech Grammar Format, version 1.0.
    #[must_use]
    pub fn jsgf(&self) -> String {
        format!("#JSGF V1.0;\ngrammar commands;\npublic <utterance> = {self};\n")
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |f: &mut fmt::Formatter<'_>, rules: &[Self], between: &str| {
            rules.iter().enumerate().try_for_each(|(i, rule)| {
                let between = if i == 0 { "" } else { between };
                write!(f, "{between}{rule}")
            })
        };
        match self {
            Self::Phrase(words) => f.write_str(words),
            Self::All(rules) => list(f, rules, " "),
            Self::Any(rules) => {
                f.write_str("(")?;
                list(f, rules, " | ")?;
                f.write_str(")")
            }
            Self::Maybe(rule) => write!(f, "[{rule}]"),
        }
    }
}

/// What there is of these, one after another.
pub(super) fn all<const N: usize>(rules: [Option<Rule>; N]) -> Rule {
    Rule::All(rules.into_iter().flatten().collect())
}

/// One of these; `None` without any.
pub(super) fn either(rules: impl IntoIterator<Item = Rule>) -> Option<Rule> {
    let rules: Vec<_> = rules.into_iter().collect();
    (!rules.is_empty()).then_some(Rule::Any(rules))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rule_is_written_as_jsgf() {
        let names = Rule::any_of(&["cup".into(), "foam block".into()]).unwrap();
        let the = Rule::maybe_of(&["the".into()]).unwrap();
        let rule = Rule::All(vec![Rule::Phrase("pick up".into()), the, names]);
        assert_eq!(rule.to_string(), "pick up [(the)] (cup | foam block)");
        assert!(rule.jsgf().ends_with("(cup | foam block);\n"));
        assert_eq!(Rule::any_of(&[]), None);
    }
}
