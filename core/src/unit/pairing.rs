//! Bringing sentences of different modalities together by time, and deciding when they are complete
//! or their window closes.

use heapless::Vec;

use super::Unit;
use crate::category::Category;
use crate::decide::{Decision, Outcome};
use crate::fuse::{Situation, fuse, says_clearly};
use crate::intent::Intent;
use crate::protocol::message::{Answer, Decided, Fault, Message, Why, WhyActions};
use crate::sentence::{Observations, Sentence};
use crate::time::Micros;

/// The modality under which answers to questions are fused with what they were asked about.
pub const ANSWER: u8 = 3;

/// How long a question stays open.
pub const QUESTION: Micros = Micros::from_millis(60_000);

/// Sentences that wait for others, or for an answer.
#[derive(Debug)]
pub struct Pairing<const N: usize, const C: usize, const W: usize> {
    observations: Observations<W, C, N>,
    modalities: u8,
    due: Micros,
    /// The decision that asked, and until when its answer is taken.
    question: Option<(u32, Micros)>,
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
            modalities: 0,
            due: Micros::NEVER,
            question: None,
            numbered: 0,
        }
    }

    /// Forgets what waits; decisions keep being numbered on.
    pub fn clear(&mut self) {
        self.observations.clear();
        self.modalities = 0;
        self.due = Micros::NEVER;
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

    fn has(&self, modality: u8) -> bool {
        self.modalities & bit(modality) != 0
    }

    fn insert(&mut self, sentence: Sentence<W, C, N>) -> Result<(), Fault> {
        let modality = sentence.modality();
        let inserted = self.observations.insert(sentence);
        inserted.map_err(|error| Fault::Sentence { modality, error })?;
        self.modalities |= bit(modality);
        Ok(())
    }
}

fn bit(modality: u8) -> u8 {
    1_u8.checked_shl(u32::from(modality)).unwrap_or(0)
}

impl<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
    const FRAME: usize,
    const OUT: usize,
> Unit<N, C, F, E, W, FRAME, OUT>
{
    /// Takes a sentence: decides at once when it was the last one expected or a clear stop, waits
    /// for others otherwise.
    pub(super) fn observe(
        &mut self,
        now: Micros,
        sentence: Sentence<W, C, N>,
    ) -> Result<(), Fault> {
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let modality = sentence.modality();
        sentence
            .check(vocabulary)
            .map_err(|error| Fault::Sentence { modality, error })?;
        if let Some(stop) = vocabulary
            .stop()
            .filter(|stop| self.is_stop(&sentence, *stop))
        {
            self.stop(stop, modality);
            return Ok(());
        }
        self.loading.scene().ok_or(Fault::NoScene)?;
        if self.pairing.question.take().is_some() {
            // A new command instead of an answer.
            self.pairing.clear();
        } else if self.pairing.has(modality) {
            // The same modality speaks again: what waited was a command of its own.
            self.decide_pending(now);
            self.pairing.clear();
        }
        self.pairing.insert(sentence)?;
        if self.pairing.due == Micros::NEVER {
            self.pairing.due = now.after(self.configuration.window);
        }
        let expected = self.configuration.expected;
        if self.pairing.modalities & expected == expected {
            self.decide_pending(now);
        }
        Ok(())
    }

    /// Takes an answer: what it says is fused, as one more modality, with what it was asked about.
    pub(super) fn answer(&mut self, now: Micros, answer: Answer<W, C, N>) -> Result<(), Fault> {
        let vocabulary = self.loading.vocabulary().ok_or(Fault::NoVocabulary)?;
        let decision = answer.decision;
        match self.pairing.question {
            Some((asked, until)) if asked == decision && now < until => {}
            _ => return Err(Fault::NoQuestion { decision }),
        }
        let given = &answer.sentence;
        given.check(vocabulary).map_err(|error| Fault::Sentence {
            modality: ANSWER,
            error,
        })?;
        let mut all = Sentence::new(ANSWER);
        let before = self
            .pairing
            .observations
            .get(ANSWER)
            .map_or(&[][..], Sentence::words);
        for word in before.iter().chain(given.words()) {
            all.push(word.clone()).map_err(|error| Fault::Sentence {
                modality: ANSWER,
                error,
            })?;
        }
        self.pairing.insert(all)?;
        self.decide_pending(now);
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

    fn stop(&mut self, action: u8, modality: u8) {
        let intent = Intent {
            action,
            parameters: Vec::new(),
        };
        self.pairing.clear();
        self.pairing.modalities = bit(modality);
        self.announce(Decision {
            outcome: Outcome::Execute(intent.clone()),
            best: Some(intent),
        });
        self.pairing.clear();
    }

    /// Decides with what there is.
    pub(super) fn decide_pending(&mut self, now: Micros) {
        let (Some(vocabulary), Some(scene)) = (self.loading.vocabulary(), self.loading.scene())
        else {
            self.pairing.clear();
            return;
        };
        let situation = Situation {
            vocabulary,
            scene,
            observations: &self.pairing.observations,
        };
        let decided = fuse(situation, &self.configuration.profile, &mut self.trace);
        self.pairing.due = Micros::NEVER;
        match decided {
            Err(error) => {
                self.pairing.clear();
                self.fault(Fault::Decision(error));
            }
            Ok(decision) => {
                let asks = matches!(decision.outcome, Outcome::Ask(_));
                let number = self.announce(decision);
                if self.configuration.explain {
                    self.explain(number);
                }
                if asks {
                    self.pairing.question = Some((number, now.after(QUESTION)));
                } else {
                    self.pairing.clear();
                }
            }
        }
    }

    fn announce(&mut self, decision: Decision<C>) -> u32 {
        let counter = match decision.outcome {
            Outcome::Execute(_) => &mut self.statistics.executes,
            Outcome::Ask(_) => &mut self.statistics.asks,
            Outcome::Repeat => &mut self.statistics.repeats,
        };
        *counter = counter.saturating_add(1);
        self.pairing.numbered = self.pairing.numbered.wrapping_add(1);
        let number = self.pairing.numbered;
        self.send(&Message::Decision(Decided {
            number,
            vocabulary: self.loading.vocabulary().map_or(0, |v| v.fingerprint()),
            scene: self.loading.scene().map_or(0, |s| s.version()),
            modalities: self.pairing.modalities,
            decision,
        }));
        number
    }

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
            .send(&Message::<N, C, F, W>::WhyActions(why), &mut self.outbox);
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
            self.link
                .send(&Message::<N, C, F, W>::Why(why), &mut self.outbox);
        }
    }
}
