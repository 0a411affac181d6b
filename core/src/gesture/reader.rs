//! The whole way from hand samples to a gesture sentence, in one struct.
//!
//! As in the paper: a pointing hand opens a target word, a closed hand separates words, the hand
//! leaving ends the sentence. A gesture that stands for an action opens an action word; until a
//! closed hand or a word of the other kind comes, what is shown next belongs to the same word, and
//! of several actions the last counts, as hands pass through shapes on their way. The stop gesture
//! waits for nothing.

use super::context::{Context, Event};
use super::counters::{SampleCounters, count};
use super::evidence::{Change, Evidence, Settings};
use super::frame::{HandFrame, Side};
use super::mapping::{Gesture, STROKES};
use super::movement::Movement;
use super::pointing::{self, Aim, Meant};
use super::shape::{self, SHAPES, Shape};
use super::shape_table::NETWORK;
use super::stroke::Likely;
use super::tracking::{Step, Tracking};
use super::vector;
use super::wire::{Sample, WireError};
use super::word::{Deed, Open, Target, action_word, meant, target_word};
use crate::scene::Scene;
use crate::sentence::{GESTURE, Sentence, Word};
use crate::time::Micros;

/// Reads one person's hand. `N` options, `C` categories, `W` words, `E` things at most.
#[derive(Debug)]
pub struct HandReader<const N: usize, const C: usize, const W: usize> {
    tracking: Tracking,
    counters: SampleCounters,
    shapes: Evidence<SHAPES>,
    movement: Movement,
    open: Option<Open<N>>,
    sentence: Sentence<W, C, N>,
    /// Whether the sentence is over: the next word begins another.
    over: bool,
    /// Target words so far.
    targets: u8,
    /// What the last movement may have been.
    likely: Option<Likely<STROKES>>,
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

    /// Probability of every [`Shape`], of the last moments.
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

    /// The hand is gone.
    fn leave(&mut self) {
        self.shapes = Evidence::new();
        self.movement.clear();
        self.open = None;
        self.likely = None;
    }

