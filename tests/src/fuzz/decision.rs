//! Decisions from raw floats, by every model and merge: held against the invariants of a decision, and, where no
//! comparison hangs by a hair, against the method in 64-bit floats.

use deictic_core::board::{Decision, Observations, Scene, Trace, Vocabulary};
use deictic_core::decide::Outcome;
use deictic_core::feasibility::{alignment, alpha, signature_mismatch};
use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Tables;
use deictic_core::judgement::judge;
use deictic_core::profile::{Align, Model, Profile, Threshold};
use deictic_core::sentence::MODALITIES;
use deictic_core::vocabulary::{Requirement, Signature};
use deictic_core::{entropy, merge};

use super::situation;
use super::source::Source;
use crate::method::{self, Method, Verdict};

/// How far figures that are rounded differently may be apart, of the largest figure of their word.
const TOLERANCE: f64 = 2e-3;

/// Comparisons nearer than this may fall on either side.
const HAIR: f64 = 1e-2;

/// Decides once and checks everything about it.
pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    if source.byte() == 255 {
        raw(&mut source);
        return;
    }
    let quirky = source.byte() >= 192;
    let profile = match quirky {
        true => reference_profile(&mut source),
        false => situation::profile(&mut source),
    };
    let vocabulary = situation::vocabulary(&mut source);
    let scene = situation::scene(&mut source, &vocabulary);
    let observations = situation::observations(&mut source, &vocabulary);
    // Last, so that inputs found before there was a choice mean what they did.
    let profile = Profile {
        align: source.pick(&[Align::Category, Align::Position]),
        ..profile
    };
    let mut trace = Trace::new();
    let decision = decide(&vocabulary, &scene, &observations, &profile, &mut trace);
    check(&decision, &trace, &vocabulary, &profile);
    // A trace that was used before changes nothing that is done.
    let again = decide(&vocabulary, &scene, &observations, &profile, &mut trace);
    assert_eq!(again, decision);
    if !quirky {
        compare(
            &decision,
            &trace,
            &method::run(&vocabulary, &scene, &observations, &profile),
        );
    }
}

fn decide(
    vocabulary: &Vocabulary,
    scene: &Scene,
    observations: &Observations,
    profile: &Profile,
    trace: &mut Trace,
) -> Decision {
    let situation = Situation {
        vocabulary,
        scene,
        observations,
        sensors: Tables::NONE,
    };
    fuse(situation, profile, trace).expect("the profile is sound")
}

fn reference_profile(source: &mut Source<'_>) -> Profile {
    use deictic_core::merge::Merge;
    let model = source.pick(&[Model::M1, Model::M2, Model::M3]);
    match source.small(9) {
        0 => Profile::reference_entropy(model, Merge::Mul),
        1 => Profile::reference_entropy(model, Merge::Add),
        2 => Profile::reference_fixed(model, Merge::Mul),
        3 => Profile::reference_fixed(model, Merge::Add),
        4 => Profile::reference_baseline(model),
        _ => Profile {
            threshold: source.pick(&[Threshold::RISK, Threshold::Risk { rate: 0.1 }]),
            ..Profile::JOINT
        },
    }
}

/// What holds of every decision.
fn check(decision: &Decision, trace: &Trace, vocabulary: &Vocabulary, profile: &Profile) {
    for word in trace.categories() {
        assert!((0.0..=1.0).contains(&word.present));
        for &w in word.merged() {
            assert!(w >= 0.0 && w.is_finite(), "a merged likelihood of {w}");
        }
        for &h in word.h() {
            assert!(h >= 0.0 && h.is_finite(), "a cross-entropy of {h}");
        }
    }
    for &factor in trace.alpha.iter().chain(&trace.beta) {
        assert!((0.0..=1.0).contains(&factor), "a penalty of {factor}");
    }
    let intents = match &decision.outcome {
        Outcome::Execute(intent) => [Some(intent), decision.best.as_ref()],
        Outcome::Ask(question) => {
            let options = vocabulary.options_of(question.category);
            let mut named = question.candidates.clone();
            named.sort_unstable();
            assert!(named.windows(2).all(|pair| pair[0] != pair[1]));
            assert!(named.iter().all(|option| usize::from(*option) < options));
            [None, decision.best.as_ref()]
        }
        Outcome::Repeat | Outcome::GiveUp => [None, decision.best.as_ref()],
    };
    for intent in intents.into_iter().flatten() {
        let signature = vocabulary.actions()[usize::from(intent.action)].signature;
        for parameter in &intent.parameters {
            let q = parameter.category.index();
            assert!(usize::from(parameter.option) < vocabulary.options_of(parameter.category));
            assert!(signature.compulsory.union(signature.voluntary).contains(q));
        }
    }
    if let Outcome::Execute(intent) = &decision.outcome {
        assert_eq!(decision.best.as_ref(), Some(intent));
        let signature = vocabulary.actions()[usize::from(intent.action)].signature;
        for q in signature.compulsory.iter() {
            let given = intent.parameters.iter().any(|p| p.category.index() == q);
            assert!(given, "{decision:?} lacks category {q}, by {profile:?}");
        }
    }
}

