//! The robot's command set on its way: messages in packets, packets in CAN frames of either kind, frames in an adapter's lines. What
//! is read is what was said, whatever else was on the bus.

use deictic_core::can::{BusFrame, CLASSIC, FLEXIBLE, Frame};
use deictic_core::command::Packet;
use deictic_core::command::message::{FromRobot, ToRobot};
use deictic_core::command::parcel::{Assembler, Sender, frames};
use deictic_core::command::seal::{Guard, Heard as Taken, ON_A_BUS, ON_A_STREAM, SEALED};
use deictic_core::protocol::seal::{KEY, Key};
use deictic_core::slcan::{Adapter, CR, Heard, Lines, Wanted, line};

use super::source::Source;

/// Checks one input, the first byte of which chooses how the others are used.
pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    match source.small(5) {
        0 => packets(&mut source),
        1 => bus::<CLASSIC>(&mut source),
        2 => lines(&mut source),
        3 => bus::<FLEXIBLE>(&mut source),
        _ => sealed(&mut source),
    }
}

/// Two guards with somebody between them who loses, doubles, changes, keeps, sends back and invents: each takes nothing
/// but what the other has said to it, in that order and once, or a halt.
fn sealed(source: &mut Source<'_>) {
    let tag = source.pick(&[ON_A_BUS, ON_A_STREAM]);
    let mut between = Between::new(tag);
    while !source.is_over() {
        let from = source.below(2);
        let mut line = match source.small(8) {
            0 => vec![Packet {
                id: source.word() as u16,
                bytes: (0..source.small(66)).map(|_| source.byte()).collect(),
            }],
            1 | 2 if !between.kept.is_empty() => {
                let first = between.kept.len().min(256);
                vec![between.kept[source.below(first)].clone()]
            }
            _ => between.say(from, packet(source, SIDES[from])),
        };
        match source.small(8) {
            0 => line.clear(),
            1 => line.extend(line.clone()),
            2 => {
                for packet in &mut line {
                    let at = source.below(packet.bytes.len().max(1));
                    let change = source.byte();
                    packet
                        .bytes
                        .iter_mut()
                        .skip(at)
                        .take(1)
                        .for_each(|b| *b ^= change);
                }
            }
            _ => {}
        }
        let to = if source.byte() < 16 { from } else { 1 - from };
        for packet in line {
            between.deliver(to, packet);
        }
    }
}

const SIDES: [Sender; 2] = [Sender::Host, Sender::Robot];

/// Both sides, and whoever is between them.
struct Between {
    guards: [Guard; 2],
    /// What each side has said.
    said: [Vec<Packet>; 2],
    /// How much of what the other said each side has passed.
    passed: [usize; 2],
    /// What was ever on the line.
    kept: Vec<Packet>,
}

impl Between {
    fn new(tag: usize) -> Self {
        let key = Key::new(&[1; KEY]).expect("it has the length of a key");
        Self {
            guards: SIDES.map(|side| Guard::new(side, key.clone(), tag, 7)),
            said: Default::default(),
            passed: [0; 2],
            kept: Vec::new(),
        }
    }

    /// What goes over the line when this side says something.
    fn say(&mut self, side: usize, message: Packet) -> Vec<Packet> {
        let sealed = self.guards[side].say(&message);
        self.said[side].push(message);
        sealed.into_iter().collect()
    }

    fn deliver(&mut self, to: usize, packet: Packet) {
        self.kept.push(packet.clone());
        match self.guards[to].hear(&packet) {
            Taken::Nothing => {}
            // Whoever answers is answered at most once more.
            Taken::Answer(answer) => self.deliver(1 - to, answer),
            Taken::Message(message) => {
                let halt = matches!(ToRobot::read(&message), Ok(ToRobot::Halt(_)));
                if packet.id & SEALED == 0 {
                    assert!(halt && SIDES[to] == Sender::Robot, "{message:?} in clear");
                    return;
                }
                let further = self.said[1 - to].iter().skip(self.passed[to]);
                let place = further.clone().position(|said| *said == message);
                let place = place.unwrap_or_else(|| panic!("{message:?} was not said"));
                self.passed[to] += place + 1;
            }
        }
    }
}

