//! What is forbidden: a person says "don't", and what their hand shows with it is not to be done, whichever of the
//! two comes first.
//!
//! Words and gestures that belong together lie within the pairing window of each other. What has come before the
//! prohibition and waits is dropped, and what other modalities say until the window has closed is not taken. A hand that was
//! seen in the middle of a sentence within the window goes on with the same sentence, however long that takes. The
//! modality that forbade lifts the prohibition by a command of its own: "don't pick the cup", "pick the can".

use super::Source;
use crate::protocol::message::{Fault, ToHost, Withheld};
use crate::sentence::{MODALITIES, SentenceError};
use crate::time::Micros;
use crate::unit::Unit;

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

impl<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
    const FRAME: usize,
    const OUT: usize,
    const S: usize,
> Unit<N, C, F, E, W, FRAME, OUT, S>
{
    /// Takes it that a modality forbade, asked or told something, or said what nobody understood: what waits is
    /// dropped, an open question with it, and what is shown with it is not taken.
    ///
    /// # Errors
    /// [`Fault`] for a modality that there is not; nothing has changed then.
    pub(in crate::unit) fn forbid(&mut self, now: Micros, by: u8) -> Result<(), Fault> {
        if usize::from(by) >= MODALITIES {
            return Err(Fault::Sentence {
                modality: by,
                error: SentenceError::UnknownModality {
                    capacity: MODALITIES as u8,
                },
            });
        }
        let modalities = self.pairing.observations.modalities();
        self.pairing.clear();
        self.pairing.forbidden = Forbidden {
            until: now.after(self.configuration.window),
            by,
            hand: self.hand.is_showing(),
        };
        self.send(&ToHost::Withheld(Withheld {
            modalities,
            confirms: true,
        }));
        Ok(())
    }

    /// Looks at the hand, after what it said.
    pub(in crate::unit) fn watch_forbidden(&mut self, now: Micros) {
        self.pairing.forbidden.watch(now, self.hand.is_showing());
    }

    /// Tells the host that this modality's sentence is not taken.
    #[inline(never)]
    pub(super) fn withhold(&mut self, modality: u8) {
        self.send(&ToHost::Withheld(Withheld {
            modalities: 1_u8.checked_shl(u32::from(modality)).unwrap_or(0),
            confirms: false,
        }));
    }
}
