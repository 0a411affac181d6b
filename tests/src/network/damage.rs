//! Frames that were damaged on the line: none of them may be taken for anything.

use deictic_bits::random::Random;
use deictic_core::board;
use deictic_core::decide::{Decision, Outcome};
use deictic_core::large::{self, ToHost};
use deictic_core::protocol::link::Link;
use deictic_core::protocol::message::{Decided, Heartbeat, Hello, Loaded, ToHost as Said};
use deictic_core::protocol::seal::{KEY, Key, Nonces, Way};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;

use super::line::{flip, smear};

/// What became of damaged frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// How many there were.
    pub frames: u64,
    /// Of these, whose damage put back what was there.
    pub intact: u64,
    /// Damaged ones that were taken.
    pub accepted: u64,
}

/// A link as it is after both ends have shown to have a key.
fn sealed<const FRAME: usize>(way: Way) -> Link<FRAME> {
    let mut link = Link::new();
    if let Some(key) = Key::new(&[7; KEY]) {
        link.lock(key, way);
        link.seal(Nonces { unit: 1, host: 2 });
    }
    link
}

/// Sends so many frames of all kinds, every second one sealed, each damaged: one to eight bits flipped, up to 32 bits in
/// a row made random, or cut short.
///
/// # Panics
/// When a frame that is not damaged is not taken.
#[must_use]
pub fn damaged_frames(frames: u64, seed: u64) -> Report {
    let mut random = Random::new(seed);
    let mut report = Report {
        frames,
        ..Report::default()
    };
    for i in 0..frames {
        let (mut mouth, mut ear) = match i % 2 {
            0 => (board::Link::new(), large::Link::new()),
            _ => (sealed(Way::ToHost), sealed(Way::ToUnit)),
        };
        let mut out = Outbox::<512>::new();
        let message = message(&mut random);
        assert!(mouth.send(&message, &mut out));
        let sound = out.waiting().to_vec();
        let mut frame = sound.clone();
        match random.below(3) {
            0 => flip(&mut frame, &mut random),
            1 => smear(&mut frame, &mut random),
            _ => {
                frame.truncate(random.below(frame.len() as u32) as usize);
                frame.push(0);
            }
        }
        // A zero behind it ends what is left.
        let intact = frame == sound;
        frame.push(0);
        let taken = frame
            .iter()
            .filter(|byte| ear.receive::<ToHost>(**byte).is_some());
        let taken = taken.count() as u64;
        if intact {
            report.intact += 1;
            assert_eq!(taken, 1, "it is as it was sent, and not taken");
        } else {
            report.accepted += taken;
        }
    }
    report
}

/// Something a unit says.
fn message(random: &mut Random) -> board::ToHost {
    match random.below(4) {
        0 => Said::Hello(Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: random.next() as u32,
            capacities: board::Unit::capacities(),
        }),
        1 => Said::Heartbeat(Heartbeat {
            now: Micros(random.next() >> random.below(60)),
            vocabulary: random.next() as u32,
            scene: random.below(1000),
        }),
        2 => Said::Loaded(Loaded::Scene(random.below(1000))),
        _ => Said::Decision(Decided {
            number: random.below(5000),
            vocabulary: random.next() as u32,
            scene: random.below(1000),
            modalities: 3,
            questions_left: 0,
            decision: Decision {
                outcome: Outcome::Execute(board::Intent {
                    action: random.below(9) as u8,
                    ..board::Intent::default()
                }),
                best: None,
            },
        }),
    }
}
