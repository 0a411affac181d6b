//! The joint model: one posterior over whole intents, from every word, the words' presence and the
//! things on the table at once. It stands beside the paper's models, which settle an action first.
//!
//! ```text
//! sentences, sensors ── word ──┐
//! scene, requirements ─ survey ┴─ factors ── posterior ── belief ── outcome ── Decision
//! ```
//!
//! * [`word`] and its [`element`]s: how well an option explains a word, at each of [`LEVELS`] noise
//!   levels, with [`rivals`] (options that are raised beside the one that was meant). Whole numbers:
//!   see [`cost`]; [`mod@weight`] is the way back to a probability.
//! * [`sensors`]: learned confusion tables; without one a plain sensor is assumed. A sensor may also
//!   say by itself how likely what it saw is under each option; nothing of that is noise then.
//! * [`fit`]: how well a thing meets a requirement, as the product of its feature likelihoods; and
//!   how well the words' presence fits an action's signature.
//! * [`survey`]: which actions are weighed; [`fits`]: which things fit them how well. Actions that take
//!   a kind of thing alike share one row of fits.
//! * [`posterior`]: at each [`level`] the posterior is a product of one factor per category
//!   ([`factors`]), so that it costs rows times options and never actions times objects times storages.
//! * [`belief`]: the posterior and the noise that was heard, as a confidence that means what it says
//!   on samples of any level, and the cuts that hold wrong executions to a given share.
//!
//! [`Evidence`] stays in the trace after a decision: costs of all options, to which more words can be
//! added ([`Evidence::hear`]) before it is solved again.
//!
//! Limits. The confidence and the cuts are fitted to generated sets; another installation
//! recalibrates (`deictic-eval calibrate`). A word of uncertain category counts by its probability.

pub mod belief;
pub mod calibration;
pub mod cost;
mod doubt;
pub mod element;
pub mod evidence;
pub mod factors;
pub mod fit;
pub mod fits;
mod fuse;
mod hearing;
pub mod level;
mod likelihoods;
mod outcome;
pub mod posterior;
mod reports;
pub mod rivals;
pub mod sensors;
mod solving;
pub mod survey;
pub mod tables;
pub mod weight;
pub mod word;

pub use evidence::Evidence;
pub use fuse::fuse;
pub use sensors::{Sensor, Sensors, Tables};

/// Noise levels that a word is weighed at: as measured on real gestures, and normal with standard
/// deviation 0.2, 0.4 and 0.6 (the paper, Considered noise levels n1 to n4).
pub const LEVELS: usize = 4;

/// One figure per noise level.
pub type Levels = [f32; LEVELS];

/// Kinds of words that the confidence tells apart: an action alone, with one thing, with two.
pub const KINDS: usize = 3;
