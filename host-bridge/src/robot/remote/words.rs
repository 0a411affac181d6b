//! The bridge's names for things in the numbers of the command set, and back.

use deictic_core::category::Category;
use deictic_core::command::code::{Direction, Motion, Reason};
use deictic_core::command::field::{Features, Id, Name, Place, Quantity, Text, Thing};
use deictic_core::command::message::{Execute, Item, Refused, Scene, ToRobot};
use deictic_core::large::{Entity, Intent};

use crate::robot::{Command, Refusal, Skill, World};
use crate::vocabulary::Lexicon;

/// The motions of the command set and the bridge's names for them.
const MOTIONS: [(Motion, Skill); 9] = [
    (Motion::MoveUp, Skill::MoveUp),
    (Motion::Release, Skill::Release),
    (Motion::Stop, Skill::Stop),
    (Motion::Pick, Skill::Pick),
    (Motion::Push, Skill::Push),
    (Motion::Unglue, Skill::Unglue),
    (Motion::Pour, Skill::Pour),
    (Motion::PutInto, Skill::PutInto),
    (Motion::Stack, Skill::Stack),
];

/// Directions and what vocabularies call them.
const DIRECTIONS: [(Direction, &str); 6] = [
    (Direction::Left, "left"),
    (Direction::Right, "right"),
    (Direction::Up, "up"),
    (Direction::Down, "down"),
    (Direction::Forward, "forward"),
    (Direction::Back, "back"),
];

/// What a thing would have to be, as far as the command set carries it.
const WANTED: [&str; 5] = [
    "pickable",
    "pushable",
    "stackable",
    "container",
    "liquid-container",
];

/// What can be missing.
const MISSING: [&str; 5] = ["object", "storage", "distance", "direction", "angle"];

/// The motion that an action of the vocabulary stands for.
fn motion_of(action: u8, lexicon: &Lexicon) -> Result<Motion, Refusal> {
    let name = lexicon.motion(action).unwrap_or_default();
    let skill = Skill::named(name);
    let found = MOTIONS.iter().find(|(_, s)| Some(*s) == skill);
    found
        .map(|(motion, _)| *motion)
        .ok_or_else(|| Refusal::UnknownMotion(name.to_owned()))
}

/// The first action of the vocabulary that stands for a motion.
pub(crate) fn action_of(motion: Motion, lexicon: &Lexicon) -> Option<u8> {
    let (_, skill) = MOTIONS.iter().find(|(m, _)| *m == motion)?;
    let actions = 0..=u8::try_from(lexicon.entries(Category::ACTION).len()).unwrap_or(u8::MAX);
    let mut standing = actions.filter(|a| lexicon.motion(*a) == Some(skill.name()));
    standing.next()
}

/// The vocabulary's option for a direction.
pub(crate) fn direction_option(direction: Direction, lexicon: &Lexicon) -> Option<u8> {
    let (_, name) = DIRECTIONS.iter().find(|(d, _)| *d == direction)?;
    lexicon.option(Category::DIRECTION, name)
}

fn direction_of(intent: &Intent, lexicon: &Lexicon) -> Direction {
    let Some(option) = intent.option(Category::DIRECTION) else {
        return Direction::None;
    };
    let name = lexicon.option_name(Category::DIRECTION, option);
    let found = DIRECTIONS.iter().find(|(_, n)| *n == name);
    found.map_or(Direction::None, |(direction, _)| *direction)
}

fn quantity_of(intent: &Intent, category: Category, unit: &str) -> Result<Quantity, Refusal> {
    match intent.parameter(category).and_then(|p| p.quantity) {
        None => Ok(Quantity::NONE),
        Some(value) => Quantity::new(value).ok_or(Refusal::TooFar(format!("{value} {unit}"))),
    }
}

fn name_for(category: Category, option: u8) -> Option<Name> {
    if category == Category::STORAGE {
        Name::storage(option)
    } else {
        Name::object(option)
    }
}

/// A thing of the scene, or of an intent that names one that is not in the scene.
fn thing_of(category: Category, option: Option<u8>, world: World<'_>) -> Result<Thing, Refusal> {
    let Some(option) = option else {
        return Ok(Thing::NONE);
    };
    let called = || world.lexicon.option_name(category, option);
    let name = name_for(category, option).ok_or_else(|| Refusal::NotHere(called()))?;
    let place = match world.table.find(category, option) {
        None => Place::default(),
        Some(entity) => place_of(entity).ok_or_else(|| Refusal::OutOfReach(called()))?,
    };
    Ok(Thing { name, place })
}

fn place_of(entity: &Entity) -> Option<Place> {
    Place::of_metres(entity.position)
}

/// A command as it is said, still without its name.
pub(super) fn execute(command: &Command, world: World<'_>) -> Result<Execute, Refusal> {
    let intent = &command.intent;
    let amount = intent
        .parameter(Category::AMOUNT)
        .and_then(|p| p.quantity)
        .unwrap_or(0.0);
    Ok(Execute {
        id: Id::default(),
        scene: command.scene,
        motion: motion_of(intent.action, world.lexicon)?,
        object: thing_of(Category::OBJECT, intent.option(Category::OBJECT), world)?,
        storage: thing_of(Category::STORAGE, intent.option(Category::STORAGE), world)?,
        distance: quantity_of(intent, Category::DISTANCE, "m")?,
        direction: direction_of(intent, world.lexicon),
        angle: quantity_of(intent, Category::ANGLE, "rad")?,
        // A cast saturates.
        amount: amount as u8,
    })
}

