//! What a unit is told of hands: which gestures stand for which actions, where the sensor stands, how
//! well the person aims, and which gestures it is taught.

use deictic_core::category::Category;
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::protocol::hand::{HandSettings, Meaning, Meanings};
use thiserror::Error;

use super::taught::Taught;
use crate::vocabulary::Lexicon;

/// Why gestures cannot stand for actions as a vocabulary says.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MeaningError {
    /// One gesture stands for two actions.
    #[error("the gesture \"{gesture}\" stands for {first} and for {second}")]
    Twice {
        /// The gesture's name.
        gesture: String,
        /// One action.
        first: String,
        /// The other.
        second: String,
    },
    /// A gesture that separates words, or opens a target word.
    #[error("the gesture \"{0}\" cannot stand for an action: it separates words, or points")]
    Reserved(String),
}

impl MeaningError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        "give each action gestures of its own, in `gestures` of the vocabulary file"
    }
}

/// All that a unit is told of hands.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HandSetup {
    /// Which gestures stand for which actions.
    pub meanings: Meanings,
    /// Where the sensor stands and how well the person aims.
    pub settings: HandSettings,
    /// Gestures it is taught.
    pub taught: Taught,
}

impl HandSetup {
    /// What a vocabulary's gestures come to. Gestures that neither the unit knows nor it is taught
    /// are left out: they can be typed, but not shown.
    ///
    /// # Errors
    /// [`MeaningError`]
    pub fn new(
        lexicon: &Lexicon,
        settings: HandSettings,
        taught: Taught,
    ) -> Result<Self, MeaningError> {
        let mut meanings = Meanings::new();
        let mut meant: Vec<(Gesture, &str)> = Vec::new();
        for (entry, action) in lexicon.entries(Category::ACTION).iter().zip(0_u8..) {
            for name in &entry.gestures {
                let Some(gesture) = gesture(name, &taught) else {
                    continue;
                };
                if [Shape::Grab, Shape::Point]
                    .map(|s| Gesture::Shape(s as u8))
                    .contains(&gesture)
                {
                    return Err(MeaningError::Reserved(name.clone()));
                }
                if let Some((_, first)) = meant.iter().find(|(g, _)| *g == gesture) {
                    return Err(MeaningError::Twice {
                        gesture: name.clone(),
                        first: (*first).to_owned(),
                        second: entry.name.clone(),
                    });
                }
                meant.push((gesture, &entry.name));
                // There is room for every gesture, and none is in it twice.
                let _ = meanings.push(Meaning { gesture, action });
            }
        }
        Ok(Self {
            meanings,
            settings,
            taught,
        })
    }

    /// The names of dynamic gestures, by the numbers that templates carry.
    #[must_use]
    pub fn strokes(&self) -> Vec<&str> {
        strokes(&self.taught)
    }
}

/// The gesture of this name, if a unit that is taught these tells it apart.
fn gesture(name: &str, taught: &Taught) -> Option<Gesture> {
    if let Some(shape) = Shape::ALL
        .iter()
        .find(|s| s.name() == name && **s != Shape::None)
    {
        return Some(Gesture::Shape(*shape as u8));
    }
    let at = strokes(taught).iter().position(|n| *n == name)?;
    u8::try_from(at).ok().map(Gesture::Stroke)
}

fn strokes(taught: &Taught) -> Vec<&str> {
    let known: &[&str] = if taught.known { &NAMES } else { &[] };
    let taught = taught.gestures.iter().map(String::as_str);
    known.iter().copied().chain(taught).collect()
}

/// How many gestures a unit knows without being taught.
#[must_use]
pub fn known() -> usize {
    Templates::KNOWN
        .known
        .iter()
        .map(|t| usize::from(t.gesture) + 1)
        .max()
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setup(text: &str) -> Result<HandSetup, MeaningError> {
        let lexicon = Lexicon::parse("x", text).unwrap();
        HandSetup::new(&lexicon, HandSettings::DEFAULT, Taught::default())
    }

    const HEAD: &str = "name = \"x\"\nlanguage = \"en\"\nfeatures = []\n";

    #[test]
    fn many_gestures_stand_for_one_action_and_unknown_ones_for_none() {
        let text = HEAD.to_owned()
            + "[[action]]\nname = \"a\"\ngestures = [\"pinch\", \"swipe-up\", \"nod\"]\n";
        let meanings = setup(&text).unwrap().meanings;
        let up = NAMES.iter().position(|n| *n == "swipe-up").unwrap() as u8;
        let expected = [Gesture::Shape(Shape::Pinch as u8), Gesture::Stroke(up)];
        let got: Vec<_> = meanings.iter().map(|m| m.gesture).collect();
        assert_eq!(got, expected);
        assert_eq!(known(), NAMES.len());
    }

    #[test]
    fn what_cannot_stand_for_an_action_is_refused() {
        let text = HEAD.to_owned() + "[[action]]\nname = \"a\"\ngestures = [\"grab\"]\n";
        assert_eq!(setup(&text), Err(MeaningError::Reserved("grab".into())));
        let text = HEAD.to_owned()
            + "[[action]]\nname = \"a\"\ngestures = [\"wave\"]\n[[action]]\nname = \"b\"\ngestures = [\"wave\"]\n";
        assert!(matches!(setup(&text), Err(MeaningError::Twice { .. })));
    }

    #[test]
    fn the_shipped_vocabulary_can_be_shown() {
        let lexicon = Lexicon::tabletop().unwrap();
        let setup = HandSetup::new(&lexicon, HandSettings::DEFAULT, Taught::default()).unwrap();
        let shown = |action: u8| setup.meanings.iter().any(|m| m.action == action);
        assert!((0..9).all(shown), "{:?}", setup.meanings);
    }
}
