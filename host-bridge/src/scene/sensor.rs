//! Where the hand sensor stands, as a scene file writes it.

use deictic_core::gesture::pointing::{Aim, Mount};
use deictic_core::protocol::hand::{HandFault, HandSettings};
use serde::Deserialize;

use super::error::SceneProblem as Problem;

/// Where the hand sensor stands and how well the person aims.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Sensor {
    origin: [f32; 3],
    x: [f32; 3],
    y: [f32; 3],
    z: [f32; 3],
    sigma: f32,
    nothing: f32,
}

impl Default for Sensor {
    fn default() -> Self {
        let HandSettings { mount, aim } = HandSettings::DEFAULT;
        let [x, y, z] = mount.axes;
        Self {
            origin: mount.origin,
            x,
            y,
            z,
            sigma: aim.sigma,
            nothing: aim.nothing,
        }
    }
}

impl Sensor {
    /// The settings of the unit that it comes to.
    pub fn settings(self) -> Result<HandSettings, Problem> {
        let mount = Mount {
            axes: [self.x, self.y, self.z],
            origin: self.origin,
        };
        let aim = Aim {
            sigma: self.sigma,
            nothing: self.nothing,
        };
        mount
            .check()
            .map_err(|e| Problem::Sensor(HandFault::Mount(e)))?;
        if !aim.is_sound() {
            return Err(Problem::Sensor(HandFault::Aim));
        }
        Ok(HandSettings { mount, aim })
    }
}
