//! The thread that keeps an arm company: it reads its state while it stands, follows one command's
//! motions, and connects again when the connection broke.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use franka::Gripper;

use super::FciFault;
use super::arm::{Arm, Host};
use super::brakes::Brakes;
use crate::robot::motion::{Kind, Motion, Stance};
use crate::robot::panda::{Caps, Joints, Limits, OPEN, Path, Trajectory, apart};

/// How long after a failed attempt the arm is tried again.
const AGAIN: Duration = Duration::from_secs(1);

/// How often the arm may be brought on to where a motion was to end, when it has lost commands and came to
/// rest short of it.
const CORRECTIONS: usize = 2;

/// How far short of it that may be, in radians: more is an arm that something holds.
const NEARLY: f64 = 0.2;

/// A motion, and what the hand carries from its end on, in kilograms, where that is known and becomes different.
#[derive(Clone, Debug)]
pub(super) struct Job {
    pub motion: Motion,
    pub load: Option<f32>,
}

/// What has become of a command's motions.
#[derive(Clone, Debug)]
pub(super) enum Report {
    /// The motion of this number, from 0, begins.
    Begun(usize),
    /// It has ended, and the arm stands so.
    Ended(usize, Joints),
    /// The arm stands and waits in a motion.
    Held,
    /// It goes on.
    Resumed,
    /// All are done.
    Done,
    /// The arm was stopped in this motion and stands so.
    Stopped(usize, Joints),
    /// This motion failed.
    Failed(usize, FciFault),
}

/// What is known of a connected arm.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub stance: Stance,
    pub limits: Limits,
    pub hand: Arc<Gripper>,
}

/// What both threads see.
#[derive(Debug, Default)]
pub(super) struct Shared {
    /// The arm, or why there is none.
    known: Mutex<Option<Result<Known, FciFault>>>,
    reports: Mutex<VecDeque<Report>>,
    /// Set to make the arm come to rest and give the command up.
    pub stop: AtomicBool,
    /// Set to make the arm come to rest and wait, cleared to have it go on.
    pub hold: AtomicBool,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // What is behind these locks is whole at any moment.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Shared {
    /// The arm as it is.
    pub fn arm(&self) -> Result<Known, FciFault> {
        lock(&self.known)
            .clone()
            .unwrap_or_else(|| Err(FciFault::Unreachable("not connected yet".into())))
    }

    /// What has been reported since the last call.
    pub fn reports(&self) -> Vec<Report> {
        lock(&self.reports).drain(..).collect()
    }

    fn report(&self, report: Report) {
        lock(&self.reports).push_back(report);
    }

    pub(super) fn met(&self, arm: &Arm) -> Result<(), FciFault> {
        let joints = arm.joints()?;
        *lock(&self.known) = Some(Ok(Known {
            stance: Stance {
                joints,
                opening: OPEN,
            },
            limits: arm.limits(),
            hand: Arc::clone(&arm.hand),
        }));
        Ok(())
    }

    fn lost(&self, fault: FciFault) {
        *lock(&self.known) = Some(Err(fault));
    }

    fn stands(&self, joints: Joints) {
        if let Some(Ok(known)) = &mut *lock(&self.known) {
            known.stance.joints = joints;
        }
    }

    fn opened(&self, opening: f64) {
        if let Some(Ok(known)) = &mut *lock(&self.known) {
            known.stance.opening = opening;
        }
    }

