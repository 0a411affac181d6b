//! A CAN bus in simulated time on which somebody talks whenever nobody else does.

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use deictic::clock;
use deictic::link::bus::Bus;
use deictic_bits::random::Random;
use deictic_core::can::Frame;
use deictic_core::time::Micros;

/// What the longest frame with an 11-bit identifier takes at 500 kbit/s: 111 bits and 24 stuffed ones.
const FRAME: Micros = Micros(270);

/// The two ends that listen, by their places in the arrays below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The bridge.
    Host,
    /// The robot.
    Robot,
}

struct Wires {
    /// When the frame that is on the bus ends.
    free: Micros,
    /// What each end still has to send.
    waiting: [VecDeque<Frame>; 2],
    /// What has come to each end, and when.
    arrived: [VecDeque<(Micros, Frame)>; 2],
    /// Who talks when nobody else does.
    babbler: Random,
}

impl Wires {
    /// Lets frames go over the bus up to `now`: at each end of a frame the lowest identifier goes next.
    fn run(&mut self, now: Micros) {
        while self.free < now {
            let head = |at: usize| Some((self.waiting[at].front()?.id(), at));
            let next = head(0).into_iter().chain(head(1)).min();
            self.free = self.free.after(FRAME);
            match next.and_then(|(_, at)| Some((at, self.waiting[at].pop_front()?))) {
                Some((at, frame)) => self.arrived[1 - at].push_back((self.free, frame)),
                None => {
                    let frame = self.babble();
                    for arrived in &mut self.arrived {
                        arrived.push_back((self.free, frame.clone()));
                    }
                }
            }
        }
    }

    /// A frame of lower priority than any of ours.
    fn babble(&mut self) -> Frame {
        let id = 0x700 + self.babbler.below(0x100) as u16;
        Frame::new(id, &self.babbler.next().to_le_bytes()).expect("11 bits and 8 bytes")
    }
}

/// An end of the bus.
pub struct Node {
    wires: Arc<Mutex<Wires>>,
    place: Place,
    began: Instant,
}

/// A bus, and its two ends.
#[must_use]
pub fn bus(seed: u64) -> [Node; 2] {
    let wires = Arc::new(Mutex::new(Wires {
        free: Micros(0),
        waiting: Default::default(),
        arrived: Default::default(),
        babbler: Random::new(seed),
    }));
    let began = clock::now();
    [Place::Host, Place::Robot].map(|place| Node {
        wires: Arc::clone(&wires),
        place,
        began,
    })
}

impl Node {
    /// The bus as it is at this moment.
    fn wires(&self) -> (MutexGuard<'_, Wires>, Micros) {
        let now = Micros(clock::since(self.began).as_micros() as u64);
        let mut wires = self.wires.lock().expect("nothing panicked in here");
        wires.run(now);
        (wires, now)
    }
}

impl Bus for Node {
    fn send(&mut self, frame: &Frame) -> io::Result<()> {
        let (mut wires, now) = self.wires();
        wires.free = wires.free.max(now);
        wires.waiting[self.place as usize].push_back(frame.clone());
        Ok(())
    }

    /// Time passes only between two turns of the session, so that there is nothing to wait for.
    fn receive(&mut self, _: Duration) -> io::Result<Option<Frame>> {
        let (mut wires, now) = self.wires();
        let arrived = &mut wires.arrived[self.place as usize];
        let due = arrived.front().is_some_and(|(at, _)| *at <= now);
        Ok(arrived.pop_front_if(|_| due).map(|(_, frame)| frame))
    }
}
