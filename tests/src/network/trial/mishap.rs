//! What goes wrong in the middle of a command.

use deictic::link::Wire;
use deictic_core::category::Category;
use deictic_core::sentence::LANGUAGE;
use deictic_core::time::Micros;

use super::{Setting, Trial};
use crate::network::around::Around;

impl<A: Around + Wire + Clone + Send + 'static> Trial<'_, A> {
    /// Something goes wrong, or the person says stop. Gives whether it was a stop.
    pub(super) fn mishap(&mut self, setting: &Setting) -> bool {
        let span = Micros(u64::from(self.random.below(4_000_000)));
        match self.random.below(10) {
            0 => self.world.restart(),
            1 => {
                let more = self.random.below(300) as usize;
                self.world.pull(span, more);
            }
            2 => self.world.freeze(span),
            3 => self
                .world
                .jump(span.after(Micros::from_millis(u64::from(self.random.below(100_000))))),
            4 => {
                self.world.sleep(span);
                // Whoever slept sees to the robot first.
                return false;
            }
            5 => {
                let moment = self.robot_now();
                self.robot.kill(moment);
            }
            6 | 7 => self.disturb_table(setting),
            8 => {
                self.session.stop();
                self.check_still();
                return true;
            }
            _ => {
                let vocabulary = setting.lexicon.vocabulary();
                let stop = vocabulary.stop().expect("the tabletop has one");
                let name = setting.lexicon.option_name(Category::ACTION, stop);
                let _ = self.session.observe(setting.say(&name, LANGUAGE));
                self.check_still();
                return true;
            }
        }
        false
    }

    /// Somebody moves a thing, takes one away, or lays the table as it was in the beginning.
    pub(super) fn disturb_table(&mut self, setting: &Setting) {
        let mut things = self.session.table().scene().entities().to_vec();
        let one = self.random.below(things.len().max(1) as u32) as usize;
        match self.random.below(3) {
            0 if one < things.len() => drop(things.remove(one)),
            1 => things = setting.table.scene().entities().to_vec(),
            _ => {
                if let Some(thing) = things.get_mut(one) {
                    thing.position[1] += 0.02 * (self.random.unit() - 0.5);
                }
            }
        }
        self.session.lay(things).expect("things of the vocabulary");
    }
}
