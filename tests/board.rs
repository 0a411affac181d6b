//! The unit on an emulated board decides what the same unit in this process decides, bit for bit,
//! and survives what links and hosts do to it.

use deictic_bits::Bench;
use deictic_core::board::{Sentence, ToHost, ToUnit};
use deictic_core::category::Category;
use deictic_core::profile::Profile;
use deictic_core::protocol::message::{Configuration, Fault, Statistics};
use deictic_core::time::Micros;
use deictic_tests::emulated::{Emulated, has_image};
use deictic_tests::host::{Host, Inside, Wire, sentence_parts};

fn configuration(profile: Profile) -> Configuration {
    let window = Micros::from_millis(60_000);
    Configuration {
        profile,
        window,
        expected: 0b11,
        explain: true,
    }
}

/// Everything that a unit says about a command: the decision and why.
fn decide<W: Wire>(host: &mut Host<W>, bench: &Bench) -> Vec<ToHost> {
    for sentence in bench.observations().iter() {
        host.tell(sentence);
    }
    let spoken = |c: &Category| {
        let words = || bench.observations().iter().flat_map(|s| s.words());
        words().any(|w| w.is_present() && w.categories().get(c.index()).is_some_and(|p| *p > 0.0))
    };
    let categories = (0..bench.vocabulary().options().len()).filter_map(Category::from_index);
    // The decision, the actions' penalties, and each category that was spoken of.
    let expected = 2 + categories.filter(spoken).count();
    (0..expected)
        .map(|_| {
            host.wait_for(|m| match m {
                ToHost::Heartbeat(_) => None,
                other => Some(other.clone()),
            })
        })
        .collect()
}

fn statistics<W: Wire>(host: &mut Host<W>) -> Statistics {
    host.say(&ToUnit::AskStatistics);
    host.wait_for(|m| match m {
        ToHost::Statistics(statistics) => Some(*statistics),
        _ => None,
    })
}

fn conversation<W: Wire>(wire: W, samples: std::ops::Range<u32>) -> Vec<Vec<ToHost>> {
    let mut host = Host::new(wire);
    let mut bench = Bench::new();
    host.hello();
    host.configure(configuration(Profile::PAPER));
    samples
        .filter_map(|i| {
            bench.sample(i);
            // A unit waits for both modalities, but not when one says nothing but stop.
            let words = |s: &Sentence| s.words().iter().filter(|w| w.is_present()).count();
            let said: Vec<usize> = bench.observations().iter().map(words).collect();
            if said.len() != 2 || said.contains(&0) || said.contains(&1) {
                return None;
            }
            host.load_vocabulary(bench.vocabulary());
            host.load_scene(i + 1, bench.scene());
            Some(decide(&mut host, &bench))
        })
        .collect()
}

#[test]
fn the_board_decides_what_the_host_decides_bit_for_bit() {
    if !has_image() {
        return;
    }
    let samples = 0..150;
    let on_board = conversation(Emulated::boot(), samples.clone());
    let inside = conversation(Inside::default(), samples);
    assert!(
        on_board.len() > 50,
        "only {} samples have both modalities",
        on_board.len()
    );
    // Messages hold the very bits of every float; equality of f32 would take 0 and -0 for the same,
    // their text does not.
    assert_eq!(format!("{on_board:?}"), format!("{inside:?}"));
}

#[test]
fn damage_on_the_line_is_counted_and_nothing_is_decided_from_it() {
    if !has_image() {
        return;
    }
    let mut host = Host::new(Emulated::boot());
    let mut bench = Bench::new();
    bench.m3_case();
    host.hello();
    host.load_vocabulary(bench.vocabulary());
    host.load_scene(1, bench.scene());
    host.configure(configuration(Profile::PAPER));
    let mut sentences = bench.observations().iter();
    let first = sentences.next().expect("two sentences").clone();
    let first = sentence_parts(&first);
    let good = host.frame(&first[0]);
    for at in (0..good.len() - 1).step_by(7) {
        let mut bad = good.clone();
        bad[at] ^= 0x20;
        host.wire.write(&bad);
    }
    host.wire.write(&[0x55; 1_500]);
    host.wire.write(&[0]);
    let counted = statistics(&mut host);
    assert_eq!((counted.executes, counted.asks, counted.repeats), (0, 0, 0));
    assert!(
        counted.link.corrupt > 0 && counted.link.oversized == 1,
        "{counted:?}"
    );
    // The sound frame is older than the question for statistics by now, and is dropped as such.
    host.wire.write(&good);
    assert_eq!(statistics(&mut host).link.reordered, 1);
    let decided = decide(&mut host, &bench);
    let Some(ToHost::Decision(decided)) = decided.first() else {
        panic!("{decided:?}")
    };
    assert!(decided.decision.best.is_some() && decided.modalities == 0b11);
}

#[test]
fn a_board_that_comes_back_knows_nothing_and_says_so() {
    if !has_image() {
        return;
    }
    let mut bench = Bench::new();
    bench.m3_case();
    let mut host = Host::new(Emulated::boot());
    host.hello();
    host.load_vocabulary(bench.vocabulary());
    host.load_scene(1, bench.scene());
    let first = bench
        .observations()
        .iter()
        .next()
        .expect("two sentences")
        .clone();
    host.tell(&first);

    // The plug is pulled in the middle of a command.
    host.wire = Emulated::boot();
    host.tell(&first);
    let fault = host.wait_for(|m| match m {
        ToHost::Fault(fault) => Some(*fault),
        _ => None,
    });
    assert_eq!(fault, Fault::NoHello);
    host.hello();
    let counted = statistics(&mut host);
    assert_eq!((counted.executes, counted.asks), (0, 0));
}
