//! How words are pronounced: from the recogniser's dictionary, with what other accents make of it,
//! and from espeak-ng for names that it does not have.

use std::collections::BTreeMap;
use std::process::{Command, Stdio};

/// A pronunciation: phones of the CMU dictionary, "K AH P".
pub type Phones = Vec<String>;

/// The dictionary of a model.
#[derive(Clone, Debug, Default)]
pub struct Dictionary {
    words: BTreeMap<String, Vec<Phones>>,
}

impl Dictionary {
    /// Of lines such as `detach(2) D IY T AE CH`.
    #[must_use]
    pub fn read(text: &str) -> Self {
        let mut words: BTreeMap<String, Vec<Phones>> = BTreeMap::new();
        for (word, phones) in text.lines().filter_map(|l| l.split_once(' ')) {
            let word = word.split('(').next().unwrap_or(word).to_owned();
            let phones = phones.split_whitespace().map(str::to_owned).collect();
            words.entry(word).or_default().push(phones);
        }
        Self { words }
    }

    /// Whether it has a word, or has learnt it.
    #[must_use]
    pub fn knows(&self, word: &str) -> bool {
        self.words.contains_key(word)
    }

    /// Asks espeak-ng how an unknown word is said, if it is installed.
    pub fn learn(&mut self, word: &str) {
        let asked = Command::new("espeak-ng")
            .args(["-q", "--ipa", "-v", "en-us", "--", word])
            .stdin(Stdio::null())
            .output();
        let ipa = asked.ok().and_then(|o| String::from_utf8(o.stdout).ok());
        if let Some(phones) = ipa.as_deref().and_then(of_ipa) {
            self.words.insert(word.to_owned(), vec![phones]);
        }
    }

    /// The part of it that has these words, with accents, as the recogniser reads it.
    #[must_use]
    pub fn part<'a>(&self, words: impl IntoIterator<Item = &'a str>) -> String {
        let mut lines = Vec::new();
        for word in words {
            let known = self.words.get(word).into_iter().flatten();
            let mut all: Vec<Phones> = Vec::new();
            for said in known.flat_map(|phones| accents(phones)) {
                if !all.contains(&said) {
                    all.push(said);
                }
            }
            for (i, phones) in all.iter().enumerate() {
                let number = if i == 0 {
                    String::new()
                } else {
                    format!("({})", i + 1)
                };
                lines.push(format!("{word}{number} {}\n", phones.join(" ")));
            }
        }
        lines.sort();
        lines.dedup();
        lines.concat()
    }
}

const VOWELS: [&str; 15] = [
    "AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW",
];

fn is_vowel(phone: Option<&String>) -> bool {
    phone.is_some_and(|p| VOWELS.contains(&p.as_str()))
}

/// An American pronunciation and what it is in England: no "r" but before vowels, "grasp" with the
/// vowel of "father", "bowl" with that of "uh-oo", "box" rounded.
fn accents(phones: &[String]) -> Vec<Phones> {
    let each = |change: &dyn Fn(&str) -> Vec<&'static str>| {
        let changed = phones.iter().flat_map(|p| match change(p)[..] {
            [] => vec![p.clone()],
            ref other => other.iter().map(|&o| o.to_owned()).collect(),
        });
        changed.collect::<Phones>()
    };
    let quiet: Phones = phones
        .iter()
        .enumerate()
        .filter_map(|(i, phone)| {
            let before_vowel = is_vowel(phones.get(i + 1));
            let after_vowel = i > 0 && is_vowel(phones.get(i - 1));
            match phone.as_str() {
                "R" if after_vowel && !before_vowel => None,
                "ER" if !before_vowel => Some("AH".to_owned()),
                _ => Some(phone.clone()),
            }
        })
        .collect();
    let mut all = vec![phones.to_vec(), quiet];
    all.push(each(&|p| if p == "OW" { vec!["AH", "UH"] } else { vec![] }));
    all.push(each(&|p| if p == "AA" { vec!["AO"] } else { vec![] }));
    let broad = phones
        .windows(2)
        .any(|pair| matches!(pair, [a, b] if a == "AE" && ["S", "F", "TH"].contains(&b.as_str())));
    if broad {
        all.push(each(&|p| if p == "AE" { vec!["AA"] } else { vec![] }));
    }
    all
}

