//! What commands and things are called.

use heapless::Vec;

use super::{Field, Part, Place, put_bytes, take_bytes};
use crate::command::LONGEST;

/// A command's number in its run, below 2^24.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Number(u32);

impl Number {
    /// The last one; a run with more commands begins a new one.
    pub const LAST: Self = Self(0x00ff_ffff);

    /// The number, if it is below 2^24.
    #[must_use]
    pub const fn new(number: u32) -> Option<Self> {
        if number <= Self::LAST.0 {
            Some(Self(number))
        } else {
            None
        }
    }

    /// As an integer.
    #[must_use]
    pub const fn get(self) -> u32 {
        self.0
    }
}

impl Field for Number {
    const PARTS: &'static [Part] = &[Part::plain(3)];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        let [a, b, c, _] = self.0.to_le_bytes();
        put_bytes(to, &[a, b, c]);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let [a, b, c] = take_bytes(from)?;
        Some(Self(u32::from_le_bytes([a, b, c, 0])))
    }
}

/// Names a command for good: a robot does what has one name at most once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Id {
    /// The run of the host that gave it.
    pub run: u32,
    /// Its number in that run, rising from 1.
    pub number: Number,
}

impl Field for Id {
    const PARTS: &'static [Part] = &[Part::named("Run", 4), Part::named("Number", 3)];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        self.run.put(to);
        self.number.put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let run = u32::take(from)?;
        let number = Number::take(from)?;
        Some(Self { run, number })
    }
}

/// Which thing: an option of the vocabulary's objects or storages, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name(u8);

impl Name {
    /// No thing.
    pub const NONE: Self = Self(u8::MAX);

    const STORAGE: u8 = 0x80;
    const PART: Part = Part {
        unit: "option, storages from 128, 255 none",
        ..Part::plain(1)
    };

    /// The object that is this option, below 127.
    #[must_use]
    pub const fn object(option: u8) -> Option<Self> {
        if option < 127 {
            Some(Self(option))
        } else {
            None
        }
    }

    /// The storage that is this option, below 127.
    #[must_use]
    pub const fn storage(option: u8) -> Option<Self> {
        if option < 127 {
            Some(Self(option | Self::STORAGE))
        } else {
            None
        }
    }

    /// Whether it is a storage and which option, if it is a thing.
    #[must_use]
    pub const fn get(self) -> Option<(bool, u8)> {
        if self.0 == Self::NONE.0 {
            return None;
        }
        Some((self.0 & Self::STORAGE != 0, self.0 & !Self::STORAGE))
    }
}

impl Field for Name {
    const PARTS: &'static [Part] = &[Self::PART];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        self.0.put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        u8::take(from).map(Self)
    }
}

/// A thing and where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Thing {
    /// Which.
    pub name: Name,
    /// Where; the origin for none.
    pub place: Place,
}

impl Thing {
    /// No thing.
    pub const NONE: Self = Self {
        name: Name::NONE,
        place: Place([0; 3]),
    };
}

impl Field for Thing {
    const PARTS: &'static [Part] = &[
        Part {
            suffix: "Name",
            ..Name::PART
        },
        Part::coordinate("X"),
        Part::coordinate("Y"),
        Part::coordinate("Z"),
    ];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        self.name.put(to);
        self.place.put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let name = Name::take(from)?;
        let place = Place::take(from)?;
        Some(Self { name, place })
    }
}
