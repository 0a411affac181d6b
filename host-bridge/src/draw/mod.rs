//! Pictures of the arm and the table, from the side and from above: as SVG for every step, and as
//! characters for a terminal.

mod svg;
mod text;

pub use svg::svg;
pub use text::{HEIGHT, text};

use deictic_core::category::Category;

use crate::robot::Posture;
use crate::robot::panda::skeleton;
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

/// Half of how wide things are drawn, in metres.
const HALF: f64 = 0.03;

/// What is in a picture: metres in the robot's base frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// The points that the arm goes through, from its foot to its finger tips; none when it does not say.
    pub arm: Vec<[f64; 3]>,
    /// The finger tips.
    pub tips: Vec<[f64; 3]>,
    /// The things.
    pub things: Vec<Drawn>,
    /// What is going on.
    pub caption: String,
}

/// A thing in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Its name.
    pub name: String,
    /// Its middle.
    pub at: [f64; 3],
    /// Whether it is a storage.
    pub storage: bool,
    /// Whether the hand holds it.
    pub held: bool,
}

impl Picture {
    /// A picture of an arm that stands so before this table, with a thing in its hand or none.
    #[must_use]
    pub fn of(
        posture: Option<Posture>,
        holding: Option<&str>,
        table: &Tabletop,
        lexicon: &Lexicon,
        caption: &str,
    ) -> Self {
        let mut picture = Self {
            caption: caption.to_owned(),
            ..Self::default()
        };
        if let Some(posture) = posture {
            let skeleton = skeleton(&posture.joints.map(f64::from));
            let line = skeleton.line();
            picture.arm = line.iter().map(|p| [p.x, p.y, p.z]).collect();
            let half = f64::from(posture.width) / 2.0;
            let tip = |aside: f64| skeleton.hand * nalgebra::Point3::new(0.0, aside, 0.0);
            let tips = [tip(half), tip(-half)];
            picture.tips = tips.iter().map(|p| [p.x, p.y, p.z]).collect();
        }
        for entity in table.scene().entities() {
            let name = lexicon.option_name(entity.category, entity.option);
            let held = holding == Some(&name);
            let mut at = entity.position.map(f64::from);
            // The table learns where a held thing is at the end of a motion; a picture is of the middle.
            if held && let Some(hand) = picture.arm.last() {
                at = *hand;
            }
            picture.things.push(Drawn {
                name,
                at,
                storage: entity.category == Category::STORAGE,
                held,
            });
        }
        picture
    }
}
