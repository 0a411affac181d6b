//! From likelihoods to one of three outcomes: execute, ask or repeat (the paper, Decision over the
//! actions for interaction mode; METHOD, section 4).

use heapless::Vec;

pub use crate::decision::{CANDIDATES, Decision, FEASIBLE, Kind, Outcome, Question, Reason};

use crate::category::Category;
use crate::decision::name;
use crate::feasibility::alignment;
use crate::intent::{Intent, Parameter};
use crate::judgement::{Judgement, bit};
use crate::profile::{Profile, SeveralClear, Threshold};
use crate::scene::Scene;
use crate::sentence::ABSENT_BELOW;
use crate::trace::{CategoryTrace, Trace};
use crate::vocabulary::Vocabulary;

/// The outcome of a filled trace.
pub fn decide<const N: usize, const C: usize, const F: usize, const E: usize>(
    vocabulary: &Vocabulary<N, C, F>,
    scene: &Scene<E, F>,
    profile: &Profile,
    trace: &Trace<C, N>,
) -> Decision<C> {
    let room = Room {
        vocabulary,
        scene,
        profile,
        trace,
    };
    let Some(action) = room.action().judgement.best else {
        return Decision {
            outcome: room.without_action(),
            best: None,
        };
    };
    let best = room.intent(action);
    // Each made where it stays: an outcome that is moved into its decision costs 400 instructions.
    match room.doubt(&best) {
        Doubt::None => Decision {
            outcome: Outcome::Execute(best.clone()),
            best: Some(best),
        },
        Doubt::Ask(question) => Decision {
            outcome: Outcome::Ask(question),
            best: Some(best),
        },
        Doubt::Everything => Decision {
            outcome: Outcome::Repeat,
            best: Some(best),
        },
    }
}

/// What speaks against executing an intent.
enum Doubt {
    None,
    Ask(Question),
    Everything,
}

/// All that a decision looks at.
struct Room<'a, const N: usize, const C: usize, const F: usize, const E: usize> {
    vocabulary: &'a Vocabulary<N, C, F>,
    scene: &'a Scene<E, F>,
    profile: &'a Profile,
    trace: &'a Trace<C, N>,
}

impl<const N: usize, const C: usize, const F: usize, const E: usize> Room<'_, N, C, F, E> {
    fn word(&self, category: usize) -> Option<&CategoryTrace<N>> {
        self.trace.categories().get(category)
    }

    fn action(&self) -> &CategoryTrace<N> {
        const { assert!(C > 0, "the action is a category") };
        let [first, ..] = self.trace.categories() else {
            return &CategoryTrace::NONE;
        };
        first
    }

    /// The action with the best option of every category of its signature that was expressed.
    fn intent(&self, action: u8) -> Intent<C> {
        let mut intent = Intent {
            action,
            parameters: Vec::new(),
        };
        self.complete(&mut intent);
        intent
    }

    /// Adds an action's parameters to an intent without any. Apart, so that [`Room::intent`] has
    /// nothing to move.
    #[inline(never)]
    fn complete(&self, intent: &mut Intent<C>) {
        let Some(known) = self.vocabulary.actions().get(usize::from(intent.action)) else {
            return;
        };
        let expressed = known.signature.compulsory.union(known.signature.voluntary);
        for q in expressed.iter() {
            let (Some(word), Some(category)) = (self.word(q), Category::from_index(q)) else {
                continue;
            };
            if let Some(option) = word.judgement.best {
                let quantity = word.quantity;
                // At most one parameter per category, and there are C categories.
                let _ = intent.parameters.push(Parameter {
                    category,
                    option,
                    quantity,
                });
            }
        }
    }

    /// No action word: with parameters the action is asked for, without anything a repetition.
    fn without_action(&self) -> Outcome<C> {
        if self
            .trace
            .categories()
            .iter()
            .all(|word| word.judgement.best.is_none())
        {
            return Outcome::Repeat;
        }
        Outcome::Ask(Question {
            kind: Kind::Which,
            action: None,
            category: Category::ACTION,
            reason: Reason::Missing,
            candidates: Vec::new(),
        })
    }

    fn doubt(&self, intent: &Intent<C>) -> Doubt {
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
