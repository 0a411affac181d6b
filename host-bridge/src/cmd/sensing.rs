//! Options of commands that read a hand.

use std::path::PathBuf;

use clap::Args;
use deictic_core::gesture::wire::Sample;
use miette::Result;

use super::advice;
use crate::hand::aim;
use crate::hand::meaning::HandSetup;
use crate::hand::source::{Address, Seen, Source, SourceError};
use crate::hand::taught::Taught;
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

/// Which hand sensor, and which gestures besides those that a unit knows.
#[derive(Args, Clone, Debug, Default)]
pub struct Sensing {
    /// A hand sensor at this machine: leap, mediapipe:FILE (JSON lines), file:RECORDING, or a made-up
    /// person, "made-up:1:thumbsup cup drawer"; one on the unit's own sensor line needs no option
    #[arg(long, value_name = "SENSOR")]
    pub hand: Option<Address>,
    /// Gestures that `deictic gestures learn` has written
    #[arg(long, value_name = "FILE")]
    pub gestures: Option<PathBuf>,
    /// How the person aims, as `deictic gestures aim` has found it; in place of the scene's `[sensor]`
    #[arg(long, value_name = "FILE")]
    pub aim: Option<PathBuf>,
}

impl Sensing {
    /// What a unit is told of hands.
    pub fn setup(&self, table: &Tabletop, lexicon: &Lexicon) -> Result<HandSetup> {
        let taught = match &self.gestures {
            Some(path) => Taught::read(path).map_err(|e| advice(&e, e.remedy()))?,
            None => Taught::default(),
        };
        let settings = match &self.aim {
            Some(path) => aim::read(path).map_err(|e| advice(&e, e.remedy()))?,
            None => table.hand(),
        };
        Ok(HandSetup::new(lexicon, settings, taught))
    }

    /// Opens the sensor, if there is one.
    pub fn open(&self, table: &Tabletop, lexicon: &Lexicon) -> Result<Option<Source>> {
        let source = self.hand.as_ref().map(|a| Source::open(a, table, lexicon));
        Ok(source.transpose()?)
    }
}

/// Takes what a source has, up to a batch, and says of anything odd what it is. `false` when there
/// will be no more.
pub fn drain(
    source: &Source,
    mut take: impl FnMut(Sample),
    mut odd: impl FnMut(SourceError),
) -> bool {
    // A flood must not keep the caller from everything else.
    for _ in 0..64 {
        match source.next() {
            Seen::Sample(sample) => take(*sample),
            Seen::Bad(error) => odd(error),
            Seen::Nothing => return true,
            Seen::End => return false,
        }
    }
    true
}
