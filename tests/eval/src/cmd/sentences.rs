//! `deictic-eval sentences`

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use deictic::language::stream::{
    Class, Fused, Grammar, Hypothesis, Outcome, Signature, Streams, Words,
};
use serde_json::{Map, Value};

/// Score the fusion of time-stamped voice and gesture streams, in whole sentences.
///
/// A sentence is right when every word of it is, asked when the fusion asks for a part or for a
/// repetition, and wrong otherwise. Sets are those of the TransforMerger benchmark (arXiv
/// 2504.01708), or any file of the same shape.
#[derive(clap::Args)]
pub struct Sentences {
    /// File with the sets, packed with xz or not
    #[arg(long = "in", value_name = "FILE")]
    file: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Shares of one set's sentences, in percent.
#[derive(serde::Serialize)]
struct Score {
    set: String,
    right: f64,
    wrong: f64,
    asked: f64,
    /// Of which every word was heard or seen with any probability: nobody knows the others.
    knowable: f64,
}

impl Sentences {
    pub fn run(self) -> anyhow::Result<()> {
        let sets = read(&self.file).with_context(|| format!("{}", self.file.display()))?;
        let mut scores = Vec::new();
        for (set, samples) in &sets {
            let samples = samples
                .as_array()
                .with_context(|| format!("{set}: not a list"))?;
            let (mut counts, mut known) = ([0_usize; 3], 0_usize);
            for (i, sample) in samples.iter().enumerate() {
                let kind = judge(set, sample).with_context(|| format!("{set}, sample {i}"))?;
                counts[kind as usize] += 1;
                known += usize::from(knowable(sample)?);
            }
            let share =
                |kind: Kind| counts[kind as usize] as f64 * 100.0 / samples.len().max(1) as f64;
            scores.push(Score {
                set: set.clone(),
                right: share(Kind::Right),
                wrong: share(Kind::Wrong),
                asked: share(Kind::Asked),
                knowable: known as f64 * 100.0 / samples.len().max(1) as f64,
            });
        }
        if self.json {
            return super::print_json(&scores);
        }
        println!("set             right  wrong  asked  knowable");
        for Score {
            set,
            right,
            wrong,
            asked,
            knowable,
        } in &scores
        {
            println!("{set:<14} {right:>6.1} {wrong:>6.1} {asked:>6.1} {knowable:>9.1}");
        }
        Ok(())
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Right,
    Wrong,
    Asked,
}

fn read(path: &Path) -> anyhow::Result<Map<String, Value>> {
    let mut bytes = Vec::new();
    let mut input = BufReader::new(File::open(path)?);
    if path.extension().is_some_and(|e| e == "xz") {
        lzma_rs::xz_decompress(&mut input, &mut bytes)?;
    } else {
        input.read_to_end(&mut bytes)?;
    }
    Ok(serde_json::from_slice(&bytes)?)
}

fn judge(set: &str, sample: &Value) -> anyhow::Result<Kind> {
    let field = |name: &str| sample.get(name).with_context(|| format!("no \"{name}\""));
    let things = table(field("scene")?)?.keys().cloned().collect();
    let grammar = grammar(set, things)?;
    let streams = Streams {
        voice: stream(field("voice")?)?,
        gesture: stream(field("gesture")?)?,
    };
    let truth = field("true_sentence")?
        .as_str()
        .context("\"true_sentence\" is not a text")?;
    let fused = grammar.fuse(&streams);
    Ok(match fused.outcome {
        Outcome::Sentence if words(&grammar, &fused) == truth => Kind::Right,
        Outcome::Sentence => Kind::Wrong,
        Outcome::Ask(_) | Outcome::Repeat => Kind::Asked,
    })
}

/// Whether every word of the true sentence is among what was heard or seen.
fn knowable(sample: &Value) -> anyhow::Result<bool> {
    let mut seen = Vec::new();
    for part in ["voice", "gesture"] {
        let moments = stream(sample.get(part).context("no stream")?)?;
        let words = moments.into_iter().flat_map(|m| m.words);
        seen.extend(
            words
                .filter(|(_, p)| *p > 0.0)
                .map(|(word, _)| word.to_lowercase()),
        );
    }
    let truth = sample.get("true_sentence").and_then(Value::as_str);
    let mut words = truth.unwrap_or_default().split(' ').filter(|w| *w != "to");
    Ok(words.all(|w| seen.contains(&w.to_lowercase())))
}

/// The sentence as the sets write it.
fn words(grammar: &Grammar, fused: &Fused) -> String {
    let mut words = Vec::new();
    for part in &fused.parts {
        if part.class == Class::Storage {
            words.push("to");
        }
        let name = part.option.and_then(|o| grammar.names(part.class).get(o));
        words.extend(name.map(String::as_str));
    }
    words.join(" ")
}

/// A table, or the text of one as Python writes it.
fn table(value: &Value) -> anyhow::Result<Map<String, Value>> {
    Ok(match value {
        Value::Object(map) => map.clone(),
        Value::String(text) => serde_json::from_str(&text.replace('\'', "\""))?,
        _ => bail!("not a table"),
    })
}

fn stream(value: &Value) -> anyhow::Result<Vec<Hypothesis>> {
    let moments = table(value)?;
    let moment = |(time, words): (&String, &Value)| {
        let words = table(words)?;
        let word =
            |(word, p): (&String, &Value)| Ok((word.clone(), p.as_f64().context("not a number")?));
        let words = words.iter().map(word).collect::<anyhow::Result<_>>()?;
        Ok(Hypothesis {
            time: time.parse()?,
            words,
        })
    };
    moments.iter().map(moment).collect()
}

/// The grammars of the benchmark: actions without parameters, of one object, of two; "put" takes two
/// only in the third. Adverbs go with every action that has a parameter.
fn grammar(set: &str, things: Vec<String>) -> anyhow::Result<Grammar> {
    let (adverbs, put_takes_two): (&[&str], _) = match () {
        () if set.contains("CFG3") => (&["fast", "slow", "force"], true),
        () if set.contains("CFG") => (&["fast", "slow", "force"], false),
        () => (
            &["quickly", "slowly", "carefully", "lightly", "force"],
            false,
        ),
    };
    let alone = ["stop", "release", "home"];
    let mut one = vec!["pick", "push", "pass", "point", "open", "close"];
    let mut two = vec!["place", "transfer", "move", "pour"];
    if put_takes_two { &mut two } else { &mut one }.push("put");
    let takes = |storage: bool| Signature {
        object: true,
        storage,
        further: vec![0],
    };
    let signatures = alone.iter().map(|_| Signature::default());
    let signatures = signatures.chain(one.iter().map(|_| takes(false)));
    let signatures = signatures.chain(two.iter().map(|_| takes(true))).collect();
    let owned = |words: &[&str]| words.iter().map(|&w| w.to_owned()).collect::<Vec<_>>();
    Ok(Grammar::new(Words {
        actions: owned(&[&alone[..], &one, &two].concat()),
        signatures,
        objects: things.clone(),
        storages: things,
        further: vec![owned(adverbs)],
        prepositions: owned(&["to"]),
        fillers: Vec::new(),
    })?)
}
