//! `high-water IMAGE START END`: boots the unit's image with the memory from START to END painted, holds whole
//! conversations with it, and prints the line `high-water BYTES`: the most stack that it ever used.

use std::path::Path;
use std::time::Duration;

use deictic::hand::source::recording::framed;
use deictic_bits::Bench;
use deictic_core::board::{Sentence, ToHost, ToUnit};
use deictic_core::profile::Profile;
use deictic_core::protocol::message::{Configuration, Fault};
use deictic_core::time::Micros;
use deictic_tests::gesturing::{RATE, person, ready};
use deictic_tests::host::{Host, Wire};
use deictic_tests::painted::Painted;
use deictic_tests::sensing::put;

/// Situations that are decided on in each way.
const SAMPLES: u32 = 60;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, image, start, end] = arguments.as_slice() else {
        panic!("high-water IMAGE START END");
    };
    let address = |text: &str| text.parse::<u32>().expect("an address in decimal");
    let board = Painted::boot(Path::new(image), address(start)..address(end));
    let mut host = ready(board);
    show(&mut host);
    let decided: u32 = [
        Profile::PAPER,
        Profile::BASELINE,
        Profile::FIXED,
        Profile::JOINT,
    ]
    .map(|profile| decide(&mut host, profile))
    .iter()
    .sum();
    assert!(decided > SAMPLES, "only {decided} decisions");
    host.wire.write(&[0x55; 3_000]);
    host.wire.write(&[0]);
    host.say(&ToUnit::AskStatistics);
    host.wait_for(|m| matches!(m, ToHost::Statistics(_)).then_some(()));
    println!("high-water {}", host.wire.high_water());
}

/// A hand shows something, at its sensor's pace.
fn show(host: &mut Host<Painted>) {
    host.say(&ToUnit::Relay(true));
    for (i, sample) in person(3, &put()).iter().enumerate() {
        host.wire.sense(&framed(sample));
        std::thread::sleep(Duration::from_secs_f64(1.0 / RATE));
        if i % 20 == 0 {
            host.say(&ToUnit::AskHand);
        }
        host.hear();
    }
    host.wait_for(|m| matches!(m, ToHost::Decision(_)).then_some(()));
}

/// Situations of all kinds, decided on in one way and explained; gives how many.
fn decide(host: &mut Host<Painted>, profile: Profile) -> u32 {
    host.configure(Configuration {
        profile,
        window: Micros::from_millis(60_000),
        expected: 0b11,
        explain: true,
    });
    let mut bench = Bench::new();
    let mut decided = 0;
    for i in 0..SAMPLES {
        bench.sample(i);
        let words = |s: &Sentence| s.words().iter().filter(|w| w.is_present()).count();
        let said: Vec<usize> = bench.observations().iter().map(words).collect();
        // A unit waits for both modalities, but not when one says nothing but stop.
        if said.len() != 2 || said.contains(&0) || said.contains(&1) {
            continue;
        }
        host.load_vocabulary(bench.vocabulary());
        host.load_scene(i + 1, bench.scene());
        for sentence in bench.observations().iter() {
            host.tell(sentence);
        }
        host.wait_for(|m| match m {
            ToHost::Decision(_) => Some(()),
            ToHost::Fault(fault) => panic!("{:?}", Fault::clone(fault)),
            _ => None,
        });
        decided += 1;
    }
    decided
}
