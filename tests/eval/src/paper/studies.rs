//! Which counts every figure shows.

use super::figure::{Figure, Form, Point, Series};
use super::{MODELS, Results, aligned, real_aligned, real_unaligned, unaligned};
use crate::score::Tally;
use crate::variant::{MergeName, ModelName, ProfileName, ThresholdName, Variant};

const LEVELS: usize = 5;
const ACTION_RIGHT: &str = "Actions decided right (%)";
const TRIPLE_RIGHT: &str = "Likeliest intent right (%)";
const NOISE: &str = "Noise level";

/// All figures for which there are results.
#[must_use]
pub fn figures(results: &Results) -> Vec<Figure> {
    let all = vec![
        ablation(results),
        noise(results, "noise-aligned", "aligned", aligned),
        noise(results, "noise-unaligned", "unaligned", unaligned),
        merge(results),
        thresholds(results),
        triples(results),
        free(results),
        profiles(results),
    ];
    all.into_iter()
        .filter(|figure| !figure.is_empty())
        .collect()
}

fn reference(model: ModelName) -> Variant {
    Variant::new(model, None, None, ProfileName::Reference)
}

fn of(merge: MergeName, threshold: ThresholdName) -> Variant {
    Variant {
        merge,
        threshold,
        ..reference(ModelName::M3)
    }
}

fn levels() -> Vec<String> {
    (0..LEVELS).map(|l| format!("n{l}")).collect()
}

/// A series of one count over lists of sets.
fn series(
    results: &Results,
    name: impl Into<String>,
    variant: Variant,
    sets: &[Vec<String>],
    count: impl Fn(&Tally) -> usize + Copy,
) -> Series {
    let point = |sets: &Vec<String>| Some(Point::of(&results.tally(sets, variant)?, count));
    Series {
        name: name.into(),
        points: sets.iter().map(point).collect(),
    }
}

fn over(sets: impl Fn(usize) -> Vec<String>) -> Vec<Vec<String>> {
    (0..LEVELS).map(sets).collect()
}

fn settings(level: usize) -> Vec<Vec<String>> {
    vec![
        aligned(level),
        unaligned(level),
        real_aligned(),
        real_unaligned(),
    ]
}

fn setting_names() -> Vec<String> {
    [
        "Sim. aligned",
        "Sim. unaligned",
        "Set-ups aligned",
        "Set-ups unaligned",
    ]
    .map(str::to_owned)
    .to_vec()
}

fn upper(model: ModelName) -> String {
    match model {
        ModelName::Baseline => "Baseline".to_owned(),
        ModelName::Joint => "Joint".to_owned(),
        other => other.to_string().to_uppercase(),
    }
}

fn ablation(results: &Results) -> Figure {
    Figure {
        name: "ablation",
        title: "Ablation study".to_owned(),
        caption: "Each penalty counts where modalities contradict each other: sum, entropy \
                  thresholds, noise n1 (the paper's ablation figure)."
            .to_owned(),
        form: Form::Bars,
        x: "Data set",
        y: ACTION_RIGHT,
        places: setting_names(),
        series: MODELS
            .map(|m| {
                series(results, upper(m), reference(m), &settings(1), |t| {
                    t.action_decided
                })
            })
            .to_vec(),
    }
}

fn noise(
    results: &Results,
    name: &'static str,
    which: &str,
    sets: impl Fn(usize) -> Vec<String>,
) -> Figure {
    let sets = over(sets);
    Figure {
        name,
        title: format!("Noise study, {which} sets"),
        caption: format!(
            "Actions decided right as noise grows, {which} sets: sum, entropy thresholds (the \
             paper's figure of noise levels)."
        ),
        form: Form::Lines,
        x: NOISE,
        y: ACTION_RIGHT,
        places: levels(),
        series: MODELS
            .map(|m| series(results, upper(m), reference(m), &sets, |t| t.action_decided))
            .to_vec(),
    }
}

fn merge(results: &Results) -> Figure {
    let sets = over(aligned);
    let one = |name: &str, merge, threshold| {
        series(results, name, of(merge, threshold), &sets, |t| {
            t.action_decided
        })
    };
    Figure {
        name: "merge",
        title: "Merge study".to_owned(),
        caption: "The sum stands strong noise better than the product, and both more than the maximum: M3, \
                  entropy thresholds but for the maximum, which has none; aligned sets."
            .to_owned(),
        form: Form::Lines,
        x: NOISE,
        y: ACTION_RIGHT,
        places: levels(),
        series: vec![
            one("max", MergeName::Max, ThresholdName::None),
            one("mul", MergeName::Mul, ThresholdName::Entropy),
            one("add", MergeName::Add, ThresholdName::Entropy),
        ],
    }
}

