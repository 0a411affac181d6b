//! Evidence over time: from a probability per frame to a belief that a gesture is being shown.
//!
//! A hidden-state filter in place of the usual "the best class for ten frames running": the hand
//! shows one gesture at a time and changes it now and then. Between frames the belief leaks towards
//! the prior (the decay); each frame then multiplies it by the frame's likelihoods. Frames that
//! follow each other closely tell nearly the same thing, so a frame counts for as much as the time
//! since the one before: 100 frames/s and 30 frames/s give the same belief.

use crate::math;
use crate::time::Micros;

/// How the filter and the firing of gestures are set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How long a frame must last to count fully, s: errors of a sensor persist about this long.
    pub independent: f32,
    /// How long a gesture is shown on average, s.
    pub dwell: f32,
    /// A gesture fires when the belief in it exceeds this.
    pub on: f32,
    /// It is over when the belief falls below this.
    pub off: f32,
    /// After it is over, it cannot fire again for this long.
    pub refractory: Micros,
}

impl Settings {
    /// A shape held for a quarter of a second fires; one that the hand passes through does not.
    pub const DEFAULT: Self = Self {
        independent: 0.06,
        dwell: 1.0,
        on: 0.9,
        off: 0.5,
        refractory: Micros::from_millis(300),
    };
}

/// What became of the gestures with one frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// This gesture is shown now.
    Begun(u8),
    /// This gesture is not shown any more.
    Ended(u8),
}

/// The belief in each of `N` gestures, the last of which is *none of these*.
#[derive(Clone, Debug)]
pub struct Evidence<const N: usize> {
    belief: [f32; N],
    shown: Option<u8>,
    /// The gesture that ended last, and when it may fire again.
    spent: Option<(u8, Micros)>,
}

impl<const N: usize> Default for Evidence<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Evidence<N> {
    /// Nothing has been seen: *none* is believed in.
    #[must_use]
    pub const fn new() -> Self {
        let mut belief = [0.0; N];
        if let Some((none, _)) = belief.split_last_mut() {
            *none = 1.0;
        }
        Self {
            belief,
            shown: None,
            spent: None,
        }
    }

    /// Probability of each gesture; they sum to 1.
    #[must_use]
    pub fn belief(&self) -> &[f32; N] {
        &self.belief
    }

    /// The gesture that is being shown, if any.
    #[must_use]
    pub fn shown(&self) -> Option<u8> {
        self.shown
    }

    /// Takes the probabilities that one frame gives, which lasted `seconds` since the one before.
    /// About 2,500 instructions for nine gestures.
    pub fn update(
        &mut self,
        now: Micros,
        seconds: f32,
        frame: &[f32; N],
        settings: &Settings,
    ) -> Option<Change> {
        self.weigh(seconds, frame, settings);
        let believed = |gesture: u8| {
            let belief = self.belief.get(usize::from(gesture));
            belief.copied().unwrap_or_default()
        };
        if let Some(shown) = self.shown {
            if believed(shown) >= settings.off {
                return None;
            }
            self.shown = None;
            self.spent = Some((shown, now.after(settings.refractory)));
            return Some(Change::Ended(shown));
        }
        let best = u8::try_from(math::argmax(&self.belief)?).ok()?;
        let is_gesture = usize::from(best) < N.saturating_sub(1);
        let spent = matches!(self.spent, Some((g, until)) if g == best && now < until);
        if !is_gesture || spent || believed(best) <= settings.on {
            return None;
        }
        self.shown = Some(best);
        Some(Change::Begun(best))
    }

    fn weigh(&mut self, seconds: f32, frame: &[f32; N], settings: &Settings) {
        let seconds = seconds.clamp(0.0, 1.0);
        let leak = seconds / (settings.dwell + seconds);
        let share = (seconds / settings.independent).min(1.0);
        let uniform = 1.0 / N as f32;
        let mut sum = 0.0;
        for (belief, p) in self.belief.iter_mut().zip(frame) {
            // A classifier that is sure errs now and then all the same.
            let likelihood = p.clamp(0.003, 1.0);
            let weight = math::exp(share * math::ln(likelihood));
            *belief = (*belief + leak * (uniform - *belief)) * weight;
            sum += *belief;
        }
        if sum > 0.0 {
            self.belief.iter_mut().for_each(|b| *b /= sum);
        } else {
            *self = Self::new();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::vec::Vec;

    const SETTINGS: Settings = Settings::DEFAULT;

    /// Frames of a rate that show gestures for a number of seconds each.
    fn play(rate: f32, shown: &[([f32; 3], f32)]) -> Vec<(f32, Change)> {
        let mut evidence = Evidence::<3>::new();
        let mut changes = Vec::new();
        let mut at = 0.0_f32;
        for (frame, span) in shown {
            let until = at + span;
            while at < until {
                at += 1.0 / rate;
                let now = Micros((at * 1e6) as u64);
                let change = evidence.update(now, 1.0 / rate, frame, &SETTINGS);
                changes.extend(change.map(|c| (at, c)));
            }
        }
        changes
    }

    const FIRST: [f32; 3] = [0.8, 0.1, 0.1];
    const SECOND: [f32; 3] = [0.1, 0.8, 0.1];
    const NONE: [f32; 3] = [0.1, 0.1, 0.8];

    #[test]
    fn a_gesture_fires_once_however_long_it_is_held() {
        let changes = play(110.0, &[(NONE, 1.0), (FIRST, 5.0), (NONE, 1.0)]);
        let kinds: Vec<_> = changes.iter().map(|c| c.1).collect();
        assert_eq!(kinds, [Change::Begun(0), Change::Ended(0)]);
        assert!(changes[0].0 - 1.0 < 0.3, "{changes:?}");
    }

    #[test]
    fn the_belief_does_not_depend_on_the_frame_rate() {
        let shown = [(NONE, 1.0), (FIRST, 1.0), (SECOND, 1.0)];
        let (slow, fast) = (play(30.0, &shown), play(120.0, &shown));
        assert_eq!(slow.len(), 3);
        for ((t, a), (u, b)) in slow.iter().zip(&fast) {
            assert_eq!(a, b);
            assert!((t - u).abs() < 0.05, "{t} {u}");
        }
    }

    #[test]
    fn a_flicker_neither_ends_a_gesture_nor_begins_one() {
        let flicker = [
            (FIRST, 1.0),
            (SECOND, 0.03),
            (FIRST, 1.0),
            (NONE, 0.03),
            (FIRST, 1.0),
        ];
        assert_eq!(play(110.0, &flicker).len(), 1);
    }

    #[test]
    fn undecided_frames_fire_nothing() {
        let torn = [0.45, 0.45, 0.1];
        assert_eq!(play(110.0, &[(NONE, 0.5), (torn, 5.0)]), []);
    }

    proptest! {
        #[test]
        fn the_belief_stays_a_probability(
            frames in prop::collection::vec((prop::array::uniform3(any::<f32>()), any::<f32>()), 0..60),
        ) {
            let mut evidence = Evidence::<3>::new();
            for (frame, seconds) in frames {
                evidence.update(Micros(0), seconds, &frame, &SETTINGS);
                let sum: f32 = evidence.belief().iter().sum();
                prop_assert!((sum - 1.0).abs() < 1e-4, "{:?}", evidence);
            }
        }
    }
}
