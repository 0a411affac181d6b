//! A deterministic world of everything between a person and a robot: the bridge's own session, a line that does all
//! that lines do, the unit's own state machine, a simulated robot, and a clock that moves only when something waits.
//! One seed gives one course of events, whatever the machine.

pub mod around;
pub mod damage;
mod ear;
pub mod inside;
pub mod line;
pub mod setting;
pub mod trial;
pub mod watch;
pub mod world;

pub use watch::Watch;
pub use world::World;
