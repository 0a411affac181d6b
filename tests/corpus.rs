//! Every committed input of every fuzzing target, and some thousands of random ones, without a fuzzer.

use std::path::Path;

use deictic_bits::random::Random;
use deictic_tests::fuzz::TARGETS;

/// How many random inputs each target gets.
const RANDOM: usize = 2_000;

#[test]
fn nothing_in_the_corpora_breaks_what_must_hold() {
    for target in TARGETS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("fuzz/corpus")
            .join(target.name);
        let mut replayed = 0;
        for entry in
            std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        {
            let path = entry.unwrap().path();
            eprintln!("{}", path.display());
            (target.run)(&std::fs::read(&path).unwrap());
            replayed += 1;
        }
        assert!(replayed > 0, "{} has no corpus", target.name);
    }
}

#[test]
fn nothing_random_breaks_what_must_hold() {
    for target in TARGETS {
        let mut random = Random::new(target.bytes as u64);
        let mut bytes = vec![0; target.bytes];
        for _ in 0..RANDOM {
            bytes.iter_mut().for_each(|b| *b = random.below(256) as u8);
            (target.run)(&bytes);
        }
    }
}
