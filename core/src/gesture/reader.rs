//! The whole way from hand samples to a gesture sentence, in one struct.
//!
//! As in the paper: a pointing hand opens a target word, a closed hand separates words, the hand
//! leaving ends the sentence. A gesture that stands for an action opens an action word; until a
//! closed hand or a word of the other kind comes, what is shown next belongs to the same word, and
//! of several actions the last counts, as hands pass through shapes on their way. The stop gesture
//! waits for nothing.

use super::evidence::{Change, Evidence, Settings};
use super::frame::HandFrame;
use super::mapping::{Gesture, Mapping, STROKES};
use super::movement::Movement;
use super::pointing::{self, Aim, Meant, Mount};
use super::shape::{self, SHAPES, Shape};
use super::shape_table::NETWORK;
use super::stroke::{Likely, Scale, Template};
use super::tracking::{SampleCounters, Step, Tracking, count};
use super::vector;
use super::wire::Sample;
use super::word::{Deed, Open, Target, action_word, meant, target_word};
use crate::scene::Scene;
use crate::sentence::{GESTURE, Sentence, Word};
use crate::time::Micros;
use crate::vocabulary::Vocabulary;

/// What the reader goes by: fixed while a hand is there.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a, const N: usize, const C: usize, const F: usize, const E: usize> {
    /// What can be said and shown.
    pub vocabulary: &'a Vocabulary<N, C, F>,
    /// What can be pointed at.
    pub scene: &'a Scene<E, F>,
    /// Which gestures stand for which actions.
    pub mapping: &'a Mapping,
    /// Examples of the dynamic gestures.
    pub templates: &'a [Template],
    /// How distances from them become probabilities.
    pub scale: &'a Scale,
    /// Where the sensor stands.
    pub mount: &'a Mount,
    /// How well the person aims.
    pub aim: &'a Aim,
}

/// What a sample led to.
#[derive(Clone, Debug, PartialEq)]
pub enum Event<const W: usize, const C: usize, const N: usize> {
    /// A word has begun; there are this many before it.
    Opened(u8),
    /// A word is complete; there are this many now.
    Closed(u8),
    /// The hand has left: this is what it said.
    Said(Sentence<W, C, N>),
    /// The stop gesture. The sentence is this one action, nothing is waited for.
    Stop(Sentence<W, C, N>),
    /// The sensor fell silent while a hand was there. What it had said is forgotten, as nobody knows
    /// what it would have said.
    SensorLost,
}

/// Reads one person's hand. `N` options, `C` categories, `W` words, `E` things at most.
#[derive(Debug)]
pub struct HandReader<const N: usize, const C: usize, const W: usize> {
    tracking: Tracking,
    counters: SampleCounters,
    shapes: Evidence<SHAPES>,
    movement: Movement,
    open: Option<Open<N>>,
    sentence: Sentence<W, C, N>,
    /// Target words so far.
    targets: u8,
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
            targets: 0,
        }
    }

    /// What has become of samples.
    #[must_use]
    pub fn counters(&self) -> &SampleCounters {
        &self.counters
    }

    /// Probability of every [`Shape`], of the last moments.
    #[must_use]
    pub fn shapes(&self) -> &[f32; SHAPES] {
        self.shapes.belief()
    }

    /// The complete words so far.
    #[must_use]
    pub fn words(&self) -> &[Word<C, N>] {
        self.sentence.words()
    }

    /// What the pointing hand means so far; `None` when it does not point.
    #[must_use]
    pub fn meant<const F: usize, const E: usize>(
        &self,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Meant<E>> {
        match &self.open {
            Some(Open::Target(target)) => Some(meant(&target.ray()?, context.scene, context.aim)),
            _ => None,
        }
    }

    /// When [`HandReader::poll`] must be called even if no sample comes.
    #[must_use]
    pub fn next_wake(&self) -> Micros {
        self.tracking.next_wake()
    }

    /// Notices a sensor that has stopped.
    pub fn poll(&mut self, now: Micros) -> Option<Event<W, C, N>> {
        if !self.tracking.is_silent(now, &mut self.counters) {
            return None;
        }
        self.forget();
        Some(Event::SensorLost)
    }

    fn forget(&mut self) {
        self.shapes = Evidence::new();
        self.movement.clear();
        self.open = None;
        self.sentence = Sentence::new(GESTURE);
        self.targets = 0;
    }

    /// Takes one sample that came `now`.
    pub fn take<const F: usize, const E: usize>(
        &mut self,
        now: Micros,
        sample: &Sample,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event<W, C, N>> {
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
    ) -> Option<Event<W, C, N>> {
        self.close(context);
        let said = core::mem::replace(&mut self.sentence, Sentence::new(GESTURE));
        self.forget();
        (!said.words().is_empty()).then_some(Event::Said(said))
    }

    /// Puts the open word into the sentence. A word too many is dropped: no action has so many
    /// parameters.
    fn close<const F: usize, const E: usize>(
        &mut self,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event<W, C, N>> {
        let word = match self.open.take()? {
            Open::Target(target) => {
                let meant = meant(&target.ray()?, context.scene, context.aim);
                let first = self.targets == 0;
                self.targets = self.targets.saturating_add(1);
                target_word(&meant, context.scene, context.vocabulary, first)
            }
            Open::Action(deed) => deed.word(context.vocabulary.actions().len()),
        };
        self.push(word?)
    }

    fn push(&mut self, word: Word<C, N>) -> Option<Event<W, C, N>> {
        self.sentence.push(word).ok()?;
        Some(Event::Closed(self.count()))
    }

    fn count(&self) -> u8 {
        u8::try_from(self.sentence.words().len()).unwrap_or(u8::MAX)
    }

    /// One frame of the hand.
    fn follow<const F: usize, const E: usize>(
        &mut self,
        frame: &HandFrame,
        seconds: f32,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event<W, C, N>> {
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
        let still = matches!(self.shown(), Some(Shape::Grab | Shape::Point));
        let stroke = self
            .movement
            .follow(clock, frame, !still, context.templates, context.scale);
        if let Some(Change::Begun(shape)) = change
            && let Some(event) = self.begin(shape, clock, context)
        {
            return Some(event);
        }
        self.stroke(&stroke?, context)
    }

    /// The shape that is being shown.
    fn shown(&self) -> Option<Shape> {
        let shown = self.shapes.shown()?;
        Shape::ALL.get(usize::from(shown)).copied()
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
    ) -> Option<Event<W, C, N>> {
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
    ) -> Option<Event<W, C, N>> {
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
    ) -> Option<Event<W, C, N>> {
        let mut sentence = Sentence::new(GESTURE);
        let actions = context.vocabulary.actions().len();
        sentence.push(action_word(likelihoods, actions)?).ok()?;
        self.open = None;
        self.sentence = Sentence::new(GESTURE);
        self.targets = 0;
        Some(Event::Stop(sentence))
    }
}
