//! Where a session hears of a changed table: a watched file, lines typed among the commands, lines over
//! TCP.

use miette::{IntoDiagnostic, Result, WrapErr};
use serde_json::json;

use super::files::Files;
use super::json;
use super::printer::Printer;
use crate::diagnose::Problem;
use crate::scene::feed::Feed;
use crate::scene::line::Thing;
use crate::scene::watch::Watch;
use crate::scene::{SceneLine, SceneProblem};
use crate::session::Session;

/// The sources of a session's scene.
#[derive(Debug)]
pub struct Scenes {
    watch: Option<Watch>,
    feed: Option<Feed>,
    printer: Printer,
}

impl Scenes {
    /// Watches the scene file when `watch` is set and there is one, and listens on `port` of loopback.
    pub fn open(files: &Files, watch: bool, port: Option<u16>, printer: Printer) -> Result<Self> {
        let feed = match port {
            None => None,
            Some(port) => Some(
                Feed::listen(port)
                    .into_diagnostic()
                    .wrap_err_with(|| format!("port {port} cannot be listened on"))?,
            ),
        };
        if let Some(feed) = &feed {
            printer.line("scenes", format!("are taken at {}", feed.address()));
            printer.object(&json!({ "event": "listening", "port": feed.address().port() }));
        }
        let watch = files.scene.as_deref().filter(|_| watch).map(Watch::new);
        Ok(Self {
            watch,
            feed,
            printer,
        })
    }

    /// Takes over what has changed.
    pub fn turn(&mut self, session: &mut Session<'_>) {
        match self.watch.as_mut().map(|w| w.look(session.lexicon())) {
            None | Some(Ok(None)) => {}
            Some(Ok(Some(things))) => {
                if let Err(error) = session.lay(things) {
                    self.refused(&SceneProblem::Refused(error));
                }
            }
            Some(Err(error)) => self
                .printer
                .not_understood(&error, error.problem().remedy()),
        }
        while let Some(request) = self.feed.as_ref().and_then(Feed::next) {
            let answer = match take(&request.line, session) {
                Ok(()) => json!({
                    "scene": session.table().version(),
                    "things": things(session),
                }),
                Err(problem) => {
                    json!({ "error": problem.to_string(), "remedy": problem.remedy() })
                }
            };
            request.answer(json::tidy(answer).to_string());
        }
    }

    /// Takes over a typed line.
    pub fn line(&self, session: &mut Session<'_>, line: &[u8]) {
        if let Err(problem) = take(line.trim_ascii(), session) {
            self.refused(&problem);
        }
    }

    fn refused(&self, problem: &SceneProblem) {
        self.printer.not_understood(problem, problem.remedy());
    }
}

fn things(session: &Session<'_>) -> Vec<Thing> {
    let things = session.table().scene().entities().iter();
    things.map(|e| Thing::of(e, session.lexicon())).collect()
}

fn take(line: &[u8], session: &mut Session<'_>) -> Result<(), SceneProblem> {
    let line = SceneLine::parse(line)?;
    if let Some(things) = line.things(session.table(), session.lexicon())? {
        session.lay(things).map_err(SceneProblem::Refused)?;
    }
    Ok(())
}
