//! METHOD, section 4: execute, ask or repeat.

use deictic_core::board::{Scene, Vocabulary};
use deictic_core::category::Category;
use deictic_core::decide::{FEASIBLE, Reason};
use deictic_core::entropy::white_noise;
use deictic_core::judgement::NOISE;
use deictic_core::profile::{Profile, SeveralClear, Threshold};
use deictic_core::sentence::ABSENT_BELOW;

use super::merge::{Penalties, alignment};
use super::{Margin, Merged};

/// What to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// This action with these options of these categories.
    Execute(u8, Vec<(Category, u8)>),
    /// Ask about this category for this reason.
    Ask(Category, Reason),
    /// Ask for everything again.
    Repeat,
}

/// The options that are clear.
pub fn clear(merged: &Merged, threshold: Threshold, margin: &mut Margin) -> Vec<usize> {
    judge(merged, threshold, margin).0
}

/// The options that are clear and those that are unclear.
fn judge(merged: &Merged, threshold: Threshold, margin: &mut Margin) -> (Vec<usize>, Vec<usize>) {
    let (mut clear, mut unclear) = (Vec::new(), Vec::new());
    let alone = merged.word.len() == 1;
    for (option, (&w, &h)) in merged.word.iter().zip(&merged.h).enumerate() {
        let (is_clear, is_noise) = match threshold {
            // Risk is a matter of whole intents, which this method does not have.
            Threshold::None | Threshold::Risk { .. } => (true, false),
            _ if alone => (true, false),
            Threshold::Entropy => (
                margin.below(h, merged.entropy),
                !margin.below(f64::from(NOISE), w),
            ),
            Threshold::WhiteNoise => {
                let limit = f64::from(white_noise(merged.word.len()));
                (margin.below(h, limit), !margin.below(f64::from(NOISE), w))
            }
            Threshold::Fixed { clear, unclear } => (
                margin.below(f64::from(clear), w),
                !margin.below(f64::from(unclear), w),
            ),
        };
        if is_clear {
            clear.push(option);
        } else if !is_noise {
            unclear.push(option);
        }
    }
    (clear, unclear)
}

/// The best option and by how much it leads.
fn best(word: &[f64], margin: &mut Margin) -> Option<(usize, f64)> {
    let mut order: Vec<usize> = (0..word.len()).collect();
    order.sort_by(|a, b| word[*b].total_cmp(&word[*a]));
    let &first = order.first()?;
    match order.get(1) {
        None => Some((first, 1.0)),
        Some(&second) => {
            margin.below(word[second], word[first]);
            Some((first, word[first] - word[second]))
        }
    }
}

pub fn decide(
    vocabulary: &Vocabulary,
    scene: &Scene,
    profile: &Profile,
    categories: &[Merged],
    penalties: &Penalties,
    margin: &mut Margin,
) -> Verdict {
    let mut room = Room {
        vocabulary,
        scene,
        profile,
        categories,
        margin,
    };
    room.decide(penalties)
}

struct Room<'a> {
    vocabulary: &'a Vocabulary,
    scene: &'a Scene,
    profile: &'a Profile,
    categories: &'a [Merged],
    margin: &'a mut Margin,
}

impl Room<'_> {
    fn decide(&mut self, penalties: &Penalties) -> Verdict {
        let actions = &self.categories[0];
        if penalties.heard.is_empty() || penalties.heard.iter().all(|&w| w <= 0.0) {
            let silent = self.categories.iter().skip(1).all(|c| c.word.is_empty());
            return if silent {
                Verdict::Repeat
            } else {
                Verdict::Ask(Category::ACTION, Reason::Missing)
            };
        }
        let Some((action, lead)) = best(&actions.word, self.margin) else {
            return Verdict::Repeat;
        };
        let most = penalties.heard.iter().copied().fold(0.0, f64::max);
        let left = penalties.heard[action] * penalties.alpha[action] * penalties.beta[action];
        let flat = 1.0 / actions.word.len() as f64;
        let guarded = self.profile.guarded;
        let relative = self.profile.threshold.is_relative();
        let weak = guarded && relative && self.margin.below(left, 0.5 * flat);
        let nothing = guarded && !self.margin.below(most * f64::from(ABSENT_BELOW), left);
        if weak || nothing {
            let heard_best = best(&penalties.heard, self.margin).map(|(i, _)| i);
            if let Some(asked) = heard_best.and_then(|action| self.parameters(action)) {
                return asked;
            }
        }
        if nothing {
            return Verdict::Repeat;
        }
        let (clear, unclear) = judge(actions, self.profile.threshold, self.margin);
        let asks_about_several = self.profile.several_clear == SeveralClear::Ask
            && self.profile.threshold != Threshold::None;
        let about_the_action = |reason| Verdict::Ask(Category::ACTION, reason);
        if clear.is_empty() && unclear.is_empty() {
            Verdict::Repeat
        } else if clear.is_empty() {
            about_the_action(Reason::NoneClear)
        } else if clear.len() > 1 && asks_about_several {
            about_the_action(Reason::SeveralClear)
        } else if !self.margin.below(f64::from(self.profile.lead), lead) {
            about_the_action(Reason::TooClose)
        } else if weak {
            about_the_action(Reason::Doubtful)
        } else if let Some(asked) = self.parameters(action) {
            asked
        } else {
            self.execute(action)
        }
    }

    /// What speaks against the parameters of an action.
    fn parameters(&mut self, action: usize) -> Option<Verdict> {
        let known = &self.vocabulary.actions()[action];
        for (q, merged) in self.categories.iter().enumerate() {
            let compulsory = known.signature.compulsory.contains(q);
            let voluntary = self.profile.guarded && known.signature.voluntary.contains(q);
            if !(compulsory || voluntary) {
                continue;
            }
            let category = Category::from_index(q)?;
            let ask = |reason| Some(Verdict::Ask(category, reason));
            let Some((option, lead)) = best(&merged.word, self.margin) else {
                if compulsory {
                    return ask(Reason::Missing);
                }
                continue;
            };
            if judge(merged, self.profile.threshold, self.margin)
                .0
                .is_empty()
            {
                return ask(Reason::NoneClear);
            }
            if !self.margin.below(f64::from(self.profile.lead), lead) {
                return ask(Reason::TooClose);
            }
            if self.profile.guarded && category.is_entity() {
                let Some(thing) = self.scene.find(category, u8::try_from(option).ok()?) else {
                    return ask(Reason::NotInScene);
                };
                let fit = alignment(known.requirement(category), &thing.features);
                if self.margin.below(fit, f64::from(FEASIBLE)) {
                    return ask(Reason::Infeasible);
                }
            }
        }
        None
    }

    fn execute(&mut self, action: usize) -> Verdict {
        let signature = self.vocabulary.actions()[action].signature;
        let expressed = signature.compulsory.union(signature.voluntary);
        let mut parameters = Vec::new();
        for q in expressed.iter() {
            if let (Some(category), Some((option, _))) = (
                Category::from_index(q),
                self.categories
                    .get(q)
                    .and_then(|c| best(&c.word, self.margin)),
            ) {
                parameters.push((category, option as u8));
            }
        }
        Verdict::Execute(action as u8, parameters)
    }
}
