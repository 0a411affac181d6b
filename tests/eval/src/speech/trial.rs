//! One utterance heard, fused with a pointing hand and decided.

use deictic::language::{Listener, Spoken};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Tables;
use deictic_core::large::{Entity, Intent, Observations, Scene, Sentence, Trace, Word};
use deictic_core::profile::Profile;
use deictic_core::sentence::GESTURE;

use super::Said;

/// What became of an utterance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// What was meant is done; of talk nothing.
    Right,
    /// Something else is done.
    Wrong(String),
    /// The person is asked, or asked to say it again.
    Asked(String),
}

/// What utterances are decided with.
pub struct Trial<'a> {
    /// Understands them.
    pub listener: &'a Listener<'a>,
    /// Their names.
    pub lexicon: &'a Lexicon,
    /// Decides.
    pub profile: Profile,
    /// What is known of the recogniser and of the hand.
    pub sensors: Tables<'a>,
}

impl Trial<'_> {
    /// Decides what was heard when `said` was said and, if it is about an object, pointed at.
    ///
    /// # Panics
    /// Never for sentences over this vocabulary.
    #[must_use]
    pub fn decide(&self, said: &Said, heard: &Spoken) -> Answer {
        let utterance = match self.listener.hear(heard) {
            Ok(utterance) => utterance,
            Err(error) => return Answer::Asked(error.to_string()),
        };
        let Some(command) = utterance.commands.first() else {
            return match said.truth[0] {
                None => Answer::Right,
                Some(_) => Answer::Asked("no command".into()),
            };
        };
        let vocabulary = self.lexicon.vocabulary();
        let mut observations = Observations::new();
        for sentence in [command.sentence.clone(), self.pointing(said)] {
            observations
                .insert(sentence, vocabulary)
                .expect("a sentence over this vocabulary");
        }
        let scene = self.table(said);
        let situation = Situation {
            vocabulary,
            scene: &scene,
            observations: &observations,
            sensors: self.sensors,
        };
        let decided = fuse(situation, &self.profile, &mut Trace::default());
        match decided.map(|d| d.outcome) {
            Ok(Outcome::Execute(intent)) => {
                let done = self.names(&intent);
                if done == said.truth {
                    Answer::Right
                } else {
                    let names: Vec<_> = done.into_iter().flatten().collect();
                    Answer::Wrong(names.join(" "))
                }
            }
            other => Answer::Asked(format!("{other:?}")),
        }
    }

    /// What a hand shows that points at an object: it, and a fifth of it for every other.
    fn pointing(&self, said: &Said) -> Sentence {
        let mut sentence = Sentence::new(GESTURE);
        if let Some(object) = &said.truth[1] {
            let options = self.lexicon.entries(Category::OBJECT).iter();
            let likelihoods: Vec<_> = options
                .map(|e| if e.name == *object { 1.0 } else { 0.22 })
                .collect();
            let word = Word::certain(Category::OBJECT, &likelihoods);
            let pushed = word.map(|word| sentence.push(word));
            assert!(matches!(pushed, Ok(Ok(()))), "one word fits");
        }
        sentence
    }

    /// Everything is on the table, at hand and free; only what is to be unglued is glued.
    fn table(&self, said: &Said) -> Scene {
        let glued = said.truth[1]
            .as_deref()
            .filter(|_| said.truth[0].as_deref() == Some("unglue"));
        let mut scene = Scene::new(0);
        for category in [Category::OBJECT, Category::STORAGE] {
            for (option, entry) in (0..).zip(self.lexicon.entries(category)) {
                let holds = |feature: &String| match feature.as_str() {
                    "glued" => glued == Some(entry.name.as_str()),
                    "full-liquid" => category == Category::OBJECT,
                    "full-stack" | "full-container" => false,
                    _ => true,
                };
                let features = self.lexicon.features().iter();
                let features = features.map(|f| f32::from(u8::from(holds(f)))).collect();
                let (position, vocabulary) = ([0.0; 3], self.lexicon.vocabulary());
                let entity = Entity {
                    category,
                    option,
                    position,
                    features,
                };
                scene.push(entity, vocabulary).expect("every thing once");
            }
        }
        scene
    }

    fn names(&self, intent: &Intent) -> [Option<String>; 3] {
        let actions = self.lexicon.vocabulary().actions();
        let needs = actions
            .get(usize::from(intent.action))
            .map(|a| a.signature.compulsory);
        [Category::ACTION, Category::OBJECT, Category::STORAGE].map(|category| match category {
            Category::ACTION => Some(self.lexicon.option_name(category, intent.action)),
            _ if !needs.is_some_and(|n| n.contains(category.index())) => None,
            _ => {
                let option = intent.option(category);
                option.map(|o| self.lexicon.option_name(category, o))
            }
        })
    }
}