    fn begin_anew(&mut self) {
        self.sentence.restart(GESTURE);
        self.over = false;
        self.targets = 0;
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

    /// Puts the open word into the sentence. A word too many is dropped: no action has so many
    /// parameters.
    fn close<const F: usize, const E: usize>(
        &mut self,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        let word = match self.open.take()? {
            Open::Target(target) => {
                let meant = meant(&target.ray()?, context.scene, context.aim);
                if self.over {
                    self.begin_anew();
                }
                let first = self.targets == 0;
                self.targets = self.targets.saturating_add(1);
                target_word(&meant, context.scene, context.vocabulary, first)
            }
            Open::Action(deed) => deed.word(context.vocabulary.actions().len()),
        };
        self.push(word?)
    }

    fn push(&mut self, word: Word<C, N>) -> Option<Event> {
        if self.over {
            self.begin_anew();
        }
        self.sentence.push(word).ok()?;
        Some(Event::Closed(self.count()))
    }

    fn count(&self) -> u8 {
        u8::try_from(self.words().len()).unwrap_or(u8::MAX)
    }

    /// One frame of the hand.
    fn follow<const F: usize, const E: usize>(
        &mut self,
        frame: &HandFrame,
        seconds: f32,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        let clock = self.tracking.clock();
        let change = match shape::features(frame) {
            Ok(features) => {
                let probabilities = NETWORK.classify(&features);
                self.shapes
                    .update(clock, seconds, &probabilities, &Settings::DEFAULT)
            }
            Err(_) => {
                count(&mut self.counters.shapeless);
                None
            }
        };
        self.gather(frame, clock, context);
        let still = [Shape::Grab, Shape::Point].map(|shape| Some(shape as u8));
        let free = !still.contains(&self.shown());
        let stroke = self.movement.follow(clock, frame, free, &context.templates);
        if stroke.is_some() {
            self.likely = stroke;
        }
        if let Some(Change::Begun(shape)) = change
            && let Some(event) = self.begin(shape, clock, context)
        {
            return Some(event);
        }
        self.stroke(&stroke?, context)
    }

    /// Adds what this frame shows to the open word, while the gesture that opened it is shown.
    fn gather<const F: usize, const E: usize>(
        &mut self,
        frame: &HandFrame,
        clock: Micros,
        context: &Context<'_, N, C, F, E>,
    ) {
        let shown = self.shapes.shown();
        match &mut self.open {
            Some(Open::Target(target)) if shown == Some(Shape::Point as u8) => {
                if let Some(ray) = pointing::ray(frame, context.mount) {
                    target.add(clock, &ray, vector::length(frame.velocity));
                }
            }
            Some(Open::Action(deed)) => {
                let action = shown.and_then(|s| context.mapping.action(Gesture::Shape(s)));
                if action == Some(deed.action()) {
                    let mut likelihoods = [0.0; N];
                    let belief = self.shapes.belief();
                    context.mapping.share(belief, &[], &mut likelihoods);
                    deed.add(clock, &likelihoods);
                }
            }
            _ => {}
        }
    }

    /// A shape has begun to be shown.
    fn begin<const F: usize, const E: usize>(
        &mut self,
        shape: u8,
        clock: Micros,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        if shape == Shape::Grab as u8 {
            return self.close(context);
        }
        if shape == Shape::Point as u8 {
            // No closed hand since the hand pointed last: the same word, and the last try counts.
            let again = matches!(self.open, Some(Open::Target(_)));
            if !again {
                self.close(context);
            }
            self.open = Some(Open::Target(Target::new(clock)));
            return (!again).then(|| Event::Opened(self.count()));
        }
        let action = context.mapping.action(Gesture::Shape(shape))?;
        let mut likelihoods = [0.0; N];
        let belief = self.shapes.belief();
        context.mapping.share(belief, &[], &mut likelihoods);
        if context.vocabulary.stop() == Some(action) {
            return self.stop(&likelihoods, context);
        }
        if matches!(&self.open, Some(Open::Action(deed)) if deed.action() == action) {
            return None;
        }
        if matches!(self.open, Some(Open::Target(_))) {
            self.close(context);
        }
        let mut deed = Deed::new(clock, action);
        deed.add(clock, &likelihoods);
        self.open = Some(Open::Action(deed));
        Some(Event::Opened(self.count()))
    }

    /// A movement has ended that may have been a gesture.
    fn stroke<const F: usize, const E: usize>(
        &mut self,
        likely: &Likely<STROKES>,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        let best = crate::math::argmax(&likely.gestures)?;
        let p = likely.gestures.get(best)?;
        if *p <= likely.none {
            return None;
        }
        let gesture = Gesture::Stroke(u8::try_from(best).ok()?);
        let action = context.mapping.action(gesture)?;
        let mut likelihoods = [0.0; N];
        context
            .mapping
            .share(&[], &likely.gestures, &mut likelihoods);
        if context.vocabulary.stop() == Some(action) {
            // What is as clear as a shape must be to fire.
            let clear = *p > Settings::DEFAULT.on;
            return clear.then(|| self.stop(&likelihoods, context)).flatten();
        }
        match self.open {
            Some(Open::Target(_)) => {
                self.close(context);
            }
            _ => self.open = None,
        }
        let actions = context.vocabulary.actions().len();
        self.push(action_word(&likelihoods, actions)?)
    }

    /// The stop gesture: everything else that was said is void.
    fn stop<const F: usize, const E: usize>(
        &mut self,
        likelihoods: &[f32; N],
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        let actions = context.vocabulary.actions().len();
        let word = action_word(likelihoods, actions)?;
        self.open = None;
        self.begin_anew();
        self.sentence.push(word).ok()?;
        self.over = true;
        Some(Event::Stop)
    }
}
