//! What is forbidden: a person says "don't", and what their hand shows with it is not to be done, whichever of the
//! two comes first.
//!
//! Words and gestures that belong together lie within the pairing window of each other. What has come before the
//! prohibition and waits is dropped, and what other modalities say until the window has closed is not taken. A hand that was
//! seen in the middle of a sentence within the window goes on with the same sentence, however long that takes. The
//! modality that forbade lifts the prohibition by a command of its own: "don't pick the cup", "pick the can".

use super::Source;
use crate::protocol::message::Fault;
use crate::sentence::{MODALITIES, SentenceError};
use crate::time::Micros;

/// What a prohibition holds back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Forbidden {
    /// Until when sentences belong to it.
    until: Micros,
    /// Who forbade; its own sentences are commands again.
    by: u8,
    /// Whether the sentence that the hand is in the middle of belongs to it.
    hand: bool,
}

impl Forbidden {
    /// Nothing is held back.
    pub(super) const NOTHING: Self = Self {
        until: Micros(0),
        by: 0,
        hand: false,
    };

    /// By a modality, and of the hand that may be in the middle of a sentence.
    ///
    /// # Errors
    /// [`Fault`] for a modality that there is not.
    pub(super) fn new(by: u8, until: Micros, hand: bool) -> Result<Self, Fault> {
        if usize::from(by) >= MODALITIES {
            return Err(Fault::Sentence {
                modality: by,
                error: SentenceError::UnknownModality {
                    capacity: MODALITIES as u8,
                },
            });
        }
        Ok(Self { until, by, hand })
    }

    /// Whether a sentence of this modality that is complete `now` belongs to it.
    pub(super) fn holds(&self, now: Micros, source: Source, modality: u8) -> bool {
        modality != self.by && (now < self.until || self.hand && source == Source::Hand)
    }

    /// Whether this modality forbade.
    pub(super) fn is_by(&self, modality: u8) -> bool {
        modality == self.by
    }

    /// Looks at the hand: what it begins within the window belongs to it to its end.
    pub(super) fn watch(&mut self, now: Micros, showing: bool) {
        self.hand = showing && (self.hand || now < self.until);
    }
}
