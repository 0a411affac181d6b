//! What the sensors in use report when an option is meant, for the joint model: a sensor that is
//! known need not be taken for a noisy one.

use deictic_core::category::Category;
use deictic_core::joint::Sensors;
use deictic_core::joint::sensors::{SensorError, quantise};
use deictic_core::large;
use deictic_core::protocol::message::{SensorPart, SensorRow};
use deictic_core::sentence::ANSWER;
use deictic_core::sentence::{GESTURE, LANGUAGE};

use crate::vocabulary::Lexicon;

/// What some sensors report, as a unit is told.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SensorModel {
    parts: Vec<SensorPart<{ large::OPTIONS }>>,
}

impl SensorModel {
    /// Of the made-up sensors ([`crate::sensor::Sensors`]): the vocabulary's similarity tables.
    /// Answers are not made up.
    #[must_use]
    pub fn made_up(lexicon: &Lexicon) -> Self {
        let mut parts = likelihoods(ANSWER, &WHOLE);
        for modality in [GESTURE, LANGUAGE] {
            for category in WHOLE {
                let options = lexicon.vocabulary().options_of(category);
                for meant in (0_u8..).take(options) {
                    let row = lexicon.similarity().row(modality, category, meant, options);
                    parts.push(SensorPart::Row(SensorRow {
                        modality,
                        category,
                        meant,
                        likelihoods: row.into_iter().map(quantise).collect(),
                    }));
                }
            }
        }
        Self { parts }
    }

    /// Of a keyboard, a recogniser and a hand: the listener knows what sounds like what, and the hand
    /// reader's classifiers are calibrated, so that both report how likely what they took in is under
    /// each option.
    #[must_use]
    pub fn calibrated(lexicon: &Lexicon) -> Self {
        let categories = (0..lexicon.vocabulary().options().len()).filter_map(Category::from_index);
        let categories: Vec<_> = categories.collect();
        let mut parts = likelihoods(LANGUAGE, &categories);
        for modality in [GESTURE, ANSWER] {
            parts.extend(likelihoods(modality, &WHOLE));
        }
        Self { parts }
    }

    /// The parts, in the order in which a unit takes them.
    #[must_use]
    pub fn parts(&self) -> &[SensorPart<{ large::OPTIONS }>] {
        &self.parts
    }

    /// The same for decisions that are made here.
    ///
    /// # Errors
    /// [`SensorError::TooLarge`] when there is no room for all tables.
    pub fn here(&self) -> Result<Box<Sensors<{ large::SENSORS }>>, SensorError> {
        let mut sensors = Box::new(Sensors::new());
        for part in &self.parts {
            match part {
                SensorPart::Row(row) => {
                    sensors.set_row(row.modality, row.category, row.meant, &row.likelihoods)?;
                }
                SensorPart::Likelihoods { modality, category } => {
                    sensors.set_likelihoods(*modality, *category)?;
                }
            }
        }
        Ok(sensors)
    }
}

/// The categories that every intent is made of.
const WHOLE: [Category; 3] = [Category::ACTION, Category::OBJECT, Category::STORAGE];

fn likelihoods(modality: u8, categories: &[Category]) -> Vec<SensorPart<{ large::OPTIONS }>> {
    let part = |&category| SensorPart::Likelihoods { modality, category };
    categories.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use deictic_core::joint::Sensor;

    use super::*;

    #[test]
    fn made_up_sensors_report_what_the_vocabulary_says() {
        let lexicon = Lexicon::tabletop().unwrap();
        let here = SensorModel::made_up(&lexicon).here().unwrap();
        for modality in [GESTURE, LANGUAGE] {
            for category in WHOLE {
                let n = lexicon.vocabulary().options_of(category);
                let Sensor::Scores(rows) = here.view().sensor(modality, category, n) else {
                    panic!("no table")
                };
                let first = lexicon.similarity().row(modality, category, 0, n);
                let first: Vec<_> = first.into_iter().map(quantise).collect();
                assert_eq!((rows.bytes.len(), &rows.bytes[..n]), (n * n, &first[..]));
            }
        }
        const { assert!(6 * large::OPTIONS * large::OPTIONS <= large::SENSORS) };
    }

    #[test]
    fn what_is_calibrated_is_no_score() {
        let lexicon = Lexicon::tabletop().unwrap();
        let here = SensorModel::calibrated(&lexicon).here().unwrap();
        for modality in [GESTURE, LANGUAGE, ANSWER] {
            let sensor = here.view().sensor(modality, Category::OBJECT, 5);
            assert_eq!(sensor, Sensor::Likelihoods);
        }
    }
}
