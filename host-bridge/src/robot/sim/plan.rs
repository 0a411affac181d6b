//! A task as named motions, each with where the hand ends and what becomes different by it.

/// How high above a thing the hand travels, in metres.
const ABOVE: f32 = 0.15;

/// A checked command.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Task {
    Stop,
    MoveUp {
        by: f32,
    },
    Release {
        thing: String,
    },
    Pick {
        thing: String,
        at: Place,
    },
    Push {
        thing: String,
        from: Place,
        to: Place,
    },
    Unglue {
        thing: String,
        at: Place,
    },
    Pour {
        thing: String,
        at: Place,
        into: String,
        over: Place,
        degrees: f32,
    },
    PutInto {
        thing: String,
        at: Place,
        into: String,
        to: Place,
    },
    Stack {
        thing: String,
        at: Place,
        onto: String,
        to: Place,
    },
}

/// Metres in the robot's base frame.
pub(super) type Place = [f32; 3];

/// One motion.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    /// What the arm does, in words.
    pub name: String,
    /// Where the hand is at its end.
    pub hand: Place,
    /// What is different at its end.
    pub effect: Effect,
}

/// What a motion does to the things on the table.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Effect {
    /// Nothing, but that a held thing comes along.
    None,
    /// The thing is in the hand.
    Grasp(String),
    /// The thing has left the hand, and rests where the hand is.
    LetGo,
    /// As [`Effect::LetGo`], and the thing fills or covers another: its name, and the feature that
    /// tells so.
    LeaveIn(String, &'static str),
    /// The thing is pushed to where the hand is.
    Push(String),
    /// The thing is loose.
    Loosen(String),
    /// What was in the first is in the second.
    Pour(String, String),
}

/// Collects motions.
struct Plan {
    steps: Vec<Step>,
    hand: Place,
}

impl Plan {
    fn go(&mut self, name: String, hand: Place, effect: Effect) {
        self.steps.push(Step { name, hand, effect });
        self.hand = hand;
    }

    fn here(&mut self, name: String, effect: Effect) {
        self.go(name, self.hand, effect);
    }

    fn over(&mut self, name: String, place: Place) {
        self.go(name, above(place), Effect::None);
    }

    /// To a thing and up with it, unless the hand holds it already.
    fn fetch(&mut self, thing: &str, at: Place, held: bool) {
        if held {
            return;
        }
        self.here("open the hand".into(), Effect::None);
        self.over(format!("approach the {thing}"), at);
        self.go(format!("lower to the {thing}"), at, Effect::None);
        self.here(format!("grasp the {thing}"), Effect::Grasp(thing.into()));
        self.over(format!("lift the {thing}"), at);
    }
}

fn above([x, y, z]: Place) -> Place {
    [x, y, z + ABOVE]
}

/// The motions of a task for a hand that is at `hand` and may hold the task's thing already.
pub(super) fn plan(task: &Task, hand: Place, held: bool) -> Vec<Step> {
    let steps = Vec::new();
    let mut plan = Plan { steps, hand };
    let [x, y, z] = hand;
    match task {
        Task::Stop => {}
        Task::MoveUp { by } => {
            plan.go("move up".into(), [x, y, z + by], Effect::None);
        }
        Task::Release { thing } => {
            plan.go(format!("set down the {thing}"), [x, y, 0.05], Effect::None);
            plan.here(format!("let go of the {thing}"), Effect::LetGo);
            plan.over("retreat".into(), [x, y, 0.05]);
        }
        Task::Pick { thing, at } => plan.fetch(thing, *at, held),
        Task::Push { thing, from, to } => {
            plan.here("close the hand".into(), Effect::None);
            plan.over(format!("approach the {thing}"), *from);
            plan.go(format!("touch the {thing}"), *from, Effect::None);
            plan.go(
                format!("press the {thing} along"),
                *to,
                Effect::Push(thing.clone()),
            );
            plan.over("retreat".into(), *to);
        }
        Task::Unglue { thing, at } => {
            plan.here("open the hand".into(), Effect::None);
            plan.over(format!("approach the {thing}"), *at);
            plan.go(format!("lower to the {thing}"), *at, Effect::None);
            plan.here(format!("grip the {thing}"), Effect::None);
            plan.here(
                format!("twist the {thing} loose"),
                Effect::Loosen(thing.clone()),
            );
            plan.over("retreat".into(), *at);
        }
        Task::Pour {
            thing,
            at,
            into,
            over,
            degrees,
        } => {
            plan.fetch(thing, *at, held);
            plan.over(format!("move over the {into}"), *over);
            let empties = Effect::Pour(thing.clone(), into.clone());
            plan.here(format!("tilt the {thing} by {degrees:.0} degrees"), empties);
            plan.here(format!("turn the {thing} upright"), Effect::None);
            plan.over(format!("carry the {thing} back"), *at);
            if !held {
                plan.go(format!("set down the {thing}"), *at, Effect::None);
                plan.here(format!("let go of the {thing}"), Effect::LetGo);
                plan.over("retreat".into(), *at);
            }
        }
        Task::PutInto {
            thing,
            at,
            into,
            to,
        } => {
            plan.fetch(thing, *at, held);
            plan.over(format!("move over the {into}"), *to);
            plan.go(format!("lower into the {into}"), *to, Effect::None);
            let leaves = Effect::LeaveIn(into.clone(), "full-container");
            plan.here(format!("release the {thing}"), leaves);
            plan.over("retreat".into(), *to);
        }
        Task::Stack {
            thing,
            at,
            onto,
            to,
        } => {
            plan.fetch(thing, *at, held);
            plan.over(format!("move over the {onto}"), *to);
            let [x, y, z] = *to;
            plan.go(
                format!("lower onto the {onto}"),
                [x, y, z + 0.05],
                Effect::None,
            );
            let leaves = Effect::LeaveIn(onto.clone(), "full-stack");
            plan.here(format!("release the {thing}"), leaves);
            plan.over("retreat".into(), *to);
        }
    }
    plan.steps
}

impl Task {
    /// The thing it is done to.
    pub(super) fn thing(&self) -> Option<&str> {
        match self {
            Self::Stop | Self::MoveUp { .. } => None,
            Self::Release { thing }
            | Self::Pick { thing, .. }
            | Self::Push { thing, .. }
            | Self::Unglue { thing, .. }
            | Self::Pour { thing, .. }
            | Self::PutInto { thing, .. }
            | Self::Stack { thing, .. } => Some(thing),
        }
    }
}
