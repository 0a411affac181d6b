//! The simulated arm does what it is told step by step, refuses what it cannot do, stops at any
//! moment, does nothing twice, and leaves the table as it made it.

use deictic::robot::sim::Sim;
use deictic::robot::{Command, CommandId, Event, Refusal, Robot, World};
use deictic::scene::{Change, SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::intent::Parameter;
use deictic_core::large::Intent;
use deictic_core::time::Micros;

struct Bench {
    lexicon: Lexicon,
    table: Tabletop,
    sim: Sim,
    now: Micros,
    number: u32,
}

impl Bench {
    fn new() -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let (sim, now, number) = (Sim::new(1.0), Micros(5), 0);
        Self {
            lexicon,
            table,
            sim,
            now,
            number,
        }
    }

    fn intent(&self, action: &str, things: &[(Category, &str)]) -> Intent {
        let mut intent = Intent {
            action: self.lexicon.option(Category::ACTION, action).unwrap(),
            ..Intent::default()
        };
        for (category, name) in things {
            let option = self.lexicon.option(*category, name).unwrap();
            let (category, quantity) = (*category, None);
            intent
                .parameters
                .push(Parameter {
                    category,
                    option,
                    quantity,
                })
                .unwrap();
        }
        intent
    }

    fn begin_as(&mut self, number: u32, scene: u32, intent: Intent) -> Result<(), Refusal> {
        let id = CommandId { run: 1, number };
        let world = World {
            table: &self.table,
            lexicon: &self.lexicon,
        };
        self.sim
            .begin(self.now, &Command { id, intent, scene }, world)
    }

    fn begin(&mut self, action: &str, things: &[(Category, &str)]) -> Result<(), Refusal> {
        let intent = self.intent(action, things);
        self.number += 1;
        self.begin_as(self.number, self.table.version(), intent)
    }

    /// Lets time pass and takes over what changes.
    fn pass(&mut self, seconds: u64) -> Vec<Event> {
        self.now = self.now.after(Micros::from_millis(seconds * 1000));
        let events = self.sim.poll(self.now);
        for event in &events {
            if let Event::Changed { changes, .. } = event {
                self.table.apply(changes, &self.lexicon).unwrap();
            }
        }
        events
    }

    fn run(&mut self, action: &str, things: &[(Category, &str)]) -> Vec<Event> {
        self.begin(action, things).unwrap();
        let events = self.pass(120);
        let id = CommandId {
            run: 1,
            number: self.number,
        };
        assert_eq!(events.last(), Some(&Event::Done(id)), "{action}");
        events
    }

    fn feature(&self, category: Category, name: &str, feature: &str) -> f32 {
        let option = self.lexicon.option(category, name).unwrap();
        let thing = self.table.find(category, option).unwrap();
        thing.features[self.lexicon.feature(feature).unwrap()]
    }

    fn position(&self, name: &str) -> [f32; 3] {
        let option = self.lexicon.option(Category::OBJECT, name).unwrap();
        self.table.find(Category::OBJECT, option).unwrap().position
    }
}

const O: Category = Category::OBJECT;
const S: Category = Category::STORAGE;

fn steps(events: &[Event]) -> Vec<&str> {
    let named = events.iter().filter_map(|e| match e {
        Event::Begun { step, .. } => Some(step.as_str()),
        _ => None,
    });
    named.collect()
}

#[test]
fn a_pick_is_approach_lower_grasp_and_lift() {
    let mut bench = Bench::new();
    let events = bench.run("pick", &[(O, "can")]);
    assert_eq!(
        steps(&events),
        [
            "open the hand",
            "approach the can",
            "lower to the can",
            "grasp the can",
            "lift the can"
        ]
    );
    assert_eq!(bench.sim.holding(), Some("can"));
    assert!((bench.position("can")[2] - 0.21).abs() < 1e-6);
}

#[test]
fn progress_goes_from_nothing_to_everything() {
    let mut bench = Bench::new();
    bench.begin("pick", &[(O, "can")]).unwrap();
    assert_eq!(bench.sim.progress(bench.now).unwrap().1, 0);
    let mut last = 0;
    while let Some((_, percent)) = bench.sim.progress(bench.now) {
        assert!(percent >= last && percent <= 100);
        last = percent;
        bench.now = bench.now.after(Micros::from_millis(100));
        bench.sim.poll(bench.now);
    }
    assert!(last > 90);
}

