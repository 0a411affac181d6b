//! The sentences of the 20 published table set-ups, where they are at hand.

use std::path::Path;

use deictic::language::Listener;
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use serde_json::Value;

#[test]
fn all_sentences_of_the_published_setups_are_understood() {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/sentences/real_setups.json");
    let Ok(text) = std::fs::read_to_string(&file) else {
        eprintln!("skipped: the published set-ups are not beside the project");
        return;
    };
    let setups: Vec<Value> = serde_json::from_str(&text).unwrap();
    let lexicon = Lexicon::tabletop().unwrap();
    let listener = Listener::new(&lexicon).unwrap();
    let mut checked = 0;
    for setup in &setups {
        for kind in ["correct", "wrong_action", "wrong_object"] {
            let said = &setup[kind];
            let text = said["text"].as_str().unwrap();
            let utterance = listener
                .understand(text)
                .unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!(
                (utterance.commands.len(), utterance.aside.len()),
                (1, 0),
                "{text}"
            );
            for (category, name) in [
                (Category::ACTION, "action"),
                (Category::OBJECT, "object"),
                (Category::STORAGE, "storage"),
            ] {
                let understood = utterance.commands[0].best(category);
                let understood = understood.map(|o| lexicon.option_name(category, o));
                assert_eq!(understood.as_deref(), said[name].as_str(), "{text}: {name}");
            }
            checked += 1;
        }
    }
    assert_eq!(checked, 60);
}
