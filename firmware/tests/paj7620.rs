//! The gesture sensor's driver against the sensor's register map.

use deictic_firmware::paj7620::{ADDRESS, Error, Gesture, Paj7620, likely};
use embedded_hal::i2c::{ErrorKind, NoAcknowledgeSource};
use embedded_hal_mock::eh1::i2c::{Mock, Transaction};

const ABSENT: ErrorKind = ErrorKind::NoAcknowledge(NoAcknowledgeSource::Address);

fn bank(number: u8) -> Transaction {
    Transaction::write(ADDRESS, vec![0xef, number])
}

fn part(id: [u8; 2]) -> Transaction {
    Transaction::write_read(ADDRESS, vec![0x00], id.to_vec())
}

fn flags(low: u8, high: u8) -> Transaction {
    Transaction::write_read(ADDRESS, vec![0x43], vec![low, high])
}

/// All that a sensor hears while it is set up: the bank it is in decides what a register is.
fn settings() -> Vec<Transaction> {
    let zero: &[(u8, u8)] = &[
        (0x37, 0x07),
        (0x38, 0x17),
        (0x39, 0x06),
        (0x41, 0x00),
        (0x42, 0x00),
        (0x46, 0x2d),
        (0x47, 0x0f),
        (0x48, 0x3c),
        (0x49, 0x00),
        (0x4a, 0x1e),
        (0x4c, 0x20),
        (0x51, 0x10),
        (0x5e, 0x10),
        (0x60, 0x27),
        (0x80, 0x42),
        (0x81, 0x44),
        (0x82, 0x04),
        (0x8b, 0x01),
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
    ];
    let one: &[(u8, u8)] = &[
        (0x02, 0x0f),
        (0x03, 0x10),
        (0x04, 0x02),
        (0x25, 0x01),
        (0x27, 0x39),
        (0x28, 0x7f),
        (0x29, 0x08),
        (0x3e, 0xff),
        (0x5e, 0x3d),
        (0x65, 0x96),
        (0x67, 0x97),
        (0x69, 0xcd),
        (0x6a, 0x01),
        (0x6d, 0x2c),
        (0x6e, 0x01),
        (0x72, 0x01),
        (0x73, 0x35),
        (0x74, 0x00),
        (0x77, 0x01),
    ];
    let write = |(register, value): &(u8, u8)| Transaction::write(ADDRESS, vec![*register, *value]);
    let mut all = vec![bank(0)];
    all.extend(zero.iter().map(write));
    all.push(bank(1));
    all.extend(one.iter().map(write));
    all.push(bank(0));
    all.extend([(0x41, 0xff), (0x42, 0x01)].iter().map(write));
    all
}

/// Steps that set a sensor up: a hello, then its settings, eight at a time.
const STEPS: usize = 8;

fn started(more: &[Transaction]) -> (Paj7620<Mock>, Mock) {
    let mut expected = vec![bank(0), part([0x20, 0x76])];
    expected.extend(settings());
    expected.extend_from_slice(more);
    let bus = Mock::new(&expected);
    let mut sensor = Paj7620::new(bus.clone());
    for step in 0..STEPS {
        assert!(!sensor.is_set_up(), "{step}");
        assert_eq!(sensor.poll(), Ok(None), "{step}");
    }
    assert!(sensor.is_set_up());
    (sensor, bus)
}

#[test]
fn a_sleeping_sensor_is_woken_and_set_up() {
    let mut expected = vec![bank(0).with_error(ABSENT), bank(0), part([0x20, 0x76])];
    expected.extend(settings());
    let mut bus = Mock::new(&expected);
    let mut sensor = Paj7620::new(bus.clone());
    assert_eq!(sensor.poll(), Err(Error::Bus(ABSENT)));
    for _ in 0..STEPS {
        assert_eq!(sensor.poll(), Ok(None));
    }
    assert!(sensor.is_set_up());
    bus.done();
}

#[test]
fn a_sensor_that_is_not_there_or_another_is_named() {
    let mut bus = Mock::new(&[bank(0).with_error(ABSENT), bank(0), part([0x34, 0x12])]);
    let mut sensor = Paj7620::new(bus.clone());
    assert_eq!(sensor.poll(), Err(Error::Bus(ABSENT)));
    assert_eq!(sensor.poll(), Err(Error::OtherPart(0x1234)));
    assert!(!sensor.is_set_up());
    bus.done();
}

#[test]
fn a_sensor_that_was_lost_is_set_up_anew() {
    let mut more = vec![
        Transaction::write_read(ADDRESS, vec![0x43], vec![0, 0]).with_error(ABSENT),
        bank(0),
        part([0x20, 0x76]),
    ];
    more.extend(settings());
    more.push(flags(1, 0));
    let (mut sensor, mut bus) = started(&more);
    assert_eq!(sensor.poll(), Err(Error::Bus(ABSENT)));
    assert!(!sensor.is_set_up());
    for _ in 0..STEPS {
        assert_eq!(sensor.poll(), Ok(None));
    }
    assert_eq!(sensor.poll(), Ok(Some(Gesture::Up)));
    bus.done();
}

#[test]
fn every_bit_is_its_gesture_and_the_larger_movement_counts() {
    let (mut sensor, mut bus) = started(&[
        flags(0, 0),
        flags(0b1, 0),
        flags(0b1000_0000, 0),
        flags(0b100, 1),
        flags(0b0100_1000, 0),
        flags(0, 0b10),
    ]);
    let seen: Vec<_> = (0..6).map(|_| sensor.poll().expect("an answer")).collect();
    let expected = [
        None,
        Some(Gesture::Up),
        Some(Gesture::Counterclockwise),
        Some(Gesture::Wave),
        Some(Gesture::Clockwise),
        // Proximity, which is no gesture.
        None,
    ];
    assert_eq!(seen, expected);
    bus.done();
}

#[test]
fn what_is_reported_becomes_probabilities() {
    for gesture in Gesture::ALL {
        let likely = likely(gesture);
        let sum: f32 = likely.gestures.iter().sum::<f32>() + likely.none;
        assert!((sum - 1.0).abs() < 1e-5, "{gesture:?} {sum}");
        let best = deictic_core::math::argmax(&likely.gestures).expect("gestures");
        assert_eq!(
            deictic_core::gesture::stroke_table::NAMES[best],
            gesture.name()
        );
    }
}
