//! The likeliest utterances that rules allow, written piece by piece; and the likeliest of any.

use std::collections::HashMap;
use std::sync::Arc;

use super::model::{Model, Written};
use super::tokens::{END, Token, Tokens};
use crate::language::speech::paths::{Paths, State};

/// How many writers go on from piece to piece. Of 648 commands at four levels of noise by six voices, 20
/// were lost on the way with 16 and 9 with 64.
const WRITERS: usize = 32;

/// The longest utterance in pieces.
const LONGEST: usize = 40;

/// Utterances less likely than the best by more than this, as ln, are not looked for.
const FARTHEST: f64 = 20.0;

/// A text that the model writes.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// In lower case and without punctuation.
    pub text: String,
    /// ln of how probable it is, in whatever pieces and punctuation.
    pub score: f64,
    /// The likeliest pieces of it.
    pub pieces: Vec<Token>,
}

/// Where a writer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Place {
    Within(State),
    /// Behind the full stop.
    Over,
}

/// Rules, and the pieces that they allow next wherever a writer has been.
#[derive(Debug)]
pub struct Search {
    paths: Paths,
    allowed: HashMap<State, Arc<[(Token, Place)]>>,
}

struct Writer {
    score: f64,
    place: Place,
    pieces: Vec<Token>,
}

impl Search {
    /// Over these paths.
    #[must_use]
    pub fn new(paths: Paths) -> Self {
        Self {
            paths,
            allowed: HashMap::new(),
        }
    }

    /// The likeliest utterances that the rules allow, the likeliest first, without punctuation and in
    /// lower case.
    ///
    /// # Errors
    /// ONNX Runtime's.
    pub fn allowed(
        &mut self,
        model: &mut Model,
        tokens: &Tokens,
        heard: &Written,
    ) -> ort::Result<Vec<Found>> {
        let mut written = heard.clone();
        // Per text ln of its probability, ln of that of its likeliest pieces, and these.
        let mut whole: HashMap<String, (f64, f64, Vec<Token>)> = HashMap::new();
        let mut writers = vec![Writer {
            score: 0.0,
            place: Place::Within(Paths::START),
            pieces: Vec::new(),
        }];
        for _ in 0..LONGEST {
            let mut next = Vec::new();
            for (w, writer) in writers.iter().enumerate() {
                if self.may_end(writer.place) {
                    let score = writer.score + f64::from(written.chance(w, END));
                    let text = plain(&tokens.text(&writer.pieces));
                    let never = (f64::NEG_INFINITY, f64::NEG_INFINITY, Vec::new());
                    let (all, most, pieces) = whole.entry(text).or_insert(never);
                    *all = sum(*all, score);
                    if score > *most {
                        (*most, *pieces) = (score, writer.pieces.clone());
                    }
                }
                for &(piece, place) in self.pieces(tokens, writer.place).iter() {
                    let score = writer.score + f64::from(written.chance(w, piece));
                    next.push((score, w, piece, place));
                }
            }
            let best = whole
                .values()
                .map(|w| w.0)
                .fold(f64::NEG_INFINITY, f64::max);
            next.retain(|n| n.0 > best - FARTHEST);
            next.sort_by(|a, b| b.0.total_cmp(&a.0));
            next.truncate(WRITERS);
            if next.is_empty() {
                break;
            }
            let from = next.iter().map(|n| n.1);
            // As many as before, for what was heard is kept once per writer.
            let rows: Vec<_> = from.chain(std::iter::repeat(0)).take(WRITERS).collect();
            written.go_on(&rows);
            let write = next.iter().map(|n| n.2).chain(std::iter::repeat(END));
            model.write(&mut written, &write.take(WRITERS).collect::<Vec<_>>())?;
            let go_on = next.into_iter().map(|(score, w, piece, place)| {
                let before = writers.get(w).map(|w| w.pieces.as_slice());
                let mut pieces = before.unwrap_or_default().to_vec();
                pieces.push(piece);
                Writer {
                    score,
                    place,
                    pieces,
                }
            });
            writers = go_on.collect();
        }
        let found = |(text, (score, _, pieces))| Found {
            text,
            score,
            pieces,
        };
        let mut all: Vec<_> = whole.into_iter().map(found).collect();
        let first = |a: &Found, b: &Found| b.score.total_cmp(&a.score);
        all.sort_by(|a, b| first(a, b).then_with(|| a.text.cmp(&b.text)));
        Ok(all)
    }

