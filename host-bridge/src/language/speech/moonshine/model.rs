//! The model's two halves, run by ONNX Runtime: what hears, and what writes word pieces down.

use std::path::Path;

use ort::environment::Environment;
use ort::session::{Session, SessionInputValue};
use ort::value::TensorRef;

use super::tokens::{BEGIN, END, Token};

/// Layers of what writes.
const LAYERS: usize = 6;
/// Heads of its attention, and the figures of each.
const HEADS: usize = 8;
const WIDTH: usize = 36;
/// Figures of one heard moment.
const HEARD: usize = 288;

/// So many texts are held against a recording at once: each needs 130 kB per piece for the figures of
/// every piece that could have come.
const AT_ONCE: usize = 8;

/// The model.
#[derive(Debug)]
pub struct Model {
    hears: Session,
    writes: Session,
}

/// What was heard, and what several writers made of it so far.
#[derive(Clone, Debug)]
pub struct Written {
    /// Moments x [`HEARD`], once per writer.
    heard: Vec<f32>,
    moments: usize,
    writers: usize,
    /// Per layer the keys and values of what was heard; the same throughout.
    of_heard: Vec<Vec<f32>>,
    /// Per layer the keys and values of the pieces so far, writers x heads x pieces x width.
    of_pieces: Vec<Vec<f32>>,
    pieces: usize,
    /// ln of the probability of every piece as the next one, per writer.
    next: Vec<f32>,
}

impl Model {
    /// Loads the two halves from a folder, with this many threads.
    ///
    /// # Errors
    /// ONNX Runtime's.
    pub fn load(runtime: &Environment, folder: &Path, threads: usize) -> ort::Result<Self> {
        let load = |file: &str| -> ort::Result<Session> {
            let builder = Session::builder(runtime)?.with_intra_threads(threads)?;
            let mut builder = builder.with_intra_op_spinning(false)?;
            builder.commit_from_file(folder.join(file))
        };
        Ok(Self {
            hears: load("encoder_model.ort")?,
            writes: load("decoder_model_merged.ort")?,
        })
    }

    /// Hears an utterance, samples between -1 and 1; one writer begins.
    ///
    /// # Errors
    /// ONNX Runtime's.
    pub fn hear(&mut self, samples: &[f32]) -> ort::Result<Written> {
        let mask = vec![1_i64; samples.len()];
        let shape = [1, samples.len()];
        let inputs: Vec<(&str, SessionInputValue<'_>)> = vec![
            (
                "input_values",
                TensorRef::from_array_view((shape, samples))?.into(),
            ),
            (
                "attention_mask",
                TensorRef::from_array_view((shape, &*mask))?.into(),
            ),
        ];
        let outputs = self.hears.run(inputs)?;
        let (_, heard) = outputs["last_hidden_state"].try_extract_tensor::<f32>()?;
        let mut written = Written {
            heard: heard.to_vec(),
            moments: heard.len() / HEARD,
            writers: 1,
            of_heard: vec![Vec::new(); 2 * LAYERS],
            of_pieces: vec![Vec::new(); 2 * LAYERS],
            pieces: 0,
            next: Vec::new(),
        };
        drop(outputs);
        self.write(&mut written, &[BEGIN])?;
        Ok(written)
    }

    /// Every writer writes its piece.
    ///
    /// # Errors
    /// ONNX Runtime's.
    pub fn write(&mut self, written: &mut Written, pieces: &[Token]) -> ort::Result<()> {
        let n = written.writers;
        let begins = written.pieces == 0;
        let pieces: Vec<i64> = pieces.iter().map(|&p| i64::from(p)).collect();
        let mask = vec![1_i64; n * written.moments];
        let goes_on = [!begins];
        let known = if begins { 0 } else { written.moments };
        let heard = TensorRef::from_array_view(([n, written.moments, HEARD], &*written.heard))?;
        let mut inputs: Vec<(String, SessionInputValue<'_>)> = vec![
            (
                "encoder_attention_mask".into(),
                TensorRef::from_array_view(([n, written.moments], &*mask))?.into(),
            ),
            (
                "input_ids".into(),
                TensorRef::from_array_view(([n, 1], &*pieces))?.into(),
            ),
            ("encoder_hidden_states".into(), heard.into()),
            (
                "use_cache_branch".into(),
                TensorRef::from_array_view(([1], &goes_on[..]))?.into(),
            ),
        ];
        let halves = [
            ("decoder", written.pieces, &written.of_pieces),
            ("encoder", known, &written.of_heard),
        ];
        for (half, length, all) in halves {
            for (name, figures) in names(half).zip(all) {
                let shape = [n, HEADS, length, WIDTH];
                let tensor = TensorRef::from_array_view((shape, &**figures))?;
                inputs.push((format!("past_key_values.{name}"), tensor.into()));
            }
        }
        let outputs = self.writes.run(inputs)?;
        let figures = |name: &str| -> ort::Result<Vec<f32>> {
            Ok(outputs[name].try_extract_tensor::<f32>()?.1.to_vec())
        };
        let next = figures("logits")?;
        let all = |half| {
            let figures = names(half).map(|name| figures(&format!("present.{name}")));
            figures.collect::<ort::Result<Vec<_>>>()
        };
        let of_pieces = all("decoder")?;
        let of_heard = if begins { Some(all("encoder")?) } else { None };
        written.of_pieces = of_pieces;
        written.of_heard = of_heard.unwrap_or(std::mem::take(&mut written.of_heard));
        written.pieces += 1;
        written.next = next;
        let size = written.next.len() / n.max(1);
        written.next.chunks_mut(size.max(1)).for_each(normalise);
        Ok(())
    }

