//! What keeps a thing from being used, as people say it.

use deictic_core::category::Category;
use deictic_core::decide::FEASIBLE;
use deictic_core::large;

use crate::vocabulary::Lexicon;

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
            reasons.push(said(name, false));
        }
        if requirement.unwanted.contains(k) && feature > 1.0 - FEASIBLE {
            reasons.push(said(name, true));
        }
    }
    reasons
}

/// That a thing has a feature, or has not, as people say it; the paper's features have words of their own.
fn said(feature: &str, has: bool) -> String {
    let text = match (feature, has) {
        ("full-liquid", true) => "it is full",
        ("full-liquid", false) => "it is empty",
        ("full-stack", true) => "something stands on it",
        ("full-stack", false) => "nothing stands on it",
        ("full-container", true) => "no more goes into it",
        ("liquid-container", false) => "nothing can be poured into it",
        ("container", false) => "nothing can be put into it",
        ("stackable", false) => "nothing can be put on it",
        ("pickable", false) => "it cannot be picked up",
        ("pushable", false) => "it cannot be pushed",
        ("reachable", false) => "it is out of reach",
        (feature, has) => {
            let not = if has { "" } else { "not " };
            return format!("it is {not}{}", feature.replace(['-', '_'], " "));
        }
    };
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_said_as_people_say_them() {
        for feature in Lexicon::tabletop().unwrap().features() {
            for has in [true, false] {
                assert!(!said(feature, has).contains('-'), "{feature}");
            }
        }
        assert_eq!(said("full-liquid", false), "it is empty");
        assert_eq!(said("very-hot", true), "it is very hot");
    }
}