    fn stopping(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn holding(&self) -> bool {
        self.hold.load(Ordering::Relaxed) && !self.stopping()
    }
}

/// Serves commands on `arm`, and on the next connection to `host` when that one breaks, until nobody
/// can give any more.
pub(super) fn serve(arm: Arm, host: &Host, inbox: &Receiver<Vec<Job>>, shared: &Shared) {
    let mut connected = Some(arm);
    loop {
        if let Some(arm) = connected.take() {
            match attend(&arm, inbox, shared) {
                Ok(()) => return,
                Err(fault) => shared.lost(fault),
            }
        }
        match inbox.recv_timeout(AGAIN) {
            Err(RecvTimeoutError::Disconnected) => return,
            Err(RecvTimeoutError::Timeout) => {}
            // It was given in the moment in which the connection broke.
            Ok(_) => {
                let gone = FciFault::Unreachable("the connection broke".into());
                shared.report(Report::Failed(0, gone));
            }
        }
        let arm = Arm::connect(host);
        match arm.and_then(|arm| shared.met(&arm).map(|()| arm)) {
            Ok(arm) => connected = Some(arm),
            Err(fault) => shared.lost(fault),
        }
    }
}

/// Serves commands until nobody can give any more; an error when the connection broke.
fn attend(arm: &Arm, inbox: &Receiver<Vec<Job>>, shared: &Shared) -> Result<(), FciFault> {
    loop {
        match inbox.try_recv() {
            Err(TryRecvError::Disconnected) => return Ok(()),
            Err(TryRecvError::Empty) => shared.stands(arm.joints()?),
            Ok(jobs) => perform(arm, &jobs, shared)?,
        }
    }
}

/// Does one command; an error only when the connection broke.
fn perform(arm: &Arm, jobs: &[Job], shared: &Shared) -> Result<(), FciFault> {
    for (i, Job { motion, load }) in jobs.iter().enumerate() {
        if shared.holding() {
            // The fingers were at it, which finish what they are at.
            shared.report(Report::Held);
            while shared.holding() {
                shared.stands(arm.joints()?);
            }
            shared.report(Report::Resumed);
        }
        if shared.stopping() {
            shared.report(Report::Stopped(i, arm.joints()?));
            return Ok(());
        }
        shared.report(Report::Begun(i));
        let acted = act(arm, motion, shared).and_then(|stands| {
            if let (Some(_), Some(kilograms)) = (stands, load) {
                arm.carries(*kilograms)?;
            }
            Ok(stands)
        });
        match acted {
            Ok(Some(joints)) => {
                shared.stands(joints);
                shared.report(Report::Ended(i, joints));
            }
            Ok(None) => {
                let joints = arm.joints()?;
                shared.stands(joints);
                shared.report(Report::Stopped(i, joints));
                return Ok(());
            }
            // A hand that is stopped says that it did not finish.
            Err(fault) if shared.stopping() && !fault.cuts() => {
                shared.report(Report::Stopped(i, arm.joints()?));
                return Ok(());
            }
            Err(fault) => {
                let cut = fault.cuts();
                shared.report(Report::Failed(i, fault.clone()));
                return if cut { Err(fault) } else { Ok(()) };
            }
        }
    }
    shared.report(Report::Done);
    Ok(())
}

/// Makes one motion; how the arm stands then, or `None` when it was stopped.
fn act(arm: &Arm, motion: &Motion, shared: &Shared) -> Result<Option<Joints>, FciFault> {
    match &motion.kind {
        Kind::Travel(trajectory) => {
            arm.ready()?;
            let end = trajectory.path().end();
            let held = |held| shared.report(if held { Report::Held } else { Report::Resumed });
            let brakes = Brakes {
                stop: &shared.stop,
                hold: &shared.hold,
                held: &held,
            };
            let follow =
                |way: &Trajectory| arm.follow(way, &brakes, |joints| shared.stands(joints));
            let mut reached = follow(trajectory)?;
            for _ in 0..CORRECTIONS {
                if !reached {
                    return Ok(None);
                }
                let from = match arm.settle(&end) {
                    Err(FciFault::Missed(_)) => arm.joints()?,
                    settled => return settled.map(Some),
                };
                match Path::through(vec![from, end]) {
                    Some(rest) if apart(&from, &end) < NEARLY => {
                        let caps = Caps::CAREFUL;
                        reached = follow(&Trajectory::along(rest, &arm.limits(), &caps))?;
                    }
                    _ => break,
                }
            }
            if reached {
                arm.settle(&end).map(Some)
            } else {
                Ok(None)
            }
        }
        Kind::Fingers { to, .. } => {
            arm.fingers(*to)?;
            shared.opened(*to);
            arm.joints().map(Some)
        }
    }
}
