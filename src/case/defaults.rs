//! What holds where a case leaves a key open and the answer depends on another key.

use super::{
    Arrangement, Case, Cloud, Divergence, Gradient, Method, Motion, Operators, Preconditioner, Pressure, PressureForm,
    Solver,
};

/// Largest displacement of a jittered point along each axis, in spacings.
pub const DEFAULT_JITTER: f64 = 0.4;
/// Least distance of two random points, in spacings. Sequential random placing jams near 0.83.
pub const DEFAULT_MINIMUM_DISTANCE: f64 = 0.7;
/// Seed of the jittered and random arrangements.
pub const DEFAULT_SEED: u64 = 1;

/// Radius of the neighbourhood of orders 1 to 4, in spacings: about four times as many neighbours as coefficients inside, twice as many at a wall.
pub const DEFAULT_RADIUS: [f64; 4] = [2.1, 2.6, 3.4, 4.2];

impl Cloud {
    /// Largest displacement along each axis, in spacings; 0 unless jittered.
    pub fn jitter(&self) -> f64 {
        match self.arrangement {
            Arrangement::Jittered => self.jitter.unwrap_or(DEFAULT_JITTER),
            Arrangement::Regular | Arrangement::Random | Arrangement::Relaxed => 0.0,
        }
    }

    /// Least distance of two random points, in spacings.
    pub fn minimum_distance(&self) -> f64 {
        self.minimum_distance.unwrap_or(DEFAULT_MINIMUM_DISTANCE)
    }

    /// The same seed gives the same points.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(DEFAULT_SEED)
    }
}

impl Method {
    /// True where the operators have second derivatives: not fits of order 1.
    pub fn second_derivatives(&self) -> bool {
        self.operators == Operators::Integral || self.order > 1
    }

    /// Radius of the neighbourhood, in spacings.
    pub fn radius(&self) -> f64 {
        self.radius.unwrap_or(DEFAULT_RADIUS[self.order.clamp(1, 4) - 1])
    }
}

impl Pressure {
    /// The form of the equation.
    pub fn form(&self) -> PressureForm {
        self.form.unwrap_or(PressureForm::Conservative)
    }

    /// The flux through the faces of the conservative form.
    pub fn divergence(&self) -> Divergence {
        self.divergence.unwrap_or(Divergence::Faces)
    }

    /// The gradient of the correction; the collocated form has the fit's alone.
    pub fn gradient(&self) -> Gradient {
        self.gradient.unwrap_or(match self.form() {
            PressureForm::Conservative | PressureForm::Collocated => Gradient::Fit,
            PressureForm::Integral => Gradient::Least,
        })
    }

    /// The solver, by default the cheapest iterative one that applies to the form.
    pub fn solver(&self) -> Solver {
        self.solver.unwrap_or(match self.form() {
            PressureForm::Conservative | PressureForm::Integral => Solver::ConjugateGradient,
            PressureForm::Collocated => Solver::Bicgstab,
        })
    }
}

/// Volume change left in a step by a pressure solve, as far as [`COARSE`] spacings to the shorter side.
const DEFAULT_TOLERANCE: f64 = 1e-6;
/// Way in a step over the spacing that the solve of implicit viscosity leaves.
const DEFAULT_VISCOUS_TOLERANCE: f64 = 1e-6;
/// Beyond so many spacings the default falls with the square of the spacing, as the step's square does.
const COARSE: f64 = 64.0;

/// Share of an error in density that a step takes out: of MPS, whose source is nothing else, and of shifted points, whose
/// source is the divergence.
const INTEGRAL_RELAXATION: f64 = 0.05;
const SHIFTED_RELAXATION: f64 = 0.01;

/// Spacings that nothing moves farther than in a step: of points that stand, and of points that move.
const DEFAULT_COURANT: f64 = 0.8;
pub const MOVING_COURANT: f64 = 0.2;

impl Case {
    /// Largest distance that a point moves in one step, in spacings.
    pub fn courant(&self) -> f64 {
        self.time.courant.unwrap_or(if self.moves() { MOVING_COURANT } else { DEFAULT_COURANT })
    }

    /// Share of an error in density that a step takes out; 0 for the paper's interpolation form.
    pub fn relaxation(&self) -> f64 {
        let default = match (self.motion(), self.method.operators) {
            (Motion::Shifted, _) => SHIFTED_RELAXATION,
            (Motion::Lagrangian, Operators::Integral) => INTEGRAL_RELAXATION,
            _ => 0.0,
        };
        self.effects.pressure.as_ref().and_then(|pressure| pressure.relaxation).unwrap_or(default)
    }

    /// What an iterative pressure solver is preconditioned by; `None` of the direct one, and without a pressure.
    pub fn preconditioner(&self) -> Option<Preconditioner> {
        let pressure = self.effects.pressure.as_ref().filter(|pressure| pressure.solver() != Solver::Direct)?;
        let summed = self.moves() || pressure.solver() == Solver::ConjugateGradient;
        Some(match summed {
            true => pressure.preconditioner.unwrap_or(Preconditioner::Multigrid),
            false => Preconditioner::Jacobi,
        })
    }

    /// Volume change, `|div u| dt` (rms over the points), at which a pressure solve is done.
    pub fn tolerance(&self) -> f64 {
        let spacings = self.domain.width.min(self.domain.height) / self.cloud.spacing;
        let default = DEFAULT_TOLERANCE * (COARSE / spacings).powi(2).min(1.0);
        self.effects.pressure.as_ref().and_then(|pressure| pressure.tolerance).unwrap_or(default)
    }

    /// Way in a step, in spacings (rms over the points), at which the solve of implicit viscosity is done.
    pub fn viscous_tolerance(&self) -> f64 {
        let given = self.effects.viscosity.as_ref().and_then(|viscosity| viscosity.tolerance);
        given.unwrap_or(DEFAULT_VISCOUS_TOLERANCE)
    }

    /// Writes the defaults that apply into the keys left open, so that a summary shows what was run.
    pub(super) fn settle_defaults(&mut self) {
        let cloud = &mut self.cloud;
        if cloud.arrangement != Arrangement::Regular {
            cloud.seed = Some(cloud.seed());
        }
        if cloud.arrangement == Arrangement::Jittered {
            cloud.jitter = Some(cloud.jitter());
        }
        if cloud.arrangement == Arrangement::Random {
            cloud.minimum_distance = Some(cloud.minimum_distance());
        }
        self.method.radius = Some(self.method.radius());
        let implicit = self.implicit_viscosity();
        let tolerance = self.viscous_tolerance();
        if let Some(viscosity) = self.effects.viscosity.as_mut().filter(|_| implicit) {
            viscosity.tolerance = Some(tolerance);
        }
        self.time.courant = Some(self.courant());
        let (tolerance, preconditioner) = (self.tolerance(), self.preconditioner());
        if let Some(pressure) = &mut self.effects.pressure {
            pressure.tolerance = Some(tolerance);
            pressure.solver = Some(pressure.solver());
            pressure.preconditioner = preconditioner;
            if pressure.form() == PressureForm::Conservative {
                pressure.divergence = Some(pressure.divergence());
            }
            if pressure.form() != PressureForm::Collocated {
                pressure.gradient = Some(pressure.gradient());
            }
        }
    }
}
