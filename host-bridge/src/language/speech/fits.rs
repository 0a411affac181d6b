//! How well a recording fits texts that another recogniser has heard in it: pocketsphinx as a second
//! opinion, which knows nothing of what people mostly say.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::thread;

use super::anything::frames;
use super::error::SpeechError;
use super::pocketsphinx::{PROGRAM, Pocketsphinx};
use super::program::{file, run, write};

/// How well a recording fits some texts.
#[derive(Clone, Debug, PartialEq)]
pub struct Fits {
    /// ln of the acoustic likelihood of each text, in units that [`super::pocketsphinx::SCALE`] tells of;
    /// `None` for a text that does not fit at all, or has a word that is none of the vocabulary's.
    pub texts: Vec<Option<f64>>,
    /// How much better any sounds in any order fit than the best of these texts, per 10 ms; `None` where
    /// no text fits.
    pub loose: Option<f64>,
}

/// A text as the only path of a network of words, as pocketsphinx reads one.
fn network(text: &str) -> String {
    let words: Vec<_> = text.split_whitespace().collect();
    let mut all = format!("FSG_BEGIN said\nNUM_STATES {}\n", words.len() + 1);
    // Writing to a string cannot fail.
    let _ = write!(all, "START_STATE 0\nFINAL_STATE {}\n", words.len());
    for (i, word) in words.iter().enumerate() {
        let _ = writeln!(all, "TRANSITION {i} {} 1.0 {word}", i + 1);
    }
    all + "FSG_END\n"
}

impl Pocketsphinx {
    /// How well samples of [`super::sound::RATE`] fit these texts. An eighth of a second of one core per
    /// text and as much again.
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn fits(&self, samples: &[i16], texts: &[&str]) -> Result<Fits, SpeechError> {
        let folder = self.take(samples)?;
        let workers = thread::available_parallelism().map_or(1, usize::from);
        let each = texts.len().div_ceil(workers.max(1)).max(1);
        let parts: Vec<_> = texts.chunks(each).enumerate().collect();
        let (fits, sounds) = thread::scope(|scope| {
            let begin = |(part, texts)| {
                scope.spawn({
                    let folder = &folder;
                    move || self.fit(folder, part, texts)
                })
            };
            let workers: Vec<_> = parts.into_iter().map(begin).collect();
            let sounds = self.sounds(&folder);
            let results = workers.into_iter().filter_map(|w| w.join().ok());
            (results.collect::<Result<Vec<_>, SpeechError>>(), sounds)
        });
        // A folder that stays is removed with its parent.
        let _ = fs::remove_dir_all(&folder);
        let texts = fits?.concat();
        let best = texts.iter().flatten().copied().max_by(f64::total_cmp);
        let loose = sounds?
            .zip(best)
            .map(|(sounds, best)| (sounds - best) / frames(samples.len()));
        Ok(Fits { texts, loose })
    }

    /// One run over some texts.
    fn fit(
        &self,
        take: &Path,
        part: usize,
        texts: &[&str],
    ) -> Result<Vec<Option<f64>>, SpeechError> {
        let known = |text: &&&str| text.split_whitespace().all(|w| self.pronounces(w));
        let path = |name: &str| take.join(format!("{part}.{name}"));
        let (mut said, mut networks) = (String::new(), String::new());
        for (i, text) in texts.iter().filter(known).enumerate() {
            said += "said\n";
            // Writing to a string cannot fail.
            let _ = writeln!(networks, "{part}.{i}");
            write(&path(&format!("{i}.fsg")), &network(text))?;
        }
        if said.is_empty() {
            return Ok(vec![None; texts.len()]);
        }
        let (list, of_list, heard) = (path("list"), path("networks"), path("hyp"));
        write(&list, &said)?;
        write(&of_list, &networks)?;
        let mut command = Command::new(PROGRAM);
        command
            .arg("-fsgctl")
            .arg(&of_list)
            .arg("-fsgdir")
            .arg(take);
        command.args(["-fsgext", ".fsg"]);
        self.settle(&mut command, take, &list, &heard);
        run(PROGRAM, &mut command)?;
        // A line per text, "pick the cup (said -4711)", without words where it does not fit.
        let lines = fs::read_to_string(&heard).map_err(file(&heard))?;
        let mut lines = lines.lines();
        let score = |text: &&str| {
            let line = known(&text).then(|| lines.next()).flatten()?;
            let line = line.trim_end().strip_suffix(')')?;
            let (text, score) = line.rsplit_once(' ')?;
            let fits = text
                .rsplit_once('(')
                .is_some_and(|(t, _)| !t.trim().is_empty());
            score.parse().ok().filter(|_| fits)
        };
        Ok(texts.iter().map(score).collect())
    }
}
