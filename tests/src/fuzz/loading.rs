//! Vocabularies and scenes in parts, of any contents and in any order: what is in force is always sound, a refusal
//! changes nothing, and what was taken over is what was sent.

use deictic_core::board::{CATEGORIES, ENTITIES, Entity, FEATURES, OPTIONS, Scene, Vocabulary};
use deictic_core::category::{BitSet, Category};
use deictic_core::protocol::message::{Loaded, ScenePart, VocabularyPart};
use deictic_core::unit::loading::Loading;
use deictic_core::vocabulary::{Action, Requirement, Signature};

use super::source::Source;

type Board = Loading<OPTIONS, CATEGORIES, FEATURES, ENTITIES>;

/// Sends parts as the bytes say.
pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let mut loading = Board::new();
    let mut actions: Vec<Action> = Vec::new();
    while !source.is_over() {
        let before = (loading.vocabulary().cloned(), loading.scene().cloned());
        let choice = source.byte();
        let changed = if choice == 0 {
            loading.clear();
            actions.clear();
            continue;
        } else if choice.is_multiple_of(3) {
            let part = vocabulary_part(&mut source);
            if part.first == 0 {
                actions.clear();
            }
            let taken = loading.take_vocabulary(&part);
            if usize::from(part.first) == actions.len() {
                actions.extend(&part.actions);
            }
            match taken {
                Ok(Some(loaded)) => {
                    assert_eq!(loaded, Loaded::Vocabulary(part.fingerprint));
                    let whole = Vocabulary::new(
                        &actions,
                        &part.parameters,
                        part.features,
                        part.stop,
                        part.fingerprint,
                    );
                    assert_eq!(
                        loading.vocabulary(),
                        Some(&whole.expect("it was taken over"))
                    );
                    assert_eq!(loading.scene(), None);
                    actions.clear();
                    true
                }
                Ok(None) => false,
                Err(_) => {
                    actions.clear();
                    // The next part is told in or out of order by what the loader holds; begin anew.
                    let _ = loading.take_vocabulary(&VocabularyPart {
                        first: 0,
                        total: 1,
                        actions: heapless::Vec::new(),
                        ..part
                    });
                    false
                }
            }
        } else {
            let part = scene_part(&mut source);
            match loading.take_scene(&part) {
                Ok(Some(loaded)) => {
                    assert_eq!(loaded, Loaded::Scene(part.version));
                    let held = before.1.as_ref().map_or(0, Scene::version);
                    assert!(part.version > held);
                    true
                }
                Ok(None) | Err(_) => false,
            }
        };
        if !changed {
            assert_eq!(
                (loading.vocabulary().cloned(), loading.scene().cloned()),
                before
            );
        }
        check(&loading);
    }
}

/// What holds of whatever is in force.
fn check(loading: &Board) {
    let Some(vocabulary) = loading.vocabulary() else {
        assert_eq!(loading.scene(), None);
        return;
    };
    let again = Vocabulary::new(
        vocabulary.actions(),
        &vocabulary.options()[1..],
        vocabulary.features() as u8,
        vocabulary.stop(),
        vocabulary.fingerprint(),
    );
    assert_eq!(again.as_ref(), Ok(vocabulary));
    if let Some(scene) = loading.scene() {
        let mut again = Scene::new(scene.version());
        for thing in scene.entities() {
            assert!(usize::from(thing.option) < vocabulary.options_of(thing.category));
            assert!(thing.features.iter().all(|f| (0.0..=1.0).contains(f)));
            again
                .push(thing.clone(), vocabulary)
                .expect("it is in force");
        }
        assert_eq!(&again, scene);
    }
}

fn vocabulary_part(source: &mut Source<'_>) -> VocabularyPart<CATEGORIES> {
    let sound = source.byte() < 224;
    let set = |source: &mut Source<'_>, most: u32| match sound {
        true => BitSet(u32::from(source.byte()) & most),
        false => BitSet(source.word()),
    };
    let first = source.small(8);
    let actions = (0..source.small(5))
        .map(|_| {
            let compulsory = set(source, 0b110);
            let wanted = set(source, 0b111);
            Action {
                signature: Signature {
                    compulsory,
                    voluntary: BitSet(set(source, 0b1110).0 & !compulsory.0),
                },
                object: Requirement {
                    wanted,
                    unwanted: BitSet(set(source, 0b111).0 & !wanted.0),
                },
                storage: Requirement::default(),
            }
        })
        .collect();
    VocabularyPart {
        fingerprint: source.word(),
        parameters: (0..source.small(9)).map(|_| source.small(18)).collect(),
        features: source.small(20),
        stop: source.flag().then(|| source.small(20)),
        total: source.small(20),
        first,
        actions,
    }
}

fn scene_part(source: &mut Source<'_>) -> ScenePart<FEATURES> {
    let entities = (0..source.small(3))
        .map(|_| Entity {
            category: Category::from_index(usize::from(source.small(4)))
                .unwrap_or(Category::OBJECT),
            option: source.small(18),
            position: match source.flag() {
                true => [source.float(), source.float(), source.float()],
                false => [0.5, 0.0, 0.1],
            },
            features: (0..source.small(17))
                .map(|_| match source.byte() {
                    0 => source.float(),
                    b => f32::from(b) / 255.0,
                })
                .collect(),
        })
        .collect();
    ScenePart {
        version: u32::from(source.small(16)),
        total: source.small(20),
        first: source.small(20),
        entities,
    }
}
