//! The whole unit under a mock clock: a host that says sensible and senseless things in any order, damage on the line
//! in between, a hand sensor that sees anything, time that passes in any steps. What it says is always in order, and it never tells anybody to move
//! unless everything that a decision needs is there.

use deictic_core::board::{Link, Scene, ToHost, ToUnit, Unit, Vocabulary};
use deictic_core::decide::Outcome;
use deictic_core::gesture::frame::{FINGERS, Finger, HandFrame};
use deictic_core::gesture::line::send;
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::hand::{HandSettings, Meaning};
use deictic_core::protocol::message::{
    ACTIONS_PART, Configuration, ENTITIES_PART, Heartbeat, Hello, Loaded, RobotState, RobotStatus,
    ScenePart, SentencePart, VocabularyPart, WORDS_PART,
};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;
use deictic_core::unit::{HEARTBEAT, HOST_LOST};

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
            28 => self.say(&ToUnit::Relay(source.flag())),
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

    fn say(&mut self, message: &ToUnit) {
        self.hellos += u32::from(matches!(message, ToUnit::Hello(_)));
        let mut out = Outbox::<2048>::new();
        assert!(self.mouth.send(message, &mut out));
        self.line.extend(out.waiting());
    }

    fn say_vocabulary(&mut self) {
        let vocabulary = self.vocabulary.clone();
        for (i, part) in vocabulary.actions().chunks(ACTIONS_PART).enumerate() {
            self.say(&ToUnit::Vocabulary(VocabularyPart {
                fingerprint: vocabulary.fingerprint(),
                parameters: vocabulary.options().iter().skip(1).copied().collect(),
                features: vocabulary.features() as u8,
                stop: vocabulary.stop(),
                total: vocabulary.actions().len() as u8,
                first: (i * ACTIONS_PART) as u8,
                actions: part.iter().copied().collect(),
            }));
        }
    }

    fn say_scene(&mut self, source: &mut Source<'_>) {
        let scene: Scene = situation::scene(source, &self.vocabulary);
        self.version += 1 + u32::from(source.small(3));
        let entities = scene.entities();
        for i in 0..entities.len().div_ceil(ENTITIES_PART).max(1) {
            self.say(&ToUnit::Scene(ScenePart {
                version: self.version,
                total: entities.len() as u8,
                first: (i * ENTITIES_PART) as u8,
                entities: entities
                    .iter()
                    .skip(i * ENTITIES_PART)
                    .take(ENTITIES_PART)
                    .cloned()
                    .collect(),
            }));
        }
    }

    fn say_sentence(&mut self, source: &mut Source<'_>) {
        let modality = source.small(5);
        let sentence = situation::sentence(source, modality, &self.vocabulary);
        let answers = source
            .flag()
            .then(|| self.newest.wrapping_add(u32::from(source.small(2))));
        let words = sentence.words();
        for i in 0..words.len().div_ceil(WORDS_PART).max(1) {
            self.say(&ToUnit::Sentence(SentencePart {
                modality,
                answers,
                total: words.len() as u8,
                first: (i * WORDS_PART) as u8,
                words: words
                    .iter()
                    .skip(i * WORDS_PART)
                    .take(WORDS_PART)
                    .cloned()
                    .collect(),
            }));
        }
    }

    /// The sensor's line sees a hand for some frames, or nothing.
    fn show(&mut self, source: &mut Source<'_>) {
        let mut out = Outbox::<128>::new();
        for _ in 0..1 + source.small(12) {
            self.now = self.now.after(Micros(9_000));
            let time = self.now.0 as u32;
            let sample = match source.byte() {
                0..=200 => Sample::Hand(hand(source, time)),
                _ => Sample::Nothing(time),
            };
            if send(&sample, &mut out).is_ok() {
                self.unit.sense(self.now, out.waiting());
                out.clear();
            }
        }
    }

    /// Changes one byte of what is on the line, leaves one out or doubles it.
    fn damage(&mut self, source: &mut Source<'_>) {
        if self.line.is_empty() {
            return;
        }
        let at = (source.word() as usize) % self.line.len();
        match source.small(3) {
            0 => self.line[at] ^= source.byte(),
            1 => drop(self.line.remove(at)),
            _ => self.line.insert(at, source.byte()),
        }
    }

    /// Gives the unit up to `n` bytes of what was said.
    fn deliver(&mut self, n: usize) {
        let n = n.min(self.line.len());
        let bytes: Vec<u8> = self.line.drain(..n).collect();
        let before = self.unit.statistics().link.received;
        self.unit.receive(self.now, &bytes);
        if self.unit.statistics().link.received != before {
            self.spoke = self.now;
        }
    }

    /// Takes up to `n` bytes of what the unit said, and holds it against what may be said.
    fn listen(&mut self, n: usize) {
        let waiting = self.unit.outgoing();
        let bytes = waiting[..n.min(waiting.len())].to_vec();
        self.unit.sent(bytes.len());
        for byte in bytes {
            if let Some(heard) = self.ear.receive::<ToHost>(byte) {
                self.hear(heard.message);
            }
        }
        // A Hello cuts short what was being said; nothing else does.
        let counters = self.ear.counters();
        assert!(counters.malformed + counters.corrupt <= self.hellos);
        assert_eq!((counters.undecodable, counters.oversized), (0, 0));
    }

    fn hear(&mut self, message: ToHost) {
        match message {
            ToHost::Hello(_) => {
                self.loaded = None;
                self.scene = 0;
                self.open = true;
                self.cut = true;
            }
            ToHost::Loaded(Loaded::Vocabulary(fingerprint)) => {
                self.loaded = Some(fingerprint);
                self.scene = 0;
            }
            ToHost::Loaded(Loaded::Scene(version)) => {
                assert!(version > self.scene);
                self.scene = version;
            }
            ToHost::Decision(decided) => {
                // Whoever has not been greeted, or has fallen silent, hears no decision.
                assert!(self.open);
                // What did not fit the outbox was not said, and shows as a gap.
                let complete = self.unit.statistics().link.unsent == 0;
                assert!(decided.number > self.newest);
                assert!(!complete || self.cut || decided.number == self.newest + 1);
                self.cut = false;
                self.newest = decided.number;
                self.decisions += 1;
                if let Outcome::Execute(intent) = &decided.decision.outcome {
                    let stop = self.vocabulary.stop() == Some(intent.action);
                    assert!(usize::from(intent.action) < self.vocabulary.actions().len());
                    assert!(!complete || Some(decided.vocabulary) == self.loaded);
                    assert!(!complete || decided.scene == self.scene);
                    assert!(stop || decided.scene > 0, "nothing moves without a scene");
                }
            }
            ToHost::Heartbeat(beat) => assert!(beat.now <= self.now),
            ToHost::Statistics(statistics) => {
                let decided = statistics.executes + statistics.asks + statistics.repeats;
                assert!(decided >= self.decisions);
            }
            _ => {}
        }
        if self.open && self.unit.next_wake() != Micros::NEVER {
            assert!(self.unit.next_wake() <= self.now.after(HOST_LOST.max(HEARTBEAT)));
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

/// A hand with its fingers straight or folded, somewhere above the sensor.
fn hand(source: &mut Source<'_>, time: u32) -> HandFrame {
    let mut place = |reach: f32| (f32::from(source.byte()) - 128.0) / 128.0 * reach;
    let palm = [place(200.0), 200.0 + place(100.0), place(200.0)];
    let velocity = [place(500.0), place(500.0), place(500.0)];
    let odd = source.byte();
    let mut fingers = [None; FINGERS];
    for (i, finger) in (0_u8..).zip(&mut fingers) {
        let straight = source.flag();
        let [x, y, z] = palm;
        let side = (f32::from(i) - 2.0) * 20.0;
        let point = |along: f32, down: f32| [x + side, y - down, z - along];
        *finger = (odd != i).then(|| Finger {
            knuckle: point(40.0, 0.0),
            middle: point(80.0, 0.0),
            tip: if straight {
                point(130.0, 0.0)
            } else {
                point(50.0, 30.0)
            },
        });
    }
    HandFrame {
        time,
        confidence: 1.0,
        palm,
        velocity,
        normal: [0.0, -1.0, 0.0],
        direction: [0.0, 0.0, -1.0],
        fingers,
        ..HandFrame::default()
    }
}
