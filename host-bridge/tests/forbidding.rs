//! "Don't": what is shown with it is not done, whichever comes first, whatever becomes of the link; and what the robot is
//! doing stops.

mod common;

use std::time::Duration;

use common::*;
use deictic::clock::Simulated;
use deictic::language::Listener;
use deictic::robot::Event;
use deictic::session::{Happening, Session};
use deictic::showing::showing;
use deictic::unit::Loss;
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::large::{Sentence, ToUnit};
use deictic_core::sentence::LANGUAGE;
use proptest::prelude::*;

/// What a gesture is called in a set of modalities.
const SHOWN: Happening = Happening::Withheld { modalities: 0b1 };

fn pick(lexicon: &Lexicon) -> Sentence {
    showing("pick cup", lexicon).unwrap()
}

fn is_stopped(h: &Happening) -> bool {
    matches!(h, Happening::Robot(Event::Stopped { .. }))
}

fn begun(h: &Happening) -> bool {
    matches!(h, Happening::Robot(Event::Begun { number: 2, .. }))
}

#[test]
fn what_is_shown_before_or_after_it_is_not_done_and_what_comes_later_is() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    session.observe(pick(&lexicon)).unwrap();
    session.forbid().unwrap();
    let mut happened = settle(&mut session);
    assert!(session.forbids(), "the window is still open");
    session.observe(pick(&lexicon)).unwrap();
    happened.extend(settle(&mut session));
    assert!(!moved(&happened), "{happened:#?}");
    let withheld = happened.iter().filter(|h| **h == SHOWN).count();
    assert_eq!(withheld, 2, "{happened:#?}");
    session.observe(surely_said("pick cup", &lexicon)).unwrap();
    session.observe(pick(&lexicon)).unwrap();
    assert!(settle(&mut session).iter().any(is_done));
}

#[test]
fn a_prohibition_that_is_lost_on_the_way_overrules_all_the_same() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    cable.with(|line| line.swallow = Some(|m| matches!(m, ToUnit::Forbid(_))));
    session.observe(pick(&lexicon)).unwrap();
    session.forbid().unwrap();
    let mut happened = until(&mut session, |h| matches!(h, Happening::Lost(Loss::Late)));
    cable.with(|line| line.swallow = None);
    happened.extend(settle(&mut session));
    assert!(happened.contains(&Happening::Overruled), "{happened:#?}");
    assert!(!moved(&happened), "{happened:#?}");
    session.observe(pick(&lexicon)).unwrap();
    assert!(settle(&mut session).iter().any(is_done));
}

#[test]
fn a_unit_that_starts_anew_within_the_window_is_told_again() {
    let clock = Simulated::start();
    let (cable, lexicon) = (Cable::new(), lexicon());
    let robot = Box::new(deictic::robot::sim::Sim::new(1000.0));
    let window = deictic_core::time::Micros::from_millis(30_000);
    let mut session = open_within(&cable, &lexicon, robot, table(&lexicon), window);
    session.forbid().unwrap();
    settle(&mut session);
    cable.restart();
    clock.advance(Duration::from_millis(600));
    until(&mut session, |h| matches!(h, Happening::Back(_)));
    settle(&mut session);
    session.observe(pick(&lexicon)).unwrap();
    let happened = settle(&mut session);
    assert_eq!(happened, [SHOWN]);
}

#[test]
fn a_refusal_stops_the_arm_and_what_waits() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1.0);
    session.observe(pick(&lexicon)).unwrap();
    session.queue([surely_said("pick can", &lexicon)]);
    until(&mut session, begun);
    cable.with(|line| line.dead = true);
    assert!(session.refuse().is_ok());
    let happened = session.turn(Duration::ZERO);
    assert!(happened.iter().any(is_stopped), "{happened:#?}");
    assert!(happened.contains(&Happening::Dropped(1)), "{happened:#?}");
    assert_eq!(session.progress(), None);
}

#[test]
fn a_question_does_not_stop_the_arm() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 50.0);
    session.observe(pick(&lexicon)).unwrap();
    until(&mut session, begun);
    session.forbid().unwrap();
    let happened = settle(&mut session);
    assert!(happened.iter().any(is_done), "{happened:#?}");
}

#[test]
fn a_correction_keeps_what_it_does_not_speak_of() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let listener = Listener::new(&lexicon).unwrap();
    let mut session = open(&cable, &lexicon, 1.0);
    let corrected = |session: &Session<'_>, text: &str| {
        let utterance = listener.understand(text).unwrap();
        let sentence = session.corrected(&utterance.commands[0]).unwrap()?;
        assert_eq!(sentence.modality(), LANGUAGE);
        let names = sentence.words().iter().map(|word| {
            let best = deictic_core::math::argmax(word.likelihoods()).unwrap();
            let category = word.category().unwrap();
            lexicon.option_name(category, best as u8).to_string()
        });
        let mut names: Vec<_> = names.collect();
        names.sort();
        Some(names.join(" "))
    };
    assert_eq!(corrected(&session, "no, the cube"), None);
    let put = surely_said("put-into can drawer", &lexicon);
    session.observe(put).unwrap();
    let all = |session: &Session<'_>| {
        let of = |text| corrected(session, text).unwrap();
        assert_eq!(of("no, the cube"), "cube drawer put-into");
        assert_eq!(of("no, into the bowl"), "bowl can put-into");
        assert_eq!(of("no, pick"), "can pick");
        assert_eq!(of("no, push the box"), "box push");
    };
    // It waits for a gesture, and then it is being done.
    all(&session);
    until(&mut session, begun);
    all(&session);
    let pointed = listener.understand("no, this one").unwrap();
    let sentence = session.corrected(&pointed.commands[0]).unwrap().unwrap();
    let object = |w: &deictic_core::large::Word| w.category() == Some(Category::OBJECT);
    assert!(!sentence.words().iter().any(object), "it is pointed at");
}

/// Something that a person does, and how many milliseconds later.
fn deeds() -> impl Strategy<Value = Vec<(u64, bool)>> {
    proptest::collection::vec((0_u64..60, any::<bool>()), 1..8)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Gestures (`true`) and prohibitions in any order, a window of 30 ms: the robot begins only what was shown
    /// outside the window of every prohibition, before or after it.
    #[test]
    fn the_robot_begins_nothing_that_is_forbidden(deeds in deeds()) {
        let clock = Simulated::start();
        let (cable, lexicon) = (Cable::new(), lexicon());
        let mut session = open(&cable, &lexicon, 1e6);
        let (mut waits, mut quiet) = (false, 1_000);
        for (pause, shows) in deeds.into_iter().chain([(200, false)]) {
            for _ in 0..pause {
                clock.advance(Duration::from_millis(1));
                quiet += 1;
                for happening in session.turn(Duration::ZERO) {
                    if let Happening::Accepted(_) = happening {
                        prop_assert!(waits, "{quiet} ms after a prohibition");
                        waits = false;
                    }
                }
            }
            if shows {
                session.observe(pick(&lexicon)).unwrap();
                waits = quiet >= 29;
            } else {
                session.forbid().unwrap();
                (waits, quiet) = (false, 0);
            }
        }
    }
}
