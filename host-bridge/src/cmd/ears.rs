//! What is spoken, listened to beside the session.

use clap::Args;
use miette::Result;

use super::advice;
use super::printer::Printer;
use crate::language::Listener;
use crate::language::pack::Pack;
use crate::language::speech::pocketsphinx::MODEL;
use crate::language::speech::{Ears, Kind, Recogniser, Source};
use crate::vocabulary::Lexicon;

/// Where speech comes from, and with what caution it is taken.
#[derive(Args, Clone, Debug)]
pub struct Speech {
    /// Listen to speech: mic, a recording, lines:COMMAND for another recogniser's lines, or
    /// samples:COMMAND for another microphone's sound (docs/speech.md)
    #[arg(long, value_name = "SOURCE")]
    speech: Option<Source>,
    /// What hears: moonshine, pocketsphinx, or best, which is moonshine where it is installed
    #[arg(long, value_name = "NAME", requires = "speech", default_value = "best")]
    recogniser: Kind,
    /// Folder of pocketsphinx's model
    #[arg(long, value_name = "FOLDER", default_value = MODEL, requires = "speech")]
    speech_model: std::path::PathBuf,
    /// Options that were heard with more than this probability are asked about
    #[arg(long, value_name = "SHARE", requires = "speech", default_value_t = crate::language::RISK)]
    speech_risk: f64,
}

impl Speech {
    /// Whether anything is listened to.
    pub fn is_on(&self) -> bool {
        self.speech.is_some()
    }

    /// Begins to listen, if speech was asked for.
    pub fn open(
        &self,
        lexicon: &Lexicon,
        listener: &mut Listener<'_>,
        printer: Printer,
    ) -> Result<Option<Ears>> {
        let Some(source) = &self.speech else {
            return Ok(None);
        };
        listener.risk = self.speech_risk;
        let recogniser = || {
            let pack = Pack::of(lexicon)?;
            let opened = Recogniser::open(self.recogniser, lexicon, &pack, &self.speech_model)?;
            printer.listens(opened.name());
            Ok(opened)
        };
        let ears = Ears::open(source, recogniser).map_err(|e| advice(&e, e.remedy()))?;
        Ok(Some(ears))
    }
}
