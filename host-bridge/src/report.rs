//! Decisions in a form for programs: what `--json` prints.

use deictic_core::category::Category;
use deictic_core::decide::{Kind, Outcome, Question, Reason};
use deictic_core::large;
use serde::Serialize;

use crate::explain;
use crate::vocabulary::Lexicon;

/// A decision by names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DecisionReport {
    /// `execute`, `ask` or `repeat`.
    pub outcome: &'static str,
    /// What to do, when it is to be executed.
    pub intent: Option<IntentReport>,
    /// What to ask, when it is to be asked.
    pub question: Option<QuestionReport>,
    /// The likeliest intent, whatever its clarity.
    pub best: Option<IntentReport>,
}

/// An intent by names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IntentReport {
    /// The action.
    pub action: String,
    /// Its parameters.
    pub parameters: Vec<ParameterReport>,
}

/// A parameter by names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterReport {
    /// The category.
    pub category: String,
    /// The option; `null` of a category that carries a quantity only.
    pub option: Option<String>,
    /// Metres, radians or a number, by category.
    pub quantity: Option<f32>,
}

/// A question by names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct QuestionReport {
    /// The kind of answer: `confirm` for yes or no, `which` for an option.
    pub kind: &'static str,
    /// The action it is about; `null` when the action itself is asked for.
    pub action: Option<String>,
    /// What is asked for.
    pub category: String,
    /// Why.
    pub reason: &'static str,
    /// The options in question.
    pub candidates: Vec<String>,
    /// The question in words.
    pub text: String,
}

/// The report of an intent.
#[must_use]
pub fn intent(intent: &large::Intent, lexicon: &Lexicon) -> IntentReport {
    IntentReport {
        action: lexicon.option_name(Category::ACTION, intent.action),
        parameters: intent
            .parameters
            .iter()
            .map(|p| ParameterReport {
                category: lexicon.category_name(p.category),
                option: (!lexicon.is_quantity_only(p.category))
                    .then(|| lexicon.option_name(p.category, p.option)),
                quantity: p.quantity,
            })
            .collect(),
    }
}

/// The report of a decision that was made on `scene`, when `heard` was heard.
#[must_use]
pub fn decision(
    decision: &large::Decision,
    heard: Option<&large::Intent>,
    scene: &large::Scene,
    lexicon: &Lexicon,
) -> DecisionReport {
    let best = decision.best.as_ref();
    let (outcome, executed, asked) = match &decision.outcome {
        Outcome::Execute(what) => ("execute", Some(intent(what, lexicon)), None),
        Outcome::Ask(q) => ("ask", None, Some(question(q, best, heard, scene, lexicon))),
        Outcome::Repeat => ("repeat", None, None),
        Outcome::GiveUp => ("give-up", None, None),
    };
    DecisionReport {
        outcome,
        intent: executed,
        question: asked,
        best: best.map(|best| intent(best, lexicon)),
    }
}

/// The kind of a question's answer.
#[must_use]
pub fn kind(question: &Question) -> &'static str {
    match question.kind {
        Kind::Which => "which",
        Kind::Confirm => "confirm",
    }
}

fn question(
    question: &Question,
    best: Option<&large::Intent>,
    heard: Option<&large::Intent>,
    scene: &large::Scene,
    lexicon: &Lexicon,
) -> QuestionReport {
    QuestionReport {
        kind: kind(question),
        action: question
            .action
            .map(|action| lexicon.option_name(Category::ACTION, action)),
        category: lexicon.category_name(question.category),
        reason: match question.reason {
            Reason::SeveralClear => "several-clear",
            Reason::NoneClear => "none-clear",
            Reason::TooClose => "too-close",
            Reason::Missing => "missing",
            Reason::NotInScene => "not-in-scene",
            Reason::Infeasible => "infeasible",
            Reason::Doubtful => "doubtful",
        },
        candidates: question
            .candidates
            .iter()
            .map(|&c| lexicon.option_name(question.category, c))
            .collect(),
        text: explain::question(question, best, heard, scene, lexicon),
    }
}
