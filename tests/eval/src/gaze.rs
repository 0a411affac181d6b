//! A third modality: where a person looks, beside what the hand shows and the voice says.
//!
//! A look names a thing and never an action. It is as easily mistaken as what a hand points at (the
//! gesture's similarity tables) and as noisy as the set's level says. In the paper's sets it follows
//! what is meant; in [`crate::free`]'s it rests on a rival, is missed, or is seen where there is
//! none as often as words there.

use rand::{Rng, RngExt};

use crate::catalogue::Catalogue;
use crate::free::{CONFUSED, MISSING, RIVAL};
use crate::generate::index;
use crate::maker::Maker;
use crate::noise::Noise;
use crate::record::{CATEGORIES, Record, Words};

/// The modality's number, the first that neither hand, voice nor answers have.
pub const GAZE: u8 = 2;

/// Whose similarity tables looks have.
pub const TABLES: usize = deictic_core::sentence::GESTURE as usize;

/// What is seen of where a person looks in a sample.
#[must_use]
pub fn words(catalogue: &Catalogue, maker: Maker, record: &Record, rng: &mut impl Rng) -> Words {
    let fairer = maker.is_free();
    let noise = Noise::from(maker.level());
    let mut words = Words::default();
    let options = record.truth.options();
    for c in 1..CATEGORIES {
        let n = catalogue.count(c);
        let (seen, rivalled) = match options[c] {
            Some(_) if fairer && rng.random_bool(MISSING) => continue,
            Some(meant) => (usize::from(meant), fairer && rng.random_bool(RIVAL[c])),
            None if fairer && rng.random_bool(CONFUSED) => (usize::from(index(n, rng)), false),
            None => continue,
        };
        let rival = match rivalled && n > 1 {
            true => (seen + 1 + usize::from(index(n - 1, rng))) % n,
            false => seen,
        };
        let row = &catalogue.similarity[TABLES][c][seen];
        let word = row.iter().enumerate().map(|(i, &likelihood)| {
            let level = if i == rival { row[seen] } else { likelihood };
            noise.observe(f64::from(level), rng) as f32
        });
        words[c] = Some(word.collect());
    }
    words
}
