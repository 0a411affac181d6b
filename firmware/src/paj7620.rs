//! PAJ7620U2, an I2C sensor that recognises nine gestures by itself (PixArt data sheet 41002AEN V1.0 and
//! V0.8, register list).
//!
//! It follows no hand: it says "something moved to the left". What it says becomes probabilities of the
//! gestures that the unit knows ([`likely`]), and the unit takes them as a movement it has seen itself.

use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::gesture::stroke_table::NAMES;
use embedded_hal::i2c::I2c;

/// The sensor's only address.
pub const ADDRESS: u8 = 0x73;

const BANK_SELECT: u8 = 0xef;
const PART_ID: u8 = 0x00;
const FLAGS: u8 = 0x43;

/// What PART_ID and the register after it hold.
const PART: u16 = 0x7620;

/// Settings written at a time: 0.55 ms at 400 kHz.
const STEP: usize = 8;

/// Register and value, in this order, for gestures at normal speed. Those that the data sheet's list leaves
/// at their value after reset are left out.
const SETTINGS: &[(u8, u8)] = &[
    (BANK_SELECT, 0),
    (0x37, 0x07), // Cursor: least distance
    (0x38, 0x17),
    (0x39, 0x06),
    (0x41, 0x00), // No interrupts while it is being set up
    (0x42, 0x00),
    (0x46, 0x2d), // Exposure control
    (0x47, 0x0f),
    (0x48, 0x3c),
    (0x49, 0x00),
    (0x4a, 0x1e),
    (0x4c, 0x20),
    (0x51, 0x10),
    (0x5e, 0x10),
    (0x60, 0x27),
    (0x80, 0x42), // GPIO
    (0x81, 0x44),
    (0x82, 0x04),
    (0x8b, 0x01), // Gesture thresholds
    (0x90, 0x06),
    (0x95, 0x0a),
    (0x96, 0x0c),
    (0x97, 0x05),
    (0x9a, 0x14),
    (0x9c, 0x3f),
    (0xa5, 0x19),
    (0xcc, 0x19),
    (0xcd, 0x0b),
    (0xce, 0x13),
    (0xcf, 0x64),
    (0xd0, 0x21),
    (BANK_SELECT, 1),
    (0x02, 0x0f), // Lens and timing
    (0x03, 0x10),
    (0x04, 0x02),
    (0x25, 0x01),
    (0x27, 0x39),
    (0x28, 0x7f),
    (0x29, 0x08),
    (0x3e, 0xff),
    (0x5e, 0x3d),
    (0x65, 0x96), // Idle times: 120 reports/s
    (0x67, 0x97),
    (0x69, 0xcd),
    (0x6a, 0x01),
    (0x6d, 0x2c),
    (0x6e, 0x01),
    (0x72, 0x01), // On
    (0x73, 0x35),
    (0x74, 0x00), // Gesture mode
    (0x77, 0x01),
    (BANK_SELECT, 0),
    (0x41, 0xff), // All nine gestures
    (0x42, 0x01),
];

/// A gesture as the sensor's register numbers them, seen from the sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Bit 0 of 0x43.
    Up,
    /// Bit 1.
    Down,
    /// Bit 2.
    Left,
    /// Bit 3.
    Right,
    /// Bit 4: towards the sensor.
    Forward,
    /// Bit 5: away from it.
    Backward,
    /// Bit 6.
    Clockwise,
    /// Bit 7.
    Counterclockwise,
    /// Bit 0 of 0x44.
    Wave,
}

impl Gesture {
    /// In the order of their bits.
    pub const ALL: [Self; 9] = [
        Self::Up,
        Self::Down,
        Self::Left,
        Self::Right,
        Self::Forward,
        Self::Backward,
        Self::Clockwise,
        Self::Counterclockwise,
        Self::Wave,
    ];

    /// Whether it goes up, down, left or right: what a hand seems to do as well that comes into view or leaves.
    #[must_use]
    pub fn is_swipe(self) -> bool {
        matches!(self, Self::Up | Self::Down | Self::Left | Self::Right)
    }

    /// Its name among the gestures that a unit knows.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Up => "swipe-up",
            Self::Down => "swipe-down",
            Self::Left => "swipe-left",
            Self::Right => "swipe-right",
            Self::Forward => "swipe-forward",
            Self::Backward => "swipe-backward",
            Self::Clockwise | Self::Counterclockwise => "circle",
            Self::Wave => "wave",
        }
    }
}

