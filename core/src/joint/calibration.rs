//! Made by `deictic-eval calibrate`: do not edit.

use super::Levels;

/// What the posterior's logit is multiplied by, per noise level.
#[rustfmt::skip]
pub const SLOPE: Levels = [1.121332, 0.991613, 0.961042, 1.005347];

/// What is added to it.
#[rustfmt::skip]
pub const OFFSET: Levels = [0.166005, -0.042909, -0.08544, -0.05175];

/// The risks that there are cuts for, smallest first: the share of all commands that are executed
/// wrongly.
pub const RISKS: [f32; 1] = [0.01];

/// For each of them the logit of the confidence from which on an intent is executed.
#[rustfmt::skip]
pub const CUTS: [Levels; 1] = [
    [0.12, 1.313974, 2.866082, 2.558646],
];
