//! Made by `deictic-eval calibrate`: do not edit.

use super::Levels;
use super::belief::KINDS;

/// What the posterior's logit is multiplied by, by kinds of words and noise level.
#[rustfmt::skip]
pub const SLOPE: [Levels; KINDS] = [
    [0.89943, 1.723974, 2.998802, 2.35654],
    [0.751932, 0.733187, 1.404834, 2.467916],
    [0.896618, 0.855622, 0.976213, 1.119485],
];

/// What its action's logit is multiplied by, by kinds of words and noise level.
#[rustfmt::skip]
pub const ACTION: [Levels; KINDS] = [
    [0.05775, -0.920456, -2.144402, -1.411336],
    [0.157972, 0.136007, -0.388854, -1.629411],
    [0.080692, 0.03639, -0.014513, 0.053124],
];

/// What is added to both, by kinds of words and noise level.
#[rustfmt::skip]
pub const OFFSET: [Levels; KINDS] = [
    [-0.691474, 0.000973, -0.097846, -0.061033],
    [-0.604566, -0.180839, 0.041499, 0.855354],
    [-0.299085, -0.117544, -0.118534, -0.062935],
];

/// The risks that there are cuts for, smallest first: the share of all commands that are executed
/// wrongly.
pub const RISKS: [f32; 4] = [0.003, 0.01, 0.03, 0.1];

/// For each of them the logit of the confidence from which on an intent is executed.
#[rustfmt::skip]
pub const CUTS: [Levels; 4] = [
    [4.138745, 3.544212, 3.790413, 3.044063],
    [2.402246, 1.708409, 2.84493, 2.014938],
    [0.02, 0.02, 2.157085, 1.067598],
    [-0.022342, -0.06, 0.823424, -0.06],
];
