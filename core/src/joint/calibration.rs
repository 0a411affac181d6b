//! Made by `deictic-eval calibrate`: do not edit.

use super::Levels;

/// What the posterior's logit is multiplied by, per noise level.
#[rustfmt::skip]
pub const SLOPE: Levels = [0.904772, 0.831302, 0.937618, 1.021114];

/// What is added to it.
#[rustfmt::skip]
pub const OFFSET: Levels = [-0.303349, -0.059437, -0.141141, -0.05184];

/// The risks that there are cuts for, smallest first: the share of all commands that are executed
/// wrongly.
pub const RISKS: [f32; 4] = [0.003, 0.01, 0.03, 0.1];

/// For each of them the logit of the confidence from which on an intent is executed.
#[rustfmt::skip]
pub const CUTS: [Levels; 4] = [
    [3.374199, 4.302093, 3.084649, 3.507798],
    [1.359713, 1.994035, 2.69377, 2.590556],
    [0.02, 0.049778, 1.558646, 1.693735],
    [-0.055816, -0.06, 1.227519, -0.06],
];
