//! What speaks against executing an intent, and the question that it leads to.

use heapless::Vec;

use super::room::Room;
use crate::category::Category;
use crate::decision::{FEASIBLE, Kind, Question, Reason, name};
use crate::feasibility::alignment;
use crate::intent::Intent;
use crate::judgement::{Judgement, bit};
use crate::profile::{SeveralClear, Threshold};
use crate::sentence::ABSENT_BELOW;

/// What speaks against executing an intent.
pub(super) enum Doubt {
    None,
    Ask(Question),
    Everything,
}

impl<const N: usize, const C: usize, const F: usize, const E: usize> Room<'_, N, C, F, E> {
    /// What speaks against executing this intent.
    pub(super) fn doubt(&self, intent: &Intent<C>) -> Doubt {
        let word = self.action();
        let heard = self
            .trace
            .heard
            .get(..usize::from(word.options))
            .unwrap_or(&[]);
        let heard_best = crate::math::argmax(heard);
        let most = heard_best
            .and_then(|i| heard.get(i))
            .copied()
            .unwrap_or(0.0);
        let left = self.left(intent.action);
        // A flat action word gives every action 1 / n; one left with less than half of that by the
        // penalties stands out only because the others are worse.
        let flat = 1.0 / f32::from(word.options.max(1));
        let relative = self.profile.threshold.is_relative();
        let weak = self.profile.guarded && relative && left < 0.5 * flat;
        let nothing = self.profile.guarded && left <= most * ABSENT_BELOW;
        if (weak || nothing)
            && let Some(question) = self.why_not(heard_best)
        {
            return Doubt::Ask(question);
        }
        if nothing {
            return Doubt::Everything;
        }
        match self.action_doubt(&word.judgement, weak) {
            Err(doubt) => doubt,
            Ok(()) => self.parameter_doubt(intent).map_or(Doubt::None, Doubt::Ask),
        }
    }

    /// What speaks against the best action, its parameters aside.
    fn action_doubt(&self, judgement: &Judgement, weak: bool) -> Result<(), Doubt> {
        let asks_about_several = self.profile.several_clear == SeveralClear::Ask
            && self.profile.threshold != Threshold::None;
        let reason = if judgement.clear == 0 && judgement.unclear == 0 {
            return Err(Doubt::Everything);
        } else if judgement.clear == 0 {
            Reason::NoneClear
        } else if judgement.clear.count_ones() > 1 && asks_about_several {
            Reason::SeveralClear
        } else if judgement.lead <= self.profile.lead {
            Reason::TooClose
        } else if weak {
            Reason::Doubtful
        } else {
            return Ok(());
        };
        Err(Doubt::Ask(self.among(None, Category::ACTION, reason)))
    }

    /// What the penalties left of an action's merged likelihood.
    fn left(&self, action: u8) -> f32 {
        let at = usize::from(action);
        let factor = |v: &[f32; N]| v.get(at).copied().unwrap_or(0.0);
        factor(&self.trace.heard) * factor(&self.trace.alpha) * factor(&self.trace.beta)
    }

    /// What speaks against an intent's parameters: each compulsory one must be there and clear, and
    /// a voluntary one that was expressed must be clear, or an arm pushes the wrong way.
    fn parameter_doubt(&self, intent: &Intent<C>) -> Option<Question> {
        let signature = self
            .vocabulary
            .actions()
            .get(usize::from(intent.action))?
            .signature;
        let checked = if self.profile.guarded {
            signature.compulsory.union(signature.voluntary)
        } else {
            signature.compulsory
        };
        for q in checked.iter() {
            let category = Category::from_index(q)?;
            let word = self.word(q)?;
            let Some(best) = word.judgement.best else {
                if signature.compulsory.contains(q) {
                    return Some(self.about(intent.action, category, Reason::Missing));
                }
                continue;
            };
            if word.judgement.clear == 0 {
                return Some(self.among(Some(intent.action), category, Reason::NoneClear));
            }
            if word.judgement.lead <= self.profile.lead {
                return Some(self.among(Some(intent.action), category, Reason::TooClose));
            }
            if let Some(reason) = self.thing_doubt(intent.action, category, best) {
                return Some(self.about(intent.action, category, reason));
            }
        }
        None
    }

    /// Whether a thing is missing from the scene or not fit for the action.
    fn thing_doubt(&self, action: u8, category: Category, option: u8) -> Option<Reason> {
        if !self.profile.guarded || !category.is_entity() {
            return None;
        }
        let Some(entity) = self.scene.find(category, option) else {
            return Some(Reason::NotInScene);
        };
        let requirement = self
            .vocabulary
            .actions()
            .get(usize::from(action))?
            .requirement(category);
        (alignment(requirement, &entity.features) < FEASIBLE).then_some(Reason::Infeasible)
    }

    /// What stops the action that was heard best, if it is one of its things.
    fn why_not(&self, heard_best: Option<usize>) -> Option<Question> {
        let action = u8::try_from(heard_best?).ok()?;
        self.parameter_doubt(&self.intent(action))
    }

    /// A question about the options of a category that are in doubt, most likely first.
    fn among(&self, action: Option<u8>, category: Category, reason: Reason) -> Question {
        let mut question = Question {
            kind: Kind::Which,
            action,
            category,
            reason,
            candidates: Vec::new(),
        };
        let Some(word) = self.word(category.index()) else {
            return question;
        };
        let Judgement { clear, unclear, .. } = word.judgement;
        let open = if reason == Reason::SeveralClear {
            clear
        } else {
            clear | unclear
        };
        name(&mut question, word.merged(), open);
        question
    }

    /// A question about which thing an action is to be done to: the fit ones, most likely first.
    fn about(&self, action: u8, category: Category, reason: Reason) -> Question {
        let mut question = Question {
            kind: Kind::Which,
            action: Some(action),
            category,
            reason,
            candidates: Vec::new(),
        };
        let Some(word) = self.word(category.index()) else {
            return question;
        };
        let Some(known) = self.vocabulary.actions().get(usize::from(action)) else {
            return question;
        };
        let requirement = known.requirement(category);
        let mut fit = 0;
        for entity in self.scene.entities() {
            if entity.category == category && alignment(requirement, &entity.features) >= FEASIBLE {
                fit |= bit(entity.option);
            }
        }
        name(&mut question, word.merged(), fit);
        question
    }
}
