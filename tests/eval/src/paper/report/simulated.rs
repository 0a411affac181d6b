//! The paper's simulated sets.

use super::Material;
use super::table::{cell, row, share, table};
use crate::paper::{aligned, unaligned};
use crate::score::Tally;
use crate::variant::{ModelName, ProfileName, Variant};

/// Whole intents of M3 beside the reference's, the joint model's and the bound.
pub fn side_by_side(material: &Material<'_>) -> String {
    let mut rows = String::new();
    for level in 0..5 {
        for (name, sets) in [("aligned", aligned(level)), ("unaligned", unaligned(level))] {
            let of = |profile| Variant::new(ModelName::M3, None, None, profile);
            let argmax = |profile| share(material, &sets, of(profile), |t| t.triple_argmax);
            let joint = Variant::new(ModelName::Joint, None, None, ProfileName::Paper);
            let recorded = material.recorded;
            let reference = recorded.and_then(|r| r.accuracy(&sets, of(ProfileName::Reference)));
            let bound = material.results.bound(&sets);
            rows += &row(&[
                format!("{name}, n{level}"),
                cell(argmax(ProfileName::Paper)),
                cell(argmax(ProfileName::Reference)),
                cell(reference.map(|a| a.triple_argmax)),
                cell(share(material, &sets, joint, |t| t.triple_argmax)),
                cell(bound.map(|b| b.percent(b.triple))),
                cell(recorded.and_then(|r| r.bound(&sets))),
                cell(bound.map(|b| b.percent(b.floor))),
            ]);
        }
    }
    let heads = [
        "Sets",
        "M3, paper's text",
        "M3, reference's habits",
        "Reference, recorded",
        "Joint",
        "Bayes bound",
        "Bound, recorded",
        "No signal",
    ];
    format!(
        "<h2>Whole intents</h2><p>Action, object and storage all right by argmax. The bound knows \
         the noise and takes the likeliest triple that is feasible in the scene. The last column is \
         what the scene and the presence of words give away with nothing said; more still can be \
         had from how these scenes are built, as all but the true thing are spoiled.</p>{}",
        table(&heads, &rows)
    )
}

/// The paper's text against the reference's habits.
pub fn differences(material: &Material<'_>) -> String {
    let mut rows = String::new();
    for level in 0..5 {
        let sets = [aligned(level), unaligned(level)].concat();
        let mut cells = vec![format!("n{level}")];
        for count in [
            (|t: &Tally| t.triple_decided) as fn(&Tally) -> usize,
            |t| t.triple_wrong_executed,
            |t| t.action_decided,
            |t| t.action_wrong_executed,
        ] {
            for profile in [ProfileName::Paper, ProfileName::Reference] {
                let variant = Variant::new(ModelName::M3, None, None, profile);
                cells.push(cell(share(material, &sets, variant, count)));
            }
        }
        rows += &row(&cells);
    }
    let heads = [
        "",
        "Triple right, text",
        "reference",
        "wrong, text",
        "reference",
        "Action right, text",
        "reference",
        "wrong, text",
        "reference",
    ];
    format!(
        "<h2>The paper's text and the reference</h2><p>M3, sum, entropy thresholds, all simulated \
         sets. By the text an action is executed only when it alone is clear and every parameter is \
         clear, in the scene and fit for it; otherwise the person is asked. The reference takes the \
         best of several clear actions, settles each category on its own, over names that are not in \
         the scene too, and takes an action as feasible when any pair of things would do. So it \
         decides more and executes more that was not meant.</p>{}",
        table(&heads, &rows)
    )
}
