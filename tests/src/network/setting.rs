//! What every session in simulated time starts from.

use deictic::scene::{SceneFile, Tabletop};
use deictic::showing::showing;
use deictic::vocabulary::Lexicon;
use deictic_core::large::Sentence;

/// The vocabulary and the table that come with the bridge.
pub struct Setting {
    pub(crate) lexicon: Lexicon,
    pub(crate) table: Tabletop,
}

impl Default for Setting {
    fn default() -> Self {
        let lexicon = Lexicon::tabletop().expect("the built-in vocabulary is sound");
        let table = SceneFile::table().expect("the built-in scene is sound");
        let table = table.tabletop(&lexicon).expect("they belong together");
        Self { lexicon, table }
    }
}

impl Setting {
    /// What a modality reports of a command that is typed as it is shown.
    pub(crate) fn say(&self, text: &str, modality: u8) -> Sentence {
        let shown = showing(text, &self.lexicon).expect("a command of the vocabulary");
        let mut sentence = Sentence::new(modality);
        for word in shown.words() {
            sentence.push(word.clone()).expect("it fitted before");
        }
        sentence
    }
}
