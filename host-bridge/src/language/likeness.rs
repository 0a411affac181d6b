//! How alike two words sound and look: double Metaphone codes and letters, both compared by their
//! Levenshtein ratio.
//!
//! The paper compares Metaphone codes alone, under which "cube" and "cup" are one word; spelling
//! keeps them apart.

use rphonetic::DoubleMetaphone;
use strsim::{normalized_levenshtein, osa_distance};

/// The codes of one phrase.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sound {
    letters: String,
    codes: Vec<String>,
}

/// Compares phrases of one language.
#[derive(Clone, Debug)]
pub struct Ear {
    metaphone: Option<DoubleMetaphone>,
    /// Share of the sound in a likeness, 0..=1; the rest is spelling.
    pub sound: f64,
}

impl Ear {
    /// `phonetic`: whether double Metaphone, which is made for English, applies.
    #[must_use]
    pub fn new(phonetic: bool) -> Self {
        // Longer than the customary 4, so that names of several words keep their ends.
        let metaphone = phonetic.then(|| DoubleMetaphone::new(Some(12)));
        Self {
            metaphone,
            sound: 0.5,
        }
    }

    /// The codes of a folded phrase.
    #[must_use]
    pub fn listen(&self, phrase: &str) -> Sound {
        let letters: String = phrase.chars().filter(|c| c.is_alphanumeric()).collect();
        let mut codes = Vec::new();
        // rphonetic indexes letters by byte, so it is only shown what it is made for.
        if let Some(metaphone) = self.metaphone.as_ref().filter(|_| letters.is_ascii()) {
            let code = metaphone.double_metaphone(&letters);
            codes.push(code.primary());
            if code.alternate() != code.primary() {
                codes.push(code.alternate());
            }
            codes.retain(|c| !c.is_empty());
        }
        Sound { letters, codes }
    }

    /// 1 for the same letters, 0 for nothing in common.
    #[must_use]
    pub fn likeness(&self, a: &Sound, b: &Sound) -> f64 {
        if a.letters == b.letters {
            return 1.0;
        }
        let longest = a.letters.chars().count().max(b.letters.chars().count());
        // Swapped letters are one slip of the fingers, not two.
        let spelling = 1.0 - osa_distance(&a.letters, &b.letters) as f64 / longest.max(1) as f64;
        let pairs = a
            .codes
            .iter()
            .flat_map(|x| b.codes.iter().map(move |y| (x, y)));
        let sound = pairs
            .map(|(x, y)| normalized_levenshtein(x, y))
            .reduce(f64::max);
        sound.map_or(spelling, |sound| {
            self.sound * sound + (1.0 - self.sound) * spelling
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alike(a: &str, b: &str) -> f64 {
        let ear = Ear::new(true);
        ear.likeness(&ear.listen(a), &ear.listen(b))
    }

    #[test]
    fn cube_and_cup_share_a_code_and_stay_apart() {
        let ear = Ear::new(true);
        assert_eq!(ear.listen("cube").codes, ear.listen("cup").codes);
        assert!(alike("cube", "cup") < 0.8);
        assert_eq!(alike("cup", "cup"), 1.0);
    }

    #[test]
    fn a_misheard_word_is_nearest_to_what_it_sounds_like() {
        for (heard, meant, other) in [
            ("kup", "cup", "can"),
            ("kan", "can", "cup"),
            ("drawr", "drawer", "bowl"),
            ("bole", "bowl", "box"),
            ("clener", "cleaner", "crackers"),
            ("pore", "pour", "push"),
            ("phoam", "foam", "bowl"),
        ] {
            assert!(alike(heard, meant) > alike(heard, other) + 0.2, "{heard}");
        }
    }

    #[test]
    fn likeness_is_symmetric_and_bounded() {
        for a in ["cup", "", "\u{10d}aj", "stack", "12"] {
            for b in ["cube", "x", "\u{43c}", "stock"] {
                let l = alike(a, b);
                assert!((0.0..=1.0).contains(&l));
                assert_eq!(l, alike(b, a));
            }
        }
    }
}
