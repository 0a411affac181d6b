//! What the paper states, beside what comes out here.

use super::{MODELS, Results, aligned, unaligned};
use crate::variant::{MergeName, ModelName, ProfileName, ThresholdName, Variant};

/// A figure that the paper states.
pub struct Stated {
    /// Of what.
    pub what: &'static str,
    /// The figure, in percent.
    pub stated: f64,
    /// On which sets.
    pub sets: Vec<String>,
    /// By which variant.
    pub variant: Variant,
    /// How near it must come, in points; `None` where the paper's code does not reach it either.
    pub within: Option<f64>,
}

/// All of the paper's figures. They count the action alone.
#[must_use]
pub fn stated() -> Vec<Stated> {
    let of = |model| Variant::new(model, None, None, ProfileName::Reference);
    let entry = |what, stated, sets, model, within| Stated {
        what,
        stated,
        sets,
        variant: of(model),
        within,
    };
    let prop = vec!["D_prop_n4".to_owned()];
    let (m1, m3) = (ModelName::M1, ModelName::M3);
    vec![
        entry("M3 at n4, aligned", 76.0, aligned(4), m3, Some(2.0)),
        entry("M3 at n3, aligned", 84.2, aligned(3), m3, Some(2.0)),
        entry("M3 at n3, unaligned", 83.6, unaligned(3), m3, Some(2.0)),
        entry(
            "Baseline at n1, aligned",
            42.6,
            aligned(1),
            ModelName::Baseline,
            Some(2.0),
        ),
        entry("M1 at n4, on D_A", 24.3, aligned(4), m1, None),
        entry("M1 at n4, on D_prop", 24.3, prop, m1, None),
    ]
}

/// Something the paper says of its variants, and whether it holds here.
pub struct Verdict {
    /// What it says.
    pub says: &'static str,
    /// The figures that decide.
    pub figures: String,
    /// Whether it holds.
    pub holds: bool,
}

/// The orderings that the paper claims; `None` for lack of results.
#[must_use]
pub fn verdicts(results: &Results) -> Option<Vec<Verdict>> {
    let share = |sets: Vec<String>, variant: Variant| {
        let tally = results.tally(&sets, variant)?;
        Some(tally.percent(tally.action_decided))
    };
    let of = |model, merge, threshold| Variant {
        model,
        merge,
        threshold,
        profile: ProfileName::Reference,
    };
    let mut verdicts = Vec::new();

    let mut holds = true;
    let mut figures = Vec::new();
    for level in 1..5 {
        let mut shares = Vec::new();
        for model in MODELS {
            let variant = Variant::new(model, None, None, ProfileName::Reference);
            shares.push(share(unaligned(level), variant)?);
        }
        holds &= shares.is_sorted_by(|a, b| a < b);
        let list: Vec<String> = shares.iter().rev().map(|s| format!("{s:.1}")).collect();
        figures.push(format!("n{level}: {}", list.join(" > ")));
    }
    verdicts.push(Verdict {
        says: "On unaligned sets M3 > M2 > M1 > Baseline",
        figures: figures.join("; "),
        holds,
    });

    let mut compare = |says, merges: [(MergeName, ThresholdName); 2], levels: &[usize]| {
        let mut holds = true;
        let mut figures = Vec::new();
        for &level in levels {
            let [a, b] = merges.map(|(merge, threshold)| of(ModelName::M3, merge, threshold));
            for (which, sets) in [("aligned", aligned(level)), ("unaligned", unaligned(level))] {
                let (x, y) = (share(sets.clone(), a)?, share(sets, b)?);
                holds &= x > y;
                figures.push(format!("{which} n{level}: {x:.1} against {y:.1}"));
            }
        }
        verdicts.push(Verdict {
            says,
            figures: figures.join("; "),
            holds,
        });
        Some(())
    };
    let (entropy, fixed) = (ThresholdName::Entropy, ThresholdName::Fixed);
    compare(
        "The sum stands strong noise better than the product",
        [(MergeName::Add, entropy), (MergeName::Mul, entropy)],
        &[3, 4],
    )?;
    compare(
        "In simulation fixed thresholds are slightly above entropy",
        [(MergeName::Add, fixed), (MergeName::Add, entropy)],
        &[3],
    )?;
    Some(verdicts)
}
