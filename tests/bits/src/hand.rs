//! A hand before a unit, for the instruction budget: a session in which the dearest things a frame
//! can ask for fall together.
//!
//! The unit is taught as many templates as it holds, all alike, so that no comparison gives up early,
//! and has as many things on the table as it holds. The hand points, opens, sweeps along the longest
//! path that is kept whole, rests, and closes. When it closes against the end of the sweep is swept
//! over, so that in some session a fist closes the target word in the frame that compares eight
//! templates. Frames come at 30 per second: the slower they come, the more falls into one.

use deictic_core::board::{self, Entity, Link, Scene, ToUnit, Unit, Vocabulary};
use deictic_core::category::Category;
use deictic_core::gesture::frame::{Finger, HandFrame};
use deictic_core::gesture::line::{FRAMED, send};
use deictic_core::gesture::mapping::{Gesture, STROKES};
use deictic_core::gesture::path::{ROOM, Stroke};
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::template::Template;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::hand::{LEARNED, Meaning, Meanings, TEMPLATES_PART, TemplatesPart};
use deictic_core::protocol::message::{
    ACTIONS_PART, Configuration, ENTITIES_PART, Heartbeat, Hello, ScenePart, VocabularyPart,
};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;

use crate::sample::ACTIONS;

/// Sessions, each of which closes the hand a frame later than the one before.
pub const SESSIONS: u32 = 24;

/// Time from frame to frame: 30 per second.
const FRAME: Micros = Micros(33_333);

/// Frames of each part of a session.
const ARRIVE: u32 = 10;
const POINT: u32 = 20;
const OPEN: u32 = 10;
const SWEEP: u32 = ROOM as u32;
const REST: u32 = 40;
const GONE: u32 = 14;

/// Frames before the end of the sweep at which the hand of the first session closes.
const EARLY: u32 = 4;

/// How far the palm sweeps per frame, mm: further than the 4 mm between points that are kept.
const STEP: f32 = 5.0;

/// Objects and as many storages, 16 things in all.
const THINGS: u8 = board::ENTITIES as u8 / 2;

/// Joints of each finger from the palm in 0.1 mm, thumb first: knuckle, middle, tip. A right hand that
/// is turned down and points forward, of one of the made-up people of `deictic::hand`.
type Joints = [[[i16; 3]; 3]; 5];

const FIVE: Joints = [
    [[-262, -11, 605], [-458, -159, 235], [-640, -359, -296]],
    [[-267, 22, -170], [-267, -24, -642], [-267, -272, -1055]],
    [[-14, 32, -214], [27, -49, -695], [69, -273, -1144]],
    [[205, 37, -178], [284, 4, -627], [369, -142, -1079]],
    [[391, -33, -92], [496, -68, -384], [613, -233, -670]],
];

const POINTING: Joints = [
    [[-262, -11, 605], [-254, -171, 191], [-63, -388, -324]],
    [[-267, 22, -170], [-261, 50, -643], [-255, -78, -1110]],
    [[-14, 32, -214], [-14, -209, -641], [-13, -606, -379]],
    [[205, 37, -178], [204, -201, -568], [203, -478, -230]],
    [[391, -33, -92], [391, -188, -363], [390, -360, -95]],
];

const FIST: Joints = [
    [[-262, -11, 605], [-254, -171, 191], [-63, -388, -324]],
    [[-267, 22, -170], [-237, -138, -615], [-207, -328, -251]],
    [[-14, 32, -214], [-10, -259, -608], [-5, -515, -257]],
    [[205, 37, -178], [186, -255, -530], [166, -448, -140]],
    [[391, -33, -92], [366, -203, -352], [337, -375, -99]],
];

/// A unit and the host that has told it all it needs; at home in a static.
pub struct HandBench {
    unit: Unit,
    host: Link,
    now: Micros,
}

impl Default for HandBench {
    fn default() -> Self {
        Self::new()
    }
}

