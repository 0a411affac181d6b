//! Text to tokens: words and numbers, folded so that case, accents, hyphens and underscores do not
//! matter, and the punctuation that tells clauses apart.

use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;
use unicode_segmentation::UnicodeSegmentation;

use super::error::{LONGEST, LanguageError};

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A word, a number or a sign such as `%`.
    Word,
    /// A comma, dash or colon.
    Comma,
    /// The end of a sentence.
    Stop,
    /// A question mark.
    Question,
}

/// One token.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: Kind,
    /// Folded: lower case, no accents.
    pub text: String,
    /// Its bytes in the text.
    pub span: std::ops::Range<usize>,
}

/// Lower case, without accents, with plain apostrophes.
#[must_use]
pub fn fold(text: &str) -> String {
    text.nfkd()
        .filter(|&c| !is_combining_mark(c))
        .map(|c| {
            if matches!(c, '\u{2019}' | '\u{2018}' | '\u{b4}' | '`') {
                '\''
            } else {
                c
            }
        })
        .flat_map(char::to_lowercase)
        .collect()
}

/// The text of these bytes.
///
/// # Errors
/// [`LanguageError::TooLong`], [`LanguageError::NotText`].
pub fn text_of(bytes: &[u8]) -> Result<&str, LanguageError> {
    if bytes.len() > LONGEST {
        return Err(LanguageError::TooLong { bytes: bytes.len() });
    }
    std::str::from_utf8(bytes).map_err(|e| LanguageError::NotText {
        at: e.valid_up_to(),
    })
}

/// The tokens of a text; control characters separate words and say nothing.
///
/// # Errors
/// [`LanguageError::TooLong`], [`LanguageError::Empty`] when there is no word.
pub fn tokens(text: &str) -> Result<Vec<Token>, LanguageError> {
    if text.len() > LONGEST {
        return Err(LanguageError::TooLong { bytes: text.len() });
    }
    let mut out = Vec::new();
    for (start, piece) in text.split_word_bound_indices() {
        let first = piece.chars().next().unwrap_or(' ');
        let before = text.get(..start).unwrap_or_default();
        if first.is_alphanumeric() {
            let at = out.len();
            words(piece, start, &mut out);
            // ".5 m"
            if let Some(token) = out
                .get_mut(at)
                .filter(|_| first.is_ascii_digit() && is_bare_point(before))
            {
                token.text.insert_str(0, "0.");
                token.span.start = start - 1;
            }
        } else if first == '_' {
            for part in piece.split('_').filter(|p| !p.is_empty()) {
                words(
                    part,
                    start + (part.as_ptr() as usize - piece.as_ptr() as usize),
                    &mut out,
                );
            }
        } else if let Some(token) = sign(text, start, piece, first) {
            out.push(token);
        }
    }
    if out.iter().any(|t| t.kind == Kind::Word) {
        Ok(out)
    } else {
        Err(LanguageError::Empty)
    }
}

/// Whether a text ends with a decimal point that has no digit before it; what follows is a digit.
fn is_bare_point(before: &str) -> bool {
    before.strip_suffix('.').is_some_and(|rest| {
        let last = rest.chars().next_back();
        last.is_none_or(|c| c.is_whitespace() || SIGNS.contains(&c))
    })
}

/// Signs of a number.
pub(super) const SIGNS: [char; 3] = ['-', '\u{2212}', '+'];

/// A piece that starts with a letter or digit: `put_into` and `5cm` are two words each.
fn words(piece: &str, at: usize, out: &mut Vec<Token>) {
    let mut start = 0;
    let mut last = '_';
    let mut push = |from: usize, to: usize| {
        let part = piece[from..to].trim_matches('_');
        if !part.is_empty() {
            out.push(Token {
                kind: Kind::Word,
                text: fold(part),
                span: at + from..at + to,
            });
        }
    };
    for (i, c) in piece.char_indices() {
        let border = c == '_' || (last.is_ascii_digit() && c.is_alphabetic());
        if border && i > start {
            push(start, i);
            start = i;
        }
        last = c;
    }
    push(start, piece.len());
}

