//! The paper's own figures come out again, on sets made here and on the reference's where those are
//! at hand.

use std::path::Path;

use deictic_eval::catalogue::Catalogue;
use deictic_eval::dataset::{self, Set};
use deictic_eval::generate::{Kind, set};
use deictic_eval::noise::Level;
use deictic_eval::paper::claims::{stated, verdicts};
use deictic_eval::paper::{Group, draw, report, run, studies};
use deictic_eval::situation::FeatureForm;

fn check(catalogue: Catalogue, sets: Vec<Set>) -> deictic_eval::paper::Results {
    let group = Group {
        catalogue,
        sets,
        form: FeatureForm::Sure,
    };
    let results = run(&[group], &|| ()).unwrap();
    for claim in stated() {
        let Some(within) = claim.within else { continue };
        let tally = results.tally(&claim.sets, claim.variant).unwrap();
        let ours = tally.percent(tally.action_decided);
        assert!(
            (ours - claim.stated).abs() <= within,
            "{}: {ours} instead of {}",
            claim.what,
            claim.stated
        );
    }
    for verdict in verdicts(&results).unwrap() {
        assert!(verdict.holds, "{}: {}", verdict.says, verdict.figures);
    }
    results
}

#[test]
fn the_paper_comes_out_again_on_sets_made_here() {
    let (catalogue, recipe) = Catalogue::papers();
    let all = Kind::ALL
        .into_iter()
        .flat_map(|kind| Level::ALL.map(|level| (kind, level)));
    let sets: Vec<Set> = all
        .map(|(kind, level)| set(&catalogue, &recipe, kind, level, 4000, 1))
        .collect();
    let results = check(catalogue, sets);

    let folder = tempfile::tempdir().unwrap();
    draw::noise_levels(folder.path()).unwrap();
    let mut drawn = Vec::new();
    for figure in studies::figures(&results) {
        draw::figure(folder.path(), &figure).unwrap();
        let svg = std::fs::read_to_string(folder.path().join(format!("{}.svg", figure.name)));
        let png = std::fs::read(folder.path().join(format!("{}.png", figure.name))).unwrap();
        assert!(png.starts_with(b"\x89PNG"));
        drawn.push((figure, svg.unwrap()));
    }
    assert!(drawn.len() >= 7);
    let html = report::html(&report::Material {
        results: &results,
        recorded: None,
        figures: &drawn,
        noise_levels: "",
        source: "",
    });
    assert_eq!(html.matches("<svg").count(), drawn.len());
    assert!(!html.contains("NaN") && !html.contains("not met</span>"));
    // Self-contained: nothing is loaded from elsewhere.
    assert!(!html.contains("src=") && !html.contains("href="));
}

#[test]
fn the_paper_comes_out_again_on_the_references_sets() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/sim");
    if !shared.exists() {
        println!("skipped: the reference's sets are not beside the project");
        return;
    }
    let (catalogue, sets) = dataset::read_folder(&shared).unwrap();
    check(catalogue, sets);
}
