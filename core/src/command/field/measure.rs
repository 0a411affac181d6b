//! Places, angles and quantities as integers.

use heapless::Vec;

use super::{Field, Part, put_bytes, take_bytes};
use crate::command::LONGEST;

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
