//! From shapes and movements to words: what opens one, what belongs to it, what closes it.

use super::context::{Context, Event};
use super::counters::count;
use super::curl;
use super::evidence::{Change, Settings};
use super::frame::HandFrame;
use super::mapping::{Gesture, STROKES};
use super::pointing;
use super::reader::HandReader;
use super::shape::{self, SHAPES, Shape};
use super::shape_table::NETWORK;
use super::stroke::Likely;
use super::vector;
use super::word::{Deed, Open, Target, action_word, meant, target_word};
use crate::sentence::Word;
use crate::time::Micros;

/// Share of a thumb's probability that a fist gets in the middle of a sentence. With 0.5 no thumb would be
/// seen there; with 0.4 each of six made-up sessions is read right of 96 % of people or more, without it
/// of 92 %.
const RATHER: f32 = 0.4;

/// A movement that stands for stop does so when it is likelier than all else together: standing still is safe. Of
/// made-up people's waves 99.0 % exceed this, 94 % would exceed 0.9; of 8,000 swipes and circles none does.
const STOPS: f32 = 0.5;

impl<const N: usize, const C: usize, const W: usize> HandReader<N, C, W> {
    /// Puts the open word into the sentence. A word too many is dropped: no action has so many
    /// parameters.
    pub(super) fn close<const F: usize, const E: usize>(
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
            Open::Action(deed) => {
                let word = deed.word(context.vocabulary.actions().len());
                return self.push_action(word?, deed.action());
            }
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

    fn push_action(&mut self, word: Word<C, N>, action: u8) -> Option<Event> {
        let pushed = self.push(word)?;
        self.named = Some(action);
        Some(pushed)
    }

    /// Whether the sentence names this action already. Who shows it again separates words with it:
    /// so a fist whose thumb stands off still does.
    fn is_named(&self, action: u8) -> bool {
        !self.over && self.named == Some(action)
    }

    fn count(&self) -> u8 {
        u8::try_from(self.words().len()).unwrap_or(u8::MAX)
    }

    /// One frame of the hand.
    pub(super) fn follow<const F: usize, const E: usize>(
        &mut self,
        frame: &HandFrame,
        seconds: f32,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        let clock = self.tracking.clock();
        let change = match shape::features(frame) {
            Ok(features) => {
                let mut probabilities = NETWORK.classify(&features);
                curl::rule_out(&mut probabilities, &curl::folds(frame));
                if self.is_showing() {
                    expect_fist(&mut probabilities);
                }
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
        if self.is_named(action) {
            return self.close(context);
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
            let stops = *p > STOPS;
            return stops.then(|| self.stop(&likelihoods, context)).flatten();
        }
        if self.is_named(action) {
            return self.close(context);
        }
        match self.open {
            Some(Open::Target(_)) => {
                self.close(context);
            }
            _ => self.open = None,
        }
        let actions = context.vocabulary.actions().len();
        self.push_action(action_word(&likelihoods, actions)?, action)
    }

    /// A sensor that follows no hand has recognised a movement: it is all that is said, unless a hand
    /// that is followed is in the middle of a sentence, to which it then belongs.
    pub fn recognised<const F: usize, const E: usize>(
        &mut self,
        likely: &Likely<STROKES>,
        context: &Context<'_, N, C, F, E>,
    ) -> Option<Event> {
        self.likely = Some(*likely);
        let alone = !self.is_showing();
        match self.stroke(likely, context)? {
            Event::Closed(_) if alone => {
                self.over = true;
                Some(Event::Said)
            }
            event => Some(event),
        }
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

/// In the middle of a sentence a closed hand is rather the fist that separates words than a thumb up.
fn expect_fist(probabilities: &mut [f32; SHAPES]) {
    if let Some(p) = probabilities.get_mut(Shape::ThumbsUp as usize) {
        let moved = *p * RATHER;
        *p -= moved;
        if let Some(p) = probabilities.get_mut(Shape::Grab as usize) {
            *p += moved;
        }
    }
}
