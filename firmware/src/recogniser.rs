//! A gesture sensor on a board's I2C bus, looked at again and again: it may come later, and go.
//!
//! A PAJ7620U2 tells what it sees as it sees it, and a hand that comes near in order to push first swipes into view:
//! the library that comes with Seeed's breakout (Gesture_PAJ7620) therefore waits for 0.8 s after a swipe whether something larger
//! comes of it, and for 1 s after a push or pull until the hand has left. So does this.

use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::time::Micros;
use embedded_hal::i2c::I2c;

use crate::paj7620::{Error, Gesture, Paj7620, likely};

/// How often a sensor is looked at that is there. It reports 120 times a second and keeps what it saw.
const PERIOD: Micros = Micros::from_millis(10);

/// How often one is looked for. What is not there costs 25 us each time.
const ABSENT: Micros = Micros::from_millis(250);

/// For how long a swipe may still become something larger.
const ENTRY: Micros = Micros::from_millis(800);

/// How long a hand takes to leave after something larger.
const EXIT: Micros = Micros::from_millis(1_000);

/// A sensor, there or not.
#[derive(Debug)]
pub struct Recogniser<I> {
    sensor: Paj7620<I>,
    due: Micros,
    /// A swipe, and when it will have been no more than that.
    swipe: Option<(Gesture, Micros)>,
    /// What is seen before this is a hand that leaves.
    leaving: Micros,
    /// Another part that answers at the sensor's address.
    other: Option<u16>,
}

impl<I: I2c> Recogniser<I> {
    /// On this bus, not looked at yet.
    pub const fn new(i2c: I) -> Self {
        Self {
            sensor: Paj7620::new(i2c),
            due: Micros(0),
            swipe: None,
            leaving: Micros(0),
            other: None,
        }
    }

    /// Whether a sensor is there and set up.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.sensor.is_set_up()
    }

    /// The number of a part that answers in a sensor's place, if one does.
    #[must_use]
    pub fn other(&self) -> Option<u16> {
        self.other
    }

    /// When [`Recogniser::look`] is to be called next.
    #[must_use]
    pub fn due(&self) -> Micros {
        self.due
    }

    /// Looks at the sensor if it is time to, with 0.6 ms on the bus at most, and gives what a gesture that is
    /// over may have been.
    pub fn look(&mut self, now: Micros) -> Option<Likely<STROKES>> {
        if now < self.due {
            return None;
        }
        let seen = match self.sensor.poll() {
            Ok(seen) => {
                self.other = None;
                // What is left of setting it up waits for nothing.
                self.due = if self.is_there() {
                    now.after(PERIOD)
                } else {
                    now
                };
                seen
            }
            Err(error) => {
                self.other = match error {
                    Error::OtherPart(part) => Some(part),
                    Error::Bus(_) => None,
                };
                self.due = now.after(ABSENT);
                self.swipe = None;
                return None;
            }
        };
        self.settle(now, seen).map(likely)
    }

    fn settle(&mut self, now: Micros, seen: Option<Gesture>) -> Option<Gesture> {
        let seen = seen.filter(|_| now >= self.leaving);
        match (seen, self.swipe) {
            (Some(gesture), _) if !gesture.is_swipe() => {
                self.swipe = None;
                self.leaving = now.after(EXIT);
                return Some(gesture);
            }
            (Some(swipe), None) => self.swipe = Some((swipe, now.after(ENTRY))),
            // The hand comes back, or waves: what came first counts, unless something larger comes.
            (Some(_), Some((first, _))) => self.swipe = Some((first, now.after(ENTRY))),
            (None, _) => {}
        }
        let (swipe, _) = self.swipe.take_if(|(_, until)| now >= *until)?;
        Some(swipe)
    }
}
