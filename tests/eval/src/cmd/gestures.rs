//! `deictic-eval gestures`

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::Subcommand;
use deictic_core::gesture::shape::Shape;
use deictic_eval::gestures::hands::{self, Hands, Labelled};
use deictic_eval::gestures::sessions::Bench;
use deictic_eval::gestures::{dynamics, statics, telling};
use serde::Serialize;

/// Train and score what the unit knows of hands.
#[derive(clap::Args)]
pub struct Gestures {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    Static(Static),
    Dynamic(Dynamic),
    Train(Train),
    Strokes(Strokes),
    Sessions(Sessions),
}

impl Gestures {
    pub fn run(self) -> anyhow::Result<()> {
        match self.what {
            What::Static(command) => command.run(),
            What::Dynamic(command) => command.run(),
            What::Train(command) => command.run(),
            What::Strokes(command) => command.run(),
            What::Sessions(command) => command.run(),
        }
    }
}

/// Train on labelled shapes and tell others.
///
/// Files hold shapes (columns label, recording and 15 distances) or, to be told, frames of a sensor,
/// and may be packed with xz. Without --test, or with the same file for both, every recording is
/// told by a network that saw none of it.
#[derive(clap::Args)]
struct Static {
    /// Labelled shapes to learn from
    #[arg(long, value_name = "FILE")]
    train: PathBuf,
    /// Shapes or frames to tell
    #[arg(long, value_name = "FILE")]
    test: Option<PathBuf>,
    /// Parts that the recordings are cut into when there is no other file to tell
    #[arg(long, default_value_t = 10, value_name = "N")]
    folds: usize,
    /// Of the random numbers
    #[arg(long, default_value_t = 2, value_name = "N")]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What a file of frames was taken for; nothing in it says what is right.
#[derive(Serialize)]
struct Told {
    n: usize,
    recordings: BTreeMap<String, telling::Told>,
}

fn labelled(file: &std::path::Path) -> anyhow::Result<Vec<Labelled>> {
    match hands::read(file)? {
        Hands::Labelled(shapes) if !shapes.is_empty() => Ok(shapes),
        Hands::Labelled(_) => bail!("{}: no shape in it", file.display()),
        Hands::Frames(_) => bail!(
            "{}: frames without labels cannot be learned",
            file.display()
        ),
    }
}

impl Static {
    fn run(self) -> anyhow::Result<()> {
        let shapes = labelled(&self.train)?;
        let test = self.test.filter(|test| *test != self.train);
        let Some(test) = test else {
            if self.folds < 2 {
                bail!("telling recordings by others needs two parts");
            }
            let answers = statics::cross_validate(&shapes, self.folds, self.seed);
            return print_score(&statics::score(&answers), self.json);
        };
        let others = hands::read(&test)?;
        let network = statics::learn(&shapes.iter().collect::<Vec<_>>(), self.seed);
        let recordings = match others {
            Hands::Labelled(mut others) => {
                // What was not learned is outside the set, whatever it is called.
                for other in &mut others {
                    if !shapes.iter().any(|s| s.shape == other.shape) {
                        other.shape = Shape::None;
                    }
                }
                let answers = statics::answers(&network, &others.iter().collect::<Vec<_>>());
                return print_score(&statics::score(&answers), self.json);
            }
            Hands::Frames(recordings) => recordings,
        };
        let told = Told {
            n: recordings.values().map(Vec::len).sum(),
            recordings: recordings
                .iter()
                .map(|(name, frames)| (name.clone(), telling::tell(&network, frames)))
                .collect(),
        };
        if self.json {
            return super::print_json(&told);
        }
        for (name, recording) in &told.recordings {
            println!("{name:<32} {}", recording.order.join(", "));
        }
        Ok(())
    }
}

fn print_score(score: &statics::Score, json: bool) -> anyhow::Result<()> {
    if json {
        return super::print_json(score);
    }
    println!("{:.2} % of {} hands right", score.accuracy, score.n);
    for (recording, shown, taken, frames) in &score.wrong {
        println!("  recording {recording}: {frames} frames of {shown} taken for {taken}");
    }
    Ok(())
}

/// Learn templates from strokes and tell others.
///
/// Columns: subject, gesture, t_ms, x, y, z and, if a person performs a gesture more than once, take.
/// Without --test, or with the same file for both, every person is told by templates of the others.
#[derive(clap::Args)]
struct Dynamic {
    /// Strokes to learn from
    #[arg(long, value_name = "FILE")]
    train: PathBuf,
    /// Strokes to tell
    #[arg(long, value_name = "FILE")]
    test: Option<PathBuf>,
    /// Templates of each gesture that the unit keeps
    #[arg(long, default_value_t = 12, value_name = "N")]
    each: usize,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Dynamic {
    fn run(self) -> anyhow::Result<()> {
        let learned = dynamics::read(&self.train)?;
        let score = match self.test.filter(|test| *test != self.train) {
            None => dynamics::leave_one_out(&learned, self.each)?,
            Some(test) => {
                let test = dynamics::read(&test)?;
                let train: Vec<_> = learned.iter().collect();
                dynamics::train_and_test(&train, &test.iter().collect::<Vec<_>>(), self.each)?
            }
        };
        if self.json {
            return super::print_json(&score);
        }
        println!(
            "{:.2} % of {} strokes right, {} templates",
            score.accuracy, score.n, score.templates
        );
        for (performed, taken) in &score.confusion {
            let wrong: Vec<String> = taken
                .iter()
                .filter(|(name, _)| *name != performed)
                .map(|(name, n)| format!("{n} taken for {name}"))
                .collect();
            if !wrong.is_empty() {
                println!("  {performed}: {}", wrong.join(", "));
            }
        }
        Ok(())
    }
}

/// Write the tables of core/src/gesture: the network that tells shapes, and the templates.
#[derive(clap::Args)]
struct Train {
    /// Labelled shapes to learn from
    #[arg(long, value_name = "FILE")]
    shapes: PathBuf,
    /// Folder to write shape_table.rs and stroke_table.rs to
    #[arg(long, default_value = "core/src/gesture", value_name = "DIR")]
    out: PathBuf,
}

impl Train {
    fn run(self) -> anyhow::Result<()> {
        let shapes = labelled(&self.shapes)?;
        let network = statics::learn(&shapes.iter().collect::<Vec<_>>(), 2);
        let strokes = dynamics::own_templates()?;
        for (name, text) in [
            ("shape_table.rs", statics::table(&network)),
            ("stroke_table.rs", dynamics::table(&strokes)),
        ] {
            let path = self.out.join(name);
            std::fs::write(&path, text).with_context(|| format!("writing {}", path.display()))?;
            println!("{}", path.display());
        }
        Ok(())
    }
}

/// Print strokes of made-up people as CSV.
#[derive(clap::Args)]
struct Strokes {
    /// How many people
    #[arg(long, default_value_t = 13, value_name = "N")]
    people: usize,
    /// How often each performs each gesture
    #[arg(long, default_value_t = 1, value_name = "N")]
    takes: usize,
    /// Draw the 26 letters instead of the unit's own gestures
    #[arg(long)]
    letters: bool,
    /// Of the random numbers
    #[arg(long, default_value_t = 1, value_name = "N")]
    seed: u64,
}

impl Strokes {
    fn run(self) -> anyhow::Result<()> {
        let names = if self.letters {
            dynamics::letters()
        } else {
            dynamics::own_names()
        };
        println!("subject,gesture,take,t_ms,x,y,z");
        for p in dynamics::perform(&names, self.people, self.takes, self.seed) {
            for (t, [x, y, z]) in &p.samples {
                let (who, what, take) = (p.subject, &p.gesture, p.take);
                println!("p{who},{what},{take},{t:.2},{x:.2},{y:.2},{z:.2}");
            }
        }
        Ok(())
    }
}

/// Whole gesture sessions of made-up people: what share says what was meant, and why others do not.
///
/// Everyone shows a sentence by chance with the gestures of deictic's own vocabulary, and points at the things of its
/// own table, or everyone shows the same. Another seed, other people.
#[derive(clap::Args)]
struct Sessions {
    /// How many
    #[arg(long, default_value_t = 1_000, value_name = "N")]
    people: usize,
    /// The first person's number
    #[arg(long, default_value_t = 1, value_name = "N")]
    seed: u64,
    /// Standard deviation by which they miss what they point at, degrees
    #[arg(long, default_value_t = 2.0, value_name = "DEGREES")]
    aim: f64,
    /// What everyone shows: gestures and things, as "thumbsup cup drawer"
    #[arg(long, value_name = "WORDS")]
    show: Option<String>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Sessions {
    fn run(self) -> anyhow::Result<()> {
        let bench = Bench::new()?;
        let shown = self.show.as_deref().map(|text| {
            let script = bench.of(text);
            script.with_context(|| {
                format!("\"{text}\" holds a word that is no gesture and no thing on the table")
            })
        });
        let shown = shown.transpose()?;
        let aim = self.aim.to_radians();
        let score = bench.score(self.seed, self.people, aim, shown.as_ref());
        if self.json {
            return super::print_json(&score);
        }
        println!("{:.2} % of {} sessions right", score.accuracy, score.n);
        for (name, cause) in &score.causes {
            println!("{:>5} {name}", cause.sessions);
            for example in &cause.examples {
                println!("        {example}");
            }
        }
        Ok(())
    }
}
