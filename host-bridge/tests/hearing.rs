//! What is made of alternatives that a recogniser gives, each with its probability.

use deictic::language::{Listener, RISK, Spoken};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;

#[test]
fn a_word_that_was_hardly_heard_is_none() {
    let lexicon = Lexicon::tabletop().unwrap();
    let listener = Listener::new(&lexicon).unwrap();
    let words = |put: f64| {
        let spoken = Spoken {
            alternatives: vec![
                ("please stop".to_owned(), 1.0 - put),
                ("put the cup in the drawer".to_owned(), put),
            ],
        };
        let utterance = listener.hear(&spoken).unwrap();
        utterance.commands[0].sentence.words().len()
    };
    assert_eq!((words(1e-6), words(0.005)), (1, 3));
}

#[test]
fn what_may_have_been_talk_is_to_be_said_again() {
    let lexicon = Lexicon::tabletop().unwrap();
    let listener = Listener::new(&lexicon).unwrap();
    let spoken = |talk: f64| Spoken {
        alternatives: vec![
            ("pick the cup".to_owned(), 1.0 - talk),
            (String::new(), talk),
        ],
    };
    assert_eq!(listener.hear(&spoken(0.001)).unwrap().commands.len(), 1);
    let unclear = listener.hear(&spoken(0.2)).unwrap_err();
    assert!(unclear.to_string().contains("pick the cup"), "{unclear}");
}

#[test]
fn what_may_have_been_said_stays_in_question() {
    let lexicon = Lexicon::tabletop().unwrap();
    let listener = Listener::new(&lexicon).unwrap();
    let heard = |texts: &[(&str, f64)]| {
        let line = texts.iter().map(
            |(text, confidence)| serde_json::json!({ "text": text, "confidence": confidence }),
        );
        let line = serde_json::json!({ "alternatives": line.collect::<Vec<_>>() });
        listener.hear(&Spoken::read(&line.to_string()).unwrap())
    };
    let object = |texts: &[(&str, f64)]| {
        let sentence = heard(texts).unwrap().commands[0].sentence.clone();
        let words = sentence.words();
        let word = words
            .iter()
            .find(|w| w.category() == Some(Category::OBJECT));
        let likelihoods = word.unwrap().likelihoods();
        // can, cup, cube, box, cleaner
        (likelihoods[0], likelihoods[1])
    };
    let (can, cup) = object(&[("pick the can", 0.9), ("pick the cup", 0.1)]);
    assert_eq!((can, cup), (1.0, 1.0));
    let (can, cup) = object(&[
        ("pick the can", 1.0 - RISK / 2.0),
        ("pick the cup", RISK / 2.0),
    ]);
    assert!(can == 1.0 && cup < 1.0, "{can} {cup}");
    assert!(heard(&[("pick the can", 0.9), ("do not pick the can", 0.1)]).is_err());
    assert!(
        heard(&[("do not pick the can", 0.9), ("pick the can", 0.1)])
            .unwrap()
            .commands
            .is_empty()
    );
}

#[test]
fn how_far_is_said_again_when_it_was_not_clear() {
    let lexicon = Lexicon::tabletop().unwrap();
    let listener = Listener::new(&lexicon).unwrap();
    let heard = |one: &str, other: &str, share: f64| {
        let alternatives = vec![(one.to_owned(), 1.0 - share), (other.to_owned(), share)];
        listener.hear(&Spoken { alternatives })
    };
    let (five, nine) = ("move up five centimetres", "move up nine centimetres");
    let unclear = heard(five, nine, 0.1).unwrap_err();
    assert!(unclear.to_string().contains(five), "{unclear}");
    assert!(heard(five, "move up", 0.1).is_err());
    let distance = lexicon.category("distance").unwrap();
    let clear = heard(five, nine, RISK / 2.0).unwrap();
    assert_eq!(clear.commands[0].quantity(distance), Some(0.05));
    // The same distance in other words is no doubt, nor is another action, of which the unit asks.
    assert!(heard(five, "go up by five centimeters", 0.4).is_ok());
    assert!(heard("push this", "push this left", 0.3).is_ok());
    assert!(heard("go up a bit", "go up and wait", 0.1).is_err());
    assert!(heard("stop", "move up nine centimetres", 0.3).is_ok());
}
