//! The cost of a vertex, a face, a row and a pixel, fitted to some cases, and tested by predicting others.

use crate::core::{Core, CORES};
use crate::fit::{dot, fit};
use crate::Result;
use bench::growth::{names, Case, Way, Work, CASES, WAYS};

/// Ways to draw that share their constants, on one core.
pub(crate) struct Growth {
    pub(crate) core: Core,
    pub(crate) ways: &'static [Way],
    /// The constants, in the order of `bench::growth::names`.
    pub(crate) constants: Vec<f64>,
    pub(crate) drawn: Vec<Drawn>,
}

pub(crate) struct Drawn {
    pub(crate) case: &'static Case,
    pub(crate) way: Way,
    pub(crate) work: Work,
    pub(crate) instructions: u64,
}

impl Growth {
    /// The instructions by the constants, divided by those that were counted.
    pub(crate) fn ratio(&self, drawn: &Drawn) -> f64 {
        dot(&drawn.work.counts(drawn.way), &self.constants) / drawn.instructions as f64
    }

    /// The errors of the cases that `chosen` chooses: their mean, the mean of their magnitudes, and the largest magnitude.
    pub(crate) fn errors(&self, chosen: impl Fn(&Drawn) -> bool) -> [f64; 3] {
        let drawn = self.drawn.iter().filter(|drawn| chosen(drawn));
        let errors: Vec<f64> = drawn.map(|drawn| self.ratio(drawn) - 1.0).collect();
        let sizes = || errors.iter().map(|error| error.abs());
        let mean = |sum: f64| sum / errors.len() as f64;
        [mean(errors.iter().sum()), mean(sizes().sum()), sizes().fold(0.0, f64::max)]
    }
}

/// Measures the cores of the table, in the order of `WAYS`; also the instructions of placing an object and of turning its light on
/// these cores.
pub(crate) fn measure() -> Result<(Vec<Growth>, Vec<[u64; 2]>)> {
    let works = works()?;
    let (mut all, mut placing) = (Vec::new(), Vec::new());
    for core in CORES {
        core.build().cargo("build", &["--bin=growth".into()])?;
        let printed = core.run(&core.build().image("growth"))?;
        // In the same order.
        let counts = printed.lines().map(|line| line.rsplit(',').next().unwrap_or(line).parse::<u64>());
        let mut counts = counts.collect::<std::result::Result<Vec<_>, _>>()?;
        if let (Some(light), Some(place)) = (counts.pop(), counts.pop()) {
            placing.push([place, light]);
        }
        if counts.len() != works.len() {
            return Err(format!("growth on {}: {} cases", core.name, counts.len()).into());
        }
        for ways in WAYS {
            let of_ways = works.iter().zip(&counts).filter(|((_, way, _), _)| ways.contains(way));
            let drawn: Vec<_> = of_ways
                .map(|(&(case, way, work), &instructions)| Drawn { case, way, work, instructions })
                .collect();
            let constants = constants(&drawn)?;
            let below = |(_, constant): &(_, &f64)| **constant < 0.0;
            if let Some((name, _)) = names(ways[0]).iter().zip(&constants).find(below) {
                return Err(
                    format!("growth on {}, {}: less than nothing for a {name}", core.name, ways[0]).into()
                );
            }
            all.push(Growth { core, ways, constants, drawn });
        }
    }
    Ok((all, placing))
}

/// The work of every case and way, in the firmware's order.
fn works() -> Result<Vec<(&'static Case, Way, Work)>> {
    let all = CASES.iter().flat_map(|case| case.ways().map(move |way| (case, way)));
    all.map(|(case, way)| {
        let work = case.work(way).ok_or_else(|| format!("{} cannot be drawn", case.name))?;
        Ok((case, way, work))
    })
    .collect()
}

/// Least squares of the relative errors.
fn constants(drawn: &[Drawn]) -> Result<Vec<f64>> {
    let part = |drawn: &Drawn| -> Vec<f64> {
        let counts = drawn.work.counts(drawn.way).into_iter();
        counts.map(|count| count / drawn.instructions as f64).collect()
    };
    let cases: Vec<_> = drawn.iter().filter(|drawn| drawn.case.fitted).map(part).collect();
    Ok(fit(&cases).ok_or("the cases do not tell all constants apart")?)
}
