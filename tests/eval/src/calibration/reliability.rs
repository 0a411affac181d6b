//! How often a word is heard right: the chance that the option that was meant has the largest
//! likelihood, of a sensor that reports 1 of it and [`ELSEWHERE`] of all others, by drawing.

use deictic_core::joint::sensors::ELSEWHERE;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::KNOTS;
use crate::noise::{Level, Noise};

/// Words of most options that the table has; larger ones count as these.
const MOST: usize = 16;

/// Draws per noise level: an error of a share of 3 in 1,000 at most.
const DRAWS: u32 = 40_000;

/// In thousandths, by options from 2 on and by noise level from n1 on. Among equals one is taken by
/// chance.
#[must_use]
pub fn table() -> Vec<[u16; KNOTS]> {
    let mut right = vec![[0.0; KNOTS]; MOST - 1];
    let levels = [Level::N1, Level::N2, Level::N3, Level::N4];
    for (b, level) in levels.into_iter().enumerate() {
        let mut rng = ChaCha8Rng::seed_from_u64(0x4e11);
        let noise = Noise::from(level);
        for _ in 0..DRAWS {
            let meant = noise.observe(1.0, &mut rng);
            let (mut top, mut alike) = (f64::NEG_INFINITY, 0);
            for row in &mut right {
                let other = noise.observe(f64::from(ELSEWHERE), &mut rng);
                if other > top {
                    (top, alike) = (other, 0);
                }
                alike += i32::from(other >= top);
                if meant > top {
                    row[b] += 1.0;
                } else if meant >= top {
                    row[b] += 1.0 / f64::from(1 + alike);
                }
            }
        }
    }
    let thousandths = |x: f64| (1000.0 * x / f64::from(DRAWS)).round() as u16;
    right.into_iter().map(|row| row.map(thousandths)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_and_more_options_make_words_less_reliable() {
        let table = table();
        for row in &table {
            assert!(row[3] < row[2] && row[2] < row[1], "{row:?}");
        }
        for (fewer, more) in table.iter().zip(&table[1..]) {
            assert!(more.iter().zip(fewer).all(|(more, fewer)| more <= fewer));
        }
        // n3: the difference of two errors of 0.4, but clipped.
        assert!((870..910).contains(&table[0][2]), "{:?}", table[0]);
    }
}
