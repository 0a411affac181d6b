//! Whether a decision may be acted upon: the robot moves only on a fresh, complete, in-sequence
//! execution from a unit that knows the present vocabulary and scene.

use deictic_core::protocol::message::Decided;

/// Why a decision must not be acted upon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distrust {
    /// Frames before it were lost, so that nobody knows what it follows.
    AfterGap {
        /// How many.
        missed: u16,
    },
    /// It was made on another scene than the present one.
    StaleScene {
        /// The scene it was made on.
        decided_on: u32,
        /// The present one.
        present: u32,
    },
    /// It speaks another vocabulary.
    OtherVocabulary,
    /// It is not newer than one before.
    OldNumber {
        /// Its number.
        number: u32,
        /// The newest so far.
        newest: u32,
    },
}

/// What decisions are held against.
pub struct Trust {
    vocabulary: u32,
    scene: u32,
    newest: u32,
}

impl Trust {
    /// A conversation that has just been opened.
    pub fn new(vocabulary: u32, scene: u32) -> Self {
        Self {
            vocabulary,
            scene,
            newest: 0,
        }
    }

    /// The scene has changed.
    pub fn set_scene(&mut self, version: u32) {
        self.scene = version;
    }

    /// Whether `decided`, before which `missed` frames were lost, may be acted upon.
    pub fn judge(&mut self, decided: &Decided<16>, missed: u16) -> Result<(), Distrust> {
        let newest = self.newest;
        self.newest = newest.max(decided.number);
        if decided.number <= newest {
            return Err(Distrust::OldNumber {
                number: decided.number,
                newest,
            });
        }
        if missed > 0 {
            return Err(Distrust::AfterGap { missed });
        }
        if decided.vocabulary != self.vocabulary {
            return Err(Distrust::OtherVocabulary);
        }
        if decided.scene != self.scene {
            return Err(Distrust::StaleScene {
                decided_on: decided.scene,
                present: self.scene,
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use deictic_core::decide::{Decision, Outcome};

    fn decided(number: u32, vocabulary: u32, scene: u32) -> Decided<16> {
        let decision = Decision {
            outcome: Outcome::Repeat,
            best: None,
        };
        Decided {
            number,
            vocabulary,
            scene,
            modalities: 1,
            questions_left: 0,
            decision,
        }
    }

    #[test]
    fn only_what_is_fresh_and_complete_is_trusted() {
        let mut trust = Trust::new(7, 1);
        assert_eq!(trust.judge(&decided(1, 7, 1), 0), Ok(()));
        let old = Distrust::OldNumber {
            number: 1,
            newest: 1,
        };
        assert_eq!(trust.judge(&decided(1, 7, 1), 0), Err(old));
        assert_eq!(
            trust.judge(&decided(2, 7, 1), 3),
            Err(Distrust::AfterGap { missed: 3 })
        );
        assert_eq!(
            trust.judge(&decided(3, 8, 1), 0),
            Err(Distrust::OtherVocabulary)
        );
        trust.set_scene(2);
        let stale = Distrust::StaleScene {
            decided_on: 1,
            present: 2,
        };
        assert_eq!(trust.judge(&decided(4, 7, 1), 0), Err(stale));
        assert_eq!(trust.judge(&decided(5, 7, 2), 0), Ok(()));
    }
}
