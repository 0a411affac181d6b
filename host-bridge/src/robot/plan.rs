//! A task as named steps, each with what the hand does and what becomes different by it.

use core::f32::consts::PI;

use super::panda::OPEN;
use super::task::{Act, Effect, Grip, Place, Step, Task};

/// How high above a thing the hand travels, in metres.
const ABOVE: f32 = 0.15;

/// How far from a thing's middle the closed fingers press against it, in metres.
const BESIDE: f32 = 0.05;

/// How low the finger tips go at least, in metres above the table.
const LOWEST: f32 = 0.015;

/// How far a gripped thing is twisted to come loose, in radians to either side.
const TWIST: f32 = 0.5;

/// How far apart the fingers are around a thing, in metres: things are thought of as this wide.
const GRIPPED: f64 = 0.04;

/// Collects steps.
struct Plan {
    steps: Vec<Step>,
    hand: Place,
    about: String,
}

impl Plan {
    fn step(&mut self, name: String, act: Act, effect: Effect) {
        self.steps.push(Step {
            name,
            about: self.about.clone(),
            act,
            effect,
        });
    }

    fn go(&mut self, name: String, [x, y, z]: Place, effect: Effect) {
        self.hand = [x, y, z.max(LOWEST)];
        let (at, turn, lean) = (self.hand, 0.0, 0.0);
        self.step(name, Act::Go(vec![Grip { at, turn, lean }]), effect);
    }

    fn over(&mut self, name: String, place: Place) {
        self.go(name, above(place), Effect::None);
    }

    fn fingers(&mut self, name: String, apart: f64, effect: Effect) {
        self.step(name, Act::Fingers(apart), effect);
    }

    fn open(&mut self) {
        self.fingers("open the hand".into(), OPEN, Effect::None);
    }

    fn lean(&mut self, name: String, lean: f32, effect: Effect) {
        let (at, turn) = (self.hand, 0.0);
        self.step(name, Act::Go(vec![Grip { at, turn, lean }]), effect);
    }

    fn retreat(&mut self) {
        self.over("retreat".into(), self.hand);
    }

    fn let_go(&mut self, thing: &str, verb: &str, effect: Effect) {
        self.fingers(format!("{verb} the {thing}"), OPEN, effect);
        self.retreat();
    }

    /// To a thing and up with it, unless the hand holds it already.
    fn fetch(&mut self, thing: &str, at: Place, held: bool) {
        self.about = thing.into();
        if held {
            return;
        }
        self.open();
        self.over(format!("approach the {thing}"), at);
        self.go(format!("lower to the {thing}"), at, Effect::None);
        let grasps = Effect::Grasp(thing.into());
        self.fingers(format!("grasp the {thing}"), GRIPPED, grasps);
        self.over(format!("lift the {thing}"), at);
    }

    /// Presses a thing along the table with closed fingers.
    fn press(&mut self, thing: &str, from: Place, to: Place) {
        let ([x, y, z], [to_x, to_y, to_z]) = (from, to);
        let way = [to_x - x, to_y - y];
        let far = deictic_core::math::sqrt(way.iter().map(|w| w * w).sum());
        let [ahead_x, ahead_y] = way.map(|w| w / far.max(1e-6) * BESIDE);
        let behind = [x - ahead_x, y - ahead_y, z];
        self.fingers("close the hand".into(), 0.0, Effect::None);
        self.over(format!("approach the {thing}"), behind);
        self.go(format!("touch the {thing}"), behind, Effect::None);
        let end = [to_x - ahead_x, to_y - ahead_y, to_z];
        let lead = [ahead_x, ahead_y, to_z - to_z.max(LOWEST)];
        let pushes = Effect::Push(thing.into(), lead);
        self.go(format!("press the {thing} along"), end, pushes);
        self.retreat();
    }

    /// Grips a thing and turns it to and fro.
    fn twist(&mut self, thing: &str, at: Place) {
        self.open();
        self.over(format!("approach the {thing}"), at);
        self.go(format!("lower to the {thing}"), at, Effect::None);
        self.fingers(format!("grip the {thing}"), GRIPPED, Effect::None);
        let (at, lean) = (self.hand, 0.0);
        let turns = [TWIST, -TWIST, 0.0].map(|turn| Grip { at, turn, lean });
        let loosens = Effect::Loosen(thing.into());
        let name = format!("twist the {thing} loose");
        self.step(name, Act::Go(turns.to_vec()), loosens);
        self.open();
        self.retreat();
    }
}

fn above([x, y, z]: Place) -> Place {
    [x, y, z + ABOVE]
}

/// The steps of a task for a hand that is at `hand` and may hold the task's thing already.
pub fn plan(task: &Task, hand: Place, held: bool) -> Vec<Step> {
    let mut plan = Plan {
        steps: Vec::new(),
        hand,
        about: task.thing().unwrap_or("place").to_owned(),
    };
    let [x, y, z] = hand;
    match task {
        Task::Stop => {}
        Task::MoveUp { by } => {
            plan.about = "place up there".into();
            plan.go("move up".into(), [x, y, z + by], Effect::None);
        }
        Task::Release { thing, to, on } => {
            plan.go(format!("set down the {thing}"), *to, Effect::None);
            let leaves = match on {
                Some((base, feature)) => Effect::LeaveIn(base.clone(), feature),
                None => Effect::LetGo,
            };
            plan.let_go(thing, "let go of", leaves);
        }
        Task::Pick { thing, at } => plan.fetch(thing, *at, held),
        Task::Push { thing, from, to } => plan.press(thing, *from, *to),
        Task::Unglue { thing, at } => plan.twist(thing, *at),
        Task::Pour {
            thing,
            at,
            into,
            over,
            degrees,
        } => {
            plan.fetch(thing, *at, held);
            plan.about.clone_from(into);
            plan.over(format!("move over the {into}"), *over);
            let empties = Effect::Pour(thing.clone(), into.clone(), *degrees);
            let lean = degrees / 180.0 * PI;
            let name = format!("tilt the {thing} by {degrees:.0} degrees");
            plan.lean(name, lean, empties);
            plan.lean(format!("turn the {thing} upright"), 0.0, Effect::None);
            if held {
                plan.go(format!("carry the {thing} back"), *at, Effect::None);
            } else {
                plan.over(format!("carry the {thing} back"), *at);
                plan.go(format!("set down the {thing}"), *at, Effect::None);
                plan.let_go(thing, "let go of", Effect::LetGo);
            }
        }
        Task::PutInto {
            thing,
            at,
            into,
            to,
        } => {
            plan.fetch(thing, *at, held);
            plan.about.clone_from(into);
            plan.over(format!("move over the {into}"), *to);
            plan.go(format!("lower into the {into}"), *to, Effect::None);
            let leaves = Effect::LeaveIn(into.clone(), "full-container");
            plan.let_go(thing, "release", leaves);
        }
        Task::Stack {
            thing,
            at,
            onto,
            to,
        } => {
            plan.fetch(thing, *at, held);
            plan.about.clone_from(onto);
            plan.over(format!("move over the {onto}"), *to);
            plan.go(format!("lower onto the {onto}"), *to, Effect::None);
            let leaves = Effect::LeaveIn(onto.clone(), "full-stack");
            plan.let_go(thing, "release", leaves);
        }
    }
    plan.steps
}