/// Why the sensor cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error<E> {
    /// The bus reports this. As long as the sensor was never there, nothing answers at [`ADDRESS`]: look at SDA, SCL
    /// and the supply.
    Bus(E),
    /// Something else answers at [`ADDRESS`]; its part number is given.
    OtherPart(u16),
}

/// A sensor, or the place where one may be.
#[derive(Debug)]
pub struct Paj7620<I> {
    i2c: I,
    /// How many of the settings it has; `None` for a sensor that has not answered.
    set: Option<usize>,
}

impl<I: I2c> Paj7620<I> {
    /// On this bus; nothing is said to it yet.
    pub const fn new(i2c: I) -> Self {
        Self { i2c, set: None }
    }

    /// Whether it is there and set up.
    #[must_use]
    pub fn is_set_up(&self) -> bool {
        self.set.is_some_and(|set| set >= SETTINGS.len())
    }

    /// Says hello to a sensor that has not answered, or sets up one that has, a few settings at a time; from then on
    /// gives the gesture that was seen since the last call. Reading it makes the sensor forget it. When it saw several,
    /// the last of them in the order of bits: a circle begins like a swipe, a wave like two.
    ///
    /// # Errors
    /// [`Error`]; it is then said hello to again. A sleeping sensor wakes at being addressed, does not acknowledge, and
    /// answers 700 us later at the latest.
    pub fn poll(&mut self) -> Result<Option<Gesture>, Error<I::Error>> {
        let step = self.step();
        if step.is_err() {
            self.set = None;
        }
        step
    }

    fn step(&mut self) -> Result<Option<Gesture>, Error<I::Error>> {
        match self.set {
            None => {
                self.identify()?;
                self.set = Some(0);
                Ok(None)
            }
            Some(set) if set < SETTINGS.len() => {
                for (register, value) in SETTINGS.iter().skip(set).take(STEP) {
                    self.write(*register, *value)?;
                }
                self.set = Some(set.saturating_add(STEP));
                Ok(None)
            }
            Some(_) => self.seen(),
        }
    }

    fn identify(&mut self) -> Result<(), Error<I::Error>> {
        self.write(BANK_SELECT, 0)?;
        match self.read(PART_ID)? {
            PART => Ok(()),
            other => Err(Error::OtherPart(other)),
        }
    }

    fn seen(&mut self) -> Result<Option<Gesture>, Error<I::Error>> {
        let flags = self.read(FLAGS)?;
        let seen = |(_, bit): &(Gesture, u32)| flags.wrapping_shr(*bit) & 1 == 1;
        let last = Gesture::ALL.into_iter().zip(0_u32..).filter(seen).last();
        Ok(last.map(|(gesture, _)| gesture))
    }

    fn write(&mut self, register: u8, value: u8) -> Result<(), Error<I::Error>> {
        self.i2c
            .write(ADDRESS, &[register, value])
            .map_err(Error::Bus)
    }

    /// A register and the one after it.
    fn read(&mut self, register: u8) -> Result<u16, Error<I::Error>> {
        let mut bytes = [0; 2];
        self.i2c
            .write_read(ADDRESS, &[register], &mut bytes)
            .map_err(Error::Bus)?;
        Ok(u16::from_le_bytes(bytes))
    }
}

/// Share of what the sensor says that is what was done. The data sheet states none, so this is an assumption, on the
/// careful side of what swipes over such sensors come to: of a hundred reports 85 are right, 8 are a movement that
/// came near the sensor on its way, 4 any other, and 3 none at all.
const RIGHT: f32 = 0.85;
const NEARING: f32 = 0.08;
const OTHER: f32 = 0.04;
const NONE: f32 = 0.03;

/// What a gesture that the sensor reports may have been.
#[must_use]
pub fn likely(reported: Gesture) -> Likely<STROKES> {
    // A hand that swipes sideways also comes nearer and goes away; who pushes may be swiping.
    let near = |name: &str| match reported {
        Gesture::Forward | Gesture::Backward => {
            matches!(
                name,
                "swipe-up" | "swipe-down" | "swipe-left" | "swipe-right"
            )
        }
        _ => matches!(name, "swipe-forward" | "swipe-backward"),
    };
    let is_near = |name: &&str| **name != *reported.name() && near(name);
    let nearing = NAMES.iter().filter(|name| is_near(name)).count() as f32;
    let others = NAMES.len() as f32 - 1.0 - nearing;
    let mut gestures = [0.0; STROKES];
    for (p, name) in gestures.iter_mut().zip(&NAMES) {
        *p = if *name == reported.name() {
            RIGHT
        } else if near(name) {
            NEARING / nearing
        } else {
            OTHER / others
        };
    }
    Likely {
        gestures,
        none: NONE,
    }
}
