//! Sensors' tables that a host sends: whole ones are decided by, all else is refused.

#[path = "common/bench.rs"]
mod bench;
mod common;

use bench::*;
use common::*;
use deictic_core::board::{ToHost, ToUnit, Word};
use deictic_core::category::Category;
use deictic_core::joint::sensors::SensorError;
use deictic_core::profile::Profile;
use deictic_core::protocol::message::*;
use deictic_core::sentence::LANGUAGE;

/// A listener that hears "bowl" when the drawer is meant.
const HEARD: [[u8; 4]; 4] = [
    [153, 77, 77, 230],
    [77, 255, 77, 77],
    [77, 77, 255, 77],
    [77, 77, 77, 255],
];

fn row(meant: u8) -> ToUnit {
    ToUnit::Sensor(SensorPart::Row(SensorRow {
        modality: LANGUAGE,
        category: Category::STORAGE,
        meant,
        likelihoods: HEARD[usize::from(meant)].into_iter().collect(),
    }))
}

fn joint() -> Bench {
    let mut bench = Bench::ready();
    bench.say(&ToUnit::Configure(Configuration {
        profile: Profile::JOINT,
        expected: 1 << LANGUAGE,
        ..Configuration::DEFAULT
    }));
    bench
}

/// Which storage "put the can into the bowl", as it was heard, is taken to mean.
fn meant(bench: &mut Bench) -> Option<u8> {
    let heard = HEARD[usize::from(DRAWER)].map(|x| f32::from(x) / 255.0);
    let said = [
        word(Category::ACTION, PUT),
        word(Category::OBJECT, CAN),
        Word::certain(Category::STORAGE, &heard).unwrap(),
    ];
    let decided = bench.decision(sentence(LANGUAGE, &said)).unwrap();
    decided.decision.best.unwrap().option(Category::STORAGE)
}

fn loaded(heard: &[ToHost]) -> bool {
    let what = Loaded::Sensor {
        modality: LANGUAGE,
        category: Category::STORAGE,
    };
    heard == [ToHost::Loaded(what)]
}

#[test]
fn a_whole_table_is_decided_by_until_the_vocabulary_changes() {
    let mut bench = joint();
    assert_eq!(meant(&mut bench), Some(BOWL));
    for option in 0..3 {
        assert_eq!(bench.say(&row(option)), []);
        assert_eq!(meant(&mut bench), Some(BOWL), "half a table counted");
    }
    assert!(loaded(&bench.say(&row(3))));
    assert_eq!(meant(&mut bench), Some(DRAWER));
    bench.all(vocabulary_parts());
    bench.all(scene_parts(2));
    assert_eq!(meant(&mut bench), Some(BOWL));
}

#[test]
fn a_row_out_of_order_is_refused_and_the_table_begun_anew() {
    let mut bench = joint();
    bench.say(&row(0));
    for (got, expected) in [(2, 1), (3, 1)] {
        assert_eq!(
            faults(&bench.say(&row(got))),
            [Fault::PartOutOfOrder { expected, got }]
        );
    }
    assert!(loaded(&bench.all((0..4).map(row).collect())));
    assert_eq!(meant(&mut bench), Some(DRAWER));
    // A row of no table that has begun.
    assert_eq!(
        faults(&bench.say(&row(1))),
        [Fault::PartOutOfOrder {
            expected: 0,
            got: 1
        }]
    );
}

#[test]
fn what_is_no_row_over_the_vocabulary_is_refused() {
    let mut bench = Bench::new();
    bench.say(&hello());
    assert_eq!(faults(&bench.say(&row(0))), [Fault::NoVocabulary]);
    let mut bench = joint();
    let refused = |bench: &mut Bench, modality, category, n| {
        let row = ToUnit::Sensor(SensorPart::Row(SensorRow {
            modality,
            category,
            meant: 0,
            likelihoods: core::iter::repeat_n(9, n).collect(),
        }));
        faults(&bench.say(&row))
    };
    let not_square = |options| [Fault::Sensor(SensorError::NotSquare { options })];
    assert_eq!(
        refused(&mut bench, LANGUAGE, Category::STORAGE, 3),
        not_square(4)
    );
    assert_eq!(
        refused(&mut bench, LANGUAGE, Category::from_index(7).unwrap(), 1),
        not_square(0)
    );
    assert_eq!(
        refused(&mut bench, 4, Category::STORAGE, 4),
        [Fault::Sensor(SensorError::UnknownModality { capacity: 4 })]
    );
}

/// What is told of the marginal of the storages when `said` has these likelihoods.
fn storages(bench: &mut Bench, said: [f32; 4]) -> Vec<f32> {
    let said = [
        word(Category::ACTION, PUT),
        word(Category::OBJECT, CAN),
        Word::certain(Category::STORAGE, &said).unwrap(),
    ];
    let heard = bench.tell(&sentence(LANGUAGE, &said));
    let of = |m: &ToHost| match m {
        ToHost::Why(why) if why.category == Category::STORAGE => Some(why.merged.to_vec()),
        _ => None,
    };
    heard.iter().find_map(of).unwrap()
}

#[test]
fn likelihoods_are_taken_as_they_are() {
    let mut bench = joint();
    bench.say(&ToUnit::Configure(Configuration {
        profile: Profile::JOINT,
        expected: 1 << LANGUAGE,
        explain: true,
        ..Configuration::DEFAULT
    }));
    // Of the four only the drawer and the bowl are there.
    let said = [0.25, 1.0, 0.0, 0.75];
    let scored = storages(&mut bench, said);
    let part = ToUnit::Sensor(SensorPart::Likelihoods {
        modality: LANGUAGE,
        category: Category::STORAGE,
    });
    assert!(loaded(&bench.say(&part)));
    let taken = storages(&mut bench, said);
    assert!((taken[3] - 0.75).abs() < 0.02, "{taken:?}");
    assert!((scored[3] - 0.75).abs() > 0.05, "{scored:?}");
    storages(&mut bench, [0.9, 0.8, 0.7, 0.1]);
    assert_eq!(
        storages(&mut bench, said),
        taken,
        "the trace was used before"
    );
    // What cannot be, however surely it was said, leaves the others a chance of 1 in 1000.
    let sure = storages(&mut bench, [0.0, 0.0, 0.0, 1.0]);
    assert!((0.0005..0.002).contains(&sure[0]), "{sure:?}");
}
