//! Named places in the small arrays that the host and the kernels share. WGSL gets the names from here.

/// A list of names whose order gives their numbers, in Rust and, as constants, in WGSL.
macro_rules! numbered {
    ($(#[$about:meta])* $name:ident { $($(#[$each:meta])* $variant:ident = $wgsl:literal,)* }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(super) enum $name { $($(#[$each])* $variant),* }

        impl $name {
            pub(super) const NAMES: &[&str] = &[$($wgsl),*];
            #[allow(dead_code, reason = "not every list is walked")]
            pub(super) const ALL: &[Self] = &[$($name::$variant),*];
        }
    };
}

numbered! {
    /// Words of `control`.
    Word {
        /// Why nothing runs any more.
        Halted = "HALTED",
        /// Most iterations of a solve, and most fresh starts, in this batch: of the pressure, then of viscosity, as always.
        MostIterations = "MOST_ITERATIONS",
        MostViscousIterations = "MOST_VISCOUS_ITERATIONS",
        MostStarts = "MOST_STARTS",
        MostViscousStarts = "MOST_VISCOUS_STARTS",
        /// Steps done, and iterations of finished solves, since the run began.
        Steps = "STEPS",
        TotalIterations = "TOTAL_ITERATIONS",
        TotalViscousIterations = "TOTAL_VISCOUS_ITERATIONS",
        /// Longest neighbour list met that did not fit.
        MostNeighbours = "MOST_NEIGHBOURS",
        /// First point whose field is not a number.
        BadVelocity = "BAD_VELOCITY",
        BadPressure = "BAD_PRESSURE",
        BadCarried = "BAD_CARRIED",
        /// The solve under way, and what it solves.
        Phase = "PHASE",
        Equation = "EQUATION",
        Outcome = "OUTCOME",
        ViscousOutcome = "VISCOUS_OUTCOME",
        Iterations = "ITERATIONS",
        ViscousIterations = "VISCOUS_ITERATIONS",
        Starts = "STARTS",
        SinceBest = "SINCE_BEST",
    }
}

numbered! {
    /// Values of [`Word::Halted`].
    Halted {
        Not = "HALTED_NOT",
        InSolve = "HALTED_IN_SOLVE",
        ForDirectSolve = "HALTED_FOR_DIRECT_SOLVE",
        ByNonFinite = "HALTED_BY_NON_FINITE",
        ByOverflow = "HALTED_BY_OVERFLOW",
    }
}

numbered! {
    /// Values of [`Word::Phase`].
    Phase {
        Idle = "PHASE_IDLE",
        Checking = "PHASE_CHECKING",
        Iterating = "PHASE_ITERATING",
    }
}

numbered! {
    /// Values of [`Word::Outcome`].
    Ended {
        Converged = "OUTCOME_CONVERGED",
        Stagnated = "OUTCOME_STAGNATED",
        BrokeDown = "OUTCOME_BROKE_DOWN",
    }
}

numbered! {
    /// Entries of `scalars`.
    Scalar {
        FirstResidual = "FIRST_RESIDUAL",
        FirstViscousResidual = "FIRST_VISCOUS_RESIDUAL",
        LastResidual = "LAST_RESIDUAL",
        LastViscousResidual = "LAST_VISCOUS_RESIDUAL",
        Energy = "ENERGY",
        DivergenceSquare = "DIVERGENCE_SQUARE",
        SpeedSquare = "SPEED_SQUARE",
        ChangeSquare = "CHANGE_SQUARE",
        Best = "BEST",
        Mean = "MEAN",
        ResidualTimesPreconditioned = "RZ",
        Alpha = "ALPHA",
        Beta = "BETA",
        Rho = "RHO",
        Omega = "OMEGA",
        Constant = "CONSTANT",
    }
}

numbered! {
    /// Entries of `clock`.
    Time {
        Dt = "CLOCK_DT",
        /// How long the forces act, s.
        Kick = "CLOCK_KICK",
        SecondKick = "CLOCK_SECOND_KICK",
        /// `-rho / kick`: of the conservative source.
        Source = "CLOCK_SOURCE",
        DensityPerKick = "CLOCK_DENSITY_PER_KICK",
        /// `kick / rho`: of the pressure gradient.
        Correction = "CLOCK_CORRECTION",
        /// `kick nu`.
        Diffusion = "CLOCK_DIFFUSION",
        /// `relaxation rho / dt^2`: of an error in density.
        Stiffness = "CLOCK_STIFFNESS",
        /// Residual at which a solve is done, of the pressure and of viscosity.
        Stop = "CLOCK_STOP",
        ViscousStop = "CLOCK_VISCOUS_STOP",
        /// Share of what a step does to spread points evenly.
        Share = "CLOCK_SHARE",
        /// Part of the mean pressure's kick that the source sees, after implicit viscosity.
        Seen = "CLOCK_SEEN",
    }
}

numbered! {
    /// Rows of the table of workgroup counts, and the dispatches that take theirs from them.
    Extent {
        Points = "EXTENT_POINTS",
        Cells = "EXTENT_CELLS",
        /// Points, one workgroup, and the two finest levels of a coarse pressure, while a solve recomputes its residual.
        Check = "EXTENT_CHECK",
        CheckOnce = "EXTENT_CHECK_ONCE",
        CheckCells = "EXTENT_CHECK_CELLS",
        CheckFours = "EXTENT_CHECK_FOURS",
        /// The same while a solve iterates.
        Iterate = "EXTENT_ITERATE",
        IterateOnce = "EXTENT_ITERATE_ONCE",
        IterateCells = "EXTENT_ITERATE_CELLS",
        IterateFours = "EXTENT_ITERATE_FOURS",
    }
}

/// No point: of [`Word::BadVelocity`] and [`Word::BadPressure`].
pub(super) const NO_POINT: u32 = u32::MAX;
