//! Deciding with what there is, and telling it.

use heapless::Vec;

use super::{Open, QUESTION};
use crate::category::Category;
use crate::decide::{Decision, Outcome};
use crate::fuse::{Situation, fuse};
use crate::intent::Intent;
use crate::joint::belief::Look;
use crate::joint::posterior::Triple;
use crate::profile::{Model, Threshold};
use crate::protocol::message::{Decided, Fault, ToHost, Why, WhyActions, WhyWhole};
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
    pub(in crate::unit) fn stop(&mut self, action: u8, modality: u8) {
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
                    self.explain_whole(number);
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
    fn explain_whole(&mut self, number: u32) {
        let profile = &self.configuration.profile;
        if profile.model != Model::Joint {
            return;
        }
        let answers = self.pairing.observations.answers();
        let look = Look::of(profile.questions, profile.questions.saturating_sub(answers));
        let belief = &self.trace.belief;
        let why = WhyWhole {
            number,
            posterior: belief.posterior,
            confidence: belief.logit(),
            cut: match profile.threshold {
                Threshold::Risk { rate } => Some(belief.cut(rate, look)),
                _ => None,
            },
        };
        self.link
            .send(&ToHost::<N, C>::WhyWhole(why), &mut self.outbox);
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
