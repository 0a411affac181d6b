//! A PAJ7620U2 on the bus of an STM32's I2C peripheral, both in memory: what the code of the board meets.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use deictic_firmware::paj7620::ADDRESS;
use deictic_firmware::stm32_i2c::{Flags, Registers};

/// The sensor: two banks of registers, of which bank 0's 0x43 and 0x44 forget what was read.
pub struct Sensor {
    /// Whether it has power.
    pub there: bool,
    asleep: bool,
    /// What it answers when asked for its part.
    pub part: [u8; 2],
    bank: u8,
    pointer: u8,
    pub registers: BTreeMap<(u8, u8), u8>,
    /// How often its flags were read.
    pub looked: usize,
}

impl Default for Sensor {
    fn default() -> Self {
        Self {
            there: true,
            asleep: true,
            part: [0x20, 0x76],
            bank: 0,
            pointer: 0,
            registers: BTreeMap::new(),
            looked: 0,
        }
    }
}

impl Sensor {
    /// Takes its power, or gives it back: what it was told is gone.
    pub fn power(&mut self, on: bool) {
        let part = self.part;
        *self = Self {
            there: on,
            part,
            ..Self::default()
        };
    }

    /// It has seen these gestures: bits as in 0x43 and 0x44.
    pub fn see(&mut self, bits: u16) {
        let [low, high] = bits.to_le_bytes();
        *self.registers.entry((0, 0x43)).or_default() |= low;
        *self.registers.entry((0, 0x44)).or_default() |= high;
    }

    fn addressed(&mut self, address: u8) -> bool {
        // Being addressed wakes it.
        let awake = !std::mem::replace(&mut self.asleep, false);
        self.there && address == ADDRESS && awake
    }

    fn write(&mut self, byte: u8) {
        if self.pointer == 0xef {
            self.bank = byte;
        } else {
            self.registers.insert((self.bank, self.pointer), byte);
        }
        self.pointer = self.pointer.wrapping_add(1);
    }

    fn read(&mut self) -> u8 {
        let at = (self.bank, self.pointer);
        self.pointer = self.pointer.wrapping_add(1);
        match at {
            (0, 0x00) => self.part[0],
            (0, 0x01) => self.part[1],
            (0, 0x43 | 0x44) => {
                self.looked += usize::from(at.1 == 0x43);
                self.registers.remove(&at).unwrap_or_default()
            }
            _ => self.registers.get(&at).copied().unwrap_or_default(),
        }
    }
}

/// What went over the bus: a start, bytes, a stop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Traffic {
    Start(u8, bool),
    Byte(u8),
    Stop,
}

/// What is wrong with the bus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trouble {
    #[default]
    None,
    /// SDA or SCL is held low: nothing moves.
    Stuck,
    /// Somebody else drives it.
    Overruled,
    /// A stop in the middle of a byte.
    Misplaced,
}

/// The peripheral, by RM0440, section 41.4.9: TXIS and RXNE for each of NBYTES, then TC; a start may follow TC; no
/// acknowledgement ends the transfer with a stop.
#[derive(Default)]
pub struct Peripheral {
    pub sensor: Rc<RefCell<Sensor>>,
    pub trouble: Trouble,
    pub traffic: Vec<Traffic>,
    flags: Flags,
    left: u8,
    reads: bool,
    /// The first byte that is written after a start is where.
    first: bool,
    open: bool,
}

impl Peripheral {
    fn proceed(&mut self) {
        self.flags.wants = self.left > 0 && !self.reads;
        self.flags.has = self.left > 0 && self.reads;
        self.flags.complete = self.left == 0;
    }
}

impl Registers for Peripheral {
    fn flags(&mut self) -> Flags {
        self.flags
    }

    fn begin(&mut self, address: u8, reads: bool, bytes: u8) {
        assert!(
            !self.open || self.flags.complete,
            "a start in the middle of a transfer"
        );
        assert!(!self.flags.refused, "a start before the last one was over");
        self.traffic.push(Traffic::Start(address, reads));
        (self.left, self.reads, self.first, self.open) = (bytes, reads, true, true);
        self.flags = Flags::default();
        match self.trouble {
            Trouble::Stuck => {}
            Trouble::Overruled => self.flags.overruled = true,
            Trouble::Misplaced => self.flags.misplaced = true,
            Trouble::None if self.sensor.borrow_mut().addressed(address) => self.proceed(),
            Trouble::None => {
                self.flags.refused = true;
                self.flags.stopped = true;
            }
        }
    }

    fn put(&mut self, byte: u8) {
        assert!(self.flags.wants, "a byte that nobody wants");
        self.traffic.push(Traffic::Byte(byte));
        let mut sensor = self.sensor.borrow_mut();
        match std::mem::replace(&mut self.first, false) {
            true => sensor.pointer = byte,
            false => sensor.write(byte),
        }
        drop(sensor);
        self.left -= 1;
        self.proceed();
    }

    fn take(&mut self) -> u8 {
        assert!(self.flags.has, "a byte that is not there");
        let byte = self.sensor.borrow_mut().read();
        self.traffic.push(Traffic::Byte(byte));
        self.left -= 1;
        self.proceed();
        byte
    }

    fn stop(&mut self) {
        if self.trouble == Trouble::None {
            self.traffic.push(Traffic::Stop);
            self.flags.stopped = true;
        }
        self.open = false;
    }

    fn restart(&mut self) {
        self.flags = Flags::default();
        self.open = false;
    }
}
