//! Speech end to end: spoken by espeak-ng, disturbed by sox, heard by pocketsphinx, fused with a
//! pointing hand, decided by the core. Skipped, and said so, where these programs are not installed.

use std::path::Path;
use std::process::Command;

use deictic::language::Listener;
use deictic::language::pack::Pack;
use deictic::language::speech::pocketsphinx::{MODEL, Pocketsphinx};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::fuse::{Situation, fuse};
use deictic_core::large::{Entity, Intent, Observations, Scene, Sentence, Trace, Word};
use deictic_core::profile::Profile;
use deictic_core::sentence::GESTURE;

const SAID: [(&str, [Option<&str>; 3]); 18] = [
    ("move up", [Some("move-up"), None, None]),
    ("please go up", [Some("move-up"), None, None]),
    ("release", [Some("release"), None, None]),
    ("let go", [Some("release"), None, None]),
    ("stop", [Some("stop"), None, None]),
    ("halt", [Some("stop"), None, None]),
    ("pick the cup", [Some("pick"), Some("cup"), None]),
    ("take the box", [Some("pick"), Some("box"), None]),
    ("push the cube", [Some("push"), Some("cube"), None]),
    ("slide the cleaner", [Some("push"), Some("cleaner"), None]),
    ("unglue the can", [Some("unglue"), Some("can"), None]),
    ("loosen the box", [Some("unglue"), Some("box"), None]),
    (
        "pour the can into the bowl",
        [Some("pour"), Some("can"), Some("bowl")],
    ),
    (
        "pour the cup into the foam",
        [Some("pour"), Some("cup"), Some("foam")],
    ),
    (
        "put the cube into the drawer",
        [Some("put-into"), Some("cube"), Some("drawer")],
    ),
    (
        "place the can into the bowl",
        [Some("put-into"), Some("can"), Some("bowl")],
    ),
    (
        "stack the box onto the crackers",
        [Some("stack"), Some("box"), Some("crackers")],
    ),
    (
        "stack the cleaner onto the foam",
        [Some("stack"), Some("cleaner"), Some("foam")],
    ),
];

const VOICES: [&str; 5] = [
    "en-us",
    "en-gb",
    "en-us+f3",
    "en-gb-scotland+m3",
    "en-us+m7",
];

