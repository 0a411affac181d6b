//! What was heard, and what it says when everything is weighed: how probable the model takes a text
//! to be, how gladly it writes it anyway, how well the sound fits it by another recogniser's reckoning,
//! and how much rather something else altogether would be written.

use super::weights::{HABIT, Weights};
use crate::language::speech::fits::Fits;
use crate::language::speech::pocketsphinx::doubt;
use crate::language::{LanguageError, Spoken};

/// What [`LOOSE`] is multiplied by where pocketsphinx was not asked, and where no command fits at all.
const NOT_ASKED: f64 = 15.0;
const NOTHING_FITS: f64 = 40.0;

/// How much more probable than of silence, as ln, the likeliest command must be for it to be as probable
/// that somebody has spoken. Of tones, hisses, knocks and a motor "up", "wait" or "freeze" is 3 to 8 more
/// probable; of 162 commands at each of four levels of noise, by voices that are not scored, what was said
/// is by less than this in none, 1, 4 and 5, all of them "up" and "halt".
const LEAST: f64 = 8.5;

/// How much more probable talk is when it is ahead by one more, as ln.
const STEEP: f64 = 10.0;

/// How much less probable a text is than it is taken for, as ln, when the rules do not have it: what
/// is said to a machine that takes commands is mostly one of them.
const OTHERWISE: f64 = 6.0;

/// So many texts of different meaning are held against the sound a second time.
const ASKED: usize = 5;

/// Texts further than this behind the likeliest, as ln, are not held against it again.
const NEAR: f64 = 6.0;

/// Texts further than this behind the best cannot count.
const FARTHEST: f64 = 12.0;

/// A text, and how gladly the model writes it.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Writing {
    /// The text.
    pub text: String,
    /// The same without words that change no meaning.
    pub core: String,
    /// ln of the probability that it is written of what was heard.
    pub heard: f64,
    /// The same of silence.
    pub anyway: f64,
    /// How well the sound fits it by pocketsphinx's reckoning, if that was asked for and it fits at all.
    pub fits: Option<f64>,
}

/// What was heard, before it is weighed.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Scores {
    /// What the rules allow.
    pub allowed: Vec<Writing>,
    /// What was written without rules.
    pub free: Writing,
    /// How much better any sounds in any order fit than the best text, per 10 ms and by pocketsphinx's
    /// reckoning, if that was asked.
    pub loose: Option<f64>,
    /// How far the voice stands out of what is behind it ([`crate::language::speech::sound::range`]).
    pub range: Option<f32>,
}

impl Writing {
    fn own(&self, habit: f64) -> f64 {
        self.heard - habit * self.anyway
    }
}

impl Scores {
    /// The likeliest command by the model's own reckoning.
    fn best(&self, habit: f64) -> Option<&Writing> {
        let own = |w: &&Writing| w.own(habit);
        self.allowed.iter().max_by(|a, b| own(a).total_cmp(&own(b)))
    }

    /// How far ahead of the likeliest command talk is, per word; whichever is more with the model's
    /// habits or without, for what is no speech at all is written by habit.
    fn ahead(&self, weights: Weights) -> Option<f64> {
        let habit = weights.habit;
        let best = self.best(habit)?;
        let count = |text: &str| text.split_whitespace().count();
        let words = count(&best.text);
        let lacking = count(&self.free.text).saturating_sub(words) as f64;
        let by = |habit: f64| self.free.own(habit) - best.own(habit);
        let lead = (by(habit).max(by(0.0)) + lacking) / (1.0 + words as f64);
        let loose = self.loose.unwrap_or(NOT_ASKED);
        Some(lead + weights.loose * loose)
    }

    /// Where it is in doubt what was said, asks how well the sound `fits` the texts that come into question.
    ///
    /// # Errors
    /// Those of `fits`.
    pub fn ask<E>(&mut self, fits: impl FnOnce(&[&str]) -> Result<Fits, E>) -> Result<(), E> {
        let mut order: Vec<&Writing> = self.allowed.iter().collect();
        order.sort_by(|a, b| b.own(HABIT).total_cmp(&a.own(HABIT)));
        let top = order.first().map_or(0.0, |w| w.own(HABIT));
        let mut asked: Vec<&Writing> = Vec::new();
        for writing in order {
            let near = writing.own(HABIT) > top - NEAR && asked.len() < ASKED;
            if near && asked.iter().all(|w| w.core != writing.core) {
                asked.push(writing);
            }
        }
        // One text, and the very one that would be written without rules.
        if asked.iter().all(|w| w.text == self.free.text) {
            return Ok(());
        }
        let texts: Vec<_> = asked.iter().map(|w| w.text.as_str()).collect();
        let Fits { texts, loose } = fits(&texts)?;
        let known: Vec<_> = asked.iter().map(|w| w.core.clone()).zip(texts).collect();
        self.loose = Some(loose.unwrap_or(NOTHING_FITS));
        for writing in &mut self.allowed {
            let same = known.iter().find(|(core, _)| *core == writing.core);
            writing.fits = same.and_then(|(_, fits)| *fits);
        }
        Ok(())
    }