#[test]
fn what_a_command_does_is_there_for_the_next_one() {
    let mut bench = Bench::new();
    assert_eq!(
        bench.begin("pick", &[(O, "box")]),
        Err(Refusal::Glued("box".into()))
    );
    bench.run("unglue", &[(O, "box")]);
    assert_eq!(bench.feature(O, "box", "glued"), 0.0);
    bench.run("put-into", &[(O, "box"), (S, "drawer")]);
    assert_eq!(bench.feature(S, "drawer", "full-container"), 1.0);
    assert_eq!(bench.position("box"), [0.5, -0.34, 0.08]);
    assert_eq!(bench.sim.holding(), None);
    let full = bench.begin("put-into", &[(O, "can"), (S, "drawer")]);
    assert_eq!(full, Err(Refusal::Full("drawer".into())));
    bench.run("pick", &[(O, "box")]);
    assert_eq!(bench.feature(S, "drawer", "full-container"), 0.0);
    bench.run("stack", &[(O, "box"), (S, "crackers")]);
    assert_eq!(bench.feature(S, "crackers", "full-stack"), 1.0);
    let covered = bench.begin("stack", &[(O, "cube"), (S, "crackers")]);
    assert_eq!(covered, Err(Refusal::Covered("crackers".into())));
}

#[test]
fn pouring_empties_one_and_fills_the_other() {
    let mut bench = Bench::new();
    let events = bench.run("pour", &[(O, "can"), (S, "bowl")]);
    assert!(steps(&events).contains(&"tilt the can by 90 degrees"));
    assert_eq!(bench.feature(O, "can", "full-liquid"), 0.0);
    assert_eq!(bench.feature(S, "bowl", "full-liquid"), 1.0);
    assert!((bench.position("can")[0] - 0.45).abs() < 1e-6);
    let empty = bench.begin("pour", &[(O, "can"), (S, "bowl")]);
    assert_eq!(empty, Err(Refusal::Empty("can".into())));
}

#[test]
fn pushing_moves_a_thing_where_it_was_said() {
    let mut bench = Bench::new();
    bench.run("push", &[(O, "cube"), (Category::DIRECTION, "left")]);
    let [x, y, z] = bench.position("cube");
    assert!((x - 0.52).abs() < 1e-6 && (y - 0.34).abs() < 1e-6 && (z - 0.02).abs() < 1e-6);
    bench.run("push", &[(O, "can"), (Category::DIRECTION, "back")]);
    assert!((bench.position("can")[0] - 0.35).abs() < 1e-6);
    let mut far = bench.intent("push", &[(O, "cube"), (Category::DIRECTION, "forward")]);
    let distance = bench
        .lexicon
        .option(Category::DISTANCE, "distance")
        .unwrap();
    let (category, option, quantity) = (Category::DISTANCE, distance, Some(0.4));
    far.parameters
        .push(Parameter {
            category,
            option,
            quantity,
        })
        .unwrap();
    let version = bench.table.version();
    assert!(matches!(
        bench.begin_as(9, version, far.clone()),
        Err(Refusal::OutOfReach(_))
    ));
    for bad in [f32::NAN, f32::INFINITY, -1.0, 3.0] {
        far.parameters.last_mut().unwrap().quantity = Some(bad);
        assert!(matches!(
            bench.begin_as(9, version, far.clone()),
            Err(Refusal::TooFar(_))
        ));
    }
}

#[test]
fn what_cannot_be_done_is_refused_and_nothing_moves() {
    let mut bench = Bench::new();
    let before = bench.table.clone();
    let refused = [
        ("release", vec![], Refusal::NothingHeld),
        ("pick", vec![], Refusal::Missing("object")),
        (
            "pick",
            vec![(O, "cleaner")],
            Refusal::OutOfReach("cleaner".into()),
        ),
        ("unglue", vec![(O, "can")], Refusal::NotGlued("can".into())),
        (
            "pour",
            vec![(O, "cup"), (S, "bowl")],
            Refusal::Empty("cup".into()),
        ),
        (
            "put-into",
            vec![(O, "can"), (S, "foam")],
            Refusal::Unfit {
                thing: "foam".into(),
                wanted: "container",
            },
        ),
        ("put-into", vec![(O, "can")], Refusal::Missing("storage")),
    ];
    for (action, things, why) in refused {
        assert_eq!(bench.begin(action, &things), Err(why.clone()), "{action}");
        assert!(!why.remedy().is_empty() && !why.to_string().is_empty());
        assert_eq!(bench.pass(10), []);
    }
    assert_eq!(bench.table, before);
    let empty = SceneFile::parse("x", "").unwrap();
    bench.table = empty.tabletop(&bench.lexicon).unwrap();
    assert_eq!(
        bench.begin("pick", &[(O, "can")]),
        Err(Refusal::NotHere("can".into()))
    );
}

