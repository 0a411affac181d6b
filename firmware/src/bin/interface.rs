//! Calls the whole public interface of deictic-core with values that the compiler cannot know. It is never run: what
//! counts is that it links, since the panic handler of a release image refers to a function that nowhere exists.
//!
//! With the feature `indexing` one `x[i]` is added, and it must not link.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use deictic_core::align::Alignment;
use deictic_core::can::{FLEXIBLE, Frame};
use deictic_core::category::{BitSet, Category};
use deictic_core::clarify::choose::choose;
use deictic_core::clarify::{Confirmation, gain};
use deictic_core::command::message::{FromRobot, ToRobot};
use deictic_core::command::parcel::{Assembler, Sender, frames};
use deictic_core::command::seal::{Guard, Heard};
use deictic_core::command::{Packet, field};
use deictic_core::decide::decide;
use deictic_core::fuse::{Situation, fuse, says_clearly};
use deictic_core::gesture::calibration::Calibration;
use deictic_core::gesture::line::{SensorLine, send};
use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::gesture::wire::{decode, encode};
use deictic_core::joint::posterior::Triple;
use deictic_core::joint::{self, Tables};
use deictic_core::judgement::judge;
use deictic_core::merge::Merge;
use deictic_core::profile::{Align, Model, Profile};
use deictic_core::protocol::seal::{Key, Nonces, Way};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::slcan::{Adapter, Lines, line};
use deictic_core::time::Micros;
use deictic_core::{board, entropy, feasibility, large, math, merge, reference};
use deictic_firmware as _;

/// Anything at all.
fn any<T: Copy>(value: T) -> T {
    black_box(value)
}

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
    figures();
    lines();
    loop {
        cortex_m::asm::wfi();
    }
}

/// What works on figures alone.
fn figures() {
    let w = any([0.1_f32; 9]);
    let w = w.get(..any(7_usize)).unwrap_or(&w);
    let mut h = any([0.0; 9]);
    let mut to = any([0.0; 9]);
    let entropy = entropy::diagonal_cross_entropy(w, &mut h);
    entropy::normalise(&mut to);
    black_box(entropy::white_noise(any(1000)));
    merge::penalise(w, &mut h, any(0.1), &mut to);
    let threshold = any(Profile::PAPER).threshold;
    let (judgement, _) = judge(w, &h, entropy, threshold);
    black_box((judgement.is_clear(any(70)), judgement.decided(any(0.0))));
    let requirement = deictic_core::vocabulary::Requirement {
        wanted: BitSet(any(5)),
        unwanted: BitSet(any(6)),
    };
    let signature = deictic_core::vocabulary::Signature {
        compulsory: BitSet(any(2)),
        voluntary: BitSet(any(4)),
    };
    black_box(feasibility::alignment(requirement, w));
    black_box(feasibility::best_alignment(requirement, &[w]));
    black_box(feasibility::alpha(
        feasibility::signature_mismatch(signature, w),
        any(-1.6),
    ));
    reference::lift(&mut to, |i| i == any(3));
    reference::stretch(&mut to, |i| i != any(2));
    reference::boost(&mut to, any(Category::STORAGE), any(Merge::Mul));
    black_box(reference::is_one_hot(w));
    black_box((
        math::argmax(w),
        math::ln(any(2.0)),
        math::exp(any(1.0)),
        math::sqrt(any(2.0)),
    ));
    black_box((
        math::atan2(any(1.0), any(2.0)),
        math::round(any(0.5)),
        math::clamp_unit(any(2.0)),
    ));
    let mut calibration = Calibration::new();
    calibration.missed_by(any(0.1));
    black_box(calibration.aim());
    black_box((Category::user(any(255)), Category::from_index(any(99))));
    let set = BitSet(any(9)).with(any(77));
    black_box((set.contains(any(40)), set.fits(any(33)), set.iter().count()));
    #[cfg(feature = "indexing")]
    black_box(w[any(8_usize)]);
}

/// What works on bytes.
fn lines() {
    let bytes = any([7_u8; 88]);
    let mut out = Outbox::<128>::new();
    let mut sensor = SensorLine::new();
    for byte in bytes {
        black_box(sensor.push(byte).is_some());
    }
    if let Ok(sample) = decode(&bytes) {
        black_box(encode(&sample).is_ok());
        black_box(send(&sample, &mut out).is_ok());
    }
    out.written(any(5));
    out.abandon();
    let (mut ear, mut adapter) = (Lines::new(), Adapter::new());
    for byte in bytes {
        black_box((ear.hear(byte).is_some(), adapter.take(byte).is_some()));
    }
    let packet = Packet {
        id: any(0x20),
        bytes: heapless::Vec::from_slice(bytes.get(..any(30)).unwrap_or(&[])).unwrap_or_default(),
    };
    for sender in [Sender::Host, Sender::Robot] {
        guarded(sender, &packet);
        let mut assembler = Assembler::new(sender);
        for frame in frames(sender, &packet) {
            black_box(line(&frame).len());
            black_box(assembler.take(&frame).is_some());
        }
        for frame in frames::<FLEXIBLE>(sender, &packet) {
            black_box((frame.id(), frame.data().len()));
            black_box(assembler.take(&frame).is_some());
        }
    }
    if let Ok(message) = ToRobot::read(&packet) {
        black_box(message.packet());
    }
    if let Ok(message) = FromRobot::read(&packet) {
        black_box(message.packet());
    }
    if let Some((frame, carried)) = Frame::of_stream(any(0x200), &bytes) {
        black_box((carried, frame.stream().len()));
    }
    black_box((
        field::Place::of_metres(any([0.1; 3])),
        field::Angle::of_radians(any(1.0)).radians(),
    ));
    black_box(field::Features::new(&any([0.5; 40])));
    let mut link = large::Link::new();
    if let Some(key) = Key::new(&any([1; 32])) {
        link.lock(key, any(Way::ToUnit));
        link.seal(Nonces {
            unit: any(1),
            host: any(2),
        });
    }
    for byte in bytes {
        black_box(link.receive::<large::ToHost>(byte).is_some());
    }
    let mut out = Outbox::<1024>::new();
    black_box(link.send(&large::ToUnit::AskStatistics, &mut out));
    black_box(link.counters().dropped());
}

/// A packet past a guard and back.
fn guarded(side: Sender, packet: &Packet) {
    let Some(key) = Key::new(&any([2; 32])) else {
        return;
    };
    let mut guard = Guard::new(side, key, any(4), any(3));
    let answer = match guard.hear(packet) {
        Heard::Message(packet) | Heard::Answer(packet) => packet,
        Heard::Nothing => packet.clone(),
    };
    for said in guard.say(&answer) {
        black_box(guard.hear(&said) == Heard::Nothing);
    }
    black_box((
        guard.refused().all(),
        guard.is_challenged(),
        guard.is_proven(),
    ));
}
