//! What the arm looks at before it begins: whether the motion can be done to these things. It asks
//! the table itself, whatever a unit may have decided.

use deictic_core::category::Category;
use deictic_core::decide::FEASIBLE;
use deictic_core::large::{Entity, Intent};

use super::hold::Hold;
use super::task::{Place, Task};
use super::{Refusal, Skill, World};
use crate::explain;

/// How far the arm reaches from its base, in metres (Franka Emika Panda, data sheet).
const REACH: f32 = 0.855;

/// What it carries at most, in kilograms (the same).
const PAYLOAD: f32 = 3.0;

/// How far one motion goes at most, in metres.
const FARTHEST: f32 = 0.5;

/// A feature of a thing by name; `None` when the vocabulary does not have it, and nothing can be said.
fn feature(entity: &Entity, name: &str, world: World<'_>) -> Option<bool> {
    let at = world.lexicon.feature(name)?;
    entity.features.get(at).map(|f| *f >= FEASIBLE)
}

fn named(intent: &Intent, category: Category, world: World<'_>) -> Option<String> {
    let option = intent.option(category)?;
    Some(world.lexicon.option_name(category, option))
}

/// The thing a command speaks of, if it is here and within reach.
fn thing<'a>(
    intent: &Intent,
    category: Category,
    called: &'static str,
    world: World<'a>,
) -> Result<(String, &'a Entity), Refusal> {
    let name = named(intent, category, world).ok_or(Refusal::Missing(called))?;
    let entity = intent
        .option(category)
        .and_then(|option| world.table.find(category, option))
        .ok_or_else(|| Refusal::NotHere(name.clone()))?;
    let [x, y, z] = entity.position;
    let out = x * x + y * y + z * z > REACH * REACH;
    if out || feature(entity, "reachable", world) == Some(false) {
        return Err(Refusal::OutOfReach(name));
    }
    Ok((name, entity))
}

/// What a command comes to for an arm whose hand is at `hand`, or why it cannot be done.
pub fn check(
    hold: &Hold,
    hand: Place,
    skill: Skill,
    intent: &Intent,
    world: World<'_>,
) -> Result<Task, Refusal> {
    let distance = quantity(intent, Category::DISTANCE)?;
    Ok(match skill {
        Skill::Stop => Task::Stop,
        Skill::MoveUp => Task::MoveUp {
            by: distance.unwrap_or(0.1),
        },
        Skill::Release => {
            let thing = hold.thing().ok_or(Refusal::NothingHeld)?.to_owned();
            let (z, on) = hold.support(&thing, hand, world);
            let [x, y, _] = hand;
            Task::Release {
                thing,
                to: [x, y, z],
                on,
            }
        }
        Skill::Pick => {
            if let Some(held) = hold.thing() {
                return Err(Refusal::Holding(held.to_owned()));
            }
            let (thing, entity) = graspable(hold, intent, world)?;
            let at = entity.position;
            Task::Pick { thing, at }
        }
        Skill::Push => {
            if let Some(held) = hold.thing() {
                return Err(Refusal::Holding(held.to_owned()));
            }
            let (thing, entity) = graspable(hold, intent, world)?;
            if feature(entity, "pushable", world) == Some(false) {
                let wanted = "pushable";
                return Err(Refusal::Unfit { thing, wanted });
            }
            let [x, y, z] = entity.position;
            let by = distance.unwrap_or(0.1);
            let to = match named(intent, Category::DIRECTION, world).as_deref() {
                Some("left") => [x, y + by, z],
                Some("right") => [x, y - by, z],
                Some("back") => [x - by, y, z],
                _ => [x + by, y, z],
            };
            if to.iter().map(|c| c * c).sum::<f32>() > REACH * REACH {
                return Err(Refusal::OutOfReach(format!(
                    "place the {thing} would go to"
                )));
            }
            if let Some(other) = hold.in_the_way(&thing, entity.position, to, world) {
                return Err(Refusal::InTheWay(other));
            }
            Task::Push {
                thing,
                from: entity.position,
                to,
            }
        }
        Skill::Unglue => {
            if let Some(held) = hold.thing() {
                return Err(Refusal::Holding(held.to_owned()));
            }
            let (thing, entity) = thing(intent, Category::OBJECT, "object", world)?;
            if feature(entity, "glued", world) == Some(false) {
                return Err(Refusal::NotGlued(thing));
            }
            let at = entity.position;
            Task::Unglue { thing, at }
        }
        Skill::Pour => {
            let (thing, entity) = graspable(hold, intent, world)?;
            if feature(entity, "full-liquid", world) == Some(false) {
                return Err(Refusal::Empty(thing));
            }
            let (into, container) = open(intent, world, "liquid-container")?;
            if feature(container, "full-liquid", world) == Some(true) {
                return Err(Refusal::Full(into));
            }
            let angle = quantity(intent, Category::ANGLE)?;
            Task::Pour {
                thing,
                at: entity.position,
                into,
                over: container.position,
                degrees: angle.unwrap_or(core::f32::consts::FRAC_PI_2).to_degrees(),
            }
        }
        Skill::PutInto => {
            let (thing, entity) = graspable(hold, intent, world)?;
            let (into, container) = open(intent, world, "container")?;
            Task::PutInto {
                thing,
                at: entity.position,
                into,
                to: container.position,
            }
        }
        Skill::Stack => {
            let (thing, entity) = graspable(hold, intent, world)?;
            let (onto, base) = open(intent, world, "stackable")?;
            let [x, y, z] = base.position;
            let to = [x, y, z + hold.half(&onto, z) + hold.half(&thing, 0.03)];
            Task::Stack {
                thing,
                at: entity.position,
                onto,
                to,
            }
        }
    })
}

