//! The whole unit under a mock clock: a host that says sensible and senseless things in any order, damage on the line
//! in between, a hand sensor that sees anything, time that passes in any steps. What it says is always in order, and it never tells anybody to move
//! unless everything that a decision needs is there.

mod hearing;
mod saying;

use deictic_core::board::{Link, ToUnit, Unit, Vocabulary};
use deictic_core::gesture::mapping::Gesture;
use deictic_core::protocol::hand::{HandSettings, Meaning};
use deictic_core::protocol::message::{Configuration, Heartbeat, Hello, RobotState, RobotStatus};
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;
use deictic_core::unit::HOST_LOST;

use super::situation;
use super::source::Source;

/// What the host knows of a unit from what it has heard.
struct Host {
    unit: Box<Unit>,
    now: Micros,
    mouth: Link,
    ear: Link,
    /// What was said and not yet delivered.
    line: Vec<u8>,
    vocabulary: Vocabulary,
    version: u32,
    /// When the unit last took a frame.
    spoke: Micros,
    open: bool,
    loaded: Option<u32>,
    scene: u32,
    newest: u32,
    decisions: u32,
    hellos: u32,
    /// Whether a Hello has come that may have cut short what was being said before.
    cut: bool,
}

/// Does what the bytes say, one thing after the other.
pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let mut host = Host {
        unit: Box::new(Unit::new(7)),
        now: Micros(0),
        mouth: Link::new(),
        ear: Link::new(),
        line: Vec::new(),
        vocabulary: situation::vocabulary(&mut source),
        version: 0,
        spoke: Micros(0),
        open: false,
        loaded: None,
        scene: 0,
        newest: 0,
        decisions: 0,
        hellos: 0,
        cut: false,
    };
    if source.flag() {
        host.open(&mut source);
    }
    while !source.is_over() {
        host.step(&mut source);
    }
}

impl Host {
    /// Everything up to a configured unit with a scene.
    fn open(&mut self, source: &mut Source<'_>) {
        self.say(&ToUnit::Hello(hello(VERSION, SCHEMA)));
        self.say_vocabulary();
        self.say_scene(source);
        self.deliver(usize::MAX);
        self.listen(usize::MAX);
    }

    fn step(&mut self, source: &mut Source<'_>) {
        match source.small(30) {
            0 => self.pass(Micros(u64::from(source.word()))),
            1 | 2 => self.pass(Micros(u64::from(source.byte()) * 10_000)),
            3 => self.poll(),
            4 => self.listen(usize::MAX),
            5 => self.listen(usize::from(source.byte())),
            6 => {
                let n = source.small(64);
                self.line.extend(source.bytes(usize::from(n)));
            }
            7 => self.damage(source),
            8 => self.deliver(usize::from(source.byte())),
            9 => self.open(source),
            10 => self.say_scene(source),
            11 => {
                let profile = match source.byte() {
                    0 => deictic_core::profile::Profile {
                        lead: source.float(),
                        least_h: source.float(),
                        ..situation::profile(source)
                    },
                    _ => situation::profile(source),
                };
                self.say(&ToUnit::Configure(Configuration {
                    profile,
                    window: Micros(u64::from(source.byte()) * 20_000),
                    expected: source.byte(),
                    explain: source.flag(),
                }));
            }
            12..=15 => self.say_sentence(source),
            16 => {
                let state = source.pick(&[
                    RobotState::Running(3),
                    RobotState::Done,
                    RobotState::Refused,
                    RobotState::Stopped,
                ]);
                let decision = self.newest;
                self.say(&ToUnit::Robot(RobotStatus { decision, state }));
            }
            17 => self.say(&ToUnit::AskStatistics),
            18 => self.say(&ToUnit::Heartbeat(Heartbeat {
                now: self.now,
                vocabulary: 0,
                scene: 0,
            })),
            20 => {
                let n = source.small(100);
                let bytes = source.bytes(usize::from(n));
                self.unit.sense(self.now, bytes);
            }
            21..=24 => self.show(source),
            25 => {
                let sound = source.flag();
                let mut float = |usual: f32| if sound { usual } else { source.float() };
                let mut settings = HandSettings::DEFAULT;
                settings.mount.origin = [float(0.5), float(0.0), float(0.3)];
                settings.aim.sigma = float(0.05);
                settings.aim.nothing = float(0.1);
                self.say(&ToUnit::Hand(settings));
            }
            26 => {
                let actions = self.vocabulary.actions().len() as u8;
                let meanings = (0..source.small(6)).map(|_| {
                    let number = source.small(12);
                    Meaning {
                        gesture: match source.flag() {
                            true => Gesture::Shape(number),
                            false => Gesture::Stroke(number),
                        },
                        action: source.small(actions.saturating_add(1)),
                    }
                });
                let meanings = meanings.collect();
                self.say(&ToUnit::Meanings(meanings));
            }
            27 => self.say(&ToUnit::AskHand),
            28 => match source.small(8) {
                flag @ (0 | 1) => self.say(&ToUnit::Relay(flag == 1)),
                beyond => self.say(&ToUnit::Forbid(beyond - 2)),
            },
            _ => {
                let version = u16::from(source.byte());
                let schema = source.word();
                self.say(&ToUnit::Hello(hello(version, schema)));
            }
        }
        if self.line.len() > 4096 {
            self.deliver(usize::MAX);
        }
    }

    fn pass(&mut self, span: Micros) {
        // A loop that keeps to next_wake; a few turns of it, as after a long sleep everything is due at once.
        let until = self.now.after(span);
        for _ in 0..4 {
            let wake = self.unit.next_wake();
            if wake > until || wake <= self.now {
                break;
            }
            self.now = wake;
            self.poll();
            self.listen(usize::MAX);
        }
        self.now = until;
    }

    fn poll(&mut self) {
        self.unit.poll(self.now);
        if self.now.since(self.spoke) >= HOST_LOST {
            assert_eq!(
                self.unit.next_wake(),
                Micros::NEVER,
                "a silent host is given up"
            );
        }
    }
}

fn hello(version: u16, schema: u32) -> Hello {
    Hello {
        version,
        schema,
        boot: 1,
        capacities: Unit::capacities(),
    }
}
