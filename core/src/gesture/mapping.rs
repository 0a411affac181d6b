//! Which action a gesture stands for: the vocabulary's table, many gestures to one action.

use serde::{Deserialize, Serialize};

use super::shape::{SHAPES, Shape};

/// Dynamic gestures that a unit tells apart at most.
pub const STROKES: usize = 24;

/// Shapes that can stand for an action: all but *none of these*.
const SHOWN: usize = SHAPES - 1;

/// No action.
const NOTHING: u8 = u8::MAX;

/// A gesture that can stand for an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Gesture {
    /// A static gesture, by the number of its [`Shape`].
    Shape(u8),
    /// A dynamic gesture, by the number that its templates carry.
    Stroke(u8),
}

/// Why a gesture cannot stand for an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MappingError {
    /// There is no such gesture.
    UnknownGesture(Gesture),
    /// A pointing hand opens a target word, a closed hand separates words; neither can be an action.
    Reserved(Gesture),
    /// The vocabulary has no such action.
    UnknownAction(u8),
}

/// The table from gestures to actions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mapping {
    shapes: [u8; SHOWN],
    strokes: [u8; STROKES],
}

impl Default for Mapping {
    fn default() -> Self {
        Self::new()
    }
}

impl Mapping {
    /// No gesture stands for anything.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            shapes: [NOTHING; SHOWN],
            strokes: [NOTHING; STROKES],
        }
    }

    /// No gesture stands for anything any more, in place.
    pub fn clear(&mut self) {
        *self = Self::new();
    }

    /// From now on this gesture stands for this action, one of a vocabulary's `actions`.
    ///
    /// # Errors
    /// [`MappingError`]; nothing has changed then.
    pub fn set(
        &mut self,
        gesture: Gesture,
        action: u8,
        actions: usize,
    ) -> Result<(), MappingError> {
        if usize::from(action) >= actions {
            return Err(MappingError::UnknownAction(action));
        }
        let place = match gesture {
            Gesture::Shape(shape) if shape == Shape::Grab as u8 || shape == Shape::Point as u8 => {
                return Err(MappingError::Reserved(gesture));
            }
            Gesture::Shape(shape) => self.shapes.get_mut(usize::from(shape)),
            Gesture::Stroke(stroke) => self.strokes.get_mut(usize::from(stroke)),
        };
        *place.ok_or(MappingError::UnknownGesture(gesture))? = action;
        Ok(())
    }

    /// What a gesture stands for.
    #[must_use]
    pub fn action(&self, gesture: Gesture) -> Option<u8> {
        let action = match gesture {
            Gesture::Shape(shape) => self.shapes.get(usize::from(shape)),
            Gesture::Stroke(stroke) => self.strokes.get(usize::from(stroke)),
        };
        action.copied().filter(|a| *a != NOTHING)
    }

    /// Adds up the probabilities of shapes, or of strokes, by the actions they stand for.
    pub(super) fn share(&self, shapes: &[f32], strokes: &[f32], actions: &mut [f32]) {
        let shapes = self.shapes.iter().zip(shapes);
        for (action, p) in shapes.chain(self.strokes.iter().zip(strokes)) {
            if let Some(place) = actions.get_mut(usize::from(*action)) {
                *place += p;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_gestures_stand_for_one_action() {
        let mut mapping = Mapping::new();
        mapping
            .set(Gesture::Shape(Shape::Five as u8), 1, 3)
            .unwrap();
        mapping.set(Gesture::Stroke(2), 1, 3).unwrap();
        mapping.set(Gesture::Stroke(0), 2, 3).unwrap();
        assert_eq!(mapping.action(Gesture::Stroke(2)), Some(1));
        assert_eq!(mapping.action(Gesture::Stroke(1)), None);
        let mut actions = [0.0; 3];
        mapping.share(
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.25],
            &[0.5, 0.0, 0.25],
            &mut actions,
        );
        assert_eq!(actions, [0.0, 0.5, 0.5]);
    }

    #[test]
    fn what_cannot_stand_for_an_action_is_refused() {
        let mut mapping = Mapping::new();
        for (gesture, action, error) in [
            (
                Gesture::Shape(0),
                0,
                MappingError::Reserved(Gesture::Shape(0)),
            ),
            (
                Gesture::Shape(2),
                0,
                MappingError::Reserved(Gesture::Shape(2)),
            ),
            (
                Gesture::Shape(8),
                0,
                MappingError::UnknownGesture(Gesture::Shape(8)),
            ),
            (
                Gesture::Stroke(24),
                0,
                MappingError::UnknownGesture(Gesture::Stroke(24)),
            ),
            (Gesture::Stroke(0), 3, MappingError::UnknownAction(3)),
        ] {
            assert_eq!(mapping.set(gesture, action, 3), Err(error));
        }
        assert_eq!(mapping, Mapping::new());
    }
}
