//! Intents and questions as sentences to a person.

use deictic_core::category::Category;
use deictic_core::decide::{FEASIBLE, Question, Reason};
use deictic_core::large;

use crate::vocabulary::Lexicon;

/// An intent in a line, for example `put-into can drawer` or `move-up 5 cm`.
#[must_use]
pub fn intent(intent: &large::Intent, lexicon: &Lexicon) -> String {
    let mut line = lexicon.option_name(Category::ACTION, intent.action);
    for parameter in &intent.parameters {
        if !lexicon.is_quantity_only(parameter.category) {
            line.push(' ');
            line += &lexicon.option_name(parameter.category, parameter.option);
        }
        if let Some(quantity) = parameter.quantity {
            line.push(' ');
            line += &amount(parameter.category, quantity);
        }
    }
    line
}

/// A quantity with its unit: centimetres, degrees, or the bare number.
fn amount(category: Category, quantity: f32) -> String {
    let tidy = |x: f32| f64::from((x * 100.0).round()) / 100.0;
    match category {
        Category::DISTANCE => format!("{} cm", tidy(quantity * 100.0)),
        Category::ANGLE => format!("{} degrees", tidy(quantity.to_degrees())),
        _ => tidy(quantity).to_string(),
    }
}

/// The question to put to the person. `best` is the likeliest intent, `scene` what the decision was
/// made on.
#[must_use]
pub fn question(
    question: &Question,
    best: Option<&large::Intent>,
    scene: &large::Scene,
    lexicon: &Lexicon,
) -> String {
    let category = question.category;
    let among = or(question
        .candidates
        .iter()
        .map(|&c| lexicon.option_name(category, c)));
    if category == Category::ACTION {
        return match (question.reason, among) {
            (Reason::SeveralClear | Reason::TooClose, Some(among)) => format!("{among}?"),
            (Reason::Missing, _) => match best {
                Some(best) => format!("What shall I do: {}?", intent(best, lexicon)),
                None => "What shall I do with it?".to_owned(),
            },
            (_, Some(among)) => format!("Did you mean {among}?"),
            (_, None) => "What shall I do?".to_owned(),
        };
    }
    let action = best.map_or_else(
        || "do that to".to_owned(),
        |best| lexicon.option_name(Category::ACTION, best.action),
    );
    let name = lexicon.category_name(category);
    let meant = best.and_then(|best| Some((best.action, best.option(category)?)));
    let first = match (question.reason, meant) {
        (Reason::NotInScene, Some((_, option))) => {
            format!("I see no {} here. ", lexicon.option_name(category, option))
        }
        (Reason::Infeasible, Some((act, option))) => format!(
            "I cannot {action} with the {}: {}. ",
            lexicon.option_name(category, option),
            because(scene, lexicon, act, category, option).join(", ")
        ),
        _ => String::new(),
    };
    let fit = matches!(
        question.reason,
        Reason::Missing | Reason::NotInScene | Reason::Infeasible
    );
    match among {
        Some(among) => format!("{first}Which {name} for {action}: {among}?"),
        None if fit && category.is_entity() => {
            format!("{first}There is no {name} here that fits {action}. What now?")
        }
        None => format!("{first}Which {name} for {action}?"),
    }
}

/// What about a thing keeps an action from being done to it, requirement by requirement.
#[must_use]
pub fn because(
    scene: &large::Scene,
    lexicon: &Lexicon,
    action: u8,
    category: Category,
    option: u8,
) -> Vec<String> {
    let (Some(entity), Some(known)) = (
        scene.find(category, option),
        lexicon.vocabulary().actions().get(usize::from(action)),
    ) else {
        return vec!["it is not here".to_owned()];
    };
    let requirement = known.requirement(category);
    let mut reasons = Vec::new();
    for (k, name) in lexicon.features().iter().enumerate() {
        let feature = entity.features.get(k).copied().unwrap_or(0.0);
        if requirement.wanted.contains(k) && feature < FEASIBLE {
            reasons.push(format!("it is not {name}"));
        }
        if requirement.unwanted.contains(k) && feature > 1.0 - FEASIBLE {
            reasons.push(format!("it is {name}"));
        }
    }
    reasons
}

/// "a, b or c"; `None` of nothing.
fn or(names: impl Iterator<Item = String>) -> Option<String> {
    let mut names: Vec<_> = names.collect();
    let last = names.pop()?;
    Some(if names.is_empty() {
        last
    } else {
        format!("{} or {last}", names.join(", "))
    })
}
