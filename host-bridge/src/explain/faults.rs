//! What a unit did not take, in words, and why a decision of its is not acted upon.

use deictic_core::gesture::mapping::MappingError;
use deictic_core::gesture::pointing::MountError;
use deictic_core::joint::sensors::SensorError;
use deictic_core::protocol::hand::HandFault;
use deictic_core::protocol::message::Fault;

use super::{Advice, profile_error, scene_error, sentence_error, vocabulary_error};
use crate::unit::{Distrust, Loss};

/// What a unit did not take.
#[must_use]
pub fn fault(fault: &Fault) -> Advice {
    const LOAD: &str = "nothing: the bridge loads the unit anew";
    match fault {
        Fault::Schema { unit, host } => Advice::new(
            format!(
                "the unit speaks version {} of the protocol (schema {:#010x}), this bridge version {} \
                 (schema {:#010x})",
                unit.0, unit.1, host.0, host.1
            ),
            "flash the firmware that belongs to this bridge: `cargo run --release` in firmware/",
        ),
        Fault::NoHello => Advice::new("the unit has restarted and knows nothing", LOAD),
        Fault::NoVocabulary => Advice::new("the unit has no vocabulary", LOAD),
        Fault::NoScene => Advice::new("the unit has no scene", LOAD),
        Fault::PartOutOfOrder { expected, got } => Advice::new(
            format!("a part was lost on the way: {expected} was expected, {got} came"),
            "look at the cable if it happens again; the bridge sends it anew",
        ),
        Fault::OldScene { held, got } => Advice::new(
            format!("scene {got} is not newer than scene {held}, which the unit has"),
            "number scenes upwards",
        ),
        Fault::Vocabulary(error) => vocabulary_error(error),
        Fault::Scene(error) => scene_error(error),
        Fault::Sentence { modality, error } => {
            let Advice { what, remedy } = sentence_error(error);
            Advice::new(
                format!("in the sentence of modality {modality}, {what}"),
                remedy,
            )
        }
        Fault::Configuration(error) => profile_error(error),
        Fault::NoQuestion { decision } => Advice::new(
            format!("the question of decision {decision} is not open any more"),
            "say the whole command again",
        ),
        Fault::Answer { expected } => Advice::new(
            format!("an answer to this question is {expected} likelihoods in 0..=1"),
            "answer again",
        ),
        Fault::HostLost => Advice::new(
            "the unit did not hear the bridge for two seconds and has forgotten what was waiting",
            "say the command again",
        ),
        Fault::Hand(fault) => hand_fault(fault),
        Fault::NotProven => Advice::new(
            "the unit was not shown the key that it was flashed with",
            "give its own key: --key FILE",
        ),
        Fault::Sensor(error) => sensor_error(error),
    }
}

/// What is wrong with a sensor's table.
#[must_use]
pub fn sensor_error(error: &SensorError) -> Advice {
    match error {
        SensorError::UnknownModality { capacity } => Advice::new(
            "a sensor's table is of a modality that the unit does not have",
            format!("number modalities from 0 to {}", capacity.saturating_sub(1)),
        ),
        SensorError::TooLarge { capacity } => Advice::new(
            format!(
                "the sensors' tables take more than the {capacity} bytes that the unit has for them"
            ),
            "use fewer actions, objects and storages, or a unit built with larger capacities; without its \
             table a sensor is taken for a plain one",
        ),
        SensorError::NotSquare { options } => Advice::new(
            format!("a row of a sensor's table is not one over {options} options"),
            "nothing: the bridge loads the unit anew",
        ),
    }
}

fn hand_fault(fault: &HandFault) -> Advice {
    match fault {
        HandFault::Meaning(error) => mapping_error(error),
        HandFault::Mount(MountError::Axes) => Advice::new(
            "the hand sensor's axes do not stand at right angles, right-handed, each of length 1",
            "look at x, y and z of [sensor] in the scene file",
        ),
        HandFault::Mount(MountError::Origin) => Advice::new(
            "the hand sensor stands further than 100 m from the robot",
            "give its origin in metres, in [sensor] of the scene file",
        ),
        HandFault::Aim => Advice::new(
            "nobody aims like that",
            "give a sigma of 0.001 to 1 rad, 0.087 for most people",
        ),
        HandFault::TooManyTemplates { capacity } => Advice::new(
            format!("a unit can be taught {capacity} examples of gestures"),
            "teach fewer gestures, or fewer examples of each: `deictic gestures learn --each`",
        ),
        HandFault::Template { template } => Advice::new(
            format!("example {template} of a gesture cannot be"),
            "learn the gestures anew: `deictic gestures learn`",
        ),
        HandFault::Scale => Advice::new(
            "the scale of the gestures' examples cannot be",
            "learn the gestures anew: `deictic gestures learn`",
        ),
        HandFault::SensorLost => Advice::new(
            "the hand sensor fell silent in the middle of a gesture, which is forgotten",
            "look at the sensor's cable, and show it again",
        ),
    }
}

fn mapping_error(error: &MappingError) -> Advice {
    const FILE: &str = "look at `gestures` in the vocabulary file";
    match error {
        MappingError::UnknownGesture(gesture) => {
            Advice::new(format!("the unit does not know {gesture:?}"), FILE)
        }
        MappingError::Reserved(_) => Advice::new(
            "a pointing hand and a closed hand have a meaning of their own",
            FILE,
        ),
        MappingError::UnknownAction(action) => Advice::new(
            format!("a gesture stands for action {action}, which is not there"),
            FILE,
        ),
    }
}

/// Why a decision is not acted upon.
#[must_use]
pub fn distrust(distrust: &Distrust) -> Advice {
    const AGAIN: &str = "say the command again";
    match distrust {
        Distrust::AfterGap { missed } => Advice::new(
            format!("{missed} frames before the decision were lost"),
            AGAIN,
        ),
        Distrust::StaleScene {
            decided_on,
            present,
        } => Advice::new(
            format!("it was made on scene {decided_on}, and the table is at scene {present} now"),
            AGAIN,
        ),
        Distrust::OtherVocabulary => {
            Advice::new("it was made with another vocabulary", "restart the bridge")
        }
        Distrust::OldNumber { number, newest } => Advice::new(
            format!("decision {number} came after decision {newest}"),
            "look for two bridges or two units on one link",
        ),
    }
}

/// How a unit was lost.
#[must_use]
pub fn loss(loss: &Loss) -> Advice {
    let what = match loss {
        Loss::Wire(words) => words.clone(),
        Loss::Silent => "the unit has fallen silent".to_owned(),
        Loss::Forgetful => {
            "the unit has restarted or lost touch, and forgot what it knew".to_owned()
        }
        Loss::Stale => "the unit did not take over the new scene".to_owned(),
        Loss::Late => "the unit did not decide in time".to_owned(),
        Loss::Unloadable(why) => format!("the unit is there, but cannot be loaded: {why}"),
    };
    Advice::new(
        what,
        "the bridge goes on trying to reach it; look at its power and cable",
    )
}
