//! What a person types and speaks, given to a session; and how it ended.

mod answer;
mod ending;
mod input;

use std::collections::VecDeque;

pub use self::ending::Ending;
use self::input::{BETWEEN, Input};
use super::printer::Printer;
use crate::explain;
use crate::language::{LanguageError, Listener, Spoken, text_of};
use crate::sensor::Sensors;
use crate::sensor_model::SensorModel;
use crate::session::{Order, Session};
use crate::showing::showing;
use crate::understanding::{self, Understood, mentions_stop};

/// A share of what may have been heard that is enough to stand still.
const MAY_BE_STOP: f64 = 0.2;

/// Takes what is typed and spoken to a session.
pub struct Conversation<'a> {
    listener: &'a Listener<'a>,
    printer: Printer,
    waiting: VecDeque<Input>,
    /// The last question that was asked, in words.
    asked: Option<String>,
    last: Ending,
    quits: bool,
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

    /// Takes a typed line. One that says stop is carried out at once, others when what was typed
    /// before is over.
    pub fn line(&mut self, session: &mut Session<'_>, line: &[u8]) {
        let text = match text_of(line) {
            Ok(text) => text.trim(),
            Err(error) => {
                self.last = Ending::NotDone;
                self.printer.not_understood(&error, error.remedy());
                return;
            }
        };
        if mentions_stop(text, session.lexicon()) {
            self.drop_waiting();
            session.stop();
            self.typed(session, text);
        } else if let Some(order @ (Order::Hold | Order::Resume | Order::Clear)) = Order::of(text) {
            self.order(session, order);
        } else if text == "cancel" {
            self.printer
                .nothing(&format!("{} typed lines are forgotten", self.waiting.len()));
            self.waiting.clear();
            session.cancel();
        } else if !text.is_empty() {
            self.waiting.push_back(Input::Line(text.to_owned()));
        }
    }

    /// Takes an utterance that was heard. One that may have been stop makes the robot stand still at
    /// once.
    pub fn spoken(&mut self, session: &mut Session<'_>, spoken: Spoken) {
        let lexicon = session.lexicon();
        let alternatives = spoken.alternatives.iter();
        let stop = alternatives.filter(|(text, _)| mentions_stop(text, lexicon));
        if stop.map(|(_, share)| share).sum::<f64>() > MAY_BE_STOP {
            self.drop_waiting();
            session.stop();
        }
        let (order, share) = likeliest_order(&spoken);
        // Standing still harms nobody, so what may have been hold is done at once.
        let enough = match order {
            Some(Order::Hold) => MAY_BE_STOP,
            _ => 1.0 - self.listener.risk,
        };
        match order {
            Some(order @ (Order::Hold | Order::Resume | Order::Clear)) if share >= enough => {
                self.printer.spoken(&spoken);
                self.order(session, order);
            }
            _ => self.waiting.push_back(Input::Spoken(spoken)),
        }
    }

    /// Tells the robot directly.
    fn order(&mut self, session: &mut Session<'_>, order: Order) {
        match session.order(order) {
            Ok(()) => self.printer.ordered(order),
            Err(refusal) => {
                self.last = Ending::NotDone;
                self.printer.declined(order, &refusal);
            }
        }
    }

    fn drop_waiting(&mut self) {
        let texts: Vec<_> = self
            .waiting
            .drain(..)
            .map(|w| w.text().to_owned())
            .collect();
        self.printer.dropped(&texts);
    }

    /// Takes the next input when the session is ready for it: when nothing is going on, or when the
    /// unit waits for just that modality.
    pub fn next(&mut self, session: &mut Session<'_>) {
        if self.quits && session.is_held() {
            // Nobody is there any more to have it go on.
            session.stop();
        }
        if !session.unit().is_there() {
            return;
        }
        let fits = |input: &Input| input.modality().is_some_and(|m| session.is_waiting_for(m));
        let ready = match session.is_idle() {
            true => Some(0),
            false => self.waiting.iter().position(fits),
        };
        match ready.and_then(|at| self.waiting.remove(at)) {
            Some(Input::Line(text)) => self.typed(session, &text),
            Some(Input::Spoken(spoken)) => self.heard(session, &spoken),
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
            Ok(utterance) => self.give(session, understanding::of(text, utterance), None),
            Err(error) => self.printer.not_understood(&error, error.remedy()),
        }
    }

    fn typed(&mut self, session: &mut Session<'_>, text: &str) {
        let (said, shown) = match text.split_once(BETWEEN) {
            None => (text.trim(), ""),
            Some((said, shown)) => (said.trim(), shown.trim()),
        };
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
        let understood = match said {
            None => Understood::Commands(Vec::new()),
            Some(text) => match self.listener.understand(text) {
                Ok(utterance) => understanding::of(text, utterance),
                Err(error) => {
                    self.printer.not_understood(&error, error.remedy());
                    return;
                }
            },
        };
        self.give(session, understood, shown);
    }

    /// Gives sentences to the unit; what is shown belongs to the first that is said.
    fn give(
        &mut self,
        session: &mut Session<'_>,
        understood: Understood,
        shown: Option<deictic_core::large::Sentence>,
    ) {
        let said = match understood {
            Understood::Nothing(why) => {
                self.printer.nothing(&why);
                return;
            }
            Understood::Commands(sentences) => sentences,
        };
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
