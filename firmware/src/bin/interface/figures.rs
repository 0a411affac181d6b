//! The part of the interface that works on figures alone.

use core::hint::black_box;

use deictic_core::category::{BitSet, Category};
use deictic_core::gesture::calibration::Calibration;
use deictic_core::judgement::judge;
use deictic_core::merge::Merge;
use deictic_core::profile::Profile;
use deictic_core::{entropy, feasibility, math, merge, reference};

use crate::any::any;

/// Calls it.
pub fn call() {
    let w = any([0.1_f32; 9]);
    let w = w.get(..any(7_usize)).unwrap_or(&w);
    let mut h = any([0.0; 9]);
    let mut to = any([0.0; 9]);
    let entropy = entropy::diagonal_cross_entropy(w, &mut h);
    entropy::normalise(&mut to);
    black_box(entropy::white_noise(any(1000)));
    merge::penalise(w, &mut h, any(0.1), &mut to);
    let threshold = any(Profile::PAPER).threshold;
    let (judgement, _) = judge(w, &h, entropy, threshold);
    black_box((judgement.is_clear(any(70)), judgement.decided(any(0.0))));
    let requirement = deictic_core::vocabulary::Requirement {
        wanted: BitSet(any(5)),
        unwanted: BitSet(any(6)),
    };
    let signature = deictic_core::vocabulary::Signature {
        compulsory: BitSet(any(2)),
        voluntary: BitSet(any(4)),
    };
    black_box(feasibility::alignment(requirement, w));
    black_box(feasibility::best_alignment(requirement, &[w]));
    black_box(feasibility::alpha(
        feasibility::signature_mismatch(signature, w),
        any(-1.6),
    ));
    reference::lift(&mut to, |i| i == any(3));
    reference::stretch(&mut to, |i| i != any(2));
    reference::boost(&mut to, any(Category::STORAGE), any(Merge::Mul));
    black_box(reference::is_one_hot(w));
    black_box((
        math::argmax(w),
        math::ln(any(2.0)),
        math::exp(any(1.0)),
        math::sqrt(any(2.0)),
    ));
    black_box((
        math::atan2(any(1.0), any(2.0)),
        math::round(any(0.5)),
        math::clamp_unit(any(2.0)),
    ));
    let mut calibration = Calibration::new();
    calibration.missed_by(any(0.1));
    black_box(calibration.aim());
    black_box((Category::user(any(255)), Category::from_index(any(99))));
    let set = BitSet(any(9)).with(any(77));
    black_box((set.contains(any(40)), set.fits(any(33)), set.iter().count()));
    #[cfg(feature = "indexing")]
    black_box(w[any(8_usize)]);
}
