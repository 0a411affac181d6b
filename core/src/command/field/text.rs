//! Texts for people and likelihoods of features, in rows of bytes.

use heapless::Vec;

use super::{Field, Part, put_bytes, take_bytes};
use crate::command::LONGEST;

/// Up to 40 bytes of UTF-8, for people; zeros behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Text([u8; 40]);

impl Text {
    /// As much of `text` as fits, cut between characters, and at a zero.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let mut bytes = [0; 40];
        let mut end = 0_usize;
        for (at, character) in text.char_indices() {
            let after = at.saturating_add(character.len_utf8());
            if after > bytes.len() || character == '\0' {
                break;
            }
            end = after;
        }
        for (to, from) in bytes.iter_mut().zip(text.bytes().take(end)) {
            *to = from;
        }
        Self(bytes)
    }

    /// The text; up to the first damage, should it not be UTF-8.
    #[must_use]
    pub fn get(&self) -> &str {
        let end = self.0.iter().position(|b| *b == 0).unwrap_or(self.0.len());
        let bytes = self.0.get(..end).unwrap_or(&[]);
        match core::str::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => bytes
                .get(..error.valid_up_to())
                .and_then(|sound| core::str::from_utf8(sound).ok())
                .unwrap_or(""),
        }
    }
}

impl Field for Text {
    const PARTS: &'static [Part] = &[
        Part::named("0", 8),
        Part::named("1", 8),
        Part::named("2", 8),
        Part::named("3", 8),
        Part::named("4", 8),
    ];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        put_bytes(to, &self.0);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        take_bytes(from).map(Self)
    }
}

/// The likelihoods of up to 32 features, in 255ths; a likelihood of 1/2 and above is 128 and above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Features(pub [u8; 32]);

impl Features {
    /// Of likelihoods in 0..=1; what is missing is 0.
    #[must_use]
    pub fn new(likelihoods: &[f32]) -> Self {
        let mut features = [0; 32];
        for (to, from) in features.iter_mut().zip(likelihoods) {
            *to = Self::in_255ths(*from);
        }
        Self(features)
    }

    /// A likelihood in 255ths.
    #[must_use]
    pub fn in_255ths(likelihood: f32) -> u8 {
        // A cast saturates, and makes 0 of what is not a number.
        crate::math::round(likelihood * 255.0) as u8
    }

    /// A likelihood of so many 255ths.
    #[must_use]
    pub fn likelihood(in_255ths: u8) -> f32 {
        f32::from(in_255ths) / 255.0
    }
}

impl Field for Features {
    const PARTS: &'static [Part] = &[
        Part::named("0To7", 8),
        Part::named("8To15", 8),
        Part::named("16To23", 8),
        Part::named("24To31", 8),
    ];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        put_bytes(to, &self.0);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        take_bytes(from).map(Self)
    }
}
