//! Examples of dynamic gestures from recordings: which strokes stand for a gesture.

use std::collections::BTreeSet;

use deictic_core::gesture::template::{Scale, Template};
use thiserror::Error;

use super::examples::Examples;
use super::fitting::{Fitted, fitted};
use super::performance::Performance;

/// As many gestures as one comparison tells apart here.
pub const GESTURES_AT_MOST: usize = 64;

/// Why nothing can be learned.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LearningError {
    /// There is no stroke.
    #[error("no movement to learn from")]
    Nothing,
    /// More gestures than are told apart.
    #[error("{0} gestures; at most {GESTURES_AT_MOST} are told apart")]
    TooMany(usize),
}

/// What the unit needs to recognise gestures.
#[derive(Clone, Debug)]
pub struct Learned {
    /// Names, by the templates' numbers.
    pub gestures: Vec<String>,
    /// Examples of each.
    pub templates: Vec<Template>,
    /// How distances become probabilities.
    pub scale: Scale,
}

/// Learns templates: every performance is one, or, where there are more than `each` of a gesture,
/// the ones that lie in the middle of the others.
///
/// # Errors
/// When there is nothing to learn, or too much for the unit.
pub fn learn(performances: &[&Performance], each: usize) -> Result<Learned, LearningError> {
    let seen: Vec<&Performance> = performances
        .iter()
        .filter(|p| p.stroke.is_some())
        .copied()
        .collect();
    let names: BTreeSet<&str> = seen.iter().map(|p| p.gesture.as_str()).collect();
    let gestures: Vec<String> = names.into_iter().map(str::to_owned).collect();
    if gestures.is_empty() {
        return Err(LearningError::Nothing);
    }
    if gestures.len() > GESTURES_AT_MOST {
        return Err(LearningError::TooMany(gestures.len()));
    }
    let examples = Examples::new(&seen, &gestures);
    let Fitted { scale, tolerances } = fitted(&examples, each);
    let mut templates = Vec::new();
    for ((gesture, tolerance), number) in tolerances.iter().enumerate().zip(0_u8..) {
        let chosen = examples.middles(&examples.of(gesture), each);
        let strokes = chosen.iter().map(|i| &examples.strokes[*i]);
        templates.extend(strokes.map(|stroke| Template {
            tolerance: *tolerance,
            ..Template::new(number, stroke)
        }));
    }
    Ok(Learned {
        gestures,
        templates,
        scale,
    })
}