/// A packet with the length that its message has.
fn packet(source: &mut Source<'_>, sender: Sender) -> Packet {
    let layout = sender.layouts()[source.below(sender.layouts().len())];
    let bytes = (0..layout.bytes()).map(|_| source.byte()).collect();
    Packet {
        id: layout.id,
        bytes,
    }
}

/// Whatever is taken for a message is put into bytes and read again as the same.
fn packets(source: &mut Source<'_>) {
    let sender = sender(source);
    let packet = match source.flag() {
        true => packet(source, sender),
        false => Packet {
            id: source.word() as u16,
            bytes: (0..source.small(57)).map(|_| source.byte()).collect(),
        },
    };
    if let Ok(message) = ToRobot::read(&packet) {
        assert_eq!(ToRobot::read(&message.packet()), Ok(message));
    }
    if let Ok(message) = FromRobot::read(&packet) {
        assert_eq!(FromRobot::read(&message.packet()), Ok(message));
    }
}

fn sender(source: &mut Source<'_>) -> Sender {
    source.pick(&[Sender::Host, Sender::Robot])
}

/// Packets in frames of which some are lost, doubled or foreign: every one that comes out is one that was sent.
fn bus<const ROOM: usize>(source: &mut Source<'_>) {
    let sender = sender(source);
    let mut assembler = Assembler::new(sender);
    let mut sent: Vec<Packet> = Vec::new();
    let mut whole = 0;
    let mut out = 0;
    while !source.is_over() {
        let packet = packet(source, sender);
        let faults = source.byte();
        let mut complete = true;
        sent.push(packet.clone());
        for frame in frames::<ROOM>(sender, &packet) {
            let fault = if faults < 128 { 0 } else { source.small(8) };
            let times = match fault {
                1 => 0,
                2 => 2,
                _ => 1,
            };
            complete &= fault == 0 || fault > 3;
            if fault == 3 {
                let id = source.word() as u16 & 0x7ff;
                let n = source.small(9);
                let foreign =
                    BusFrame::<ROOM>::new(id, source.bytes(usize::from(n))).expect("it fits");
                // A foreign frame under one of our identifiers is not ours to tell apart here.
                if sender.layouts().iter().all(|l| l.id != id) && id != sender.long_id() {
                    assert_eq!(assembler.take(&foreign), None);
                }
            }
            for _ in 0..times {
                if let Some(Ok(got)) = assembler.take(&frame) {
                    assert!(sent.contains(&got), "{got:?} was never sent");
                    out += 1;
                }
            }
        }
        whole += u32::from(complete);
    }
    assert!(out >= whole, "of {whole} whole messages {out} came");
}

/// Any characters at either end of an adapter; and a frame is the same behind its line.
fn lines(source: &mut Source<'_>) {
    let n = source.small(9);
    let id = source.word() as u16 & 0x7ff;
    let frame = Frame::new(id, source.bytes(usize::from(n))).expect("it fits");
    let (mut ear, mut adapter) = (Lines::new(), Adapter::new());
    while !source.is_over() {
        let character = match source.byte() {
            b if b < 200 => b"tO0123456789ABCDEFSCVL\r\nz"[usize::from(b) % 25],
            _ => source.byte(),
        };
        if let Some(Heard::Frame(heard)) = ear.hear(character) {
            let again = line(&heard);
            let mut lines = Lines::new();
            let heard_again = again.iter().find_map(|c| lines.hear(*c));
            assert_eq!(heard_again, Some(Heard::Frame(heard)));
        }
        if let Some((wanted, answer)) = adapter.take(character) {
            assert!(!answer.is_empty());
            assert!(adapter.is_open() || wanted == Wanted::Nothing);
        }
    }
    ear.hear(CR);
    let heard = line(&frame).iter().find_map(|c| ear.hear(*c));
    assert_eq!(heard, Some(Heard::Frame(frame)));
}
