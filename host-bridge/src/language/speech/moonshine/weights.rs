//! What everything that was heard counts, and by which recordings these figures were set.

/// How far ahead, as ln and per word, what is written without rules must be of the likeliest command
/// for it to be as probable that the utterance was talk. A command is as many words and one more, for
/// the silence around them; words that it lacks add to the lead, and so does [`LOOSE`]. Of 162 commands
/// at each of four levels of noise, by six voices of espeak-ng that are not scored, 96, 91, 80 and 70 %
/// are done at 6.5, and of 480 sentences of talk none; from 6 to 7.5 that changes by one or two.
pub const LEAD: f64 = 6.5;

/// What it adds to the lead that any sounds in any order fit better than the likeliest commands do, by
/// 1 per 10 ms in pocketsphinx's units. Half of those commands had less than 4, 5, 8 and 10 at the four
/// levels, half of the talk more than 38, 36, 29 and 23. By logistic regression. Without it, and 4.2 to
/// be ahead by, 89.5 and 79.6 % would be done at 20 and 10 dB in place of 90.7 and 80.2 %.
pub const LOOSE: f64 = 0.16;

/// How far a text must be behind in quiet, as ln, to be e times less probable; see [`NOISE`].
pub const SCALE: f64 = 0.7;

/// How much of ln of a text's probability of silence is taken from that of what was heard: the model
/// has read more than it has heard, and writes "go on" rather than "go up" whatever was said (the
/// internal language model, Meng et al. 2021, arXiv 2011.01991). Of 162 commands per level of noise by
/// six voices, the likeliest was the one that was said in 94, 89, 86 and 73 % of them at 0, and in 98,
/// 95, 91 and 84 % at 0.5.
pub const HABIT: f64 = 0.5;

/// How far a text must be behind by pocketsphinx's reckoning in quiet, in its units, to count as one
/// behind by 1 by the model's own. Of 81 commands in quiet, by voices that are not scored, 88 % were
/// the likeliest by 99 % without it, 96 % at 80 and 98 % at 120; one that was not said was, either way.
pub const SECOND: f64 = 100.0;

/// How much noise makes all of it doubtful: [`SCALE`] is multiplied by this power of what
/// pocketsphinx's scores count less. With 10 and 5 dB, of 81 commands each, by voices that are not
/// scored, 1 and 2 would have been done wrongly at 0, and one each at 0.25 and at 0.5, which asks more.
pub const NOISE: f64 = 0.25;

/// How scores are weighed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// [`SCALE`].
    pub scale: f64,
    /// [`LEAD`].
    pub lead: f64,
    /// [`LOOSE`].
    pub loose: f64,
    /// [`HABIT`].
    pub habit: f64,
    /// [`SECOND`].
    pub second: f64,
    /// [`NOISE`].
    pub noise: f64,
}

impl Default for Weights {
    fn default() -> Self {
        Self {
            scale: SCALE,
            lead: LEAD,
            loose: LOOSE,
            habit: HABIT,
            second: SECOND,
            noise: NOISE,
        }
    }
}