fn sign(text: &str, start: usize, piece: &str, first: char) -> Option<Token> {
    let span = start..start + piece.len();
    let token = |kind, text: &str| {
        Some(Token {
            kind,
            text: text.to_owned(),
            span: span.clone(),
        })
    };
    let rest = text.get(start + piece.len()..).unwrap_or_default();
    let digit = |c: char| c.is_ascii_digit();
    let counts = |rest: &str| rest.strip_prefix('.').unwrap_or(rest).starts_with(digit);
    match first {
        '.' if rest.starts_with(digit) && is_bare_point(text.get(..=start).unwrap_or_default()) => {
            None
        }
        // "--5" is no number: it may be less than nothing or stand behind a dash.
        '-' | '\u{2212}' | '+'
            if rest.starts_with(SIGNS) && counts(rest.trim_start_matches(SIGNS)) =>
        {
            let rest_of_sign = rest.len() - rest.trim_start_matches(SIGNS).len();
            let run = text.get(start..start + piece.len() + rest_of_sign);
            token(Kind::Word, run.unwrap_or(piece))
        }
        ',' | ':' | '(' | ')' | '\u{2013}' | '\u{2014}' | '\u{2026}' => token(Kind::Comma, ","),
        '.' | ';' | '!' | '\n' => token(Kind::Stop, "."),
        '?' | '\u{bf}' => token(Kind::Question, "?"),
        '%' | '\u{b0}' => token(Kind::Word, piece),
        '-' | '\u{2212}' => {
            let before = text[..start]
                .chars()
                .next_back()
                .is_none_or(char::is_whitespace);
            let after = rest.chars().next();
            match after {
                Some(_) if counts(rest) && before => token(Kind::Word, "minus"),
                Some(c) if c.is_alphanumeric() && !before => None,
                _ => token(Kind::Comma, ","),
            }
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Vec<String> {
        tokens(text).unwrap().into_iter().map(|t| t.text).collect()
    }

    #[test]
    fn words_numbers_and_signs_come_apart() {
        assert_eq!(of("Put_into CUP"), ["put", "into", "cup"]);
        assert_eq!(
            of("put-into cup, 5cm!"),
            ["put", "into", "cup", ",", "5", "cm", "."]
        );
        assert_eq!(
            of("Don\u{2019}t \u{2013} 1.5 m, 1,5 m"),
            ["don't", ",", "1.5", "m", ",", "1,5", "m"]
        );
        assert_eq!(of("turn -30\u{b0}"), ["turn", "minus", "30", "\u{b0}"]);
        assert_eq!(
            of(".5 m, -.5 m. 5"),
            ["0.5", "m", ",", "minus", "0.5", "m", ".", "5"]
        );
        assert_eq!(of("--5 x--y -+5"), ["--", "5", "x", ",", "y", "-+", "5"]);
        assert_eq!(of("hrn\u{ed}\u{10d}ek"), ["hrnicek"]);
        assert_eq!(of("pick\u{0}the\u{7}\u{1b}cup"), ["pick", "the", "cup"]);
    }

    #[test]
    fn spans_point_into_the_text() {
        let text = "put_into the \u{10d}a\u{161}ka 5cm";
        for t in tokens(text).unwrap() {
            assert_eq!(fold(text[t.span.clone()].trim_matches('_')), t.text);
        }
    }

    #[test]
    fn what_has_no_words_is_refused() {
        for text in ["", "   ", "\u{0}\u{1}\u{2}", "...", "\u{1f916}"] {
            assert_eq!(tokens(text), Err(LanguageError::Empty), "{text:?}");
        }
        assert_eq!(
            tokens(&"a".repeat(100_000)),
            Err(LanguageError::TooLong { bytes: 100_000 })
        );
        assert_eq!(text_of(b"pick \xff"), Err(LanguageError::NotText { at: 5 }));
    }
}
