//! The sets made here are statistically those that the authors' program made.

use std::path::Path;

use deictic_eval::catalogue::{CATEGORY_NAMES, Catalogue, MODALITY_NAMES};
use deictic_eval::dataset::{self, Set, write};
use deictic_eval::generate::{Kind, set};
use deictic_eval::noise::Level;

/// Both files say the same vocabulary.
#[test]
fn the_committed_vocabulary_is_the_reference_sets() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/sim");
    if !shared.exists() {
        println!("skipped: the reference's sets are not beside the project");
        return;
    }
    let theirs = Catalogue::read_json(&shared.join("vocab.json")).unwrap();
    let (ours, _) = Catalogue::papers();
    assert_eq!(ours.names, theirs.names);
    assert_eq!(ours.features, theirs.features);
    assert_eq!(ours.types, theirs.types);
    assert_eq!(ours.actions, theirs.actions);
    assert_eq!(ours.similarity, theirs.similarity);
}

#[test]
fn the_same_seed_gives_the_same_set_and_files_keep_it() {
    let (catalogue, recipe) = Catalogue::papers();
    let make = |seed| set(&catalogue, &recipe, Kind::Properties, Level::N3, 20, seed);
    assert_eq!(make(3).records, make(3).records);
    assert_ne!(make(3).records, make(4).records);

    let folder = tempfile::tempdir().unwrap();
    write::vocabulary(&folder.path().join("vocab.json"), &catalogue).unwrap();
    let made = make(3);
    write::set(&folder.path().join("D_prop_n3.jsonl.gz"), &made, &catalogue).unwrap();
    let (read_catalogue, read) = dataset::read_folder(folder.path()).unwrap();
    assert_eq!(read_catalogue.actions, catalogue.actions);
    assert_eq!(read[0].name, made.name);
    for (a, b) in read[0].records.iter().zip(&made.records) {
        assert_eq!(
            (&a.objects, &a.storages, a.truth),
            (&b.objects, &b.storages, b.truth)
        );
        let flat = |r: &deictic_eval::record::Record| -> Vec<f32> {
            r.words
                .iter()
                .flatten()
                .flatten()
                .flatten()
                .copied()
                .collect()
        };
        for (x, y) in flat(a).iter().zip(flat(b)) {
            assert!((x - y).abs() <= 1e-6);
        }
    }
}

/// The two-sample Kolmogorov-Smirnov statistic, scaled so that 1.63 is passed by chance in 1 % and
/// 2.3 in 5 of 100,000.
fn kolmogorov_smirnov(mut a: Vec<f64>, mut b: Vec<f64>) -> f64 {
    a.sort_by(f64::total_cmp);
    b.sort_by(f64::total_cmp);
    let (mut i, mut j, mut worst) = (0, 0, 0.0_f64);
    while i < a.len() && j < b.len() {
        let x = a[i].min(b[j]);
        while i < a.len() && a[i] <= x {
            i += 1;
        }
        while j < b.len() && b[j] <= x {
            j += 1;
        }
        let gap = i as f64 / a.len() as f64 - j as f64 / b.len() as f64;
        worst = worst.max(gap.abs());
    }
    let (n, m) = (a.len() as f64, b.len() as f64);
    worst * (n * m / (n + m)).sqrt()
}

/// What is compared of a sample's word: its mean, spread and the level of what is meant.
fn summaries(set: &Set, modality: usize, category: usize) -> [Vec<f64>; 3] {
    let mut out: [Vec<f64>; 3] = Default::default();
    for record in &set.records {
        let (Some(word), Some(meant)) = (
            &record.words[modality][category],
            record.truth.options()[category],
        ) else {
            continue;
        };
        let n = word.len() as f64;
        let mean = word.iter().map(|&x| f64::from(x)).sum::<f64>() / n;
        let spread = word
            .iter()
            .map(|&x| (f64::from(x) - mean).powi(2))
            .sum::<f64>()
            / n;
        out[0].push(mean);
        out[1].push(spread.sqrt());
        out[2].push(f64::from(word[usize::from(meant)]));
    }
    out
}

#[test]
fn made_sets_are_like_the_references() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/sim");
    if !shared.exists() {
        println!("skipped: the reference's sets are not beside the project");
        return;
    }
    let (catalogue, recipe) = Catalogue::papers();
    let mut tests = 0;
    for kind in Kind::ALL {
        for level in Level::ALL {
            let made = set(&catalogue, &recipe, kind, level, 4_000, 11);
            let file = shared.join(format!("{}.jsonl.gz", made.name));
            let theirs = dataset::read(&file, &catalogue).unwrap();
            for (m, modality) in MODALITY_NAMES.iter().enumerate() {
                for (c, category) in CATEGORY_NAMES.iter().enumerate() {
                    let pairs = summaries(&made, m, c)
                        .into_iter()
                        .zip(summaries(&theirs, m, c));
                    for (what, (ours, theirs)) in ["mean", "spread", "meant"].iter().zip(pairs) {
                        let place = format!("{} {modality} {category} {what}", made.name);
                        let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
                        let gap = (mean(&ours) - mean(&theirs)).abs();
                        assert!(gap < 0.03, "{place}: means differ by {gap}");
                        let d = kolmogorov_smirnov(ours, theirs);
                        assert!(d < 2.3, "{place}: D = {d}");
                        tests += 1;
                    }
                }
            }
            for action in 0..catalogue.count(0) {
                let share = |set: &Set| {
                    let can = |r: &&deictic_eval::record::Record| catalogue.possible(action, r);
                    set.records.iter().filter(can).count() as f64 / set.records.len() as f64
                };
                let gap = (share(&made) - share(&theirs)).abs();
                assert!(gap < 0.06, "{}: action {action} possible: {gap}", made.name);
            }
        }
    }
    assert_eq!(tests, 15 * 2 * 3 * 3);
}
