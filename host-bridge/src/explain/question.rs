//! Intents and questions as sentences to a person.

use deictic_core::category::Category;
use deictic_core::decide::{Kind, Question, Reason};
use deictic_core::large;

use super::fitness::because;
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
#[must_use]
pub fn amount(category: Category, quantity: f32) -> String {
    let tidy = |x: f32| f64::from((x * 100.0).round()) / 100.0;
    match category {
        Category::DISTANCE => format!("{} cm", tidy(quantity * 100.0)),
        Category::ANGLE => format!("{} degrees", tidy(quantity.to_degrees())),
        _ => tidy(quantity).to_string(),
    }
}

/// The question to put to the person. `best` is the likeliest intent, `heard` what was heard before
/// anything was held against the scene ([`crate::deciding::heard`]), `scene` what the decision was
/// made on.
#[must_use]
pub fn question(
    question: &Question,
    best: Option<&large::Intent>,
    heard: Option<&large::Intent>,
    scene: &large::Scene,
    lexicon: &Lexicon,
) -> String {
    let category = question.category;
    if let (Kind::Confirm, Some(best)) = (question.kind, best) {
        let gone = match (
            question.reason,
            heard.and_then(|heard| heard.option(category)),
        ) {
            (Reason::NotInScene, Some(option)) if scene.find(category, option).is_none() => {
                format!("I see no {} here. ", lexicon.option_name(category, option))
            }
            _ => String::new(),
        };
        return format!("{gone}Do you mean: {}?", intent(best, lexicon));
    }
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
    let name = lexicon.category_name(category);
    let reason = question.reason;
    // The question is about the likeliest intent, or about what was heard when the penalties have
    // made another one likelier.
    let about = [best, heard].into_iter().flatten().find(|intent| {
        let action = intent.action;
        let known = lexicon.vocabulary().actions().get(usize::from(action));
        let takes = known.is_some_and(|a| a.signature.compulsory.contains(category.index()));
        takes
            && (reason != Reason::Infeasible
                || intent.option(category).is_some_and(|option| {
                    !because(scene, lexicon, action, category, option).is_empty()
                }))
    });
    let called = about.map(|intent| lexicon.option_name(Category::ACTION, intent.action));
    let meant = about.or(best).and_then(|intent| intent.option(category));
    let first = match (reason, meant) {
        (Reason::NotInScene, Some(option)) => {
            format!("I see no {} here. ", lexicon.option_name(category, option))
        }
        (Reason::Infeasible, Some(option)) => {
            let thing = lexicon.option_name(category, option);
            match (&called, about) {
                (Some(called), Some(intent)) => {
                    let why = because(scene, lexicon, intent.action, category, option);
                    format!("The {thing} does not do for {called}: {}. ", why.join(", "))
                }
                _ => format!("That cannot be done with the {thing}. "),
            }
        }
        (Reason::Infeasible, None) => format!("That {name} does not fit. "),
        _ => String::new(),
    };
    let to = called.map_or_else(String::new, |called| format!(" for {called}"));
    let fit = matches!(
        reason,
        Reason::Missing | Reason::NotInScene | Reason::Infeasible
    );
    match (among, &question.candidates[..]) {
        (Some(only), [_]) => format!("{first}Shall it be the {only}?"),
        (Some(among), _) => format!("{first}Which {name}{to}: {among}?"),
        (None, _) if fit && category.is_entity() => {
            format!("{first}There is no {name} here that fits. What now?")
        }
        (None, _) => format!("{first}Which {name}{to}?"),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneFile;
    use deictic_core::intent::Parameter;
    use deictic_core::profile::Profile;

    fn asked(
        category: Category,
        reason: Reason,
        candidates: &[u8],
        action: &str,
        object: Option<u8>,
    ) -> String {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let mut best = large::Intent {
            action: lexicon.option(Category::ACTION, action).unwrap(),
            ..large::Intent::default()
        };
        if let Some(option) = object {
            let (category, quantity) = (Category::OBJECT, None);
            let parameter = Parameter {
                category,
                option,
                quantity,
            };
            best.parameters.push(parameter).unwrap();
        }
        let asked = Question {
            kind: Kind::Which,
            action: None,
            category,
            reason,
            candidates: candidates.iter().copied().collect(),
        };
        question(&asked, Some(&best), None, table.scene(), &lexicon)
    }

    #[test]
    fn a_question_names_what_is_in_doubt_and_why() {
        const O: Category = Category::OBJECT;
        let text = asked(O, Reason::SeveralClear, &[0, 1], "pick", Some(0));
        assert_eq!(text, "Which object for pick: can or cup?");
        let text = asked(O, Reason::Infeasible, &[0], "pick", Some(3));
        assert_eq!(
            text,
            "The box does not do for pick: it is glued. Shall it be the can?"
        );
        let text = asked(O, Reason::Infeasible, &[0, 1, 2], "unglue", Some(3));
        assert_eq!(
            text,
            "That cannot be done with the box. Which object: can, cup or cube?"
        );
        let text = asked(Category::STORAGE, Reason::Infeasible, &[3], "pick", Some(0));
        assert_eq!(text, "That storage does not fit. Shall it be the bowl?");
        let text = asked(O, Reason::Missing, &[], "pick", None);
        assert_eq!(text, "There is no object here that fits. What now?");
        let text = asked(
            Category::ACTION,
            Reason::SeveralClear,
            &[3, 4],
            "pick",
            None,
        );
        assert_eq!(text, "pick or push?");
        let text = asked(Category::ACTION, Reason::NoneClear, &[3], "pick", None);
        assert_eq!(text, "Did you mean pick?");
    }

    #[test]
    fn a_yes_or_no_names_the_whole_intent() {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let mut best = large::Intent {
            action: lexicon.option(Category::ACTION, "pick").unwrap(),
            ..large::Intent::default()
        };
        let cup = lexicon.option(Category::OBJECT, "cup").unwrap();
        best.parameters
            .push(Parameter {
                category: Category::OBJECT,
                option: cup,
                quantity: None,
            })
            .unwrap();
        let asked = Question {
            kind: Kind::Confirm,
            action: Some(best.action),
            category: Category::OBJECT,
            reason: Reason::TooClose,
            candidates: [0, 1].into_iter().collect(),
        };
        let text = question(&asked, Some(&best), None, table.scene(), &lexicon);
        assert_eq!(text, "Do you mean: pick cup?");
    }

    #[test]
    fn what_was_heard_is_named_when_something_else_has_become_likelier() {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let shown = crate::showing::showing("pick cleaner", &lexicon).unwrap();
        let heard = crate::deciding::heard([&shown], &lexicon, &Profile::PAPER);
        let asked = Question {
            kind: Kind::Which,
            action: None,
            category: Category::OBJECT,
            reason: Reason::Infeasible,
            candidates: [0, 1].into_iter().collect(),
        };
        let release = large::Intent {
            action: 1,
            ..large::Intent::default()
        };
        let (best, scene) = (Some(&release), table.scene());
        assert_eq!(
            question(&asked, best, heard.as_ref(), scene, &lexicon),
            "The cleaner does not do for pick: it is out of reach. Which object for pick: can or cup?"
        );
    }

    #[test]
    fn quantities_are_said_with_their_unit() {
        let lexicon = Lexicon::tabletop().unwrap();
        let mut up = large::Intent::default();
        let parameter = Parameter {
            category: Category::DISTANCE,
            option: 0,
            quantity: Some(0.05),
        };
        up.parameters.push(parameter).unwrap();
        assert_eq!(intent(&up, &lexicon), "move-up 5 cm");
    }
}