    /// What they say.
    ///
    /// # Errors
    /// [`LanguageError::Empty`] when nothing was heard.
    pub fn weigh(&self, weights: Weights) -> Result<Spoken, LanguageError> {
        let Weights { lead, habit, .. } = weights;
        let doubt = doubt(self.range);
        let scale = weights.scale * doubt.powf(weights.noise);
        // What was not asked for fits no better than the worst that was.
        let fits = self.allowed.iter().filter_map(|w| w.fits);
        let worst = fits.min_by(f64::total_cmp).unwrap_or(0.0);
        let fits = |w: &Writing| w.fits.unwrap_or(worst) / (weights.second * doubt);
        let score = |w: &Writing| (w.text.clone(), w.own(habit) + fits(w));
        let mut all: Vec<_> = self.allowed.iter().map(score).collect();
        let largest = |some: &mut dyn Iterator<Item = f64>| some.fold(f64::NEG_INFINITY, f64::max);
        let top = largest(&mut all.iter().map(|s| s.1));
        let free = self.free.heard;
        // What nobody would write is no likelier for that, so habits count among commands alone.
        let (talk, otherwise) = match (self.ahead(weights), self.best(habit)) {
            (Some(ahead), Some(best)) => {
                let spoken = best.heard - best.anyway;
                let talk = top + scale * STEEP * (ahead - lead).max(LEAST - spoken);
                (talk, top + free - best.heard)
            }
            _ => (free, free),
        };
        all.push((String::new(), talk));
        // What the rules have as well is no other hypothesis.
        let text = &self.free.text;
        if !text.is_empty() && self.allowed.iter().all(|w| w.text != *text) {
            all.push((text.clone(), otherwise - OTHERWISE));
        }
        let top = largest(&mut all.iter().map(|s| s.1));
        all.retain(|s| s.1 > top - FARTHEST * scale);
        Spoken::of_scores(all, scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn writing(&(text, heard): &(&str, f64)) -> Writing {
        Writing {
            text: text.to_owned(),
            core: text.replace("the ", ""),
            heard,
            anyway: -20.0,
            fits: None,
        }
    }

    fn scores(allowed: &[(&str, f64)], free: (&str, f64)) -> Scores {
        Scores {
            allowed: allowed.iter().map(writing).collect(),
            free: writing(&free),
            loose: None,
            range: None,
        }
    }

    fn heard(allowed: &[(&str, f64)], free: (&str, f64)) -> Spoken {
        scores(allowed, free).weigh(Weights::default()).unwrap()
    }

    #[test]
    fn what_would_much_rather_be_written_was_talk() {
        let odd = heard(&[("pick the cup", -5.0)], ("big the kappa", -2.0));
        assert_eq!(odd.best(), "pick the cup");
        let talk = heard(&[("up", -14.0)], ("the weather is lovely", -2.0));
        assert_eq!(talk.best(), "");
        assert_eq!(heard(&[], ("hm", -1.0)).best(), "");
    }

    #[test]
    fn what_the_rules_lack_is_a_hypothesis_and_what_they_have_is_no_other() {
        let asked = heard(&[("pick the cup", -11.0)], ("should i pick the cup", -1.0));
        assert_eq!(asked.best(), "should i pick the cup");
        let same = heard(&[("pick the cup", -1.0)], ("pick the cup", -1.2));
        assert_eq!(same.certain(0.01), Some("pick the cup"));
    }

    #[test]
    fn sounds_that_fit_no_command_are_talk() {
        let mut odd = scores(&[("pick the cup", -7.5)], ("big the kappa", -2.0));
        let best = |s: &Scores| s.weigh(Weights::default()).unwrap().best().to_owned();
        odd.loose = Some(4.0);
        assert_eq!(best(&odd), "pick the cup");
        odd.loose = Some(NOTHING_FITS);
        assert_eq!(best(&odd), "");
    }

    #[test]
    fn what_is_hardly_likelier_than_of_silence_is_nobody_speaking() {
        let mut hum = scores(&[("up", -5.0)], ("uh", -4.0));
        let best = |s: &Scores| s.weigh(Weights::default()).unwrap().best().to_owned();
        assert_eq!(best(&hum), "up");
        hum.allowed[0].anyway = -10.0;
        assert_eq!(best(&hum), "");
    }

    #[test]
    fn what_is_written_gladly_anyway_counts_less() {
        let mut scores = scores(&[("go on", -2.0), ("go up", -3.0)], ("go on", -2.0));
        let best = |s: &Scores| s.weigh(Weights::default()).unwrap().best().to_owned();
        assert_eq!(best(&scores), "go on");
        scores.allowed[0].anyway = -8.0;
        scores.allowed[1].anyway = -18.0;
        assert_eq!(best(&scores), "go up");
    }

    #[test]
    fn a_second_opinion_is_asked_for_once_per_meaning_and_only_in_doubt() {
        let said = [
            ("pour the cup", -3.0),
            ("put the cup", -2.0),
            ("put cup", -4.0),
            ("stop", -30.0),
        ];
        let mut doubtful = scores(&said, ("put a cup", -2.0));
        let fits = |texts: &[&str]| -> Result<_, ()> {
            assert_eq!(texts, ["put the cup", "pour the cup"]);
            Ok(Fits {
                texts: vec![Some(-9000.0), Some(-8000.0)],
                loose: Some(3.0),
            })
        };
        doubtful.ask(fits).unwrap();
        let fits: Vec<_> = doubtful.allowed.iter().map(|w| w.fits).collect();
        assert_eq!(fits, [Some(-8000.0), Some(-9000.0), Some(-9000.0), None]);
        let heard = doubtful.weigh(Weights::default()).unwrap();
        assert_eq!(heard.best(), "pour the cup");
        let mut clear = scores(&said[..1], ("pour the cup", -3.0));
        let nobody = |_: &[&str]| Err("asked");
        assert_eq!(clear.ask(nobody), Ok(()));
    }
}
