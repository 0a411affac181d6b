//! What a unit is told of hands: which gestures stand for which actions, where the sensor stands, how
//! well the person aims, and which gestures it is taught.

use deictic_core::category::Category;
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::protocol::hand::{HandSettings, Meaning, Meanings};

use super::taught::Taught;
use crate::vocabulary::Lexicon;

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
    #[must_use]
    pub fn new(lexicon: &Lexicon, settings: HandSettings, taught: Taught) -> Self {
        let mut meanings = Meanings::new();
        for (entry, action) in lexicon.entries(Category::ACTION).iter().zip(0_u8..) {
            for name in &entry.gestures {
                let Some(gesture) = gesture(name, &taught) else {
                    continue;
                };
                // There is room for every gesture, and none is in it twice.
                let _ = meanings.push(Meaning { gesture, action });
            }
        }
        Self {
            meanings,
            settings,
            taught,
        }
    }

    /// The gestures of actions that nobody can show it, as it neither knows them nor is taught them.
    #[must_use]
    pub fn unknown<'a>(&self, lexicon: &'a Lexicon) -> Vec<&'a str> {
        let entries = lexicon.entries(Category::ACTION).iter();
        let names = entries.flat_map(|entry| entry.gestures.iter().map(String::as_str));
        names
            .filter(|name| gesture(name, &self.taught).is_none())
            .collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_gestures_stand_for_one_action_and_unknown_ones_for_none() {
        let text = "name = \"x\"\n[[action]]\nname = \"a\"\ngestures = [\"pinch\", \"swipe-up\", \"nod\"]\n";
        let lexicon = Lexicon::parse("x", text).unwrap();
        let setup = HandSetup::new(&lexicon, HandSettings::DEFAULT, Taught::default());
        let up = NAMES.iter().position(|n| *n == "swipe-up").unwrap() as u8;
        let expected = [Gesture::Shape(Shape::Pinch as u8), Gesture::Stroke(up)];
        let got: Vec<_> = setup.meanings.iter().map(|m| m.gesture).collect();
        assert_eq!(got, expected);
        assert_eq!(setup.unknown(&lexicon), ["nod"]);
    }

    #[test]
    fn the_shipped_vocabulary_can_be_shown() {
        let lexicon = Lexicon::tabletop().unwrap();
        let setup = HandSetup::new(&lexicon, HandSettings::DEFAULT, Taught::default());
        let shown = |action: u8| setup.meanings.iter().any(|m| m.action == action);
        assert!((0..9).all(shown), "{:?}", setup.meanings);
    }
}
