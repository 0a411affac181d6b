//! Where in a stream of sound somebody speaks: stretches that stand out of the noise, with a pause
//! behind them.

use super::sound::{MOMENT, level};

/// By how many dB a moment must stand out of the noise to be part of an utterance.
const ABOVE: f32 = 6.0;

/// A moment below this is never speech, however quiet the room: 0.2 % of full scale.
const LEAST: f32 = 36.0;

/// So many moments of speech begin an utterance: a click is shorter than 60 ms.
const BEGIN: usize = 3;

/// So many quiet moments end it: 0.6 s, longer than the pause before a "k" or a breath.
const PAUSE: usize = 30;

/// The longest utterance in moments, 15 s; a noise that never ends is cut there.
const LONGEST: usize = 750;

/// How many moments before its beginning belong to an utterance: an "s" starts softly.
const BEFORE: usize = 15;

/// How fast the noise's level rises, in dB per moment; it falls at once.
const RISE: f32 = 0.05;

/// Cuts utterances out of a stream of samples, given in pieces of any length.
#[derive(Clone, Debug, Default)]
pub struct Segmenter {
    rest: Vec<i16>,
    /// The moments that are kept: those before an utterance, or the utterance so far.
    kept: Vec<i16>,
    noise: Option<f32>,
    loud: usize,
    quiet: usize,
    speaking: bool,
}

impl Segmenter {
    /// Takes more sound; gives the utterances that have ended in it.
    pub fn take(&mut self, samples: &[i16]) -> Vec<Vec<i16>> {
        self.rest.extend_from_slice(samples);
        let whole = self.rest.len() / MOMENT * MOMENT;
        let moments: Vec<i16> = self.rest.drain(..whole).collect();
        let moments = moments.chunks_exact(MOMENT);
        moments.filter_map(|moment| self.moment(moment)).collect()
    }

    /// What was being said when the stream ended.
    pub fn end(&mut self) -> Option<Vec<i16>> {
        let spoken = std::mem::take(self);
        spoken.speaking.then_some(spoken.kept)
    }

    fn moment(&mut self, moment: &[i16]) -> Option<Vec<i16>> {
        let level = level(moment);
        let noise = self.noise.get_or_insert(level);
        *noise = level.min(*noise + RISE);
        let speech = level > (*noise + ABOVE).max(LEAST);
        self.loud = if speech { self.loud + 1 } else { 0 };
        self.quiet = if speech { 0 } else { self.quiet + 1 };
        self.kept.extend_from_slice(moment);
        if !self.speaking {
            self.speaking = self.loud >= BEGIN;
            let most = (BEFORE + self.loud) * MOMENT;
            let spare = self.kept.len().saturating_sub(most);
            self.kept.drain(..spare);
            return None;
        }
        let over = self.quiet >= PAUSE || self.kept.len() >= LONGEST * MOMENT;
        over.then(|| {
            self.speaking = false;
            self.loud = 0;
            std::mem::take(&mut self.kept)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::sound::RATE;
    use super::*;

    fn tone(seconds: f32, loud: f32) -> Vec<i16> {
        let count = (seconds * RATE as f32) as usize;
        let at = |i: usize| (loud * [0.0, 1.0, 0.0, -1.0][i / 8 % 4]) as i16;
        (0..count).map(at).collect()
    }

    fn speech(noise: f32) -> Vec<i16> {
        [
            (0.7, noise),
            (1.0, 8000.0),
            (0.3, noise),
            (0.5, 6000.0),
            (1.2, noise),
            (0.8, 8000.0),
            (1.0, noise),
        ]
        .into_iter()
        .flat_map(|(seconds, loud)| tone(seconds, loud))
        .collect()
    }

    #[test]
    fn a_pause_ends_an_utterance_and_a_breath_does_not() {
        for noise in [0.0, 30.0, 300.0] {
            for piece in [37, 1000, 100_000] {
                let mut segmenter = Segmenter::default();
                let sound = speech(noise);
                let found: Vec<_> = sound
                    .chunks(piece)
                    .flat_map(|c| segmenter.take(c))
                    .collect();
                let seconds: Vec<_> = found.iter().map(|u| u.len() as f32 / RATE as f32).collect();
                assert_eq!(
                    found.len(),
                    2,
                    "noise {noise}, pieces of {piece}: {seconds:?}"
                );
                assert!((1.8..3.0).contains(&seconds[0]), "{seconds:?}");
                assert!((0.8..2.0).contains(&seconds[1]), "{seconds:?}");
                assert_eq!(segmenter.end(), None);
            }
        }
    }

    #[test]
    fn what_is_cut_off_is_not_lost_and_silence_says_nothing() {
        let mut segmenter = Segmenter::default();
        assert!(segmenter.take(&tone(3.0, 0.0)).is_empty());
        assert!(segmenter.take(&tone(1.0, 5000.0)).is_empty());
        assert!(segmenter.end().is_some());
        assert_eq!(segmenter.end(), None);
    }

    #[test]
    fn a_noise_that_never_ends_is_cut() {
        let mut segmenter = Segmenter::default();
        let mut sound = tone(1.0, 0.0);
        sound.extend(tone(15.5, 5000.0));
        assert_eq!(segmenter.take(&sound).len(), 1);
    }
}
