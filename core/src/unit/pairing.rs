//! Bringing sentences of different modalities together by time, and deciding when they are complete
//! or their window closes.

use heapless::Vec;

use super::Unit;
use super::loading::in_order;
use crate::category::Category;
use crate::clarify::Confirmation;
use crate::decide::{Decision, Kind, Outcome};
use crate::fuse::{Situation, fuse, says_clearly};
use crate::intent::Intent;
use crate::joint::posterior::Triple;
use crate::observations::Observations;
use crate::protocol::message::{Answer, Decided, Fault, SentencePart, ToHost, Why, WhyActions};
use crate::sentence::{ANSWER, GESTURE, Sentence, Word};
use crate::time::Micros;

/// How long a decision waits for a hand that is in the middle of a sentence, from the first sentence
/// of another modality on. People point for seconds, and say what they point at in the middle of it.
pub const HAND_PATIENCE: Micros = Micros::from_millis(10_000);

/// How often it looks whether the hand has finished.
const LOOKING: Micros = Micros::from_millis(100);

/// How long a question stays open.
pub const QUESTION: Micros = Micros::from_millis(60_000);

/// Where a sentence comes from that is to be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// The host said it.
    Host,
    /// The hand reader read it.
    Hand,
}

/// A question that is open.
#[derive(Clone, Copy, Debug)]
struct Open {
    /// The number of the decision that asked.
    number: u32,
    /// Until when its answer is taken.
    until: Micros,
    kind: Kind,
    category: Category,
    /// The intent that a yes or no speaks of.
    about: Option<Triple>,
}

/// Sentences that wait for others, or for an answer.
#[derive(Debug)]
pub struct Pairing<const N: usize, const C: usize, const W: usize> {
    observations: Observations<W, C, N>,
    /// The sentence that is arriving, and which decision's question it answers.
    arriving: Sentence<W, C, N>,
    answers: Option<u32>,
    /// Whether all of it has arrived and nobody has looked at it yet.
    complete: bool,
    due: Micros,
    /// Until when a hand that is in the middle of a sentence is waited for.
    patience: Micros,
    question: Option<Open>,
    numbered: u32,
}

impl<const N: usize, const C: usize, const W: usize> Default for Pairing<N, C, W> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const C: usize, const W: usize> Pairing<N, C, W> {
    /// Nothing waits.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            observations: Observations::new(),
            arriving: Sentence::new(0),
            answers: None,
            complete: false,
            due: Micros::NEVER,
            patience: Micros(0),
            question: None,
            numbered: 0,
        }
    }

    /// As new, in place.
    pub fn restart(&mut self) {
        self.clear();
        self.arriving.restart(0);
        self.answers = None;
        self.complete = false;
        self.numbered = 0;
    }

    /// Forgets what waits; decisions keep being numbered on.
    pub fn clear(&mut self) {
        self.observations.clear();
        self.due = Micros::NEVER;
        self.patience = Micros(0);
        self.question = None;
    }

    /// When what waits is to be decided with what there is.
    #[must_use]
    pub fn due(&self) -> Micros {
        self.due
    }

    /// Whether that moment has come.
    #[must_use]
    pub fn is_due(&self, now: Micros) -> bool {
        now >= self.due
    }

    /// Takes a part of a sentence, the last of which completes it.
    ///
    /// # Errors
    /// [`Fault`] when the part is out of order or there is no room; from the first part on the
    /// sentence can be said again.
    pub(super) fn take(&mut self, part: &SentencePart<C, N>) -> Result<(), Fault> {
        let modality = part.modality;
        if part.first == 0 {
            self.arriving.restart(modality);
            self.answers = part.answers;
        }
        if modality != self.arriving.modality() || part.answers != self.answers {
            return Err(Fault::PartOutOfOrder {
                expected: 0,
                got: part.first,
            });
        }
        in_order(self.arriving.words().len(), part.first)?;
        for word in &part.words {
            let pushed = self.arriving.push(word.clone());
            pushed.map_err(|error| Fault::Sentence { modality, error })?;
        }
        self.complete = self.arriving.words().len() >= usize::from(part.total);
        Ok(())
    }
}

impl<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
    const FRAME: usize,
    const OUT: usize,
    const S: usize,
