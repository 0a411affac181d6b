//! Sets that the paper's simulation does not cover: D_free and the user study's set-ups.

use super::Material;
use super::table::{cell, row, share, table};
use crate::paper::{MODELS, real_aligned};
use crate::score::Tally;
use crate::variant::{ModelName, ProfileName, Variant};

/// Every model on D_free, with its bound and its floor.
pub fn free(material: &Material<'_>) -> String {
    let mut rows = String::new();
    for level in 0..5 {
        let sets = [format!("D_free_n{level}")];
        let Some(bound) = material.results.bound(&sets) else {
            return String::new();
        };
        let mut cells = vec![format!("n{level}")];
        let of = |model| Variant::new(model, None, None, ProfileName::Paper);
        for model in MODELS.into_iter().chain([ModelName::Joint]) {
            let right = share(material, &sets, of(model), |t| t.triple_argmax);
            cells.push(cell(right));
        }
        cells.push(cell(Some(bound.percent(bound.triple))));
        cells.push(cell(Some(bound.percent(bound.floor))));
        for variant in [ModelName::M3, ModelName::Joint].map(of) {
            for count in [(|t: &Tally| t.triple_decided) as fn(&Tally) -> usize, |t| {
                t.triple_wrong_executed
            }] {
                cells.push(cell(share(material, &sets, variant, count)));
            }
        }
        rows += &row(&cells);
    }
    let heads = [
        "",
        "Baseline",
        "M1",
        "M2",
        "M3",
        "Joint",
        "Bayes bound",
        "No signal",
        "M3 executed right",
        "wrong",
        "Joint executed right",
        "wrong",
    ];
    format!(
        "<h2>D_free</h2><p>Whole intents right by argmax on scenes drawn before the intent, with \
         at least three actions with parameters possible in each; the paper's text throughout, \
         and the joint model at a risk of 1 %.</p>{}",
        table(&heads, &rows)
    )
}

/// Baseline, M3 and the joint model on the set-ups.
pub fn setups(material: &Material<'_>) -> String {
    let mut rows = String::new();
    for (name, sets) in [
        ("aligned", real_aligned()),
        (
            "wrong action in gesture",
            vec!["real_wrong_action_in_gesture".to_owned()],
        ),
        (
            "wrong action in language",
            vec!["real_wrong_action_in_language".to_owned()],
        ),
        (
            "wrong object in gesture",
            vec!["real_wrong_object_in_gesture".to_owned()],
        ),
        (
            "wrong object in language",
            vec!["real_wrong_object_in_language".to_owned()],
        ),
    ] {
        let mut cells = vec![name.to_owned()];
        for model in [ModelName::Baseline, ModelName::M3, ModelName::Joint] {
            let variant = Variant::new(model, None, None, ProfileName::Paper);
            for count in [
                (|t: &Tally| t.triple_argmax) as fn(&Tally) -> usize,
                |t| t.triple_decided,
                |t| t.triple_wrong_executed,
            ] {
                let Some(share) = share(material, &sets, variant, count) else {
                    return String::new();
                };
                cells.push(cell(Some(share)));
            }
        }
        rows += &row(&cells);
    }
    let heads = [
        "Command",
        "Baseline, likeliest right",
        "executed right",
        "wrong",
        "M3, likeliest right",
        "executed right",
        "wrong",
        "Joint, likeliest right",
        "executed right",
        "wrong",
    ];
    format!(
        "<h2>The user study's set-ups</h2><p>Whole intents, the paper's text. Of two contradicting \
         objects the one in the modality with the sharper similarity table mostly wins, right or \
         wrong, because M3 picks each parameter alone.</p>{}",
        table(&heads, &rows)
    )
}