    fn may_end(&self, place: Place) -> bool {
        match place {
            Place::Over => true,
            Place::Within(state) => self.paths.is_whole(state),
        }
    }

    /// The pieces that may come next, and where they lead.
    fn pieces(&mut self, tokens: &Tokens, place: Place) -> Arc<[(Token, Place)]> {
        let Place::Within(state) = place else {
            return Arc::new([]);
        };
        if let Some(known) = self.allowed.get(&state) {
            return Arc::clone(known);
        }
        let mut found = Vec::new();
        let mut open = vec![(Tokens::ROOT, state)];
        while let Some((knot, at)) = open.pop() {
            let letters = self.paths.letters(at);
            for (letter, next) in tokens.letters(knot) {
                if !letters.contains(&letter) {
                    continue;
                }
                if let Some(to) = self.paths.follow(at, letter) {
                    found.extend(tokens.at(next).iter().map(|&t| (t, Place::Within(to))));
                    open.push((next, to));
                }
            }
        }
        if self.paths.is_whole(state) {
            let stops = [".", "!"].into_iter().flat_map(|stop| tokens.just(stop));
            found.extend(stops.map(|&stop| (stop, Place::Over)));
        }
        if state != Paths::START && self.paths.letters(state).contains(&b' ') {
            found.extend(tokens.just(",").iter().map(|&comma| (comma, place)));
        }
        let found: Arc<[_]> = found.into();
        self.allowed.insert(state, Arc::clone(&found));
        found
    }
}

/// What the model writes if nothing is ruled out, always taking the likeliest piece; as
/// [`Search::allowed`] writes it, but for question marks.
///
/// # Errors
/// ONNX Runtime's.
pub fn anything(model: &mut Model, tokens: &Tokens, heard: &Written) -> ort::Result<Found> {
    let mut written = heard.clone();
    let (mut score, mut pieces) = (0.0, Vec::new());
    loop {
        let piece = written.likeliest(0);
        score += f64::from(written.chance(0, piece));
        if piece == END || pieces.len() == LONGEST {
            let text = plain(&tokens.text(&pieces));
            return Ok(Found {
                text,
                score,
                pieces,
            });
        }
        pieces.push(piece);
        model.write(&mut written, &[piece])?;
    }
}

fn plain(text: &str) -> String {
    let text = text.trim_end_matches(['.', '!']).replace(',', "");
    text.to_lowercase()
}

/// ln of the sum of what two are the ln of.
fn sum(a: f64, b: f64) -> f64 {
    let (high, low) = (a.max(b), a.min(b));
    high + f64::ln_1p(f64::exp(low - high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::speech::rule::Rule;

    #[test]
    fn pieces_follow_the_rules() {
        let pieces = [
            "<unk>",
            "<s>",
            "</s>",
            "\u{2581}P",
            "\u{2581}pick",
            "ick",
            "s",
            ".",
            ",",
            "x",
        ];
        let mut file = Vec::new();
        for piece in pieces {
            file.push(piece.len() as u8);
            file.extend(piece.bytes());
        }
        let tokens = Tokens::read(&file).unwrap();
        let rules = [Rule::Phrase("pick".into()), Rule::Phrase("picks up".into())];
        let mut search = Search::new(Paths::new(&rules));
        let mut at = |place| {
            let mut found: Vec<_> = search.pieces(&tokens, place).to_vec();
            found.sort_by_key(|f| f.0);
            found
        };
        let start = at(Place::Within(Paths::START));
        assert_eq!(start.iter().map(|s| s.0).collect::<Vec<_>>(), [3, 4]);
        let after_p = at(start[0].1);
        assert_eq!(after_p.iter().map(|s| s.0).collect::<Vec<_>>(), [5]);
        let after_pick = at(start[1].1);
        assert_eq!(after_pick.iter().map(|s| s.0).collect::<Vec<_>>(), [6, 7]);
        assert_eq!(after_pick[1].1, Place::Over);
        let after_picks = at(after_pick[0].1);
        assert_eq!(after_picks.iter().map(|s| s.0).collect::<Vec<_>>(), [8]);
        assert!(at(Place::Over).is_empty());
    }

    #[test]
    fn probabilities_add_up() {
        let half = f64::ln(0.5);
        assert!(sum(half, half).abs() < 1e-12);
        assert_eq!(sum(f64::NEG_INFINITY, half), half);
        assert_eq!(plain("Pick, the cup."), "pick the cup");
    }
}
