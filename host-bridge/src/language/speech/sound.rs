//! Sound as the recogniser takes it: 16,000 samples a second, one channel, 16 bits.

use std::io::{self, Write};
use std::path::Path;

use deictic_core::math;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Samples a second.
pub const RATE: usize = 16_000;

/// Samples of a moment, over which loudness is measured: 20 ms.
pub const MOMENT: usize = RATE / 50;

/// Silence that is put before and after an utterance, in samples: the recogniser's noise estimate
/// needs something to hold on to.
const AROUND: (usize, usize) = (RATE * 2 / 5, RATE * 3 / 5);

/// The loudest sample after [`prepared`], of full scale.
const LOUDEST: f32 = 0.7;

/// Noise that is mixed in, by its spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// As much at every frequency.
    White,
    /// As much in every octave, as rooms have it.
    Pink,
    /// 6 dB less per octave: rumbling.
    Brown,
}

/// An utterance made ready: as loud as a recogniser likes it, with silence around, and with a little
/// noise, the same for the same sound. Without noise, what a synthesiser leaves perfectly silent is
/// all that the recogniser hears: 60 % of the sentences are right without it, 90 % with it.
#[must_use]
pub fn prepared(samples: &[i16], colour: Colour, level: f32) -> Vec<i16> {
    let peak = samples.iter().map(|s| s.unsigned_abs()).max().unwrap_or(0);
    let gain = LOUDEST * f32::from(i16::MAX) / f32::from(peak.max(1));
    let silence = |n| std::iter::repeat_n(0.0, n);
    let voice = samples.iter().map(|&s| f32::from(s) * gain);
    let whole = silence(AROUND.0).chain(voice).chain(silence(AROUND.1));
    let mut noise = Noise::new(colour);
    let level = level * f32::from(i16::MAX);
    whole.map(|s| (s + level * noise.next()) as i16).collect()
}

/// Noise that repeats exactly, between about -1 and 1.
struct Noise {
    colour: Colour,
    random: ChaCha8Rng,
    state: [f32; 3],
}

impl Noise {
    fn new(colour: Colour) -> Self {
        Self {
            colour,
            random: ChaCha8Rng::seed_from_u64(1),
            state: [0.0; 3],
        }
    }

    fn next(&mut self) -> f32 {
        let white = self.random.random_range(-1.0_f32..1.0);
        match self.colour {
            Colour::White => white,
            // Three poles that follow -3 dB per octave within half a dB above 10 Hz (Kellet).
            Colour::Pink => {
                let [a, b, c] = &mut self.state;
                *a = 0.997_65 * *a + white * 0.099_046;
                *b = 0.963 * *b + white * 0.296_516_4;
                *c = 0.57 * *c + white * 1.052_691_3;
                (*a + *b + *c + white * 0.1848) * 0.25
            }
            Colour::Brown => {
                let [a, ..] = &mut self.state;
                *a = 0.99 * *a + white * 0.1;
                *a
            }
        }
    }
}

/// How far the voice stands out of what is behind it, in dB: the loudest twentieth of the moments
/// against the quietest tenth. `None` of less than ten moments.
#[must_use]
pub fn range(samples: &[i16]) -> Option<f32> {
    let mut levels: Vec<f32> = samples.chunks_exact(MOMENT).map(level).collect();
    if levels.len() < 10 {
        return None;
    }
    levels.sort_by(f32::total_cmp);
    let at = |share: f32| levels.get((levels.len() as f32 * share) as usize).copied();
    Some(at(0.95)? - at(0.1)?)
}

/// The loudness of some samples in dB; 0 is that of one step of the converter.
#[must_use]
pub fn level(samples: &[i16]) -> f32 {
    let sum: f32 = samples.iter().map(|&s| f32::from(s) * f32::from(s)).sum();
    let mean = sum / samples.len().max(1) as f32;
    10.0 / std::f32::consts::LN_10 * math::ln(mean.max(1.0))
}

/// Writes samples without any header, as the recogniser reads them.
///
/// # Errors
/// As the file system's.
pub fn write(path: &Path, samples: &[i16]) -> io::Result<()> {
    let bytes: Vec<u8> = samples.iter().flat_map(|s| s.to_le_bytes()).collect();
    io::BufWriter::new(std::fs::File::create(path)?).write_all(&bytes)
}

/// Samples of their bytes, little end first; an odd byte at the end is left out.
#[must_use]
pub fn of_bytes(bytes: &[u8]) -> Vec<i16> {
    let pairs = bytes.as_chunks::<2>().0.iter();
    pairs.map(|&pair| i16::from_le_bytes(pair)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(samples: usize, loud: f32) -> Vec<i16> {
        let at = |i: usize| (loud * [0.0, 1.0, 0.0, -1.0][i / 8 % 4]) as i16;
        (0..samples).map(at).collect()
    }

    #[test]
    fn what_is_prepared_is_as_loud_as_can_be_and_never_silent() {
        for colour in [Colour::White, Colour::Pink, Colour::Brown] {
            let out = prepared(&tone(RATE, 300.0), colour, 0.02);
            assert_eq!(out.len(), RATE + AROUND.0 + AROUND.1);
            let peak = out.iter().map(|s| s.unsigned_abs()).max().unwrap();
            assert!((20_000..26_000).contains(&peak), "{colour:?} {peak}");
            let before = level(&out[..AROUND.0]);
            assert!((35.0..60.0).contains(&before), "{colour:?} {before}");
            assert_eq!(out, prepared(&tone(RATE, 300.0), colour, 0.02));
        }
        assert!(!prepared(&[], Colour::Pink, 0.02).is_empty());
    }

    #[test]
    fn a_voice_stands_out_of_its_noise() {
        let mut sound = tone(RATE, 1.0);
        sound.extend(tone(RATE, 10_000.0));
        let range = range(&sound).unwrap();
        assert!((70.0..85.0).contains(&range), "{range}");
        assert_eq!(super::range(&[0; 100]), None);
    }

    #[test]
    fn bytes_are_samples_little_end_first() {
        assert_eq!(of_bytes(&[1, 0, 255, 255, 7]), [1, -1]);
    }
}
