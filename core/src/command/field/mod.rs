//! How a value lies in a message: whole bytes, little end first, integers only.

mod measure;
mod name;
mod text;

use heapless::Vec;

use super::LONGEST;

pub use measure::{Angle, Place, Quantity};
pub use name::{Id, Name, Number, Thing};
pub use text::{Features, Text};

/// One integer signal of a field, as a DBC file describes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// What is put behind the field's name for it.
    pub suffix: &'static str,
    /// How many bytes it takes.
    pub bytes: u8,
    /// Whether it is signed.
    pub signed: bool,
    /// Its unit.
    pub unit: &'static str,
    /// The names of its values, where they are numbered choices.
    pub codes: &'static [(&'static str, u8)],
}

impl Part {
    pub(super) const fn plain(bytes: u8) -> Self {
        Self {
            suffix: "",
            bytes,
            signed: false,
            unit: "",
            codes: &[],
        }
    }

    pub(super) const fn named(suffix: &'static str, bytes: u8) -> Self {
        Self {
            suffix,
            ..Self::plain(bytes)
        }
    }

    pub(super) const fn coordinate(suffix: &'static str) -> Self {
        Self {
            suffix,
            signed: true,
            unit: "0.1 mm",
            ..Self::plain(2)
        }
    }

    /// A numbered choice.
    pub(in crate::command) const fn choice(codes: &'static [(&'static str, u8)]) -> Self {
        Self {
            codes,
            ..Self::plain(1)
        }
    }
}

/// A value that lies in messages.
pub trait Field: Sized {
    /// The integers it is made of, in the order in which they lie.
    const PARTS: &'static [Part];

    /// Puts it behind what is there; nothing when there is no room, which a test of every message's
    /// layout excludes.
    fn put(&self, to: &mut Vec<u8, LONGEST>);

    /// Takes it from the beginning of `from`; `None` when that is too short or no such value.
    fn take(from: &mut &[u8]) -> Option<Self>;
}

pub(super) fn put_bytes(to: &mut Vec<u8, LONGEST>, bytes: &[u8]) {
    // Every message's layout is shorter than a packet's room, which a test holds it to.
    let _ = to.extend_from_slice(bytes);
}

pub(super) fn take_bytes<const N: usize>(from: &mut &[u8]) -> Option<[u8; N]> {
    let (taken, rest) = from.split_first_chunk::<N>()?;
    *from = rest;
    Some(*taken)
}

macro_rules! integer {
    ($($type:ty: $bytes:literal, $signed:literal;)*) => {$(
        impl Field for $type {
            const PARTS: &'static [Part] = &[Part { signed: $signed, ..Part::plain($bytes) }];

            fn put(&self, to: &mut Vec<u8, LONGEST>) {
                put_bytes(to, &self.to_le_bytes());
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                take_bytes::<$bytes>(from).map(Self::from_le_bytes)
            }
        }
    )*};
}

integer! {
    u8: 1, false;
    u16: 2, false;
    u32: 4, false;
    u64: 8, false;
    i32: 4, true;
}
