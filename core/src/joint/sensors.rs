//! What a sensor reports when an option is meant.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::reports::Place;
pub use super::reports::{ELSEWHERE, Rows, Sensor, Tables, quantise};
use crate::category::Category;
use crate::sentence::MODALITIES;

/// How many sensors can be known: sixteen categories of four modalities, all that the largest build
/// has.
pub const TABLES: usize = 64;

/// Why a row of a table was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SensorError {
    /// A modality that this build does not have.
    UnknownModality {
        /// How many it has.
        capacity: u8,
    },
    /// More tables, or larger ones, than this build holds.
    TooLarge {
        /// How many bytes of tables it holds.
        capacity: u16,
    },
    /// Not a row of the table that was begun: its length is another, or there is no such option.
    NotSquare {
        /// How many options the table has.
        options: u8,
    },
}

/// Learned confusion tables, as the paper's similarity tables are, by modality and category; `B`
/// bytes of them.
///
/// A table has a row per option that may be meant, and in each a likelihood per option of what is
/// reported. Without one a sensor reports 1 of what is meant and [`ELSEWHERE`] of all else.
/// Likelihoods are kept in 255ths.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensors<const B: usize> {
    places: Vec<Place, TABLES>,
    /// Row after row, table after table.
    bytes: Vec<u8, B>,
}

impl<const B: usize> Default for Sensors<B> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const B: usize> Sensors<B> {
    /// No tables at all.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            places: Vec::new(),
            bytes: Vec::new(),
        }
    }

    /// Forgets all tables.
    pub fn clear(&mut self) {
        self.places.clear();
        self.bytes.clear();
    }

    /// Sets what a modality reports, in 255ths, when option `meant` of a category is. The first row
    /// of a table makes the others as those of a sensor that is not known.
    ///
    /// # Errors
    /// [`SensorError`]; nothing has changed then.
    pub fn set_row(
        &mut self,
        modality: u8,
        category: Category,
        meant: u8,
        row: &[u8],
    ) -> Result<(), SensorError> {
        check(modality)?;
        self.drop_empty(modality, category);
        let known = self.view().place(modality, category);
        let options = known.map_or(row.len(), |(place, _)| usize::from(place.options));
        if options != row.len() || usize::from(meant) >= options {
            return Err(SensorError::NotSquare {
                options: u8::try_from(options).unwrap_or(u8::MAX),
            });
        }
        let start = match known {
            Some((_, start)) => start,
            None => self.begin(modality, category, options)?,
        };
        let start = start.saturating_add(options.saturating_mul(usize::from(meant)));
        let table = self.bytes.iter_mut().skip(start);
        for (byte, value) in table.zip(row) {
            *byte = *value;
        }
        let elsewhere = self.view().rows(modality, category, options).flat();
        if let Some(place) = self.find(modality, category) {
            place.elsewhere = elsewhere;
            place.likelihoods = false;
        }
        Ok(())
    }

    /// Takes the figures that a modality reports of a category for what they are: how likely what was
    /// seen is under each option. A calibrated classifier does so, or a listener that knows what its
    /// words sound like; no noise is looked for in them.
    ///
    /// # Errors
    /// [`SensorError`]; nothing has changed then.
    pub fn set_likelihoods(&mut self, modality: u8, category: Category) -> Result<(), SensorError> {
        check(modality)?;
        if let Some(place) = self.find(modality, category) {
            place.likelihoods = true;
            return Ok(());
        }
        let place = Place {
            likelihoods: true,
            ..Place::new(modality, category, 0)
        };
        self.places.push(place).map_err(|_| Self::TOO_LARGE)
    }

    fn find(&mut self, modality: u8, category: Category) -> Option<&mut Place> {
        let key = Place::new(modality, category, 0).key;
        self.places.iter_mut().find(|place| place.key == key)
    }

    /// Makes room for a table where there was none.
    fn drop_empty(&mut self, modality: u8, category: Category) {
        let key = Place::new(modality, category, 0).key;
        self.places
            .retain(|place| place.options > 0 || place.key != key);
    }

    const TOO_LARGE: SensorError = SensorError::TooLarge {
        capacity: if B > u16::MAX as usize {
            u16::MAX
        } else {
            B as u16
        },
    };

    fn begin(
        &mut self,
        modality: u8,
        category: Category,
        options: usize,
    ) -> Result<usize, SensorError> {
        let too_large = Self::TOO_LARGE;
        let start = self.bytes.len();
        let more = options.saturating_mul(options);
        let counted = u8::try_from(options).map_err(|_| too_large)?;
        self.bytes
            .resize(start.saturating_add(more), quantise(ELSEWHERE))
            .map_err(|_| too_large)?;
        let place = Place::new(modality, category, counted);
        if self.places.push(place).is_err() {
            self.bytes.truncate(start);
            return Err(too_large);
        }
        let table = self.bytes.iter_mut().skip(start);
        for own in table.step_by(options.saturating_add(1)) {
            *own = u8::MAX;
        }
        Ok(start)
    }

    /// The tables, without their capacity.
    #[must_use]
    pub fn view(&self) -> Tables<'_> {
        Tables::new(&self.places, &self.bytes)
    }
}

