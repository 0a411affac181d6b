//! What a unit keeps of a hand: what reads it, what it goes by, and what it said.

use super::taught::Taught;
use crate::gesture::line::SensorLine;
use crate::gesture::mapping::Mapping;
use crate::gesture::reader::HandReader;
use crate::gesture::wire::WireError;
use crate::protocol::hand::{HandSettings, SampleBytes, TemplatesPart};
use crate::protocol::message::{Fault, Loaded};
use crate::sentence::Sentence;
use crate::time::Micros;

/// What a hand has said that nobody has looked at yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spoken {
    /// A sentence.
    Sentence,
    /// The stop gesture.
    Stop,
}

/// The hand reader with all it goes by.
#[derive(Debug)]
pub struct Hand<const N: usize, const C: usize, const W: usize> {
    pub(super) line: SensorLine,
    pub(super) reader: HandReader<N, C, W>,
    pub(super) mapping: Mapping,
    pub(super) settings: HandSettings,
    pub(super) taught: Taught,
    /// Whether the host is told of samples that come from the unit's own sensor.
    pub(super) relays: bool,
    /// A sample that was not read yet; empty when there is none.
    pub(super) pending: SampleBytes,
    pub(super) spoken: Option<Spoken>,
    /// Whether the host was told that the hand is in the middle of a sentence.
    pub(super) told: bool,
}

impl<const N: usize, const C: usize, const W: usize> Default for Hand<N, C, W> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const C: usize, const W: usize> Hand<N, C, W> {
    /// No hand, and no gesture that stands for anything.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            line: SensorLine::new(),
            reader: HandReader::new(),
            mapping: Mapping::new(),
            settings: HandSettings::DEFAULT,
            taught: Taught::new(),
            relays: false,
            pending: SampleBytes::new(),
            spoken: None,
            told: false,
        }
    }

    /// As new, in place.
    #[inline(never)]
    pub fn restart(&mut self) {
        self.line = SensorLine::new();
        self.reader.restart();
        self.clear();
    }

    /// As new, in place; what was counted stays.
    pub fn clear(&mut self) {
        self.forget();
        self.mapping.clear();
        self.settings = HandSettings::DEFAULT;
        self.taught.clear();
        self.relays = false;
    }

    /// Forgets the hand and what it was saying.
    pub fn forget(&mut self) {
        self.reader.forget();
        self.pending.clear();
        self.spoken = None;
        self.told = false;
    }

    /// The actions that gestures stood for are no more.
    pub fn unlearn_meanings(&mut self) {
        self.forget();
        self.mapping.clear();
    }

    /// What the hand said last.
    #[must_use]
    pub fn said(&self) -> &Sentence<W, C, N> {
        self.reader.said()
    }

    /// Whether the hand is in the middle of a sentence.
    #[must_use]
    pub fn is_showing(&self) -> bool {
        self.reader.is_showing()
    }

    /// When the sensor's silence is to be noticed.
    #[must_use]
    pub fn next_wake(&self) -> Micros {
        self.reader.next_wake()
    }

    /// Takes a part of the templates to be taught.
    ///
    /// # Errors
    /// Those of [`Taught::take`].
    pub fn take_templates(&mut self, part: &TemplatesPart) -> Result<Option<Loaded>, Fault> {
        self.taught.take(part)
    }

    /// Keeps a sample, to be read next.
    pub(super) fn keep_sample(&mut self, bytes: &[u8]) {
        self.pending.clear();
        if bytes.is_empty() || self.pending.extend_from_slice(bytes).is_err() {
            self.reader.count_error(WireError::Length(0));
        }
    }

    pub(super) fn take_spoken(&mut self) -> Option<Spoken> {
        self.spoken.take()
    }
}
