//! The core with the reference's habits against the reference's recorded answers.

use std::path::Path;

use deictic_eval::{dataset, parity};

#[test]
fn every_decision_of_the_reference_is_reproduced() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    if !shared.join("data/sim/vocab.json").exists() {
        println!("skipped: the reference's sets are not beside the project");
        return;
    }
    let (catalogue, sets) = dataset::read_folder(&shared.join("data/sim")).unwrap();
    let parity = parity::compare(&catalogue, &sets, &shared.join("reference/predictions")).unwrap();
    assert_eq!(parity.compared, 15 * 1000 * 15 * 6);
    assert!(parity.agreement >= 0.999, "{}", parity.agreement);
    assert!(parity.identical >= 0.998, "{}", parity.identical);
    for d in &parity.differences {
        assert!(d.tie, "not explained by a tie: {d:?}");
        assert!(d.field.starts_with("max_"), "a decision differs: {d:?}");
    }
}
