//! The pages in `docs/`, each with what it takes to measure it.

use crate::bands::{self, Speed};
use crate::cells::{self, Choice};
use crate::cross::Build;
use crate::speed_page::{self, Figures};
use crate::{
    bands_page, footprint, footprint_page, growth, growth_page, profile, profile_page, rivals, scenes,
    targets, Result, M3,
};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Page {
    Speed,
    Profile,
    Growth,
    Bands,
    Footprint,
}

pub(crate) const PAGES: [Page; 5] = [Page::Speed, Page::Profile, Page::Growth, Page::Bands, Page::Footprint];

impl Page {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Profile => "profile",
            Self::Growth => "growth",
            Self::Bands => "bands",
            Self::Footprint => "footprint",
        }
    }

    pub(crate) fn file(self) -> String {
        format!("docs/{}.md", self.name())
    }

    /// Measures what stands on it. `rebase` takes today's sizes for limits.
    pub(crate) fn text(self, compiler: &str, rebase: bool, failures: &mut Vec<String>) -> Result<String> {
        Ok(match self {
            Self::Speed => speed(compiler, failures)?,
            Self::Profile => {
                profile_page::text(compiler, &profile::measure(failures)?, &targets::targets()?)?
            }
            Self::Growth => growth_page::text(compiler, &growth::measure()?),
            Self::Bands => bands_page::text(compiler, &measure_bands(failures)?),
            Self::Footprint => footprint_page::text(compiler, &footprint::measure(rebase, failures)?),
        })
    }
}

/// All cells, which are printed as they come.
fn speed(compiler: &str, failures: &mut Vec<String>) -> Result<String> {
    scenes::compare_models(failures);
    scenes::compare_lists(failures);
    let mut cells = Vec::new();
    cells::measure(&Choice::default(), failures, |cell| {
        println!("{cell}");
        cells.push(cell);
    })?;
    let (targets, rivals) = (targets::targets()?, rivals::measure(failures)?);
    Ok(speed_page::text(compiler, &Figures { cells: &cells, targets: &targets, rivals: &rivals }))
}

fn measure_bands(failures: &mut Vec<String>) -> Result<Speed> {
    let m3 = Build { target: M3, level: "3" };
    let host = bands::host()?;
    m3.cargo("build", &bands::bins())?;
    bands::measure(m3, &host, failures)
}