/// The table as it is said.
pub(super) fn scene(world: World<'_>) -> Result<Vec<ToRobot>, Refusal> {
    let version = world.table.version();
    let entities = world.table.scene().entities();
    let mut said = vec![ToRobot::Scene(Scene {
        version,
        vocabulary: world.lexicon.vocabulary().fingerprint(),
        things: u8::try_from(entities.len()).unwrap_or(u8::MAX),
    })];
    for (place, entity) in entities.iter().enumerate() {
        let option = Some(entity.option);
        said.push(ToRobot::Item(Item {
            version,
            place: u8::try_from(place).unwrap_or(u8::MAX),
            thing: thing_of(entity.category, option, world)?,
            features: Features::new(&entity.features),
        }));
    }
    Ok(said)
}

/// The thing's name in the vocabulary; `None` for no thing.
pub(super) fn name_of(thing: Name, lexicon: &Lexicon) -> Option<String> {
    let (storage, option) = thing.get()?;
    let category = if storage {
        Category::STORAGE
    } else {
        Category::OBJECT
    };
    Some(lexicon.option_name(category, option))
}

/// The number of the thing of this name: an object's, where it is object and storage alike.
pub(crate) fn thing_named(name: &str, lexicon: &Lexicon) -> Option<Name> {
    [Category::OBJECT, Category::STORAGE]
        .into_iter()
        .find_map(|category| name_for(category, lexicon.option(category, name)?))
}

fn place_in(list: &[&str], name: &str) -> Option<u32> {
    let place = list.iter().position(|n| *n == name)?;
    u32::try_from(place).ok()
}

fn at<'a>(list: &[&'a str], place: u32) -> Option<&'a str> {
    list.get(usize::try_from(place).ok()?).copied()
}

/// A refusal as it is said: its reason, a number and a text that belong to it.
pub(crate) fn reason_of(refusal: &Refusal) -> (Reason, u32, Text) {
    let (reason, value, text) = match refusal {
        Refusal::Busy => (Reason::Busy, Some(0), ""),
        Refusal::Repeated => (Reason::Repeated, Some(0), ""),
        Refusal::StaleScene { present, .. } => (Reason::StaleScene, Some(*present), ""),
        Refusal::UnknownMotion(name) => (Reason::UnknownMotion, Some(0), name.as_str()),
        Refusal::Missing(what) => (Reason::Missing, place_in(&MISSING, what), *what),
        Refusal::NotHere(thing) => (Reason::NotHere, Some(0), thing.as_str()),
        Refusal::Glued(thing) => (Reason::Glued, Some(0), thing.as_str()),
        Refusal::NotGlued(thing) => (Reason::NotGlued, Some(0), thing.as_str()),
        Refusal::OutOfReach(thing) => (Reason::OutOfReach, Some(0), thing.as_str()),
        Refusal::Covered(thing) => (Reason::Covered, Some(0), thing.as_str()),
        Refusal::Full(thing) => (Reason::Full, Some(0), thing.as_str()),
        Refusal::Empty(thing) => (Reason::Empty, Some(0), thing.as_str()),
        Refusal::Unfit { thing, wanted } => {
            (Reason::Unfit, place_in(&WANTED, wanted), thing.as_str())
        }
        Refusal::Holding(thing) => (Reason::Holding, Some(0), thing.as_str()),
        Refusal::NothingHeld => (Reason::NothingHeld, Some(0), ""),
        Refusal::TooFar(what) => (Reason::TooFar, Some(0), what.as_str()),
        Refusal::InTheWay(thing) => (Reason::InTheWay, Some(0), thing.as_str()),
        Refusal::Held => (Reason::Held, Some(0), ""),
        Refusal::Faulted => (Reason::Faulted, Some(0), ""),
        Refusal::OtherVocabulary => (Reason::OtherVocabulary, Some(0), ""),
        Refusal::Other(why) => (Reason::Other, Some(0), why.as_str()),
        _ => (Reason::Other, None, ""),
    };
    match value {
        Some(value) => (reason, value, Text::new(text)),
        None => (Reason::Other, 0, Text::new(&refusal.to_string())),
    }
}

/// What a robot's refusal of a command says that was decided on this scene.
pub(super) fn refusal_of(of: &Refused, decided_on: u32) -> Refusal {
    let text = of.text.get().to_owned();
    match of.reason {
        Reason::Busy => Refusal::Busy,
        Reason::Repeated => Refusal::Repeated,
        Reason::StaleScene => Refusal::StaleScene {
            decided_on,
            present: of.value,
        },
        Reason::UnknownMotion => Refusal::UnknownMotion(text),
        Reason::Missing => match at(&MISSING, of.value) {
            Some(what) => Refusal::Missing(what),
            None => Refusal::Other(format!("no {text} is given")),
        },
        Reason::NotHere => Refusal::NotHere(text),
        Reason::Glued => Refusal::Glued(text),
        Reason::NotGlued => Refusal::NotGlued(text),
        Reason::OutOfReach => Refusal::OutOfReach(text),
        Reason::Covered => Refusal::Covered(text),
        Reason::Full => Refusal::Full(text),
        Reason::Empty => Refusal::Empty(text),
        Reason::Unfit => match at(&WANTED, of.value) {
            Some(wanted) => Refusal::Unfit {
                thing: text,
                wanted,
            },
            None => Refusal::Other(format!("the {text} is not fit for it")),
        },
        Reason::Holding => Refusal::Holding(text),
        Reason::NothingHeld => Refusal::NothingHeld,
        Reason::TooFar => Refusal::TooFar(text),
        Reason::Held => Refusal::Held,
        Reason::Faulted => Refusal::Faulted,
        Reason::OtherVocabulary => Refusal::OtherVocabulary,
        Reason::InTheWay => Refusal::InTheWay(text),
        Reason::Other => Refusal::Other(text),
    }
}
