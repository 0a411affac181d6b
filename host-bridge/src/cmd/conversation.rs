//! What a person types and speaks, given to a session; and how it ended.

mod answer;
mod arriving;
mod ending;
mod input;
mod refusing;

use std::collections::VecDeque;

use deictic_core::large::Sentence;

pub use self::ending::Ending;
use self::input::{Input, Waiting, parts};
use super::printer::Printer;
use crate::explain;
use crate::language::{LanguageError, Listener, Spoken, Utterance};
use crate::sensor::Sensors;
use crate::sensor_model::SensorModel;
use crate::session::{Order, Session};
use crate::showing::showing;
use crate::understanding::{self, Bearing, Understood, bearing};

/// Takes what is typed and spoken to a session.
pub struct Conversation<'a> {
    listener: &'a Listener<'a>,
    printer: Printer,
    waiting: VecDeque<Waiting>,
    /// The last question that was asked, in words.
    asked: Option<String>,
    last: Ending,
    quits: bool,
    /// Whether something went wrong that no command makes good.
    failed: bool,
    /// What observes what is said and shown; without any it is observed as it was typed.
    sensors: Option<Sensors<'a>>,
    /// What the unit was told of those who observe.
    told: SensorModel,
}

impl<'a> Conversation<'a> {
    /// Nothing was typed yet.
    pub fn new(listener: &'a Listener<'a>, printer: Printer) -> Self {
        Self {
            listener,
            printer,
            waiting: VecDeque::new(),
            asked: None,
            last: Ending::Done,
            quits: false,
            failed: false,
            sensors: None,
            told: SensorModel::default(),
        }
    }

    /// From now on these observe what is said and shown; without any it is observed as it was typed.
    /// Tells the unit what to expect of them.
    pub fn observe_by(&mut self, session: &mut Session<'_>, sensors: Option<Sensors<'a>>) {
        let model = match sensors {
            Some(_) => SensorModel::made_up(session.lexicon()),
            None => SensorModel::calibrated(session.lexicon()),
        };
        if model != self.told {
            self.told = model.clone();
            // A unit that cannot be told is lost, which the session tells.
            let _ = session.set_sensors(model);
        }
        self.sensors = sensors;
    }

    /// From now on this one understands what is said.
    pub fn listen_by(&mut self, listener: &'a Listener<'a>) {
        self.listener = listener;
    }

    /// What is said next is observed as it was typed; what was said before stays as it was observed.
    pub fn answer_clearly(&mut self) {
        self.sensors = None;
    }

    /// Tells the robot directly.
    fn order(&mut self, session: &mut Session<'_>, order: Order) {
        if order == Order::Hold && !session.is_moving() {
            // What waits would begin as soon as nothing else is pending.
            self.drop_waiting();
        }
        match session.order(order) {
            Ok(()) => self.printer.ordered(order),
            Err(refusal) => {
                self.last = Ending::NotDone;
                self.printer.declined(order, &refusal);
            }
        }
    }

    /// Takes the next input when the session is ready for it: when nothing is going on, or when the
    /// unit waits for just that modality.
    pub fn next(&mut self, session: &mut Session<'_>) {
        self.look_again(session);
        if self.quits && session.is_held() {
            // Nobody is there any more to have it go on.
            session.stop();
        }
        if !session.unit().is_there() {
            return;
        }
        let fits = |waiting: &Waiting| {
            let modality = waiting.input.modality();
            modality.is_some_and(|m| session.is_waiting_for(m))
        };
        let ready = match session.is_idle() {
            true => Some(0),
            false => {
                // What is shown after further words belongs to those.
                let mut waiting = self.waiting.iter();
                let stands = waiting.position(|w| fits(w) || w.input.says_something());
                stands.filter(|at| self.waiting.get(*at).is_some_and(fits))
            }
        };
        let next = ready.and_then(|at| self.waiting.remove(at));
        match next.map(|waiting| waiting.input) {
            Some(Input::Line(text)) => self.typed(session, &text),
            Some(Input::Spoken(spoken)) => self.heard(session, &spoken),
            Some(Input::Corrected { text, sentence }) => {
                self.last = Ending::NotDone;
                let meant = explain::sentence(&sentence, session.lexicon());
                self.printer.corrected(&text, &meant);
                self.give(session, vec![*sentence], None);
            }
            None => {}
        }
    }