impl HandBench {
    /// A unit that was told nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            unit: Unit::new(1),
            host: Link::new(),
            now: Micros(1),
        }
    }

    /// Tells the unit vocabulary, scene, gestures and templates.
    pub fn prepare(&mut self) {
        self.say(&ToUnit::Hello(Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: 1,
            capacities: Unit::capacities(),
        }));
        let vocabulary = vocabulary();
        for (actions, first) in ACTIONS
            .chunks(ACTIONS_PART)
            .zip((0..).step_by(ACTIONS_PART))
        {
            self.say(&ToUnit::Vocabulary(VocabularyPart {
                fingerprint: 1,
                parameters: heapless::Vec::from_slice(&[THINGS, THINGS]).unwrap_or_default(),
                features: vocabulary.features() as u8,
                stop: vocabulary.stop(),
                total: ACTIONS.len() as u8,
                first,
                actions: actions.iter().copied().collect(),
            }));
        }
        let scene = scene(&vocabulary);
        let things = scene.entities();
        for (part, first) in things
            .chunks(ENTITIES_PART)
            .zip((0..).step_by(ENTITIES_PART))
        {
            self.say(&ToUnit::Scene(ScenePart {
                version: 1,
                total: things.len() as u8,
                first,
                entities: part.iter().cloned().collect(),
            }));
        }
        self.say(&ToUnit::Configure(Configuration {
            expected: 0b1,
            ..Configuration::DEFAULT
        }));
        self.say(&ToUnit::Meanings(meanings()));
        let Some(sweep) = sweep() else { return };
        for first in (0..LEARNED).step_by(TEMPLATES_PART) {
            let gestures = (first..LEARNED).take(TEMPLATES_PART);
            self.say(&ToUnit::Templates(TemplatesPart {
                total: LEARNED as u8,
                first: first as u8,
                known: true,
                scale: *Templates::KNOWN.scale,
                templates: gestures
                    .map(|i| Template::new(i.checked_rem(STROKES).unwrap_or(0) as u8, &sweep))
                    .collect(),
            }));
        }
    }

    fn say(&mut self, message: &ToUnit) {
        let mut out = Outbox::<512>::new();
        self.host.send(message, &mut out);
        self.unit.receive(self.now, out.waiting());
        self.unit.sent(self.unit.outgoing().len());
    }

    /// The bytes of a session's `k`-th frame; `None` when the session is over. Time goes on, and the
    /// host shows that it lives.
    pub fn next(&mut self, session: u32, k: u32) -> Option<Outbox<FRAMED>> {
        self.now = self.now.after(FRAME);
        self.say(&ToUnit::Heartbeat(Heartbeat {
            now: self.now,
            vocabulary: 1,
            scene: 1,
        }));
        let sample = sample(session, k, self.now.0 as u32)?;
        let mut out = Outbox::new();
        send(&sample, &mut out).ok()?;
        Some(out)
    }

    /// The unit reads a frame from its sensor's line. What it says to it is taken from it.
    pub fn sense(&mut self, bytes: &[u8]) {
        self.unit.sense(self.now, bytes);
    }

    /// Takes what the unit has said, and gives how many bytes it was.
    pub fn hear(&mut self) -> usize {
        let said = self.unit.outgoing().len();
        self.unit.sent(said);
        said
    }

    /// The unit.
    #[must_use]
    pub fn unit(&self) -> &Unit {
        &self.unit
    }
}

fn vocabulary() -> Vocabulary {
    Vocabulary::new(&ACTIONS, &[THINGS, THINGS], 8, Some(2), 1).unwrap_or_default()
}

/// Things in two rows before the hand.
fn scene(vocabulary: &Vocabulary) -> Scene {
    let mut scene = Scene::new(1);
    for (category, far) in [(Category::OBJECT, -0.5), (Category::STORAGE, -0.7)] {
        for option in 0..THINGS {
            let entity = Entity {
                category,
                option,
                position: [far, 0.1 * f32::from(option) - 0.35, 0.05],
                features: heapless::Vec::from_slice(&[0.5; 8]).unwrap_or_default(),
            };
            // Options and features fit the vocabulary above.
            let _ = scene.push(entity, vocabulary);
        }
    }
    scene
}

/// Every dynamic gesture stands for the same action, stacking.
fn meanings() -> Meanings {
    (0..STROKES as u8)
        .map(|stroke| Meaning {
            gesture: Gesture::Stroke(stroke),
            action: 8,
        })
        .collect()
}

/// The sweep itself, so that no comparison gives up.
fn sweep() -> Option<Stroke> {
    let way = (0..SWEEP).map(|k| [STEP * k as f32, 0.0, 0.0]);
    Stroke::new(way, SWEEP as f32 / 30.0)
}

/// A session's `k`-th sample at this time of the sensor.
fn sample(session: u32, k: u32, time: u32) -> Option<Sample> {
    const OPENED: u32 = ARRIVE + POINT;
    const SWEEPING: u32 = OPENED + OPEN;
    const RESTING: u32 = SWEEPING + SWEEP;
    const LEFT: u32 = RESTING + REST;
    if k >= LEFT + GONE {
        return None;
    }
    if k >= LEFT {
        return Some(Sample::Nothing(time));
    }
    let closes = (RESTING - EARLY).saturating_add(session);
    let joints = match k {
        _ if k >= closes => &FIST,
        ARRIVE..OPENED => &POINTING,
        _ => &FIVE,
    };
    let swept = k.saturating_sub(SWEEPING).min(SWEEP);
    let palm = [STEP * (swept as f32 - 0.5 * SWEEP as f32), 220.0, 0.0];
    let moves = (SWEEPING..RESTING).contains(&k);
    let speed = if moves { 600.0 } else { 0.0 };
    let at = |joint: [i16; 3]| {
        let [x, y, z] = joint.map(|n| f32::from(n) / 10.0);
        let [px, py, pz] = palm;
        [px + x, py + y, pz + z]
    };
    Some(Sample::Hand(HandFrame {
        time,
        confidence: 0.9,
        palm,
        velocity: [speed, 0.0, 0.0],
        normal: [0.0, -1.0, 0.0],
        direction: [0.0, 0.0, -1.0],
        fingers: joints.map(|[knuckle, middle, tip]| {
            Some(Finger {
                knuckle: at(knuckle),
                middle: at(middle),
                tip: at(tip),
            })
        }),
        ..HandFrame::default()
    }))
}
