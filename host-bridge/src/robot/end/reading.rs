//! What a host tells of its table and its commands, in the vocabulary's numbers.

use deictic_core::category::Category;
use deictic_core::command::field::{Features, Thing};
use deictic_core::command::message::{Execute, Item, Scene};
use deictic_core::intent::Parameter;
use deictic_core::large::{Entity, Intent};

use super::End;
use crate::robot::Refusal;
use crate::robot::remote::{action_of, direction_option};
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

/// A scene that is being told.
pub(super) struct Telling {
    version: u32,
    things: usize,
    entities: Vec<Entity>,
}

impl End {
    pub(super) fn scene(&mut self, of: &Scene) {
        self.telling = None;
        if of.vocabulary != self.lexicon.vocabulary().fingerprint() {
            return;
        }
        self.telling = Some(Telling {
            version: of.version,
            things: usize::from(of.things),
            entities: Vec::new(),
        });
        self.told();
    }

    pub(super) fn item(&mut self, of: &Item) {
        let features = self.lexicon.features().len();
        let Some(telling) = &mut self.telling else {
            return;
        };
        let next = (telling.version, telling.entities.len()) == (of.version, of.place.into());
        match entity_of(&of.thing, &of.features, features).filter(|_| next) {
            Some(entity) => telling.entities.push(entity),
            // Something was lost: the scene is told anew when a command on it is refused.
            None => self.telling = None,
        }
        self.told();
    }

    fn told(&mut self) {
        let Some(telling) = self.telling.take_if(|t| t.entities.len() >= t.things) else {
            return;
        };
        let table = Tabletop::numbered(telling.version, telling.entities, &self.lexicon);
        let table = table.map(|table| table.with_measures(self.measures.clone()));
        self.table = table.ok().or(self.table.take());
    }
}

/// What a command wants, in the vocabulary's numbers.
pub(super) fn intent_of(of: &Execute, lexicon: &Lexicon) -> Result<Intent, Refusal> {
    let action = action_of(of.motion, lexicon)
        .ok_or_else(|| Refusal::UnknownMotion(format!("{:?}", of.motion)))?;
    let mut intent = Intent {
        action,
        ..Intent::default()
    };
    let option = |thing: &Thing| thing.name.get().map(|(_, option)| option);
    let amount = Some(f32::from(of.amount)).filter(|a| *a > 0.0);
    let parameters = [
        (Category::OBJECT, option(&of.object), None),
        (Category::STORAGE, option(&of.storage), None),
        (Category::DISTANCE, None, of.distance.get()),
        (
            Category::DIRECTION,
            direction_option(of.direction, lexicon),
            None,
        ),
        (Category::ANGLE, None, of.angle.get()),
        (Category::AMOUNT, None, amount),
    ];
    for (category, option, quantity) in parameters {
        if option.is_none() && quantity.is_none() {
            continue;
        }
        let option = option.unwrap_or(0);
        let parameter = Parameter {
            category,
            option,
            quantity,
        };
        // There is room for every category.
        let _ = intent.parameters.push(parameter);
    }
    Ok(intent)
}

fn entity_of(thing: &Thing, features: &Features, count: usize) -> Option<Entity> {
    let (storage, option) = thing.name.get()?;
    let features = features.0.iter().take(count);
    Some(Entity {
        category: if storage {
            Category::STORAGE
        } else {
            Category::OBJECT
        },
        option,
        position: thing.place.metres(),
        features: features.map(|f| Features::likelihood(*f)).collect(),
    })
}
