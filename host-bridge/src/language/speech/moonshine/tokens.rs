//! The pieces of words that the model writes with.

use std::collections::BTreeMap;

/// A piece, by its number.
pub type Token = u32;

/// The piece that begins every utterance.
pub const BEGIN: Token = 1;
/// The piece that ends it.
pub const END: Token = 2;

/// What stands for a space in a piece: "▁".
const SPACE: char = '\u{2581}';

/// All pieces, and a tree of their letters.
#[derive(Clone, Debug, Default)]
pub struct Tokens {
    texts: Vec<Vec<u8>>,
    /// Per knot of the tree: where each letter leads, and the pieces that end here.
    tree: Vec<(BTreeMap<u8, usize>, Vec<Token>)>,
}

impl Tokens {
    /// The pieces of a file: of each its length, in one byte below 128 or in two (the first of them less
    /// 128, plus 128 times the second), and its bytes.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(mut bytes: &[u8]) -> Result<Self, String> {
        let mut tokens = Self {
            texts: Vec::new(),
            tree: vec![Default::default()],
        };
        while let Some((&first, rest)) = bytes.split_first() {
            let (length, rest) = match (usize::from(first), rest.split_first()) {
                (short @ 0..128, _) => (short, rest),
                (long, Some((&second, rest))) => (long - 128 + 128 * usize::from(second), rest),
                (_, None) => return Err("the file of word pieces ends in a length".into()),
            };
            let piece = rest.split_at_checked(length);
            let (piece, rest) = piece.ok_or("the file of word pieces ends in a piece")?;
            tokens.push(piece);
            bytes = rest;
        }
        match tokens.texts.len() > END as usize {
            true => Ok(tokens),
            false => Err("the file of word pieces has none".into()),
        }
    }

    fn push(&mut self, piece: &[u8]) {
        let token = self.texts.len() as Token;
        let said = std::str::from_utf8(piece).unwrap_or_default();
        self.texts.push(said.replace(SPACE, " ").into_bytes());
        if token <= END || said.is_empty() {
            return;
        }
        let mut at = 0;
        for letter in said.replace(SPACE, " ").to_lowercase().bytes() {
            let new = self.tree.len();
            let Some((letters, _)) = self.tree.get_mut(at) else {
                return;
            };
            at = *letters.entry(letter).or_insert(new);
            if at == new {
                self.tree.push(Default::default());
            }
        }
        if let Some((_, ends)) = self.tree.get_mut(at) {
            ends.push(token);
        }
    }

    /// The root of the tree.
    pub const ROOT: usize = 0;

    /// Where each letter, in lower case, leads from a knot of the tree.
    pub fn letters(&self, knot: usize) -> impl Iterator<Item = (u8, usize)> {
        let letters = self.tree.get(knot).into_iter().flat_map(|(l, _)| l.iter());
        letters.map(|(&letter, &next)| (letter, next))
    }

    /// The pieces that end at a knot, in whatever case.
    #[must_use]
    pub fn at(&self, knot: usize) -> &[Token] {
        self.tree.get(knot).map_or(&[], |(_, ends)| ends)
    }

    /// The pieces that are just this text.
    #[must_use]
    pub fn just(&self, text: &str) -> &[Token] {
        let mut knot = Self::ROOT;
        for letter in text.bytes() {
            match self.letters(knot).find(|(l, _)| *l == letter) {
                Some((_, next)) => knot = next,
                None => return &[],
            }
        }
        self.at(knot)
    }

    /// What these pieces say.
    #[must_use]
    pub fn text(&self, tokens: &[Token]) -> String {
        let pieces = tokens.iter().filter_map(|&t| self.texts.get(t as usize));
        let bytes: Vec<u8> = pieces.flatten().copied().collect();
        String::from_utf8_lossy(&bytes).trim().to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(pieces: &[&str]) -> Vec<u8> {
        let of = |piece: &&str| {
            let n = piece.len();
            let mut bytes = match n {
                0..128 => vec![n as u8],
                _ => vec![(n % 128 + 128) as u8, (n / 128) as u8],
            };
            bytes.extend(piece.bytes());
            bytes
        };
        pieces.iter().flat_map(of).collect()
    }

    #[test]
    fn pieces_are_read_and_found_in_whatever_case() {
        let long = "x".repeat(300);
        let pieces = [
            "<unk>",
            "<s>",
            "</s>",
            "\u{2581}Pick",
            "\u{2581}pick",
            "s",
            &long,
        ];
        let tokens = Tokens::read(&file(&pieces)).unwrap();
        assert_eq!(tokens.just(" pick"), [3, 4]);
        assert_eq!(tokens.just(&long), [6]);
        assert_eq!(tokens.just("pick"), [0; 0]);
        assert_eq!(tokens.text(&[3, 5]), "Picks");
    }

    #[test]
    fn what_is_no_file_of_pieces_is_refused() {
        for bytes in [&[][..], &[200], &[5, b'a'], &[0, 0]] {
            assert!(Tokens::read(bytes).is_err(), "{bytes:?}");
        }
    }
}