fn check(modality: u8) -> Result<(), SensorError> {
    if usize::from(modality) < MODALITIES {
        return Ok(());
    }
    Err(SensorError::UnknownModality {
        capacity: MODALITIES as u8,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_kept_by_row() {
        let mut sensors = Sensors::<32>::new();
        sensors.set_row(0, Category::OBJECT, 1, &[1, 2, 3]).unwrap();
        let rest = quantise(ELSEWHERE);
        assert_eq!(
            sensors.view().rows(0, Category::OBJECT, 3).bytes,
            [255, rest, rest, 1, 2, 3, rest, rest, 255]
        );
        let unknown = |modality, options| sensors.view().rows(modality, Category::OBJECT, options);
        for rows in [unknown(0, 4), unknown(1, 3)] {
            assert_eq!((rows.bytes, rows.elsewhere), (&[][..], Some(rest)));
        }
        assert_eq!(unknown(0, 3).elsewhere, None);
        sensors.set_row(1, Category::ACTION, 0, &[9]).unwrap();
        assert_eq!(sensors.view().rows(1, Category::ACTION, 1).bytes, [9]);
    }

    #[test]
    fn a_flat_table_is_known_as_such() {
        let mut sensors = Sensors::<32>::new();
        let c = Category::OBJECT;
        for (meant, row) in [(0, [255, 7, 7]), (1, [7, 250, 7]), (2, [7, 7, 255])] {
            assert_ne!(sensors.view().rows(0, c, 3).elsewhere, Some(7));
            sensors.set_row(0, c, meant, &row).unwrap();
        }
        assert_eq!(sensors.view().rows(0, c, 3).elsewhere, Some(7));
        sensors.set_row(0, c, 1, &[8, 255, 7]).unwrap();
        assert_eq!(sensors.view().rows(0, c, 3).elsewhere, None);
    }

    #[test]
    fn a_sensor_reports_scores_or_likelihoods() {
        let mut sensors = Sensors::<16>::new();
        let c = Category::OBJECT;
        sensors.set_likelihoods(1, c).unwrap();
        assert_eq!(sensors.view().sensor(1, c, 2), Sensor::Likelihoods);
        for _ in 0..2 {
            sensors.set_row(1, c, 0, &[255, 7]).unwrap();
            let Sensor::Scores(rows) = sensors.view().sensor(1, c, 2) else {
                panic!("a table was set")
            };
            assert_eq!(rows.of(0), [255, 7]);
            sensors.set_likelihoods(1, c).unwrap();
            assert_eq!(sensors.view().sensor(1, c, 2), Sensor::Likelihoods);
        }
        assert!(sensors.set_likelihoods(4, c).is_err());
        assert!(matches!(sensors.view().sensor(0, c, 2), Sensor::Scores(_)));
    }

    #[test]
    fn every_category_of_every_modality_can_be_known() {
        let mut sensors = Sensors::<256>::new();
        for modality in 0..MODALITIES as u8 {
            for q in 0..TABLES / MODALITIES {
                let category = Category::from_index(q).unwrap();
                let row = [modality, q as u8];
                sensors.set_row(modality, category, 1, &row).unwrap();
            }
        }
        for modality in 0..MODALITIES as u8 {
            for q in 0..TABLES / MODALITIES {
                let category = Category::from_index(q).unwrap();
                let rows = sensors.view().rows(modality, category, 2);
                assert_eq!(rows.of(1), [modality, q as u8]);
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let mut sensors = Sensors::<8>::new();
        let c = Category::ACTION;
        assert_eq!(
            sensors.set_row(4, c, 0, &[1]),
            Err(SensorError::UnknownModality { capacity: 4 })
        );
        assert_eq!(
            sensors.set_row(0, c, 0, &[1; 3]),
            Err(SensorError::TooLarge { capacity: 8 })
        );
        sensors.set_row(0, c, 0, &[1; 2]).unwrap();
        for (meant, row) in [(2, &[1, 1][..]), (0, &[1, 1, 1])] {
            assert_eq!(
                sensors.set_row(0, c, meant, row),
                Err(SensorError::NotSquare { options: 2 })
            );
        }
    }
}
