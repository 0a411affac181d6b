//! The I2C driver against a peripheral in memory: what goes over the bus, and what becomes of a bus in trouble.

mod common;

use common::sensor::Traffic::{Byte, Start, Stop};
use common::sensor::{Peripheral, Trouble};
use deictic_firmware::paj7620::ADDRESS;
use deictic_firmware::stm32_i2c::Controller;
use embedded_hal::i2c::{ErrorKind, I2c, NoAcknowledgeSource, Operation};

/// A bus whose sensor is awake.
fn awake() -> Controller<Peripheral> {
    let mut bus = Controller(Peripheral::default());
    let asleep = bus.write(ADDRESS, &[0xef, 0]);
    let refused = ErrorKind::NoAcknowledge(NoAcknowledgeSource::Address);
    assert_eq!(asleep, Err(refused));
    bus.0.traffic.clear();
    bus
}

#[test]
fn a_transaction_is_what_embedded_hal_says_it_is() {
    let mut bus = awake();
    let mut part = [0; 2];
    bus.write_read(ADDRESS, &[0x00], &mut part).unwrap();
    assert_eq!(part, [0x20, 0x76]);
    let expected = [
        Start(ADDRESS, false),
        Byte(0x00),
        Start(ADDRESS, true),
        Byte(0x20),
        Byte(0x76),
        Stop,
    ];
    assert_eq!(bus.0.traffic, expected);

    // Operations of one kind follow each other without a start.
    bus.0.traffic.clear();
    let mut operations = [Operation::Write(&[0x37]), Operation::Write(&[7, 8])];
    bus.transaction(ADDRESS, &mut operations).unwrap();
    let expected = [Start(ADDRESS, false), Byte(0x37), Byte(7), Byte(8), Stop];
    assert_eq!(bus.0.traffic, expected);
    assert_eq!(bus.0.sensor.borrow().registers[&(0, 0x38)], 8);

    bus.0.traffic.clear();
    bus.transaction(ADDRESS, &mut []).unwrap();
    assert_eq!(bus.0.traffic, []);
}

#[test]
fn a_bus_in_trouble_is_named_and_works_again_when_the_trouble_is_over() {
    let mut bus = awake();
    for (trouble, error) in [
        (Trouble::Stuck, ErrorKind::Other),
        (Trouble::Overruled, ErrorKind::ArbitrationLoss),
        (Trouble::Misplaced, ErrorKind::Bus),
    ] {
        bus.0.trouble = trouble;
        assert_eq!(bus.write(ADDRESS, &[0xef, 0]), Err(error));
        bus.0.trouble = Trouble::None;
        assert_eq!(bus.write(ADDRESS, &[0xef, 0]), Ok(()));
    }
    bus.0.sensor.borrow_mut().power(false);
    let refused = ErrorKind::NoAcknowledge(NoAcknowledgeSource::Address);
    for _ in 0..3 {
        assert_eq!(bus.read(ADDRESS, &mut [0]), Err(refused));
    }
}

#[test]
fn more_bytes_than_the_peripheral_counts_are_refused() {
    let mut bus = awake();
    assert_eq!(bus.write(ADDRESS, &[0; 256]), Err(ErrorKind::Other));
    assert_eq!(bus.write(ADDRESS, &[0; 255]), Ok(()));
}
