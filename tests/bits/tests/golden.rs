//! The hash over every figure of 75,000 decisions is the committed one, in every build.

use deictic_bits::hand::{HandBench, SESSIONS};
use deictic_bits::{Bench, GOLDEN, SAMPLES, START};
use deictic_core::decide::Outcome;
use deictic_core::profile::Profile;

#[test]
fn every_bit_is_the_golden_one() {
    let hash = Bench::new().hash(START, 0..SAMPLES);
    assert_eq!(
        hash, GOLDEN,
        "{hash:#018x}: some decision has changed in at least one bit; if that is meant, this is the \
         new GOLDEN"
    );
}

#[test]
fn portions_give_what_the_whole_gives() {
    let mut bench = Bench::new();
    let whole = bench.hash(START, 0..120);
    let portions = (0..12).fold(START, |hash, k| bench.hash(hash, 10 * k..10 * (k + 1)));
    assert_eq!(whole, portions);
}

#[test]
fn the_samples_reach_every_outcome() {
    let mut bench = Bench::new();
    let (mut done, mut asked, mut repeated) = (0, 0, 0);
    for i in 0..4_000 {
        bench.sample(i);
        match bench.decide(&Profile::PAPER).unwrap().outcome {
            Outcome::Execute(_) => done += 1,
            Outcome::Ask(_) => asked += 1,
            Outcome::Repeat | Outcome::GiveUp => repeated += 1,
        }
        let finite = bench
            .trace()
            .categories()
            .iter()
            .all(|w| w.merged.iter().chain(&w.h).all(|x| x.is_finite()));
        assert!(finite, "sample {i}");
    }
    assert!(
        done > 100 && asked > 100 && repeated > 10,
        "{done} {asked} {repeated}"
    );
}

#[test]
fn the_case_of_the_budget_has_every_word() {
    let mut bench = Bench::new();
    bench.m3_case();
    assert!(bench.decide(&Profile::PAPER).unwrap().best.is_some());
    let words: Vec<(u8, f32)> = bench
        .trace()
        .categories()
        .iter()
        .map(|w| (w.options, w.present))
        .collect();
    assert_eq!(words[..3], [(9, 1.0), (7, 1.0), (4, 1.0)]);
}

#[test]
fn a_bench_fits_beside_a_unit() {
    assert!(
        size_of::<Bench>() <= 12 * 1024,
        "{} bytes",
        size_of::<Bench>()
    );
}

#[test]
fn the_hand_of_the_budget_is_read_as_one_that_points_sweeps_and_leaves() {
    let mut bench = HandBench::new();
    bench.prepare();
    assert_eq!(bench.unit().hand_view().no_stroke, 1.0);
    let mut together = 0;
    for session in 0..SESSIONS {
        let (mut words, mut compared) = (Vec::new(), None);
        for k in 0.. {
            let Some(frame) = bench.next(session, k) else {
                break;
            };
            let before = bench.unit().hand_view();
            bench.sense(frame.waiting());
            bench.hear();
            let view = bench.unit().hand_view();
            if view.words.len() > before.words.len() {
                words.push(k);
            }
            if view.no_stroke < 0.5 && before.no_stroke == 1.0 {
                compared = Some(k);
            }
        }
        // Sixteen frames compare 128 templates. A hand that closes before the sweep has ended does not gesture.
        if let Some(compared) = compared {
            together += usize::from(words.iter().any(|k| (compared - 15..compared).contains(k)));
        }
    }
    assert!(
        together > 0,
        "no word was closed while strokes were compared"
    );
    // Where the fist ends the sweep, what is left says no action and answers the question before it.
    let decided = bench.unit().statistics();
    assert!(decided.asks >= SESSIONS / 2, "{decided:?}");
}