#[test]
fn a_hand_that_is_full_takes_nothing_else() {
    let mut bench = Bench::new();
    bench.run("pick", &[(O, "can")]);
    let holding = Refusal::Holding("can".into());
    assert_eq!(bench.begin("pick", &[(O, "cup")]), Err(holding.clone()));
    assert_eq!(bench.begin("push", &[(O, "cup")]), Err(holding.clone()));
    assert_eq!(
        bench.begin("stack", &[(O, "cup"), (S, "foam")]),
        Err(holding.clone())
    );
    assert_eq!(bench.begin("unglue", &[(O, "box")]), Err(holding));
    bench.run("put-into", &[(O, "can"), (S, "bowl")]);
    bench.run("pick", &[(O, "cup")]);
    let events = bench.run("release", &[]);
    assert_eq!(
        steps(&events),
        ["set down the cup", "let go of the cup", "retreat"]
    );
    assert_eq!(bench.sim.holding(), None);
    assert!((bench.position("cup")[2] - 0.05).abs() < 1e-6);
}

#[test]
fn only_one_command_at_a_time_only_once_and_only_on_the_present_scene() {
    let mut bench = Bench::new();
    let pick = bench.intent("pick", &[(O, "can")]);
    assert_eq!(
        bench.begin_as(4, 7, pick.clone()),
        Err(Refusal::StaleScene {
            decided_on: 7,
            present: 1
        })
    );
    bench.begin_as(4, 1, pick.clone()).unwrap();
    assert_eq!(bench.begin_as(4, 1, pick.clone()), Err(Refusal::Repeated));
    assert_eq!(bench.begin_as(5, 1, pick.clone()), Err(Refusal::Busy));
    bench.pass(60);
    for number in [4, 3] {
        assert_eq!(
            bench.begin_as(number, bench.table.version(), pick.clone()),
            Err(Refusal::Repeated)
        );
    }
}

#[test]
fn a_stop_stops_at_every_moment_and_keeps_what_the_hand_holds() {
    for tenth in 0..120 {
        let mut bench = Bench::new();
        bench
            .begin("put-into", &[(O, "can"), (S, "drawer")])
            .unwrap();
        bench.now = bench.now.after(Micros::from_millis(100 * tenth));
        bench.number += 1;
        let stop = bench.intent("stop", &[]);
        bench.begin_as(bench.number, 999, stop).unwrap();
        let events = bench.pass(0);
        let id = CommandId { run: 1, number: 1 };
        let over = events.contains(&Event::Done(id));
        let stopped = events
            .iter()
            .any(|e| matches!(e, Event::Stopped { id: i, .. } if *i == id));
        assert!(over != stopped, "{tenth}");
        assert_eq!(bench.pass(60), [], "nothing moves after a stop");
        if stopped && bench.sim.holding() == Some("can") {
            let moved = events.iter().rev().find_map(|e| match e {
                Event::Changed { changes, .. } => changes.last().cloned(),
                _ => None,
            });
            assert!(matches!(moved, Some(Change::Moved { .. })));
            bench.run("put-into", &[(O, "can"), (S, "bowl")]);
        }
    }
}

#[test]
fn an_action_of_the_users_own_stands_for_its_motion() {
    let text = r#"
        name = "x"
        [[action]]
        name = "zvedni"
        motion = "pick"
        compulsory = ["object"]
        [[action]]
        name = "dance"
        [[object]]
        name = "can"
    "#;
    let mut bench = Bench::new();
    bench.lexicon = Lexicon::parse("x", text).unwrap();
    let scene = "[[object]]\nname = \"can\"\nposition = [0.4, 0, 0.1]";
    bench.table = SceneFile::parse("x", scene)
        .unwrap()
        .tabletop(&bench.lexicon)
        .unwrap();
    assert_eq!(
        bench.begin("dance", &[]),
        Err(Refusal::UnknownMotion("dance".into()))
    );
    bench.run("zvedni", &[(O, "can")]);
    assert_eq!(bench.sim.holding(), Some("can"));
}
