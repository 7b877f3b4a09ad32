//! What each key of a case file may hold, in the words that its errors use.

use super::fault::dotted;

/// What each key of one kind of file may hold: dotted key, and the end of the sentence "it must be ...". `*` stands for
/// any name.
pub(crate) type Words = [(&'static str, &'static str)];

#[rustfmt::skip] // A row a line, as the documents are held to it.
pub(super) const ALLOWED: &[(&str, &str)] = &[
    ("title", "one line of text that names the scene"),
    ("domain", "a table with the keys width, height"),
    ("domain.width", "a length above 0, m"),
    ("domain.height", "a length above 0, m"),
    ("domain.periodic", r#""none", "x", "y" or "both""#),
    ("cloud", "a table with the keys arrangement, spacing"),
    ("cloud.arrangement", r#""regular", "jittered", "random" or "relaxed""#),
    ("cloud.spacing", "a length above 0, m"),
    ("cloud.jitter", "a number from 0 to below 0.5, in spacings"),
    ("cloud.minimum_distance", "a number from 0.1 to 0.75, in spacings"),
    ("cloud.seed", "a whole number from 0"),
    ("cloud.fill", "a table with the keys from, to"),
    ("cloud.fill.from", "two numbers [x, y], m, the lower left corner, inside the domain"),
    ("cloud.fill.to", "two numbers [x, y], m, the upper right corner, inside the domain"),
    ("cloud.fill.wave", "a table with the keys amplitude, half_waves"),
    ("cloud.fill.wave.amplitude", "a length above 0, m"),
    ("cloud.fill.wave.half_waves", "a whole number from 1 to 4294967295"),
    ("cloud.refine", "tables [[cloud.refine]]"),
    ("cloud.refine.near", r#"the name of an obstacle, or "left", "right", "bottom" or "top""#),
    ("cloud.refine.box", "two corners [[x, y], [x, y]], m, inside the domain"),
    ("cloud.refine.spacing", "a length above 0 and at most cloud.spacing, m"),
    ("cloud.refine.growth", "a number above 0 and at most 0.3, m/m"),
    ("fluid", "a table with the key density"),
    ("fluid.density", "a number above 0, kg/m^3"),
    ("boundaries.*.kind", r#""wall", "slip", "inlet" or "outlet""#),
    ("boundaries.*.profile", r#""uniform" or "parabola""#),
    ("boundaries.*.velocity", "two numbers [along x, along y], m/s"),
    ("boundaries.*.temperature", "a number, K"),
    ("boundaries.*.heat_flux", "a number, K m/s, above 0 into the domain"),
    ("initial", "a table with the key rotation"),
    ("initial.rotation", "a number, 1/s"),
    ("obstacles", "tables [[obstacles]]"),
    ("obstacles.name", "letters, digits, _ and - alone, and no side's name"),
    ("obstacles.circle", "a table with the keys centre, radius"),
    ("obstacles.circle.centre", "a place [x, y], m"),
    ("obstacles.circle.radius", "a length above 0, m"),
    ("obstacles.polygon", "three or more corners [[x, y], ...], m, in order"),
    ("obstacles.parts", "tables, each with one of the keys circle, ellipse, box, capsule"),
    ("obstacles.parts.circle", "a table with the keys centre, radius"),
    ("obstacles.parts.circle.centre", "a place [x, y], m"),
    ("obstacles.parts.circle.radius", "a length above 0, m"),
    ("obstacles.parts.ellipse", "a table with the keys centre, axes"),
    ("obstacles.parts.ellipse.centre", "a place [x, y], m"),
    ("obstacles.parts.ellipse.axes", "two lengths above 0 [half its length, half its width], m"),
    ("obstacles.parts.ellipse.turn", "an angle, degrees, anticlockwise"),
    ("obstacles.parts.box", "a table with the keys centre, size"),
    ("obstacles.parts.box.centre", "a place [x, y], m"),
    ("obstacles.parts.box.size", "two lengths above 0 [width, height], m"),
    ("obstacles.parts.box.corner", "a length from 0 to half its width and height, m"),
    ("obstacles.parts.box.turn", "an angle, degrees, anticlockwise"),
    ("obstacles.parts.capsule", "a table with the keys from, to, radius"),
    ("obstacles.parts.capsule.from", "a place [x, y], m"),
    ("obstacles.parts.capsule.to", "a place [x, y], m, not that of from"),
    ("obstacles.parts.capsule.radius", "a length above 0, m"),
    ("obstacles.parts.combine", r#""add", "subtract" or "intersect""#),
    ("method.operators", r#""interpolation" or "integral""#),
    ("method.order", "1, 2, 3 or 4"),
    ("method.radius", "a number above 1.5 and at most 5, in spacings"),
    ("method.weight", r#""none", "quadratic" or "smooth""#),
    ("effects.viscosity.kinematic", "a number above 0, m^2/s (for none, leave out the table effects.viscosity)"),
    ("effects.viscosity.scheme", r#""explicit" or "implicit""#),
    ("effects.viscosity.tolerance", "a number above 0 and below 1"),
    ("effects.pressure.form", r#""conservative", "collocated" or "integral""#),
    ("effects.pressure.divergence", r#""faces" or "fit""#),
    ("effects.pressure.gradient", r#""fit" or "adjoint", with MPS "least" or "corrected""#),
    ("effects.pressure.solver", r#""conjugate_gradient", "bicgstab" or "direct""#),
    ("effects.pressure.preconditioner", r#""jacobi" or "multigrid""#),
    ("effects.pressure.tolerance", "a number above 0 and below 1"),
    ("effects.pressure.max_iterations", "a whole number from 1 to 4294967295"),
    ("effects.pressure.relaxation", "a number from 0 to 1"),
    ("effects.advection.motion", r#""fixed", "lagrangian" or "shifted""#),
    ("effects.advection.remap", r#""departure" or "forward""#),
    ("effects.gravity.acceleration", "two numbers [along x, along y], m/s^2, not both 0"),
    ("effects.drag.permeability", "a number above 0, m^2"),
    ("effects.drag.inertia", "a number from 0, 1/m"),
    ("effects.drag.circle", "a table with the keys centre, radius"),
    ("effects.drag.circle.centre", "a place [x, y], m"),
    ("effects.drag.circle.radius", "a length above 0, m"),
    ("effects.drag.polygon", "three or more corners [[x, y], ...], m, in order"),
    ("effects.heat.diffusivity", "a number above 0, m^2/s"),
    ("effects.heat.initial", "a number, K"),
    ("effects.buoyancy.expansion", "a number other than 0, 1/K"),
    ("effects.buoyancy.reference", "a number, K"),
    ("effects.tracers.name", "a name of letters, digits and _, not that of another field"),
    ("effects.tracers.diffusivity", "a number from 0, m^2/s"),
    ("effects.tracers.shape", r#""gaussian", "disc" or "box""#),
    ("effects.tracers.centre", "two numbers [x, y], m"),
    ("effects.tracers.radius", "a length above 0, m"),
    ("effects.tracers.size", "two lengths above 0 [width, height], m"),
    ("time", "a table with the key end"),
    ("time.end", "a time above 0, s"),
    ("time.courant", "a number above 0 and at most 50, in spacings a step"),
    ("time.step", "a time above 0 and at most time.end, s"),
    ("time.steady", "a number above 0, m/s^2"),
    ("time.splitting", r#""reflection" or "projection""#),
    ("guard.retries", "a whole number from 0 to 20"),
    ("guard.energy", "a number above 1"),
    ("exact", "a table with the key solution"),
    ("exact.solution", r#""taylor_green", "kovasznay", "couette", "poiseuille", "conduction" or "rotation""#),
    ("derivatives", "a table with the key field"),
    ("derivatives.field", r#""waves" or "cosines""#),
    ("poisson", "a table with the key field"),
    ("poisson.field", r#""waves" or "cosines""#),
    ("output.report_every", "a whole number from 1 to 4294967295"),
    ("output.pictures", "true or false"),
    ("output.frame_every", "a time above 0, s"),
    ("output.sensors", "tables [output.sensors.NAME]"),
    ("output.sensors.*", "a table with the key at"),
    ("output.sensors.*.at", "two numbers [x, y], m, inside the domain"),
    ("expect", "tables [expect.NAME]"),
    ("expect.*", "a table, its name of letters, digits, _ and - alone"),
    ("expect.*.component", r#""u", "v", "p", "temperature" or "tracer"; "velocity", "gradient", "laplacian", "x" or "y" with some measures"#),
    ("expect.*.line", "{ x = NUMBER } or { y = NUMBER }, m, inside the domain"),
    ("expect.*.measure", r#""minimum", "maximum", "profile", "error", "force", "difference", "flux", "slope", "loss", "front", "sensor", "noise", "area", "energy" or "period""#),
    ("expect.*.on", r#"the name of an obstacle; with measure = "flux" also a side"#),
    ("expect.*.between", "two places [[x, y], [x, y]] in the fluid, m"),
    ("expect.*.value", "a number other than 0 (its error is relative), m/s, Pa, K, K/m, N/m, m^2/s or s"),
    ("expect.*.profile", "the path of a CSV file, from the case file's folder"),
    ("expect.*.column", "the name of a column of the profile"),
    ("expect.*.tracer", "the name of one of effects.tracers"),
    ("expect.*.side", r#""left", "right", "bottom" or "top""#),
    ("expect.*.sensor", "the name of one of output.sensors"),
    ("expect.*.length", "a length above 0, m"),
    ("expect.*.duration", "a time above 0, s"),
    ("expect.*.delay", "a number, in units of duration"),
    ("expect.*.after", "a time from 0 to below time.end, s"),
    ("expect.*.tolerance", "a number above 0, relative"),
    ("expect.*.source", "a line that says where the value was published"),
];

/// What `path` may hold; an item of an array and a variant's content take the words of the key that holds them.
pub(crate) fn allowed(words: &Words, path: &[String]) -> Option<&'static str> {
    let plain: Vec<&String> = path.iter().filter(|name| !name.starts_with('[')).collect();
    let is_row = |key: &str, path: &[&String]| {
        key.split('.').count() == path.len()
            && key.split('.').zip(path).all(|(name, given)| name == "*" || name == *given)
    };
    let find = |path: &[&String]| words.iter().find(|(key, _)| is_row(key, path)).map(|(_, text)| *text);
    find(&plain).or_else(|| {
        let (_, parent) = plain.split_last()?;
        if parent.last().is_some_and(|name| *name == "line") { find(parent) } else { None }
    })
}

/// The key that an unknown one was perhaps meant to be: a like one of its own table, else the same name in another.
pub(super) fn suggest(words: &Words, path: &[String], known: &[&str]) -> Option<String> {
    let (name, table) = path.split_last()?;
    let sibling = closest(name, known).map(|known| {
        let mut meant = table.to_vec();
        meant.push(known.to_owned());
        dotted(&meant)
    });
    sibling.or_else(|| {
        let elsewhere = |key: &&str| !key.contains('*') && key.rsplit('.').next() == Some(name);
        words.iter().map(|(key, _)| *key).find(elsewhere).map(str::to_owned)
    })
}

/// The word of `known` that `given` is a likely misspelling of.
pub(crate) fn closest<'a>(given: &str, known: &[&'a str]) -> Option<&'a str> {
    let scored = known.iter().map(|word| (strsim::jaro_winkler(given, word), *word));
    scored.filter(|(score, _)| *score > 0.8).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, word)| word)
}

#[cfg(test)]
mod tests {
    use serde::de::DeserializeOwned;
    use toml::Value;

    use super::super::decode::decode;
    use super::super::fault::Problem;
    use super::super::*;
    use super::*;

    fn allowed(path: &[String]) -> Option<&'static str> {
        super::allowed(ALLOWED, path)
    }

    fn path(key: &str) -> Vec<String> {
        key.split('.').filter(|name| !name.is_empty()).map(str::to_owned).collect()
    }

    /// The keys that the type has, as it reports them when given one that it has not.
    fn fields<T: DeserializeOwned>() -> &'static [&'static str] {
        let unknown = Value::Table([("?".to_owned(), Value::Integer(0))].into_iter().collect());
        match decode::<T>(&unknown).map(|_| ()).expect_err("an unknown key").problem {
            Problem::Unknown(known) => known,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_table_holds_the_keys_of_the_types_and_no_others() {
        let tables: [(&str, &[&str]); 33] = [
            ("domain", fields::<Domain>()),
            ("cloud", fields::<Cloud>()),
            ("cloud.fill", fields::<Fill>()),
            ("cloud.fill.wave", fields::<Wave>()),
            ("initial", fields::<Initial>()),
            ("output.sensors.*", fields::<Sensor>()),
            ("cloud.refine", fields::<Refine>()),
            ("obstacles", fields::<Obstacle>()),
            ("obstacles.circle", fields::<Circle>()),
            ("obstacles.parts", fields::<Part>()),
            ("obstacles.parts.circle", fields::<Circle>()),
            ("obstacles.parts.ellipse", fields::<Ellipse>()),
            ("obstacles.parts.box", fields::<Block>()),
            ("obstacles.parts.capsule", fields::<Capsule>()),
            ("fluid", fields::<Fluid>()),
            ("boundaries.*", fields::<Wall>()),
            ("method", fields::<Method>()),
            ("effects.viscosity", fields::<Viscosity>()),
            ("effects.pressure", fields::<Pressure>()),
            ("effects.advection", fields::<Advection>()),
            ("effects.gravity", fields::<Gravity>()),
            ("effects.drag", fields::<Drag>()),
            ("effects.drag.circle", fields::<Circle>()),
            ("effects.heat", fields::<Heat>()),
            ("effects.buoyancy", fields::<Buoyancy>()),
            ("effects.tracers", fields::<Tracer>()),
            ("time", fields::<Time>()),
            ("guard", fields::<Guard>()),
            ("exact", fields::<Exact>()),
            ("derivatives", fields::<KnownField>()),
            ("poisson", fields::<KnownField>()),
            ("output", fields::<Output>()),
            ("expect.*", fields::<Expectation>()),
        ];
        let held = tables.iter().flat_map(|(table, keys)| keys.iter().map(move |key| format!("{table}.{key}")));
        let mut held: Vec<String> = held.collect();
        let absent: Vec<_> = held.iter().filter(|key| allowed(&path(key)).is_none()).collect();
        assert!(absent.is_empty(), "no words for {absent:?}");
        held.extend(fields::<Case>().iter().map(|key| (*key).to_owned()));
        held.extend(["expect.*", "output.sensors.*"].map(str::to_owned));
        let stray: Vec<_> = ALLOWED.iter().filter(|(key, _)| !held.contains(&(*key).to_owned())).collect();
        assert!(stray.is_empty(), "words for no key: {stray:?}");
    }

    #[test]
    fn every_word_that_a_key_takes_is_offered() {
        fn words<T: DeserializeOwned>() -> &'static [&'static str] {
            match decode::<T>(&Value::String("?".to_owned())).map(|_| ()).expect_err("an unknown word").problem {
                Problem::Word(_, known) => known,
                other => panic!("{other:?}"),
            }
        }
        let keys: [(&str, &[&str]); 20] = [
            ("effects.pressure.divergence", words::<Divergence>()),
            ("domain.periodic", words::<Axes>()),
            ("exact.solution", words::<Solution>()),
            ("cloud.arrangement", words::<Arrangement>()),
            ("method.operators", words::<Operators>()),
            ("method.weight", words::<Weight>()),
            ("derivatives.field", words::<Field>()),
            ("poisson.field", words::<Field>()),
            ("effects.pressure.form", words::<PressureForm>()),
            ("effects.pressure.gradient", words::<Gradient>()),
            ("effects.pressure.solver", words::<Solver>()),
            ("effects.advection.motion", words::<Motion>()),
            ("effects.advection.remap", words::<Remap>()),
            ("effects.tracers.shape", words::<Shape>()),
            ("obstacles.parts.combine", words::<Combine>()),
            ("boundaries.any.kind", words::<SideKind>()),
            ("boundaries.any.profile", words::<SideProfile>()),
            ("effects.viscosity.scheme", words::<Scheme>()),
            ("expect.any.measure", words::<Measure>()),
            ("expect.any.side", words::<SideName>()),
        ];
        for (key, words) in keys {
            let text = allowed(&path(key)).expect(key);
            assert!(
                words.iter().all(|word| text.contains(&format!("{word:?}"))),
                "{key}: {text} lacks one of {words:?}"
            );
            assert_eq!(text.matches('"').count(), 2 * words.len(), "{key}: {text} offers more than {words:?}");
        }
    }

    #[test]
    fn unlike_words_are_not_suggested() {
        assert_eq!(closest("spacng", &["spacing", "seed"]), Some("spacing"));
        assert_eq!(closest("colour", &["spacing", "seed"]), None);
        assert_eq!(suggest(ALLOWED, &path("domain.jitter"), &["width"]), Some("cloud.jitter".to_owned()));
    }
}