fn sox(arguments: &[&str]) -> String {
    let output = Command::new("sox").args(arguments).output().unwrap();
    assert!(output.status.success(), "sox {arguments:?}");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The level of a recording in dB below full scale.
fn level(file: &str) -> f64 {
    let stats = sox(&[file, "-n", "stats"]);
    let line = stats.lines().find(|l| l.starts_with("RMS lev dB")).unwrap();
    line.split_whitespace().nth(3).unwrap().parse().unwrap()
}

fn speak(folder: &Path, voice: &str, text: &str, snr: Option<i32>) -> String {
    let file = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (clean, noise, loud, noisy) = (
        file("clean.wav"),
        file("noise.wav"),
        file("loud.wav"),
        file("noisy.wav"),
    );
    let espeak = ["-v", voice, "-s", "140", "-w", &clean, text];
    assert!(
        Command::new("espeak-ng")
            .args(espeak)
            .status()
            .unwrap()
            .success()
    );
    let Some(snr) = snr else { return clean };
    // Repeatable noise (-R), as loud as asked for below the voice.
    sox(&["-R", &clean, &noise, "synth", "pinknoise", "norm", "-6"]);
    let gain = format!("{:.2}", level(&clean) - f64::from(snr) - level(&noise));
    sox(&[&noise, &loud, "gain", &gain]);
    sox(&["-m", "-v", "1", &clean, "-v", "1", &loud, &noisy]);
    noisy
}

/// What a hand shows that points at an object: it, and a fifth of it for every other.
fn pointing(lexicon: &Lexicon, object: Option<&str>) -> Sentence {
    let mut sentence = Sentence::new(GESTURE);
    if let Some(object) = object {
        let options = lexicon.entries(Category::OBJECT).iter();
        let likelihoods: Vec<_> = options
            .map(|e| if e.name == object { 1.0 } else { 0.22 })
            .collect();
        sentence
            .push(Word::certain(Category::OBJECT, &likelihoods).unwrap())
            .unwrap();
    }
    sentence
}

/// Everything is on the table, at hand and free; only what is to be unglued is glued.
fn table(lexicon: &Lexicon, glued: Option<&str>) -> Scene {
    let vocabulary = lexicon.vocabulary();
    let mut scene = Scene::new(0);
    for category in [Category::OBJECT, Category::STORAGE] {
        for (option, entry) in (0..).zip(lexicon.entries(category)) {
            let holds = |feature: &String| match feature.as_str() {
                "glued" => glued == Some(entry.name.as_str()),
                "full-liquid" => category == Category::OBJECT,
                "full-stack" | "full-container" => false,
                _ => true,
            };
            let features = lexicon
                .features()
                .iter()
                .map(|f| f32::from(u8::from(holds(f))));
            let (position, features) = ([0.0; 3], features.collect());
            let entity = Entity {
                category,
                option,
                position,
                features,
            };
            scene.push(entity, vocabulary).unwrap();
        }
    }
    scene
}

fn names(lexicon: &Lexicon, intent: &Intent) -> [Option<String>; 3] {
    let needs = lexicon.vocabulary().actions()[usize::from(intent.action)]
        .signature
        .compulsory;
    [Category::ACTION, Category::OBJECT, Category::STORAGE].map(|category| match category {
        Category::ACTION => Some(lexicon.option_name(category, intent.action)),
        _ if !needs.contains(category.index()) => None,
        _ => intent
            .option(category)
            .map(|o| lexicon.option_name(category, o)),
    })
}

#[test]
fn what_is_said_aloud_is_done_or_asked_about() {
    let there = |program: &str| Command::new(program).arg("--version").output().is_ok();
    let programs = ["espeak-ng", "sox", "pocketsphinx_batch"];
    if !programs.into_iter().all(there) || !Path::new(MODEL).exists() {
        eprintln!("skipped: espeak-ng, sox or pocketsphinx is not installed");
        return;
    }
    let lexicon = Lexicon::tabletop().unwrap();
    let pack = Pack::built_in("en").unwrap();
    let recogniser = Pocketsphinx::new(&lexicon, &pack, Path::new(MODEL)).unwrap();
    assert!(
        recogniser.left_out().len() <= 1,
        "{:?}",
        recogniser.left_out()
    );
    let listener = Listener::new(&lexicon).unwrap();
    let profile = Profile::default();
    let folder = tempfile::tempdir().unwrap();
    for snr in [None, Some(20), Some(10), Some(5)] {
        let (mut right, mut wrong, mut all) = (0, 0, 0);
        // All voices in quiet, two in noise: each utterance takes a quarter of a second.
        for voice in VOICES
            .iter()
            .take(if snr.is_none() { VOICES.len() } else { 2 })
        {
            for (text, truth) in SAID {
                all += 1;
                let recording = speak(folder.path(), voice, text, snr);
                let Ok(spoken) = recogniser.hear(Path::new(&recording)) else {
                    continue;
                };
                let utterance = match listener.hear(&spoken) {
                    Ok(utterance) => utterance,
                    Err(error) => {
                        println!("{snr:?} {voice}: {text} -> {error}");
                        continue;
                    }
                };
                let Some(command) = utterance.commands.first() else {
                    continue;
                };
                let mut observations = Observations::new();
                let vocabulary = lexicon.vocabulary();
                observations
                    .insert(command.sentence.clone(), vocabulary)
                    .unwrap();
                observations
                    .insert(pointing(&lexicon, truth[1]), vocabulary)
                    .unwrap();
                let glued = truth[1].filter(|_| truth[0] == Some("unglue"));
                let scene = table(&lexicon, glued);
                let situation = Situation {
                    vocabulary,
                    scene: &scene,
                    observations: &observations,
                };
                let decision = fuse(situation, &profile, &mut Trace::default()).unwrap();
                if let Outcome::Execute(intent) = &decision.outcome {
                    let done = names(&lexicon, intent);
                    if done.iter().map(Option::as_deref).eq(truth) {
                        right += 1;
                    } else {
                        wrong += 1;
                        println!("{snr:?} {voice}: {text} -> {done:?}");
                    }
                } else {
                    println!(
                        "{snr:?} {voice}: {text} -> {:?} {:?}",
                        spoken.alternatives.first(),
                        decision.outcome
                    );
                }
            }
        }
        let asked = all - right - wrong;
        println!("noise {snr:?} dB: {right} right, {asked} asked, {wrong} wrong of {all}");
        if snr.is_none() {
            assert!(right * 10 >= all * 8 && wrong * 10 <= all, "clean speech");
        }
    }
}