    /// ln of the probability that each of these texts is written, and nothing else, of what was heard.
    ///
    /// # Errors
    /// ONNX Runtime's.
    pub fn whole(&mut self, heard: &Written, texts: &[&[Token]]) -> ort::Result<Vec<f64>> {
        let mut all = Vec::with_capacity(texts.len());
        for some in texts.chunks(AT_ONCE) {
            all.extend(self.whole_at_once(heard, some)?);
        }
        Ok(all)
    }

    fn whole_at_once(&mut self, heard: &Written, texts: &[&[Token]]) -> ort::Result<Vec<f64>> {
        let (n, moments) = (texts.len(), heard.moments);
        let length = 1 + texts.iter().map(|t| t.len()).max().unwrap_or(0);
        // What follows the end of a shorter text changes nothing before it.
        let row = |text: &&[Token]| {
            let pieces = std::iter::once(BEGIN).chain(text.iter().copied());
            let padded = pieces.chain(std::iter::repeat(END)).take(length);
            padded.map(i64::from).collect::<Vec<_>>()
        };
        let pieces: Vec<i64> = texts.iter().flat_map(row).collect();
        let mask = vec![1_i64; n * moments];
        let of_one = heard.heard.get(..moments * HEARD).unwrap_or_default();
        let of_all = of_one.repeat(n);
        let mut inputs: Vec<(String, SessionInputValue<'_>)> = vec![
            (
                "encoder_attention_mask".into(),
                TensorRef::from_array_view(([n, moments], &*mask))?.into(),
            ),
            (
                "input_ids".into(),
                TensorRef::from_array_view(([n, length], &*pieces))?.into(),
            ),
            (
                "encoder_hidden_states".into(),
                TensorRef::from_array_view(([n, moments, HEARD], &*of_all))?.into(),
            ),
            (
                "use_cache_branch".into(),
                TensorRef::from_array_view(([1], &[false][..]))?.into(),
            ),
        ];
        for name in ["decoder", "encoder"].into_iter().flat_map(names) {
            let none = TensorRef::from_array_view(([n, HEADS, 0, WIDTH], &[0.0_f32; 0][..]))?;
            inputs.push((format!("past_key_values.{name}"), none.into()));
        }
        let outputs = self.writes.run(inputs)?;
        let (_, figures) = outputs["logits"].try_extract_tensor::<f32>()?;
        let size = figures.len() / (n * length).max(1);
        let rows = |(text, figures): (&&[Token], &[f32])| -> f64 {
            let next = text.iter().copied().chain(std::iter::once(END));
            let places = figures.chunks_exact(size.max(1));
            let ln = |(piece, place): (Token, &[f32])| match place.get(piece as usize) {
                Some(figure) => f64::from(*figure) - total(place),
                None => f64::NEG_INFINITY,
            };
            next.zip(places).map(ln).sum()
        };
        let of_texts = figures.chunks_exact((size * length).max(1));
        Ok(texts.iter().zip(of_texts).map(rows).collect())
    }
}

impl Written {
    /// ln of the probability of a piece as the next one of a writer.
    #[must_use]
    pub fn chance(&self, writer: usize, piece: Token) -> f32 {
        let size = self.next.len() / self.writers.max(1);
        let figure = self.next.get(writer * size + piece as usize);
        figure.copied().unwrap_or(f32::NEG_INFINITY)
    }

    /// The likeliest next piece of a writer.
    #[must_use]
    pub fn likeliest(&self, writer: usize) -> Token {
        let size = self.next.len() / self.writers.max(1);
        let of_writer = self
            .next
            .chunks(size.max(1))
            .nth(writer)
            .unwrap_or_default();
        let best = of_writer
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(b.1));
        best.map_or(END, |(piece, _)| piece as Token)
    }

    /// From now on these writers go on, each from where one of the present ones is.
    pub fn go_on(&mut self, from: &[usize]) {
        let (heads, n) = (HEADS * WIDTH, self.writers);
        let rows = |figures: &[f32]| -> Vec<f32> {
            let size = figures.len() / n.max(1);
            let rows = from
                .iter()
                .filter_map(|&w| figures.get(w * size..(w + 1) * size));
            rows.flatten().copied().collect()
        };
        debug_assert!(
            self.of_pieces
                .iter()
                .all(|f| f.len() == n * heads * self.pieces)
        );
        self.of_pieces.iter_mut().for_each(|f| *f = rows(f));
        // What was heard is the same for all of them.
        if from.len() != n {
            self.of_heard.iter_mut().for_each(|f| *f = rows(f));
            self.heard = rows(&self.heard);
        }
        self.next = rows(&self.next);
        self.writers = from.len();
    }
}

fn names(half: &str) -> impl Iterator<Item = String> {
    (0..LAYERS).flat_map(move |layer| {
        let half = half.to_owned();
        ["key", "value"].map(|kind| format!("{layer}.{half}.{kind}"))
    })
}

/// Makes ln of probabilities of a row.
fn normalise(row: &mut [f32]) {
    let ln = total(row) as f32;
    row.iter_mut().for_each(|x| *x -= ln);
}

/// ln of the sum of what a row's figures are the ln of.
fn total(row: &[f32]) -> f64 {
    let top = row.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let sum: f64 = row.iter().map(|&x| f64::exp(f64::from(x - top))).sum();
    f64::from(top) + f64::ln(sum)
}
