//! Where a session hears of a changed table: a watched file, lines typed among the commands, lines over
//! TCP.

use deictic_core::large::Entity;
use deictic_core::scene::SceneError;
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
use crate::vocabulary::Lexicon;

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
                if let Err(error) = self.lay(session, things) {
                    self.refused(&SceneProblem::Refused(error));
                }
            }
            Some(Err(error)) => self.printer.no_scene(&error, error.problem().remedy()),
        }
        while let Some(request) = self.feed.as_ref().and_then(Feed::next) {
            let answer = match self.take(&request.line, session) {
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
        if let Err(problem) = self.take(line.trim_ascii(), session) {
            self.refused(&problem);
        }
    }

    fn refused(&self, problem: &SceneProblem) {
        self.printer.no_scene(problem, problem.remedy());
    }

    fn take(&self, line: &[u8], session: &mut Session<'_>) -> Result<(), SceneProblem> {
        let line = SceneLine::parse(line)?;
        if let Some(things) = line.things(session.table(), session.lexicon())? {
            self.lay(session, things).map_err(SceneProblem::Refused)?;
        }
        Ok(())
    }

    /// Lays the table anew, and says what is different.
    fn lay(&self, session: &mut Session<'_>, things: Vec<Entity>) -> Result<(), SceneError> {
        let before = session.table().scene().entities().to_vec();
        session.lay(things)?;
        let now = session.table().scene().entities();
        let different = difference(&before, now, session.lexicon());
        if !different.is_empty() {
            self.printer.line("table", different);
        }
        Ok(())
    }
}

/// What is different between two tables, in words: "can changed; box new; cup gone".
fn difference(before: &[Entity], now: &[Entity], lexicon: &Lexicon) -> String {
    let of = |things: &[Entity], thing: &Entity| {
        let same =
            |other: &&Entity| (other.category, other.option) == (thing.category, thing.option);
        things.iter().find(same).cloned()
    };
    let named = |things: &[Entity], what: &str, is: &dyn Fn(&Entity) -> bool| {
        let things = things.iter().filter(|thing| is(thing));
        let names = things.map(|t| lexicon.option_name(t.category, t.option).to_string());
        let names: Vec<_> = names.collect();
        (!names.is_empty()).then(|| format!("{} {what}", names.join(", ")))
    };
    let parts = [
        named(now, "changed", &|t| {
            of(before, t).is_some_and(|was| was != *t)
        }),
        named(now, "new", &|t| of(before, t).is_none()),
        named(before, "gone", &|t| of(now, t).is_none()),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
}

fn things(session: &Session<'_>) -> Vec<Thing> {
    let things = session.table().scene().entities().iter();
    things.map(|e| Thing::of(e, session.lexicon())).collect()
}
