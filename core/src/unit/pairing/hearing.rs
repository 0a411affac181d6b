//! What a sentence or an answer does when all of it has arrived.

use super::forbidding::Forbidden;
use super::{HAND_PATIENCE, LOOKING, Pairing, Source};
use crate::category::Category;
use crate::clarify::Confirmation;
use crate::decide::Kind;
use crate::fuse::says_clearly;
use crate::protocol::message::{Answer, Fault, ToHost, Withheld};
use crate::sentence::{ANSWER, GESTURE, Sentence, Word};
use crate::time::Micros;
use crate::unit::Unit;

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
    pub(in crate::unit) fn settle(&mut self, now: Micros) {
        if core::mem::take(&mut self.pairing.complete) {
            self.look_at(now, Source::Host, self.pairing.answers);
        }
        let sampled = !self.hand.pending.is_empty();
        if sampled {
            self.take_sample(now);
        }
        if let Some(spoken) = self.hand.take_spoken() {
            self.look_at_hand(now, spoken);
        }
        if sampled {
            self.watch_forbidden(now);
        }
        if self.pairing.is_due(now) && !self.waits_for_hand(now) {
            self.decide_pending(now);
        }
    }

    /// Looks at a sentence: a command, or the answer to the question of that decision.
    pub(in crate::unit) fn look_at(&mut self, now: Micros, source: Source, answers: Option<u32>) {
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
    pub(in crate::unit) fn question(&self, now: Micros) -> Option<u32> {
        let open = self.pairing.question?;
        (now < open.until).then_some(open.number)
    }

    /// Looks at the sentence that has arrived: a clear stop is told at once, one that is forbidden is not taken, the
    /// last one expected makes the decision due, any other waits.
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
        if self.pairing.forbidden.holds(now, source, modality) {
            self.withhold(modality);
            return Ok(());
        }
        if self.pairing.forbidden.is_by(modality) {
            self.pairing.forbidden = Forbidden::NOTHING;
        }
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
    pub(in crate::unit) fn take_answer(
        &mut self,
        now: Micros,
        answer: &Answer<N>,
    ) -> Result<(), Fault> {
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

    /// Takes it that a modality forbade, asked or told something, or said what nobody understood: what waits is
    /// dropped, an open question with it, and what is shown with it is not taken.
    ///
    /// # Errors
    /// [`Fault`] for a modality that there is not; nothing has changed then.
    pub(in crate::unit) fn forbid(&mut self, now: Micros, by: u8) -> Result<(), Fault> {
        let until = now.after(self.configuration.window);
        let forbidden = Forbidden::new(by, until, self.hand.is_showing())?;
        let modalities = self.pairing.observations.modalities();
        self.pairing.clear();
        self.pairing.forbidden = forbidden;
        self.send(&ToHost::Withheld(Withheld {
            modalities,
            confirms: true,
        }));
        Ok(())
    }

    /// Looks at the hand, after what it said.
    pub(in crate::unit) fn watch_forbidden(&mut self, now: Micros) {
        self.pairing.forbidden.watch(now, self.hand.is_showing());
    }

    /// Tells the host that this modality's sentence is not taken.
    #[inline(never)]
    fn withhold(&mut self, modality: u8) {
        self.send(&ToHost::Withheld(Withheld {
            modalities: 1_u8.checked_shl(u32::from(modality)).unwrap_or(0),
            confirms: false,
        }));
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
}
