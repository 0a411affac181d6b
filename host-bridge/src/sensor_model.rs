//! What the sensors in use report when an option is meant, for the joint model: a sensor that is
//! known need not be taken for a noisy one.

use deictic_core::category::Category;
use deictic_core::joint::Sensors;
use deictic_core::joint::sensors::{SensorError, quantise};
use deictic_core::large;
use deictic_core::protocol::message::SensorRow;
use deictic_core::sentence::{GESTURE, LANGUAGE};

use crate::language::Listener;
use crate::vocabulary::Lexicon;

/// The tables of some sensors: square, rows of likelihoods in 255ths by the option that is meant.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SensorModel {
    rows: Vec<SensorRow<{ large::OPTIONS }>>,
}

impl SensorModel {
    /// Of the made-up sensors ([`crate::sensor::Sensors`]): the vocabulary's similarity tables.
    #[must_use]
    pub fn made_up(lexicon: &Lexicon) -> Self {
        Self::of(lexicon, |modality, category, meant, options| {
            lexicon.similarity().row(modality, category, meant, options)
        })
    }

    /// Of what is typed or spoken, as the listener understands each name, and of a hand, as the unit
    /// reads it: of a clear gesture nothing is left for other options.
    #[must_use]
    pub fn of_listener(listener: &Listener<'_>, lexicon: &Lexicon) -> Self {
        Self::of(lexicon, |modality, category, meant, options| {
            if modality == LANGUAGE {
                return listener.reported(category, meant);
            }
            let mut row = vec![0.0; options];
            if let Some(own) = row.get_mut(usize::from(meant)) {
                *own = 1.0;
            }
            row
        })
    }

    fn of(lexicon: &Lexicon, reported: impl Fn(u8, Category, u8, usize) -> Vec<f32>) -> Self {
        let mut rows = Vec::new();
        for modality in [GESTURE, LANGUAGE] {
            for category in [Category::ACTION, Category::OBJECT, Category::STORAGE] {
                let options = lexicon.vocabulary().options_of(category);
                for meant in (0_u8..).take(options) {
                    let likelihoods = reported(modality, category, meant, options);
                    rows.push(SensorRow {
                        modality,
                        category,
                        meant,
                        likelihoods: likelihoods.into_iter().map(quantise).collect(),
                    });
                }
            }
        }
        Self { rows }
    }

    /// The rows, in the order in which a unit takes them.
    #[must_use]
    pub fn rows(&self) -> &[SensorRow<{ large::OPTIONS }>] {
        &self.rows
    }

    /// The same for decisions that are made here.
    ///
    /// # Errors
    /// [`SensorError::TooLarge`] when there is no room for all tables.
    pub fn here(&self) -> Result<Box<Sensors<{ large::SENSORS }>>, SensorError> {
        let mut sensors = Box::new(Sensors::new());
        for row in &self.rows {
            sensors.set_row(row.modality, row.category, row.meant, &row.likelihoods)?;
        }
        Ok(sensors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_sound_alike_are_reported_together() {
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        let model = SensorModel::of_listener(&listener, &lexicon);
        let place = |name: &str| {
            let entries = lexicon.entries(Category::OBJECT);
            entries.iter().position(|e| e.name == name).unwrap()
        };
        let (cup, cube, can) = (place("cup"), place("cube"), place("can"));
        let row = |modality| {
            let is = |r: &&SensorRow<_>| {
                (r.modality, r.category, usize::from(r.meant)) == (modality, Category::OBJECT, cup)
            };
            model.rows().iter().find(is).unwrap().likelihoods.clone()
        };
        let heard = row(LANGUAGE);
        assert!(
            heard[cup] > heard[cube] && heard[cube] > heard[can],
            "{heard:?}"
        );
        let shown = row(GESTURE);
        assert_eq!((shown[cup], shown[cube]), (255, 0));
    }

    #[test]
    fn the_largest_vocabulary_of_a_host_has_room() {
        let lexicon = Lexicon::tabletop().unwrap();
        let model = SensorModel::made_up(&lexicon);
        let here = model.here().unwrap();
        for row in model.rows() {
            let n = row.likelihoods.len();
            let table = here.view().rows(row.modality, row.category, n);
            assert_eq!(table.bytes.len(), n * n);
        }
        const { assert!(6 * large::OPTIONS * large::OPTIONS <= large::SENSORS) };
    }
}