> Unit<N, C, F, E, W, FRAME, OUT, S>
{
    /// Looks at a sentence that has just been completed, and decides when it is time. Called when
    /// the message that completed it is out of the way, so that the stack holds one of the two.
    pub(super) fn settle(&mut self, now: Micros) {
        if core::mem::take(&mut self.pairing.complete) {
            self.look_at(now, Source::Host, self.pairing.answers);
        }
        if !self.hand.pending.is_empty() {
            self.take_sample(now);
        }
        if let Some(spoken) = self.hand.take_spoken() {
            self.look_at_hand(now, spoken);
        }
        if self.pairing.is_due(now) && !self.waits_for_hand(now) {
            self.decide_pending(now);
        }
    }

    /// Looks at a sentence: a command, or the answer to the question of that decision.
    pub(super) fn look_at(&mut self, now: Micros, source: Source, answers: Option<u32>) {
        let looked_at = match answers {
            None => self.observe(now, source),
            Some(decision) => self.answer(now, source, decision),
        };
        if let Err(fault) = looked_at {
            self.fault(fault);
        }
    }

    /// Whether what is due has to wait for a hand that has begun to say something.
    fn waits_for_hand(&mut self, now: Micros) -> bool {
        let waits = now < self.pairing.patience
            && self.pairing.observations.get(GESTURE).is_none()
            && self.hand.is_showing();
        if waits {
            self.pairing.due = now.after(LOOKING);
        }
        waits
    }

    /// The number of the decision whose question is open.
    pub(super) fn question(&self, now: Micros) -> Option<u32> {
        let open = self.pairing.question?;
        (now < open.until).then_some(open.number)
    }

    /// Looks at the sentence that has arrived: a clear stop is told at once, the last one expected
    /// makes the decision due, any other waits.
    fn observe(&mut self, now: Micros, source: Source) -> Result<(), Fault> {
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let arrived = match source {
            Source::Host => &self.pairing.arriving,
            Source::Hand => self.hand.said(),
        };
        let modality = arrived.modality();
        let refused = |error| Fault::Sentence { modality, error };
        arrived.check(vocabulary).map_err(refused)?;
        if let Some(stop) = vocabulary
            .stop()
            .filter(|stop| self.is_stop(arrived, *stop))
        {
            self.stop(stop, modality);
            return Ok(());
        }
        self.loading.scene().ok_or(Fault::NoScene)?;
        if self.pairing.question.take().is_some() {
            // A new command instead of an answer.
            self.pairing.clear();
        } else if self.pairing.observations.get(modality).is_some() {
            // The same modality speaks again: what waited was a command of its own.
            self.decide_pending(now);
            self.pairing.clear();
        }
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let Pairing {
            observations,
            arriving,
            due,
            patience,
            ..
        } = &mut self.pairing;
        let arrived = match source {
            Source::Host => &*arriving,
            Source::Hand => self.hand.said(),
        };
        observations.insert(arrived, vocabulary).map_err(refused)?;
        if *due == Micros::NEVER {
            *due = now.after(self.configuration.window);
            *patience = now.after(HAND_PATIENCE);
        }
        let expected = self.configuration.expected;
        if observations.modalities() & expected == expected {
            *due = now;
            *patience = Micros(0);
        }
        Ok(())
    }

    /// Looks at the answer that has arrived: what it says is fused, as one more modality, with what
    /// it was asked about and with the answers before it.
    fn answer(&mut self, now: Micros, source: Source, decision: u32) -> Result<(), Fault> {
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let Pairing {
            observations,
            arriving,
            due,
            patience,
            question,
            ..
        } = &mut self.pairing;
        let arrived = match source {
            Source::Host => &*arriving,
            Source::Hand => self.hand.said(),
        };
        match *question {
            Some(open) if open.number == decision && now < open.until => {}
            _ => return Err(Fault::NoQuestion { decision }),
        }
        let appended = observations.answer(arrived, vocabulary);
        appended.map_err(|error| Fault::Sentence {
            modality: ANSWER,
            error,
        })?;
        *due = now;
        *patience = Micros(0);
        Ok(())
    }

    /// Takes an answer as likelihoods. A yes or no is fused at once; what names an option is a word of
    /// an answer, looked at when the message is out of the way.
    ///
    /// # Errors
    /// [`Fault`]; the question stays open.
    pub(super) fn take_answer(&mut self, now: Micros, answer: &Answer<N>) -> Result<(), Fault> {
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let decision = answer.question;
        let open = self.pairing.question;
        let open = open.filter(|open| open.number == decision && now < open.until);
        let open = open.ok_or(Fault::NoQuestion { decision })?;
        let likelihoods = &answer.likelihoods[..];
        let expected = match open.kind {
            Kind::Confirm => 2,
            Kind::Which => vocabulary.options_of(open.category),
        };
        let sound = likelihoods.iter().all(|p| (0.0..=1.0).contains(p));
        if likelihoods.len() != expected || !sound {
            let expected = u8::try_from(expected).unwrap_or(u8::MAX);
            return Err(Fault::Answer { expected });
        }
        let pairing = &mut self.pairing;
        match (open.kind, likelihoods, open.about) {
            (Kind::Confirm, &[yes, no], Some(asked)) => {
                pairing.observations.confirm(Confirmation {
                    asked,
                    likelihoods: [yes, no],
                });
                pairing.due = now;
                pairing.patience = Micros(0);
            }
            _ => {
                let refused = |error| Fault::Sentence {
                    modality: ANSWER,
                    error,
                };
                let word = Word::certain(open.category, likelihoods).map_err(refused)?;
                pairing.arriving.restart(ANSWER);
                pairing.arriving.push(word).map_err(refused)?;
                pairing.answers = Some(decision);
                pairing.complete = true;
            }
        }
        Ok(())
    }

    /// A sentence of the stop action alone always stops. One with other words, which may have been
    /// misheard, stops when the robot is moving and is fused like any other when it is not.
    fn is_stop(&self, sentence: &Sentence<W, C, N>, stop: u8) -> bool {
        let mut present = sentence.words().iter().filter(|word| word.is_present());
        let profile = &self.configuration.profile;
        let clear = sentence
            .words()
            .iter()
            .any(|word| says_clearly(word, Category::ACTION, stop, profile));
        clear && (self.moving || present.nth(1).is_none())
    }

    pub(super) fn stop(&mut self, action: u8, modality: u8) {
        let intent = Intent {
            action,
            parameters: Vec::new(),
        };
        self.pairing.clear();
        let modalities = 1_u8.checked_shl(u32::from(modality)).unwrap_or(0);
        self.announce(
            modalities,
            Decision {
                outcome: Outcome::Execute(intent.clone()),
                best: Some(intent),
            },
        );
    }

    /// Decides with what there is.
    #[inline(never)]
    fn decide_pending(&mut self, now: Micros) {
        let (Some(vocabulary), Some(scene)) = (self.loading.vocabulary(), self.loading.scene())
        else {
            self.pairing.clear();
            return;
        };
        let situation = Situation {
            vocabulary,
            scene,
            observations: &self.pairing.observations,
            sensors: self.sensing.tables(),
        };
        let decided = fuse(situation, &self.configuration.profile, &mut self.trace);
        self.pairing.due = Micros::NEVER;
        match decided {
            Err(error) => {
                self.pairing.clear();
                self.fault(Fault::Configuration(error));
            }
            Ok(decision) => {
                let until = now.after(QUESTION);
                let asks = match &decision.outcome {
                    Outcome::Ask(question) => Some(Open {
                        number: 0,
                        until,
                        kind: question.kind,
                        category: question.category,
                        about: decision.best.as_ref().map(Triple::of),
                    }),
                    _ => None,
                };
                let number = self.announce(self.pairing.observations.modalities(), decision);
                if self.configuration.explain {
                    self.explain(number);
                }
                match asks {
                    Some(open) => self.pairing.question = Some(Open { number, ..open }),
                    None => self.pairing.clear(),
                }
            }
        }
    }

    #[inline(never)]
    fn announce(&mut self, modalities: u8, decision: Decision<C>) -> u32 {
        let counter = match decision.outcome {
            Outcome::Execute(_) => &mut self.statistics.executes,
            Outcome::Ask(_) => &mut self.statistics.asks,
            Outcome::Repeat | Outcome::GiveUp => &mut self.statistics.repeats,
        };
        *counter = counter.saturating_add(1);
        self.pairing.numbered = self.pairing.numbered.wrapping_add(1);
        let number = self.pairing.numbered;
        let asked = self.pairing.observations.answers();
        let asks = u8::from(matches!(decision.outcome, Outcome::Ask(_)));
        let left = self.configuration.profile.questions;
        self.send(&ToHost::Decision(Decided {
            number,
            vocabulary: self.loading.vocabulary().map_or(0, |v| v.fingerprint()),
            scene: self.loading.scene().map_or(0, |s| s.version()),
            modalities,
            questions_left: left.saturating_sub(asked).saturating_sub(asks),
            decision,
        }));
        number
    }

    #[inline(never)]
    fn explain(&mut self, number: u32) {
        let actions = self
            .trace
            .category(Category::ACTION)
            .map_or(0, |word| usize::from(word.options));
        let all = |v: &[f32; N]| Vec::from_slice(v.get(..actions).unwrap_or(v)).unwrap_or_default();
        let why = WhyActions {
            number,
            heard: all(&self.trace.heard),
            alpha: all(&self.trace.alpha),
            beta: all(&self.trace.beta),
        };
        self.link
            .send(&ToHost::<N, C>::WhyActions(why), &mut self.outbox);
        for (q, word) in self.trace.categories().iter().enumerate() {
            let Some(category) = Category::from_index(q) else {
                return;
            };
            if word.present <= 0.0 {
                continue;
            }
            let why = Why {
                number,
                category,
                present: word.present,
                merged: Vec::from_slice(word.merged()).unwrap_or_default(),
                h: Vec::from_slice(word.h()).unwrap_or_default(),
                entropy: word.entropy,
                threshold: word.threshold,
                clear: word.judgement.clear,
            };
            self.link.send(&ToHost::<N, C>::Why(why), &mut self.outbox);
        }
    }
}