fn quantity(intent: &Intent, category: Category) -> Result<Option<f32>, Refusal> {
    let Some(quantity) = intent.parameter(category).and_then(|p| p.quantity) else {
        return Ok(None);
    };
    let most = match category {
        Category::ANGLE => core::f32::consts::PI,
        _ => FARTHEST,
    };
    if quantity > 0.0 && quantity <= most {
        Ok(Some(quantity))
    } else {
        Err(Refusal::TooFar(explain::amount(category, quantity)))
    }
}

/// The object of a command, if the hand can take it or holds it already.
fn graspable<'a>(
    hold: &Hold,
    intent: &Intent,
    world: World<'a>,
) -> Result<(String, &'a Entity), Refusal> {
    let (thing, entity) = thing(intent, Category::OBJECT, "object", world)?;
    match hold.thing() {
        Some(held) if held == thing => return Ok((thing, entity)),
        Some(held) => return Err(Refusal::Holding(held.to_owned())),
        None => {}
    }
    if feature(entity, "glued", world) == Some(true) {
        return Err(Refusal::Glued(thing));
    }
    if feature(entity, "full-stack", world) == Some(true) {
        return Err(Refusal::Covered(thing));
    }
    if feature(entity, "pickable", world) == Some(false) {
        let wanted = "pickable";
        return Err(Refusal::Unfit { thing, wanted });
    }
    let mass = world.table.measures().get(&thing).and_then(|m| m.mass);
    if mass.is_some_and(|mass| mass > PAYLOAD) {
        return Err(Refusal::TooHeavy(thing));
    }
    Ok((thing, entity))
}

/// The storage of a command, if it is `wanted` and takes something more.
fn open<'a>(
    intent: &Intent,
    world: World<'a>,
    wanted: &'static str,
) -> Result<(String, &'a Entity), Refusal> {
    let (thing, entity) = thing(intent, Category::STORAGE, "storage", world)?;
    if feature(entity, wanted, world) == Some(false) {
        return Err(Refusal::Unfit { thing, wanted });
    }
    if feature(entity, "full-stack", world) == Some(true) {
        return Err(Refusal::Covered(thing));
    }
    if wanted != "stackable" && feature(entity, "full-container", world) == Some(true) {
        return Err(Refusal::Full(thing));
    }
    Ok((thing, entity))
}
