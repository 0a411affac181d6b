//! A catalogue's similarity tables as the joint model's sensors.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Sensors;
use deictic_core::joint::sensors::quantise;
use deictic_core::profile::{Profile, ProfileError};
use deictic_core::sentence::{ANSWER, LANGUAGE};

use crate::catalogue::Catalogue;
use crate::gaze::{self, GAZE};
use crate::order::Order;
use crate::record::{CATEGORIES, MODALITIES};
use crate::situation::Prepared;

/// Room for eleven tables of 16 options.
const BYTES: usize = 11 * 256;

/// The tables of a catalogue with options in some order.
#[derive(Clone, Debug)]
pub struct Sensing(Sensors<BYTES>);

impl Sensing {
    /// Of a catalogue in the core's order.
    ///
    /// # Errors
    /// When the tables are larger than there is room for.
    pub fn new(catalogue: &Catalogue, order: &Order) -> anyhow::Result<Self> {
        let mut sensors = Sensors::new();
        for m in 0..MODALITIES {
            for c in 0..CATEGORIES {
                let Some(category) = Category::from_index(c) else {
                    continue;
                };
                let places = order.places(c);
                for (meant, &k) in (0_u8..).zip(places) {
                    let row = &catalogue.similarity[m][c][usize::from(k)];
                    let row: Vec<u8> = places
                        .iter()
                        .map(|&j| quantise(row[usize::from(j)]))
                        .collect();
                    let mut set = |modality| {
                        sensors
                            .set_row(modality, category, meant, &row)
                            .map_err(|e| anyhow::anyhow!("the core refuses a table: {e:?}"))
                    };
                    set(m as u8)?;
                    if m as u8 == LANGUAGE {
                        // Questions are answered by voice.
                        set(ANSWER)?;
                    }
                    if m == gaze::TABLES && category != Category::ACTION {
                        set(GAZE)?;
                    }
                }
            }
        }
        Ok(Self(sensors))
    }

    /// No tables: every sensor is taken for a plain one.
    #[must_use]
    pub const fn unknown() -> Self {
        Self(Sensors::new())
    }

    /// Decides a sample, by the joint model with these tables.
    ///
    /// # Errors
    /// The core's, for settings that cannot be.
    pub fn decide(
        &self,
        sample: &Prepared,
        vocabulary: &board::Vocabulary,
        profile: &Profile,
        trace: &mut board::Trace,
    ) -> Result<board::Decision, ProfileError> {
        let situation = Situation {
            sensors: self.0.view(),
            ..sample.with(vocabulary)
        };
        fuse(situation, profile, trace)
    }
}
