//! What the recognisers hear: commands spoken by espeak-ng, talk, noises. Skipped, and said so, where
//! they are not installed. `deictic-eval speech` gives figures over voices and noise.

#[path = "common/voice.rs"]
mod voice;

use std::path::Path;

use deictic::language::pack::Pack;
use deictic::language::speech::pocketsphinx::MODEL;
use deictic::language::speech::{Expected, Kind, Recogniser, moonshine, samples};
use deictic::language::{Command, Listener, RISK};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use tempfile::TempDir;
use voice::{installed, sox, speak};

fn open(kind: Kind, lexicon: &Lexicon) -> Recogniser {
    let pack = Pack::built_in("en").unwrap();
    Recogniser::open(kind, lexicon, &pack, Path::new(MODEL)).unwrap()
}

fn hears_what_is_said(kind: Kind) {
    let lexicon = Lexicon::tabletop().unwrap();
    let mut recogniser = open(kind, &lexicon);
    let listener = Listener::new(&lexicon).unwrap();
    let folder = TempDir::new().unwrap();
    let mut hear = |text: &str, expected| {
        let recording = speak(&folder, "said.wav", text);
        recogniser
            .hear(&samples(&recording).unwrap(), expected)
            .unwrap()
    };
    for (text, action, object, storage) in [
        ("release", "release", None, None),
        ("pick the cup", "pick", Some("cup"), None),
        (
            "put the cube into the drawer",
            "put-into",
            Some("cube"),
            Some("drawer"),
        ),
    ] {
        let heard = hear(text, Expected::Command);
        let utterance = listener.hear(&heard).unwrap();
        let command = &utterance.commands[0];
        let name = |c| command.best(c).map(|option| lexicon.option_name(c, option));
        assert_eq!(name(Category::ACTION).as_deref(), Some(action), "{heard:?}");
        assert_eq!(name(Category::OBJECT).as_deref(), object, "{heard:?}");
        assert_eq!(name(Category::STORAGE).as_deref(), storage, "{heard:?}");
    }
    let forbidden = hear("don't pick the cup", Expected::Command);
    let done = listener.hear(&forbidden);
    assert!(
        done.is_err() || done.is_ok_and(|u| u.commands.is_empty()),
        "{forbidden:?}"
    );
    assert_eq!(hear("yes", Expected::Answer).best(), "yes");
    for refused in ["no", "no don't"] {
        let heard = hear(refused, Expected::Underway);
        assert_eq!(heard.certain(0.05), Some(refused), "{heard:?}");
    }
    for talk in ["the weather is lovely today", "my sister bought a new car"] {
        let heard = hear(talk, Expected::Command);
        assert_eq!(heard.best(), "", "{heard:?}");
        assert!(listener.hear(&heard).unwrap().commands.is_empty());
        assert_eq!(hear(talk, Expected::Answer).certain(RISK), None);
    }
}

#[test]
fn what_is_said_is_heard_and_what_is_forbidden_is_not_done() {
    if installed() {
        hears_what_is_said(Kind::Pocketsphinx);
    }
}

#[test]
fn moonshine_hears_what_is_said_and_takes_no_question_for_a_command() {
    if moonshine::installed().is_none() || !installed() {
        eprintln!("skipped: Moonshine is not installed where DEICTIC_MOONSHINE says");
        return;
    }
    hears_what_is_said(Kind::Moonshine);
    let lexicon = Lexicon::tabletop().unwrap();
    let listener = Listener::new(&lexicon).unwrap();
    let mut recogniser = open(Kind::Moonshine, &lexicon);
    let folder = TempDir::new().unwrap();
    for text in [
        "should I pick the cup",
        "where is the cup",
        "I have to pick up my daughter at five",
        "never put the cup into the drawer",
    ] {
        let recording = samples(&speak(&folder, "said.wav", text)).unwrap();
        let heard = recogniser.hear(&recording, Expected::Command).unwrap();
        let understood = listener.hear(&heard);
        assert!(
            understood.is_err() || understood.is_ok_and(|u| u.commands.is_empty()),
            "{heard:?}"
        );
    }
    assert!(
        recogniser
            .hear(&[], Expected::Command)
            .is_ok_and(|h| h.best().is_empty())
    );
}

/// What a laboratory sounds like when nobody says anything.
#[test]
fn what_is_no_speech_is_no_command() {
    if moonshine::installed().is_none() || !installed() {
        eprintln!("skipped: Moonshine is not installed where DEICTIC_MOONSHINE says");
        return;
    }
    let folder = TempDir::new().unwrap();
    let lexicon = Lexicon::tabletop().unwrap();
    let mut recogniser = open(Kind::Best, &lexicon);
    let listener = Listener::new(&lexicon).unwrap();
    for (name, sound) in [
        ("hiss", "synth 2 whitenoise gain -12"),
        ("rumble", "synth 3 brownnoise gain -6"),
        ("room", "synth 1 pinknoise gain -30"),
        ("tone", "synth 1.5 sine 440 gain -6"),
        ("sweep", "synth 2 sine 3000-100 gain -6"),
        ("string", "synth 1.5 pluck 220 gain -6"),
        ("motor", "synth 2 sawtooth 80 tremolo 3 30 gain -10"),
        ("knock", "synth 0.05 whitenoise gain -3 pad 0.5 0.5"),
        ("silence", "trim 0 1.5"),
    ] {
        let file = folder.path().join(name).with_extension("wav");
        let text = file.to_string_lossy();
        let made = ["-R", "-n", "-r", "16000", "-c", "1", "-b", "16", &text];
        sox(&made.into_iter().chain(sound.split(' ')).collect::<Vec<_>>());
        let heard = recogniser.hear(&samples(&file).unwrap(), Expected::Command);
        let done = heard.map_err(|e| e.to_string());
        let done = done.and_then(|h| listener.hear(&h).map_err(|e| e.to_string()));
        let commands = done.map(|utterance| utterance.commands).unwrap_or_default();
        let action = |c: &Command| c.best(Category::ACTION);
        // What may have been "stop" stops.
        let moves = commands
            .iter()
            .any(|c| action(c) != lexicon.vocabulary().stop());
        assert!(!moves, "{name}");
    }
}

#[test]
fn distances_and_directions_are_heard() {
    if !installed() {
        return;
    }
    let folder = TempDir::new().unwrap();
    let lexicon = Lexicon::tabletop().unwrap();
    let mut recogniser = open(Kind::Best, &lexicon);
    let listener = Listener::new(&lexicon).unwrap();
    let distance = lexicon.category("distance").unwrap();
    for (said, far) in [
        ("move up by twenty five centimetres", 0.25),
        ("push the cup left ten centimetres", 0.1),
        ("move up half a metre", 0.5),
    ] {
        let file = speak(&folder, "said.wav", said);
        let heard = recogniser.hear(&samples(&file).unwrap(), Expected::Command);
        let command = listener.hear(&heard.unwrap()).unwrap().commands.remove(0);
        assert_eq!(command.quantity(distance), Some(far), "{said}");
        let left = command.best(Category::DIRECTION).is_some();
        assert_eq!(left, said.contains("left"), "{said}");
    }
}
