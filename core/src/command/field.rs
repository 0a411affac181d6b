//! How a value lies in a message: whole bytes, little end first, integers only.

use heapless::Vec;

use super::LONGEST;

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
    const fn plain(bytes: u8) -> Self {
        Self {
            suffix: "",
            bytes,
            signed: false,
            unit: "",
            codes: &[],
        }
    }

    const fn named(suffix: &'static str, bytes: u8) -> Self {
        Self {
            suffix,
            ..Self::plain(bytes)
        }
    }

    const fn coordinate(suffix: &'static str) -> Self {
        Self {
            suffix,
            signed: true,
            unit: "0.1 mm",
            ..Self::plain(2)
        }
    }

    /// A numbered choice.
    pub(super) const fn choice(codes: &'static [(&'static str, u8)]) -> Self {
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

/// A place in the robot's base frame, in tenths of a millimetre: 3.2 m to every side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place(pub [i16; 3]);

impl Place {
    /// The place nearest to one in metres; what is beyond 3.2 m, or not a number, does not count as
    /// a place.
    #[must_use]
    pub fn of_metres(metres: [f32; 3]) -> Option<Self> {
        let mut place = [0; 3];
        for (to, from) in place.iter_mut().zip(metres) {
            let tenths = crate::math::round(from * 10_000.0);
            if !(tenths >= f32::from(i16::MIN) && tenths <= f32::from(i16::MAX)) {
                return None;
            }
            *to = tenths as i16;
        }
        Some(Self(place))
    }

    /// In metres.
    #[must_use]
    pub fn metres(self) -> [f32; 3] {
        self.0.map(|tenths| f32::from(tenths) / 10_000.0)
    }
}

impl Field for Place {
    const PARTS: &'static [Part] = &[
        Part::coordinate("X"),
        Part::coordinate("Y"),
        Part::coordinate("Z"),
    ];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        for coordinate in self.0 {
            put_bytes(to, &coordinate.to_le_bytes());
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let mut place = [0; 3];
        for coordinate in &mut place {
            *coordinate = i16::from_le_bytes(take_bytes(from)?);
        }
        Some(Self(place))
    }
}

/// The angle of a joint, in fifths of a milliradian: 6.5 rad to either side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Angle(pub i16);

impl Angle {
    /// Of radians; the nearest that can be said, 0 for what is not a number.
    #[must_use]
    pub fn of_radians(radians: f32) -> Self {
        // A cast saturates, and makes 0 of what is not a number.
        Self(crate::math::round(radians * 5_000.0) as i16)
    }

    /// In radians.
    #[must_use]
    pub fn radians(self) -> f32 {
        f32::from(self.0) / 5_000.0
    }
}

impl Field for Angle {
    const PARTS: &'static [Part] = &[Part {
        unit: "0.2 mrad",
        ..Part::coordinate("")
    }];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        put_bytes(to, &self.0.to_le_bytes());
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        take_bytes(from).map(i16::from_le_bytes).map(Self)
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

/// A length in tenths of a millimetre or an angle in tenths of a milliradian, or none: below 6.5535 m
/// or rad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity(u16);

impl Quantity {
    /// Not given.
    pub const NONE: Self = Self(u16::MAX);

    /// Of metres or radians; `None` for what cannot be said: negative, 6.5535 and above, not a
    /// number.
    #[must_use]
    pub fn new(value: f32) -> Option<Self> {
        let tenths = crate::math::round(value * 10_000.0);
        (tenths >= 0.0 && tenths < f32::from(u16::MAX)).then_some(Self(tenths as u16))
    }

    /// In metres or radians, if it is given.
    #[must_use]
    pub fn get(self) -> Option<f32> {
        (self != Self::NONE).then(|| f32::from(self.0) / 10_000.0)
    }
}

impl Field for Quantity {
    const PARTS: &'static [Part] = &[Part {
        unit: "0.1 mm or mrad, 65535 none",
        ..Part::plain(2)
    }];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        self.0.put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        u16::take(from).map(Self)
    }
}

/// Up to 40 bytes of UTF-8, for people; zeros behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Text([u8; 40]);

impl Text {
    /// As much of `text` as fits, cut between characters, and at a zero.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let mut bytes = [0; 40];
        let mut end = 0_usize;
        for (at, character) in text.char_indices() {
            let after = at.saturating_add(character.len_utf8());
            if after > bytes.len() || character == '\0' {
                break;
            }
            end = after;
        }
        for (to, from) in bytes.iter_mut().zip(text.bytes().take(end)) {
            *to = from;
        }
        Self(bytes)
    }

    /// The text; up to the first damage, should it not be UTF-8.
    #[must_use]
    pub fn get(&self) -> &str {
        let end = self.0.iter().position(|b| *b == 0).unwrap_or(self.0.len());
        let bytes = self.0.get(..end).unwrap_or(&[]);
        match core::str::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => bytes
                .get(..error.valid_up_to())
                .and_then(|sound| core::str::from_utf8(sound).ok())
                .unwrap_or(""),
        }
    }
}

impl Field for Text {
    const PARTS: &'static [Part] = &[
        Part::named("0", 8),
        Part::named("1", 8),
        Part::named("2", 8),
        Part::named("3", 8),
        Part::named("4", 8),
    ];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        put_bytes(to, &self.0);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        take_bytes(from).map(Self)
    }
}

/// The likelihoods of up to 32 features, in 255ths; a likelihood of 1/2 and above is 128 and above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Features(pub [u8; 32]);

impl Features {
    /// Of likelihoods in 0..=1; what is missing is 0.
    #[must_use]
    pub fn new(likelihoods: &[f32]) -> Self {
        let mut features = [0; 32];
        for (to, from) in features.iter_mut().zip(likelihoods) {
            *to = Self::in_255ths(*from);
        }
        Self(features)
    }

    /// A likelihood in 255ths.
    #[must_use]
    pub fn in_255ths(likelihood: f32) -> u8 {
        // A cast saturates, and makes 0 of what is not a number.
        crate::math::round(likelihood * 255.0) as u8
    }

    /// A likelihood of so many 255ths.
    #[must_use]
    pub fn likelihood(in_255ths: u8) -> f32 {
        f32::from(in_255ths) / 255.0
    }
}

impl Field for Features {
    const PARTS: &'static [Part] = &[
        Part::named("0To7", 8),
        Part::named("8To15", 8),
        Part::named("16To23", 8),
        Part::named("24To31", 8),
    ];

    fn put(&self, to: &mut Vec<u8, LONGEST>) {
        put_bytes(to, &self.0);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        take_bytes(from).map(Self)
    }
}