/// Phones by IPA, the longest first.
const IPA: [(&str, &str); 52] = [
    ("t\u{283}", "CH"),
    ("d\u{292}", "JH"),
    ("a\u{26a}", "AY"),
    ("a\u{28a}", "AW"),
    ("e\u{26a}", "EY"),
    ("o\u{28a}", "OW"),
    ("\u{259}\u{28a}", "OW"),
    ("\u{254}\u{26a}", "OY"),
    ("i\u{2d0}", "IY"),
    ("u\u{2d0}", "UW"),
    ("\u{251}\u{2d0}", "AA"),
    ("\u{254}\u{2d0}", "AO"),
    ("\u{25c}\u{2d0}", "ER"),
    ("\u{25a}", "ER"),
    ("\u{25d}", "ER"),
    ("o\u{2d0}", "AO"),
    ("\u{259}l", "AH L"),
    ("i\u{259}", "IY AH"),
    ("\u{26a}", "IH"),
    ("\u{28a}", "UH"),
    ("\u{28c}", "AH"),
    ("\u{259}", "AH"),
    ("\u{250}", "AH"),
    ("\u{25b}", "EH"),
    ("\u{e6}", "AE"),
    ("\u{251}", "AA"),
    ("\u{254}", "AO"),
    ("\u{252}", "AA"),
    ("a", "AE"),
    ("e", "EH"),
    ("i", "IY"),
    ("o", "OW"),
    ("u", "UW"),
    ("b", "B"),
    ("d", "D"),
    ("f", "F"),
    ("\u{261}", "G"),
    ("h", "HH"),
    ("j", "Y"),
    ("k", "K"),
    ("l", "L"),
    ("m", "M"),
    ("n", "N"),
    ("\u{14b}", "NG"),
    ("p", "P"),
    ("\u{279}", "R"),
    ("s", "S"),
    ("t", "T"),
    ("\u{27e}", "T"),
    ("v", "V"),
    ("w", "W"),
    ("z", "Z"),
];

/// Sounds that are no parts of another in IPA either.
const MORE: [(&str, &str); 6] = [
    ("\u{283}", "SH"),
    ("\u{292}", "ZH"),
    ("\u{3b8}", "TH"),
    ("\u{f0}", "DH"),
    ("r", "R"),
    ("g", "G"),
];

/// Phones of what espeak-ng writes; `None` when it has a sound that English has not.
fn of_ipa(text: &str) -> Option<Phones> {
    let mut phones = Vec::new();
    let mut rest = text.trim();
    let silent = [
        '\u{2c8}', '\u{2cc}', '\u{2d0}', ' ', '\u{303}', '\u{329}', '_', '-',
    ];
    while !rest.is_empty() {
        rest = rest.trim_start_matches(silent);
        if rest.is_empty() {
            break;
        }
        let (ipa, phone) = IPA
            .iter()
            .chain(&MORE)
            .find(|(ipa, _)| rest.starts_with(ipa))?;
        phones.extend(phone.split(' ').map(str::to_owned));
        rest = rest.strip_prefix(ipa)?;
    }
    (!phones.is_empty()).then_some(phones)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ipa_is_read() {
        let of = |text| of_ipa(text).unwrap_or_default().join(" ");
        assert_eq!(of("\u{28c}nst\u{2c8}\u{26a}k\n"), "AH N S T IH K");
        assert_eq!(of("t\u{283}\u{2c8}i\u{2d0}z"), "CH IY Z");
        assert_eq!(of_ipa("\u{294}"), None);
        assert_eq!(of_ipa(" "), None);
    }

    #[test]
    fn accents_are_added() {
        let dictionary = Dictionary::read("drawer D R AO R\ngrasp G R AE S P\ncup K AH P\n");
        assert_eq!(
            dictionary.part(["drawer", "cup"]),
            "cup K AH P\ndrawer D R AO R\ndrawer(2) D R AO\n"
        );
        assert!(dictionary.part(["grasp"]).contains("G R AA S P"));
        assert!(dictionary.knows("cup") && !dictionary.knows("can"));
    }
}
