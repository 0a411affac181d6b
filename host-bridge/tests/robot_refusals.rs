//! The simulated arm refuses what it cannot do, does one thing at a time and nothing twice.

#[path = "common/bench.rs"]
mod bench;

use bench::*;
use deictic::robot::{Refusal, Robot};
use deictic::scene::SceneFile;
use deictic::vocabulary::Lexicon;

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