    fn heard(&mut self, session: &mut Session<'_>, spoken: &Spoken) {
        let text = spoken.best();
        if text.is_empty() {
            self.printer.nothing("somebody talks, and it is no command");
            return;
        }
        let (order, share) = likeliest_order(spoken);
        if let Some(order) = order.filter(|_| share > self.listener.risk) {
            self.printer.spoken(spoken);
            // Going home moves the arm, so it is done only of what was heard clearly.
            if share >= 1.0 - self.listener.risk && session.question().is_none() {
                self.order(session, order);
            } else {
                let error = LanguageError::Unclear { text: text.into() };
                self.printer.not_understood(&error, error.remedy());
            }
            return;
        }
        if session.question().is_some() {
            match spoken.certain(self.listener.risk) {
                Some(text) => self.take(session, Some(text), None),
                None => {
                    let error = LanguageError::Unclear { text: text.into() };
                    self.printer.not_understood(&error, error.remedy());
                }
            }
            return;
        }
        self.last = Ending::NotDone;
        self.printer.spoken(spoken);
        match self.listener.hear(spoken) {
            Ok(utterance) => {
                if let Some(commands) = self.commands(session, text, utterance) {
                    self.give(session, commands, None);
                }
            }
            Err(error) => self.not_understood(session, &error),
        }
    }

    fn typed(&mut self, session: &mut Session<'_>, text: &str) {
        let (said, shown) = parts(text);
        match said {
            "quit" | "exit" => self.quit(),
            "help" | "?" => self.printer.help(),
            "table" => self.printer.table(session),
            _ if shown.is_empty() && Order::of(said) == Some(Order::Home) => {
                self.order(session, Order::Home);
            }
            _ => {
                let given = |text| Some(text).filter(|text: &&str| !text.is_empty());
                self.take(session, given(said), given(shown));
            }
        }
    }

    /// Takes what was said and shown.
    pub fn take(&mut self, session: &mut Session<'_>, said: Option<&str>, shown: Option<&str>) {
        self.last = Ending::NotDone;
        if let (Some(text), None, Some(question)) = (said, shown, session.question().cloned()) {
            self.answer(session, text, &question);
            return;
        }
        self.printer.heard(said, shown);
        let shown = match shown.map(|text| showing(text, session.lexicon())) {
            Some(Err(error)) => {
                self.printer.not_understood(&error, error.remedy());
                return;
            }
            Some(Ok(sentence)) => Some(sentence),
            None => None,
        };
        let commands = match said.map(|text| (text, self.listener.understand(text))) {
            None => Some(Vec::new()),
            Some((text, Ok(utterance))) => self.commands(session, text, utterance),
            Some((_, Err(error))) => {
                self.not_understood(session, &error);
                None
            }
        };
        if let Some(commands) = commands {
            self.give(session, commands, shown);
        }
    }

    /// The sentences of an utterance; `None`, and why, of one that commands nothing.
    fn commands(
        &mut self,
        session: &mut Session<'_>,
        text: &str,
        utterance: Utterance,
    ) -> Option<Vec<Sentence>> {
        let bearing = bearing(text, &utterance, session.lexicon());
        match understanding::of(text, utterance) {
            Understood::Commands(commands) => Some(commands),
            Understood::Nothing(why) => {
                self.printer.nothing(&why);
                if bearing != Bearing::Apart {
                    self.forbid(session);
                }
                None
            }
        }
    }

    /// Gives sentences to the unit; what is shown belongs to the first that is said.
    fn give(&mut self, session: &mut Session<'_>, said: Vec<Sentence>, shown: Option<Sentence>) {
        let observed: Result<Vec<_>, _> = match &mut self.sensors {
            None => Ok(shown.iter().chain(&said).cloned().collect()),
            Some(sensors) => {
                let meant = shown.iter().chain(&said);
                meant.map(|sentence| sensors.observe(sentence)).collect()
            }
        };
        let mut observed = match observed {
            Ok(observed) => observed.into_iter(),
            Err(error) => {
                let advice = explain::sentence_error(&error);
                self.printer.not_understood(advice.what, advice.remedy);
                return;
            }
        };
        let first = usize::from(shown.is_some()) + usize::from(!said.is_empty());
        let first: Vec<_> = observed.by_ref().take(first).collect();
        if let Err(error) = session.observe_together(&first) {
            self.printer.not_understood(&error, AGAIN.into());
            return;
        }
        session.queue(observed);
    }
}

/// What to do when the unit could not be told.
const AGAIN: &str = "wait until the unit is back, and say it again";

/// The order that was most likely heard, in whatever words, and how likely.
fn likeliest_order(spoken: &Spoken) -> (Option<Order>, f64) {
    let share = |order| {
        let alternatives = spoken.alternatives.iter();
        let fitting = alternatives.filter(|(text, _)| Order::of(text) == Some(order));
        fitting.map(|(_, share)| share).sum::<f64>()
    };
    let mut best = (None, 0.0);
    for order in [Order::Hold, Order::Resume, Order::Home, Order::Clear] {
        if share(order) > best.1 {
            best = (Some(order), share(order));
        }
    }
    best
}
