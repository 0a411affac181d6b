//! The whole way from hand samples to a gesture sentence, in one struct.
//!
//! As in the paper: a pointing hand opens a target word, a closed hand separates words, the hand
//! leaving ends the sentence. A gesture that stands for an action opens an action word; until a
//! closed hand or a word of the other kind comes, what is shown next belongs to the same word, and
//! of several actions the last counts, as hands pass through shapes on their way. The stop gesture
//! waits for nothing.

use super::context::{Context, Event};
use super::counters::{SampleCounters, count};
use super::evidence::Evidence;
use super::frame::Side;
use super::mapping::STROKES;
use super::movement::Movement;
use super::pointing::{Aim, Meant};
use super::shape::SHAPES;
use super::stroke::Likely;
use super::tracking::{Step, Tracking};
use super::wire::{Sample, WireError};
use super::word::{Open, meant};
use crate::scene::Scene;
use crate::sentence::{GESTURE, Sentence, Word};
use crate::time::Micros;

/// Reads one person's hand. `N` options, `C` categories, `W` words, `E` things at most.
#[derive(Debug)]
pub struct HandReader<const N: usize, const C: usize, const W: usize> {
    pub(super) tracking: Tracking,
    pub(super) counters: SampleCounters,
    pub(super) shapes: Evidence<SHAPES>,
    pub(super) movement: Movement,
    pub(super) open: Option<Open<N>>,
    pub(super) sentence: Sentence<W, C, N>,
    /// Whether the sentence is over: the next word begins another.
    pub(super) over: bool,
    /// Target words so far.
    pub(super) targets: u8,
    /// The action that the sentence names.
    pub(super) named: Option<u8>,
    /// What the last movement may have been.
    pub(super) likely: Option<Likely<STROKES>>,
}

impl<const N: usize, const C: usize, const W: usize> Default for HandReader<N, C, W> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const C: usize, const W: usize> HandReader<N, C, W> {
    /// No hand yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            tracking: Tracking::new(),
            counters: SampleCounters::ZERO,
            shapes: Evidence::new(),
            movement: Movement::new(),
            open: None,
            sentence: Sentence::new(GESTURE),
            over: false,
            targets: 0,
            named: None,
            likely: None,
        }
    }

    /// What has become of samples.
    #[must_use]
    pub fn counters(&self) -> &SampleCounters {
        &self.counters
    }

    /// Counts bytes that gave no sample.
    pub fn count_error(&mut self, error: WireError) {
        count(match error {
            WireError::Framing(_) | WireError::Length(_) => &mut self.counters.damaged,
            WireError::Version(_) => &mut self.counters.foreign,
            WireError::Frame(_) => &mut self.counters.unsound,
        });
    }

    /// Counts a sample that came before there was anything to read it by.
    pub fn count_unready(&mut self) {
        count(&mut self.counters.unready);
    }

    /// The hand that is followed.
    #[must_use]
    pub fn hand(&self) -> Option<Side> {
        self.tracking.hand()
    }

    /// Probability of every [`super::shape::Shape`], of the last moments.
    #[must_use]
    pub fn shapes(&self) -> &[f32; SHAPES] {
        self.shapes.belief()
    }

    /// The shape that is being shown, by its number.
    #[must_use]
    pub fn shown(&self) -> Option<u8> {
        self.shapes.shown()
    }

    /// What the hand's last movement may have been; `None` before the first.
    #[must_use]
    pub fn likely(&self) -> Option<&Likely<STROKES>> {
        self.likely.as_ref()
    }

    /// The complete words so far.
    #[must_use]
    pub fn words(&self) -> &[Word<C, N>] {
        if self.over {
            &[]
        } else {
            self.sentence.words()
        }
    }

    /// What the hand said: after [`Event::Said`] or [`Event::Stop`] and until the next word.
    #[must_use]
    pub fn said(&self) -> &Sentence<W, C, N> {
        &self.sentence
    }

    /// Whether the hand is in the middle of a sentence.
    #[must_use]
    pub fn is_showing(&self) -> bool {
        self.open.is_some() || !self.words().is_empty()
    }

    /// What the pointing hand means so far; `None` when it does not point.
    #[must_use]
    pub fn meant<const F: usize, const E: usize>(
        &self,
        scene: &Scene<E, F>,
        aim: &Aim,
    ) -> Option<Meant<E>> {
        match &self.open {
            Some(Open::Target(target)) => Some(meant(&target.ray()?, scene, aim)),
            _ => None,
        }
    }

    /// When [`HandReader::poll`] must be called even if no sample comes.
    #[must_use]
    pub fn next_wake(&self) -> Micros {
        self.tracking.next_wake()
    }

    /// Notices a sensor that has stopped.
    pub fn poll(&mut self, now: Micros) -> Option<Event> {
        if !self.tracking.is_silent(now, &mut self.counters) {
            return None;
        }
        self.forget();
        Some(Event::SensorLost)
    }

    /// Forgets the hand and what it was saying; the counters stay.
    pub fn forget(&mut self) {
        self.tracking.forget();
        self.leave();
        self.begin_anew();
    }

    /// As new, in place.
    pub fn restart(&mut self) {
        self.forget();
        self.tracking = Tracking::new();
        self.counters = SampleCounters::ZERO;
    }

    /// The hand is gone.
    fn leave(&mut self) {
        self.shapes = Evidence::new();
        self.movement.clear();
        self.open = None;
        self.likely = None;
    }

    pub(super) fn begin_anew(&mut self) {
        self.sentence.restart(GESTURE);
        self.over = false;
        self.targets = 0;
        self.named = None;
    }

    /// Takes one sample that came `now`.
    pub fn take<const F: usize, const E: usize>(
        &mut self,
        now: Micros,
        sample: &Sample,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        let step = self.tracking.take(now, sample, &mut self.counters);
        match (step, sample) {
            (Step::Left, _) => self.finish(context),
            (Step::There(seconds), Sample::Hand(frame)) => self.follow(frame, seconds, context),
            _ => None,
        }
    }

    /// The hand has left.
    fn finish<const F: usize, const E: usize>(
        &mut self,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        self.close(context);
        self.leave();
        let said = !self.words().is_empty();
        self.over = true;
        said.then_some(Event::Said)
    }
}
