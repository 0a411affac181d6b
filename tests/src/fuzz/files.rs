//! Vocabulary and scene files with anything in them: taken or refused with a reason, and what is taken is sound.

use deictic::scene::SceneFile;
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;

use super::source::Source;

/// Reads one file, a vocabulary or a scene by its first byte.
pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let is_scene = source.flag();
    let text = String::from_utf8_lossy(source.bytes(usize::MAX));
    if is_scene {
        scene(&text);
    } else {
        vocabulary(&text);
    }
}

fn vocabulary(text: &str) {
    let lexicon = match Lexicon::parse("fuzzed.toml", text) {
        Ok(lexicon) => lexicon,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let vocabulary = lexicon.vocabulary();
    for (q, &options) in vocabulary.options().iter().enumerate() {
        let category = Category::from_index(q).expect("a vocabulary's category");
        for option in 0..options {
            let name = lexicon.option_name(category, option);
            if !lexicon.is_quantity_only(category) {
                assert_eq!(lexicon.option(category, &name), Some(option), "{name}");
            }
        }
    }
}

fn scene(text: &str) {
    thread_local! {
        static LEXICON: Lexicon = Lexicon::tabletop().expect("the built-in vocabulary is sound");
    }
    let file = match SceneFile::parse("fuzzed.toml", text) {
        Ok(file) => file,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    LEXICON.with(|lexicon| match file.tabletop(lexicon) {
        Ok(table) => assert_eq!(table.version(), 1),
        Err(error) => assert!(!error.to_string().is_empty()),
    });
}