fn thresholds(results: &Results) -> Figure {
    let one = |name: &str, merge, threshold| {
        let variant = of(merge, threshold);
        series(results, name, variant, &settings(3), |t| t.action_decided)
    };
    Figure {
        name: "thresholds",
        title: "Threshold study".to_owned(),
        caption:
            "Fixed thresholds, tuned on simulated sets, against the entropy of the word itself \
                  and that of white noise: M3, noise n3 on simulated sets, n1 on the set-ups."
                .to_owned(),
        form: Form::Bars,
        x: "Data set",
        y: ACTION_RIGHT,
        places: setting_names(),
        series: vec![
            one("add, fixed", MergeName::Add, ThresholdName::Fixed),
            one("add, entropy", MergeName::Add, ThresholdName::Entropy),
            one(
                "add, white noise",
                MergeName::Add,
                ThresholdName::WhiteNoise,
            ),
            one("mul, fixed", MergeName::Mul, ThresholdName::Fixed),
            one("mul, entropy", MergeName::Mul, ThresholdName::Entropy),
        ],
    }
}

fn bound(results: &Results, sets: &[Vec<String>]) -> Series {
    let point = |sets: &Vec<String>| Some(Point::of_bound(&results.bound(sets)?, |b| b.triple));
    Series {
        name: "Bayes bound".to_owned(),
        points: sets.iter().map(point).collect(),
    }
}

fn floor(results: &Results, sets: &[Vec<String>]) -> Series {
    let point = |sets: &Vec<String>| Some(Point::of_bound(&results.bound(sets)?, |b| b.floor));
    Series {
        name: "No signal".to_owned(),
        points: sets.iter().map(point).collect(),
    }
}

fn against_bound(results: &Results, sets: &[Vec<String>]) -> Vec<Series> {
    let mut all: Vec<Series> = MODELS
        .into_iter()
        .chain([ModelName::Joint])
        .map(|m| {
            let variant = Variant::new(m, None, None, ProfileName::Paper);
            series(results, upper(m), variant, sets, |t| t.triple_argmax)
        })
        .collect();
    all.push(bound(results, sets));
    all.push(floor(results, sets));
    all
}

fn triples(results: &Results) -> Figure {
    let sets = over(|l| [aligned(l), unaligned(l)].concat());
    Figure {
        name: "triples",
        title: "Whole intents and what can be reached".to_owned(),
        caption: "Action, object and storage all right, whether or not it would be executed, on all \
                  three kinds of simulated sets; above, what the best method reaches that knows the \
                  noise, and below, what the scene and the presence of words give away."
            .to_owned(),
        form: Form::Lines,
        x: NOISE,
        y: TRIPLE_RIGHT,
        places: levels(),
        series: against_bound(results, &sets),
    }
}

fn free(results: &Results) -> Figure {
    let sets = over(|l| vec![format!("D_free_n{l}")]);
    Figure {
        name: "free",
        title: "A fairer data set".to_owned(),
        caption:
            "The same on D_free, whose scenes are drawn before the intent, with rivals in each \
                  modality on its own, missing and mistaken words, and graded features."
                .to_owned(),
        form: Form::Lines,
        x: NOISE,
        y: TRIPLE_RIGHT,
        places: levels(),
        series: against_bound(results, &sets),
    }
}

fn profiles(results: &Results) -> Figure {
    let sets = over(|l| [aligned(l), unaligned(l)].concat());
    let one = |name: &str, profile, count: fn(&Tally) -> usize| {
        let variant = Variant::new(ModelName::M3, None, None, profile);
        series(results, name, variant, &sets, count)
    };
    let (ours, theirs) = (ProfileName::Paper, ProfileName::Reference);
    Figure {
        name: "profiles",
        title: "Executed, by the paper's text and as implemented".to_owned(),
        caption:
            "Whole intents executed right and wrong by M3. By the paper's text more is asked, \
                  and far less is executed wrong."
                .to_owned(),
        form: Form::Lines,
        x: NOISE,
        y: "Intents executed (%)",
        places: levels(),
        series: vec![
            one("text: right", ours, |t| t.triple_decided),
            one("text: wrong", ours, |t| t.triple_wrong_executed),
            one("reference: right", theirs, |t| t.triple_decided),
            one("reference: wrong", theirs, |t| t.triple_wrong_executed),
        ],
    }
}
