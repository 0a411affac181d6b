//! What the core would do with a sample, and what it finds likeliest.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::intent::Intent;
use deictic_core::profile::{Model, Profile};

use crate::catalogue::Catalogue;
use crate::order::Order;
use crate::reading::choice;
use crate::record::{CATEGORIES, Triple};
use crate::sensing::Sensing;
use crate::situation::Prepared;
use crate::variant::ProfileName;

/// The core's answer to one sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// What would be executed; `None` when something is asked first.
    pub executed: Option<Triple>,
    /// The action that is settled, whether or not its parameters are. In the paper's profile one is
    /// not settled without the other.
    pub action: Option<u8>,
    /// The likeliest intent; `None` when nothing was said of an action.
    pub likeliest: Option<Triple>,
}

/// How a sample is decided and how the decision is read.
#[derive(Clone, Copy)]
pub struct Judge<'a> {
    /// What the numbers mean.
    pub catalogue: &'a Catalogue,
    /// In which order the core sees them.
    pub order: &'a Order,
    /// The catalogue in that order.
    pub vocabulary: &'a board::Vocabulary,
    /// How easily its options are mistaken, for the joint model.
    pub sensing: &'a Sensing,
    /// Whose habits the answer is read with: the paper's outcome is one intent or a question, the
    /// reference settles every category on its own.
    pub habits: ProfileName,
}

impl Judge<'_> {
    /// Decides a sample; `trace` is working memory.
    ///
    /// # Errors
    /// The core's, for a sample that does not fit the vocabulary.
    pub fn answer(
        &self,
        prepared: &Prepared,
        profile: &Profile,
        trace: &mut board::Trace,
    ) -> Result<Answer, deictic_core::profile::ProfileError> {
        let decision = self
            .sensing
            .decide(prepared, self.vocabulary, profile, trace)?;
        let habits = if profile.model == Model::Joint {
            ProfileName::Paper
        } else {
            self.habits
        };
        Ok(match habits {
            ProfileName::Paper => {
                let executed = match &decision.outcome {
                    Outcome::Execute(intent) => Some(self.triple(intent)),
                    Outcome::Ask(_) | Outcome::Repeat | Outcome::GiveUp => None,
                };
                Answer {
                    executed,
                    action: executed.map(|triple| triple.action),
                    likeliest: decision.best.as_ref().map(|best| self.triple(best)),
                }
            }
            ProfileName::Reference => {
                let choices: [_; CATEGORIES] = std::array::from_fn(|c| choice(trace, c, profile));
                let decided = choices.map(|c| c.decided);
                Answer {
                    executed: self.complete(decided, false),
                    action: decided[0].map(|a| self.order.outside(0, a)),
                    likeliest: self.complete(choices.map(|c| c.likeliest), true),
                }
            }
        })
    }

    /// An intent in the catalogue's numbers.
    #[must_use]
    pub fn triple(&self, intent: &Intent<{ board::CATEGORIES }>) -> Triple {
        let parameter = |category: Category| {
            let option = intent.option(category)?;
            Some(self.order.outside(category.index(), option))
        };
        Triple {
            action: self.order.outside(0, intent.action),
            object: parameter(Category::OBJECT),
            storage: parameter(Category::STORAGE),
        }
    }

    /// The chosen action with the choices of the categories it takes; `None` when it lacks one,
    /// unless it may be `partial`.
    fn complete(&self, choices: [Option<u8>; CATEGORIES], partial: bool) -> Option<Triple> {
        let [action, object, storage] = choices;
        let action = self.order.outside(0, action?);
        let takes = |c: usize| self.catalogue.takes(usize::from(action), c);
        if !partial && (takes(1) && object.is_none() || takes(2) && storage.is_none()) {
            return None;
        }
        let outside = |c: usize, choice: Option<u8>| {
            choice
                .filter(|_| takes(c))
                .map(|o| self.order.outside(c, o))
        };
        Some(Triple {
            action,
            object: outside(1, object),
            storage: outside(2, storage),
        })
    }
}
