//! Points that move: what is measured of them on the way, what is watched, and how long their steps may be.

use super::{Motion, Progress, Run, State, Trouble};
use crate::engine::{Clock, Data, EngineError};
use crate::motion::{self, Watched};
use crate::scene::Scene;
use crate::snapshot::Snapshot;
use crate::step::{Buffer, Operation, Points};

use glam::DVec2;

/// Most steps of points that move between two looks at their speed.
pub(super) const STRETCH: u32 = 10;
/// Part by which the energy of a motion may exceed that at its start.
const ENERGY_GROWTH: f64 = 0.05;
/// Distance below which two points are one, in spacings.
const CLUMPED: f64 = 0.01;
/// Part of the points that may leave the domain: with more there is little left to simulate.
const GONE: f64 = 0.25;

/// Watches points that move for a motion that is no longer one of the fluid.
pub(super) struct Watch {
    /// Potential energy of all fluid on the floor, m^4/s^2.
    floor: f64,
    /// Points at the start.
    points: usize,
    shifted: bool,
    /// What is read of every state beside what is kept of it.
    flags: Vec<(Buffer, Data)>,
    look: Option<Look>,
}

/// What is to be told with a row.
struct Look {
    row: motion::Row,
    /// Where it is due.
    frame: Option<Snapshot>,
}

impl Watch {
    pub fn new(scene: &Scene) -> Self {
        let (gravity, size) = (scene.constants.gravity, scene.constants.size);
        let volume = scene.cloud.filled.unwrap_or(0.0) * scene.cloud.interior as f64;
        let floor = -volume * gravity.max(DVec2::ZERO).dot(size);
        let (points, shifted) = (scene.cloud.interior, scene.plan.motion == crate::case::Motion::Shifted);
        Self { floor, points, shifted, flags: motion::flags(scene), look: None }
    }

    /// Energy above that of all fluid on the floor, m^4/s^2.
    fn energy(&self, watched: &Watched) -> f64 {
        watched.kinetic_energy + watched.potential_energy - self.floor
    }

    /// What is wrong, if something is; `start` is the energy at the start.
    fn judge(&self, watched: &Watched, start: f64) -> Option<Trouble> {
        let ([nearest, _, most], lost) = (watched.nearest, watched.outside.len());
        // Where every point is alone there are no two.
        if nearest < CLUMPED && most > 0.0 {
            return Some(Trouble::Diverged(format!("two points are {nearest:.1e} spacings apart")));
        }
        if lost as f64 > GONE * self.points as f64 {
            let reason = format!("{lost} of {} points have left the domain", self.points);
            return Some(Trouble::Diverged(reason));
        }
        let energy = self.energy(watched);
        let exceeds = energy > (1.0 + ENERGY_GROWTH) * start;
        if !exceeds {
            return None;
        }
        // One point that is shot out of the surface makes as much; shifted points may do without in shorter steps.
        let grown = Trouble::Grown { times: energy / start };
        Some(if self.shifted { grown } else { Trouble::Diverged(grown.to_string()) })
    }
}

impl Run<'_> {
    /// The pressure of points between mirrors at the beginning, for the reports, and for the first solve to begin from: that of the
    /// first step, after which the points are put back. Of MPS, whose pressure answers to an error in density, there is
    /// none yet.
    pub(super) fn first_pressure(&mut self, clock: &Clock) -> Result<(), EngineError> {
        if !self.scene.plan.mirrors() {
            return Ok(());
        }
        let plan = &self.scene.plan;
        let changed = [Buffer::Position(Points::Standing), Buffer::Projected];
        let begun = changed.map(|buffer| self.engine.read(buffer));
        for &operation in plan.drift.iter().chain(&plan.kick) {
            match operation {
                Operation::Collide => continue,
                Operation::CorrectMirrored => break,
                _ => self.engine.apply(operation, clock)?,
            }
        }
        for (buffer, begun) in changed.into_iter().zip(begun) {
            self.engine.write(buffer, &begun?)?;
        }
        // The fits of the velocity that was put back.
        plan.setup.iter().try_for_each(|&operation| self.engine.apply(operation, clock))
    }

    /// The speed that points are moved with by the time that it is looked at again, m/s, at `courant` spacings a step: they fall on
    /// until then.
    pub(super) fn faster(&self, speed: f64, courant: f64) -> f64 {
        if !self.scene.plan.moves() {
            return speed;
        }
        let falls = self.scene.constants.gravity.length() * f64::from(STRETCH);
        let way = courant * self.scene.constants.spacing;
        0.5 * (speed + (speed * speed + 4.0 * falls * way).sqrt())
    }

    /// The time at which the steps have to arrive, s: the end, or the next frame.
    pub(super) fn until(&self, now: f64) -> f64 {
        let end = self.scene.case.time.end;
        match self.scene.case.output.frame_every {
            Some(every) if self.scene.plan.moves() => end.min(every * ((now / every * (1.0 + 1e-9)).floor() + 1.0)),
            _ => end,
        }
    }

    /// Judges a state of points that move, and measures it, to be told with the row; what is wrong with their motion, if
    /// something is.
    pub(super) fn look_at_points(
        &mut self,
        progress: &mut Progress,
        state: &State,
    ) -> Result<Option<Trouble>, EngineError> {
        if !self.scene.plan.moves() {
            return Ok(None);
        }
        self.engine.read_all(&mut self.moving.flags)?;
        let seen = motion::State::new(self.scene, &state.arrays, &self.moving.flags);
        let watched = motion::watch(self.scene, &seen);
        let begun =
            || Motion { area: motion::covered(self.scene, &watched), energy: self.moving.energy(&watched), frames: 0 };
        let motion = progress.motion.get_or_insert_with(begun);
        let wrong = self.moving.judge(&watched, motion.energy);
        if wrong.is_none() {
            let row = motion::measure(self.scene, &seen, watched, progress.step, progress.time, motion.area);
            let due = |every: f64| row.time >= f64::from(motion.frames) * every * (1.0 - 1e-9);
            let frame = self.scene.case.output.frame_every.is_some_and(due);
            let frame = frame.then(|| self.snapshot_of(state, progress.time)).transpose()?;
            motion.frames += u32::from(frame.is_some());
            self.moving.look = Some(Look { row, frame });
        }
        Ok(wrong)
    }

    /// Tells the observer of the last look.
    pub(super) fn tell_moved(&mut self) {
        let Some(Look { row, frame }) = self.moving.look.take() else { return };
        self.observer.moved(&row);
        if let Some(frame) = frame {
            self.observer.frame(&frame);
        }
    }
}
