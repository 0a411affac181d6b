//! What a decision, the dearest frame of a hand and a frame of the host link cost on the board: instructions (in QEMU with `-icount shift=10`) and
//! stack. `cargo xtask budget` reads the lines `instructions NAME COUNT` and `stack NAME BYTES`.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use deictic_bits::Bench;
use deictic_bits::hand::{HandBench, SESSIONS};
use deictic_core::board::{Link, ToUnit};
use deictic_core::profile::{Model, Profile};
use deictic_core::protocol::message::Heartbeat;
use deictic_core::protocol::seal::{KEY, Key, Nonces, Way};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::time::Micros;
use deictic_firmware::mps2_an386::measure::{Counter, stack_used};

/// Models with the paper's other choices.
const MODELS: [(&str, Model); 3] = [("m1", Model::M1), ("m2", Model::M2), ("m3", Model::M3)];

#[entry]
fn main() -> ! {
    static mut BENCH: Bench = Bench::new();
    static mut HAND: HandBench = HandBench::new();
    static mut ENDS: [Link; 2] = [Link::new(), Link::new()];
    if let Some(core) = cortex_m::Peripherals::take() {
        let mut counter = Counter::new(core.SYST);
        BENCH.m3_case();
        let mut measure = |name: &str, profile: &Profile| {
            let count = counter.instructions(|| decide(BENCH, profile));
            hprintln!("instructions {} {}", name, count);
            let stack = stack_used(|| decide(BENCH, profile));
            hprintln!("stack {} {}", name, stack);
        };
        measure("baseline", &Profile::BASELINE);
        for (name, model) in MODELS {
            measure(
                name,
                &Profile {
                    model,
                    ..Profile::PAPER
                },
            );
        }
        measure("joint", &Profile::JOINT);
        for (name, key) in [("", None), ("-sealed", Key::new(black_box(&[7; KEY])))] {
            let [say, hear] = frame(ENDS, key, &mut counter);
            hprintln!("instructions say{} {}", name, say);
            hprintln!("instructions hear{} {}", name, hear);
        }
        let most = largest(BENCH, &mut counter);
        hprintln!("instructions joint-largest {}", most);
        HAND.prepare();
        hprintln!("instructions hand {}", worst_frame(HAND, &mut counter));
        debug::exit(debug::EXIT_SUCCESS);
    }
    loop {
        cortex_m::asm::wfi();
    }
}

/// One decision, its result kept from being optimised away.
#[inline(never)]
fn decide(bench: &mut Bench, profile: &Profile) {
    let decision = bench.decide(black_box(profile));
    black_box(decision.is_ok());
}

/// Samples of `deictic-bits` that the joint model decides.
const SAMPLES: u32 = 512;

/// The most that a joint decision costs among situations of all kinds: vocabularies of their own, two or three modalities,
/// words that are missing, faint, clipped or of uncertain category.
fn largest(bench: &mut Bench, counter: &mut Counter) -> u32 {
    let mut largest = 0;
    for sample in 0..SAMPLES {
        bench.sample(sample);
        largest = counter
            .instructions(|| decide(bench, &Profile::JOINT))
            .max(largest);
    }
    largest
}

/// The most that reading one frame costs, from the first byte on the sensor's line to all that follows from it, be it a
/// decision.
fn worst_frame(bench: &mut HandBench, counter: &mut Counter) -> u32 {
    let mut worst = 0;
    for session in 0..SESSIONS {
        let mut k = 0;
        while let Some(frame) = bench.next(session, k) {
            worst = counter
                .instructions(|| bench.sense(black_box(frame.waiting())))
                .max(worst);
            bench.hear();
            k = k.wrapping_add(1);
        }
    }
    worst
}

/// What a frame with the contents of a heartbeat costs its sender and its receiver, sealed where there is a key.
fn frame(ends: &mut [Link; 2], key: Option<Key>, counter: &mut Counter) -> [u32; 2] {
    let [unit, host] = ends;
    if let Some(key) = key {
        let nonces = Nonces { unit: 1, host: 2 };
        unit.lock(key.clone(), Way::ToHost);
        host.lock(key, Way::ToUnit);
        unit.seal(nonces);
        host.seal(nonces);
    }
    let beat = ToUnit::Heartbeat(Heartbeat {
        now: Micros(1_234_567_890),
        vocabulary: 0xdead_beef,
        scene: 1_000,
    });
    let mut out = Outbox::<128>::new();
    let say = counter.instructions(|| host.send(black_box(&beat), &mut out));
    let mut taken = false;
    let hear = counter.instructions(|| {
        for byte in out.waiting() {
            taken |= unit.receive::<ToUnit>(*byte).is_some();
        }
    });
    // A frame that is not taken costs as much as none.
    [say, if taken { hear } else { 0 }]
}
