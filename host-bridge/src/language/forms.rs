//! The forms of words: plurals and cases of names, verbs that are no commands, negated verbs. What
//! endings a language has is in its pack.

use super::pack::{Endings, Verb};
use super::token::fold;

/// The keys of a word: two words are forms of one when they share a key.
#[must_use]
pub fn keys(word: &str, endings: &Endings) -> Vec<String> {
    let mut keys = vec![word.to_owned()];
    for ending in &endings.name {
        if let Some(stem) = word.strip_suffix(ending.as_str())
            && stem.chars().count() >= endings.keep
        {
            keys.push(stem.to_owned());
        }
    }
    for [from, to] in &endings.alternate {
        for i in 0..keys.len() {
            let other = keys.get(i).and_then(|k| k.strip_suffix(from.as_str()));
            if let Some(stem) = other.filter(|s| s.chars().count() + 1 >= endings.keep) {
                keys.push(format!("{stem}{to}"));
            }
        }
    }
    keys.sort_unstable();
    keys.dedup();
    keys
}

/// A verb with each of these endings, in all ways in which it may be spelled: with a dropped e or
/// i, with a doubled consonant.
pub fn inflected<'a>(verb: &'a str, endings: &'a [String]) -> impl Iterator<Item = String> + 'a {
    let vowel = |c: char| "aeiouy".contains(c);
    endings.iter().flat_map(move |ending| {
        let mut forms = vec![format!("{verb}{ending}")];
        if ending.starts_with(vowel) {
            if let Some(stem) = verb.strip_suffix(['e', 'i']) {
                forms.push(format!("{stem}{ending}"));
            }
            if let Some(last) = verb.chars().next_back().filter(|&c| !vowel(c)) {
                forms.push(format!("{verb}{last}{ending}"));
            }
        }
        forms
    })
}

/// The forms of a folded verb that are no commands: "vezmu" and "vezme" of "vezmi". At least one
/// letter of it is left.
pub fn mentions<'a>(verb: &'a str, verbs: &'a [Verb]) -> impl Iterator<Item = String> + 'a {
    verbs.iter().flat_map(move |class| {
        let stems = class.ends.iter();
        let stems = stems.filter_map(move |end| verb.strip_suffix(fold(end).as_str()));
        let stems = stems.filter(|stem| !stem.is_empty());
        stems.flat_map(|stem| {
            let put = move |ending: &String| format!("{stem}{}", fold(ending));
            class.mentions.iter().map(put)
        })
    })
}

/// Whether an unknown word is a verb negated by a prefix, as "neber" is in Czech.
#[must_use]
pub fn is_negated(word: &str, endings: &Endings) -> bool {
    let negates = |prefix: &String| {
        word.strip_prefix(prefix.as_str())
            .is_some_and(|rest| rest.chars().count() >= endings.keep)
    };
    endings.negative.iter().any(negates)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_of_a_word_share_a_key() {
        let endings = Endings {
            name: ["s", "es", "u", "a", "y", "ou", "e"]
                .map(String::from)
                .to_vec(),
            alternate: vec![["ek".into(), "k".into()], ["c".into(), "k".into()]],
            keep: 3,
            ..Endings::default()
        };
        let one = |a: &str, b: &str| {
            let b = keys(b, &endings);
            keys(a, &endings).iter().any(|k| b.contains(k))
        };
        for (a, b) in [
            ("cup", "cups"),
            ("cube", "cubes"),
            ("box", "boxes"),
            ("hrnek", "hrnku"),
            ("miska", "misce"),
            ("plechovka", "plechovek"),
        ] {
            assert!(one(a, b), "{a} {b}");
        }
        for (a, b) in [
            ("cup", "cube"),
            ("can", "cup"),
            ("as", "a"),
            ("box", "bowl"),
        ] {
            assert!(!one(a, b), "{a} {b}");
        }
    }

    #[test]
    fn forms_that_are_no_commands_go_by_how_the_verb_ends() {
        let class = |ends: &str, mentions: [&str; 2]| Verb {
            ends: vec![ends.into()],
            mentions: mentions.map(String::from).to_vec(),
        };
        let verbs = [class("", ["u", "ím"]), class("i", ["u", "eš"])];
        let of = |verb| mentions(verb, &verbs).collect::<Vec<_>>();
        assert_eq!(of("vezmi"), ["vezmiu", "vezmiim", "vezmu", "vezmes"]);
        assert_eq!(of("seber"), ["seberu", "seberim"]);
        assert_eq!(of("i"), ["iu", "iim"]);
    }

    #[test]
    fn verbs_take_their_endings_as_they_are_spelled() {
        let endings = ["ing", "ed"].map(String::from);
        let of = |verb| inflected(verb, &endings).collect::<Vec<_>>();
        assert!(of("release").contains(&"releasing".to_owned()));
        assert!(of("stop").contains(&"stopped".to_owned()));
        assert!(of("pick").contains(&"picking".to_owned()));
    }
}
