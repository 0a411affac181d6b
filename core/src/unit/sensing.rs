//! Taking over the sensors' tables, row by row.

use super::loading::in_order;
use crate::category::Category;
use crate::joint::sensors::SensorError;
use crate::joint::{Sensors, Tables};
use crate::protocol::message::{Fault, Loaded, SensorPart, SensorRow};
use crate::vocabulary::Vocabulary;

/// The tables in force, `S` bytes of them, and the one that is arriving.
#[derive(Debug)]
pub struct Sensing<const S: usize> {
    sensors: Sensors<S>,
    /// Of which modality and category a table is arriving, and its next row.
    arriving: Option<(u8, Category, u8)>,
}

impl<const S: usize> Default for Sensing<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const S: usize> Sensing<S> {
    /// No tables.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            sensors: Sensors::new(),
            arriving: None,
        }
    }

    /// Forgets all tables, in place.
    pub fn clear(&mut self) {
        self.sensors.clear();
        self.arriving = None;
    }

    /// The tables to decide by: none while one is arriving.
    #[must_use]
    pub fn tables(&self) -> Tables<'_> {
        match self.arriving {
            None => self.sensors.view(),
            Some(_) => Tables::NONE,
        }
    }

    /// Takes what a sensor reports, or a row of it; the last one completes a table.
    ///
    /// # Errors
    /// A [`Fault`]: the row is out of order, is not one over the vocabulary's options, or there is no
    /// room for its table. The tables that are complete stay in force.
    pub fn take<const N: usize, const C: usize, const F: usize>(
        &mut self,
        part: &SensorPart<N>,
        vocabulary: &Vocabulary<N, C, F>,
    ) -> Result<Option<Loaded>, Fault> {
        match part {
            SensorPart::Row(row) => self.take_row(row, vocabulary.options_of(row.category)),
            &SensorPart::Likelihoods { modality, category } => {
                let set = self.sensors.set_likelihoods(modality, category);
                set.map_err(Fault::Sensor)?;
                self.arriving = None;
                Ok(Some(Loaded::Sensor { modality, category }))
            }
        }
    }

    fn take_row<const N: usize>(
        &mut self,
        row: &SensorRow<N>,
        options: usize,
    ) -> Result<Option<Loaded>, Fault> {
        let &SensorRow {
            modality,
            category,
            meant,
            ref likelihoods,
        } = row;
        let next = match self.arriving {
            Some((m, c, next)) if (m, c) == (modality, category) && meant > 0 => next,
            _ => 0,
        };
        in_order(usize::from(next), meant)?;
        if likelihoods.len() != options {
            return Err(Fault::Sensor(SensorError::NotSquare {
                options: u8::try_from(options).unwrap_or(u8::MAX),
            }));
        }
        self.sensors
            .set_row(modality, category, meant, likelihoods)
            .map_err(Fault::Sensor)?;
        let next = next.saturating_add(1);
        if usize::from(next) < options {
            self.arriving = Some((modality, category, next));
            return Ok(None);
        }
        self.arriving = None;
        Ok(Some(Loaded::Sensor { modality, category }))
    }
}