/// The core's figures and decision against the obvious ones; those that hang by a hair are left out, and with them the
/// actions' figures, which depend on what counts as meant.
fn compare(decision: &Decision, trace: &Trace, method: &Method) {
    if method.categories.iter().any(|merged| merged.faint) {
        return;
    }
    let by_a_hair = method.margin.0 < HAIR;
    for (q, (word, expected)) in trace
        .categories()
        .iter()
        .zip(&method.categories)
        .enumerate()
    {
        if q == 0 && by_a_hair {
            continue;
        }
        assert!((f64::from(word.present) - expected.present).abs() < 1e-6);
        if expected.word.is_empty() {
            continue;
        }
        let largest = expected.word.iter().copied().fold(0.0, f64::max);
        for (&w, &e) in word.merged().iter().zip(&expected.word) {
            assert!(
                (f64::from(w) - e).abs() <= TOLERANCE * largest,
                "{w} instead of {e} in category {q}, margin {:?}",
                method.margin
            );
        }
    }
    if by_a_hair {
        return;
    }
    let verdict = match &decision.outcome {
        Outcome::Execute(intent) => Verdict::Execute(
            intent.action,
            intent
                .parameters
                .iter()
                .map(|p| (p.category, p.option))
                .collect(),
        ),
        Outcome::Ask(question) => Verdict::Ask(question.category, question.reason),
        Outcome::Repeat | Outcome::GiveUp => Verdict::Repeat,
    };
    assert_eq!(verdict, method.verdict, "{method:#?}");
}

/// The pieces, with any float there is: they may give nonsense, but they give it.
fn raw(source: &mut Source<'_>) {
    let n = source.below(17);
    let w: Vec<f32> = (0..n).map(|_| source.float()).collect();
    let mut h = vec![0.0; n];
    let mut scratch = vec![0.0; n];
    let entropy = entropy::diagonal_cross_entropy(&w, &mut h);
    merge::penalise(&w, &mut h, source.float(), &mut scratch);
    entropy::normalise(&mut scratch);
    let thresholds = [
        Threshold::None,
        Threshold::Entropy,
        Threshold::WhiteNoise,
        Threshold::Fixed {
            clear: source.float(),
            unclear: source.float(),
        },
    ];
    for threshold in thresholds {
        let (judgement, _) = judge(&w, &h, entropy, threshold);
        assert!(judgement.best.is_none_or(|best| usize::from(best) < n));
        assert_eq!(judgement.clear & judgement.unclear, 0);
        assert_eq!(
            (judgement.clear | judgement.unclear)
                .checked_shr(n as u32)
                .unwrap_or(0),
            0
        );
    }
    let requirement = Requirement {
        wanted: source.set(16),
        unwanted: source.set(16),
    };
    let aligned = alignment(requirement, &w);
    assert!(aligned.is_nan() || aligned <= 1.0);
    let signature = Signature {
        compulsory: source.set(16),
        voluntary: source.set(16),
    };
    let _ = alpha(signature_mismatch(signature, &w), source.float());
    let profile = Profile {
        weights: [(); MODALITIES].map(|()| source.float()),
        signature_penalty: source.float(),
        lead: source.float(),
        least_h: source.float(),
        ..Profile::PAPER
    };
    let _ = profile.check();
}
