//! Calls the whole public interface of deictic-core with values that the compiler cannot know. It is never run: what
//! counts is that it links, since the panic handler of a release image refers to a function that nowhere exists.
//!
//! With the feature `indexing` one `x[i]` is added, and it must not link.
#![no_std]
#![no_main]

mod any;
mod figures;
mod lines;

use core::hint::black_box;

use cortex_m_rt::entry;
use deictic_core::align::Alignment;
use deictic_core::category::Category;
use deictic_core::clarify::choose::choose;
use deictic_core::clarify::{Confirmation, gain};
use deictic_core::decide::decide;
use deictic_core::fuse::{Situation, fuse, says_clearly};
use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::joint::posterior::Triple;
use deictic_core::joint::{self, Tables};
use deictic_core::merge::Merge;
use deictic_core::profile::{Align, Model, Profile};
use deictic_core::protocol::seal::{Key, Nonces};
use deictic_core::time::Micros;
use deictic_core::{board, large};
use deictic_firmware as _;

use any::any;

/// The units of both capacities, by all that can be said to them.
macro_rules! unit {
    ($capacity:ident) => {{
        // On the stack, however large: nobody runs this.
        let mut unit = $capacity::Unit::new(any(1));
        let now = Micros(any(5));
        let bytes = any([0_u8; 64]);
        unit.restart(any(4));
        if let Some(mut key) = Key::new(&any([3; 32])) {
            black_box(key.is_proof(
                Nonces {
                    unit: any(1),
                    host: any(2),
                },
                &any([0; 8]),
            ));
            unit.lock(key);
        }
        unit.receive(now, &bytes);
        unit.sense(now, &bytes);
        unit.recognise(&any(Likely {
            gestures: [0.1; STROKES],
            none: 0.2,
        }));
        unit.poll(now);
        unit.sent(any(3));
        black_box((unit.next_wake(), unit.outgoing().len(), unit.statistics()));
        black_box($capacity::Unit::capacities());
    }};
}

/// Vocabulary, scene, sentences and a decision of one size.
macro_rules! decision {
    ($capacity:ident) => {{
        let mut vocabulary = $capacity::Vocabulary::EMPTY;
        let mut scene = $capacity::Scene::new(any(1));
        let mut observed = $capacity::Observations::new();
        let mut trace = $capacity::Trace::new();
        let actions = any([deictic_core::vocabulary::Action::default(); 3]);
        let set = vocabulary.set(&actions, &any([3, 2]), any(4), any(Some(0)), any(7));
        black_box(set.is_ok());
        let thing = $capacity::Entity {
            category: any(Category::OBJECT),
            option: any(1),
            position: any([0.1; 3]),
            features: heapless::Vec::from_slice(&any([0.5; 4])).unwrap_or_default(),
        };
        black_box(scene.push(thing, &vocabulary).is_ok());
        black_box(scene.find(any(Category::STORAGE), any(1)).is_some());
        let mut sentence = $capacity::Sentence::new(any(1));
        if let Ok(word) = $capacity::Word::new(&any([0.5, 0.5]), &any([0.1, 0.9, 0.3])) {
            let word = word.with_quantity(any(0.5));
            black_box((word.category(), word.is_present(), word.quantity()));
            black_box(says_clearly(
                &word,
                any(Category::ACTION),
                any(0),
                &any(Profile::PAPER),
            ));
            black_box(sentence.push(word).is_ok());
        }
        black_box($capacity::Word::certain(any(Category::OBJECT), &any([0.5; 3])).is_ok());
        black_box(observed.insert(&sentence, &vocabulary).is_ok());
        black_box(observed.answer(&sentence, &vocabulary).is_ok());
        let asked = Triple {
            action: any(1),
            things: any([Some(1), None]),
        };
        observed.confirm(Confirmation {
            asked,
            likelihoods: any([1.0, 0.5]),
        });
        let aligned = Alignment::of(&observed, any(Align::Position));
        black_box((
            aligned.presence(any(Category::OBJECT)),
            aligned.slot(any(Category::ACTION)).len(),
        ));
        let profiles = [
            Profile::PAPER,
            Profile::BASELINE,
            Profile::FIXED,
            Profile::reference_entropy(any(Model::M2), any(Merge::Mul)),
            Profile::reference_fixed(any(Model::M3), any(Merge::Add)),
            Profile::reference_baseline(any(Model::M1)),
        ];
        for profile in any(profiles) {
            let situation = Situation {
                vocabulary: &vocabulary,
                scene: &scene,
                observations: &observed,
                sensors: any(Tables::NONE),
            };
            black_box(fuse(situation, &profile, &mut trace).is_ok());
            black_box(decide(&vocabulary, &scene, &profile, &trace).best.is_some());
            black_box(joint::fuse(situation, &any(Profile::JOINT), &mut trace).is_ok());
            if let Ok(decision) = joint::fuse(situation, &any(Profile::JOINT), &mut trace)
                && let Some(best) = &decision.best
            {
                black_box(choose(best, &observed, &trace).is_some());
                black_box(Triple::of(best));
            }
            black_box(gain::confirm(any(0.5), any(1.0)) + gain::which(&any([0.5; 3]), any(1.0)));
            black_box(profile.weight(any(9)));
        }
        for word in trace.categories() {
            black_box((
                word.merged().len(),
                word.h().len(),
                word.judgement.decided(any(0.1)),
            ));
        }
        observed.clear();
        trace.clear();
        vocabulary.clear();
    }};
}

#[entry]
fn main() -> ! {
    unit!(board);
    decision!(board);
    decision!(large);
    figures::call();
    lines::call();
    loop {
        cortex_m::asm::wfi();
    }
}
