//! The pages in `docs/`, each with the measurements that it needs.

use crate::bands::{self, Speed};
use crate::cells::{self, Cell, Choice};
use crate::cross::Build;
use crate::speed_page::{self, Figures};
use crate::{
    bands_page, chips, cycles, cycles_page, esp32c3, footprint, footprint_page, growth, growth_page, profile,
    profile_page, rivals, scenes, targets, two_cores, Result, M3,
};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Page {
    Speed,
    Profile,
    Growth,
    Bands,
    Cores,
    Footprint,
}

pub(crate) const PAGES: [Page; 6] =
    [Page::Speed, Page::Profile, Page::Growth, Page::Bands, Page::Cores, Page::Footprint];

impl Page {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Profile => "profile",
            Self::Growth => "growth",
            Self::Bands => "bands",
            Self::Cores => "cores",
            Self::Footprint => "footprint",
        }
    }

    pub(crate) fn file(self) -> String {
        format!("docs/{}.md", self.name())
    }

    /// Measures the figures of a page. `rebase` takes today's sizes for limits.
    pub(crate) fn text(self, compiler: &str, rebase: bool, failures: &mut Vec<String>) -> Result<String> {
        Ok(match self {
            Self::Speed => speed(compiler, failures)?,
            Self::Profile => {
                profile_page::text(compiler, &profile::measure(failures)?, &targets::targets()?)?
            }
            Self::Growth => {
                let per_instruction =
                    cycles_page::per_instruction(chips::measured(failures)?, &esp32c3::measure()?);
                {
                    let (all, placing) = growth::measure()?;
                    growth_page::text(compiler, &all, &placing, &per_instruction)
                }
            }
            Self::Bands => bands_page::text(compiler, &measure_bands(failures)?),
            Self::Cores => two_cores::text(compiler, &two_cores::measure(&bands::host()?, failures)?),
            Self::Footprint => {
                footprint_page::text(compiler, &footprint::measure(&footprint::BUILDS, rebase, failures)?)
            }
        })
    }
}

/// Measures all cells, which are printed as they come, and the cells that have planes once more without them.
fn speed(compiler: &str, failures: &mut Vec<String>) -> Result<String> {
    scenes::compare_models(failures);
    scenes::compare_lists(failures);
    let mut cells = Vec::new();
    cells::measure(&Choice::default(), failures, |cell| {
        println!("{cell}");
        cells.push(cell);
    })?;
    let targets = targets::targets()?;
    targets::limit(&cells, &targets, failures);
    let without = cells::measure_without_planes(failures)?;
    compare_pictures(&cells, &without, failures);
    let rivals = rivals::measure(failures)?;
    let (open, times) = (targets::open()?, targets::times()?);
    let figures = Figures {
        cells: &cells,
        without: &without,
        targets: &targets,
        open: &open,
        times: &times,
        rivals: &rivals,
    };
    let on_page: Vec<&Cell> = cells.iter().filter(|cell| cycles::is_on_page(cell)).collect();
    let cycles = cycles::time(&on_page, &cycles::TIMED_CORES, failures)?;
    let frames = cycles_page::frames_per_second(chips::measured(failures)?);
    Ok(speed_page::text(compiler, &figures) + &cycles_page::cycles(&cycles) + &frames)
}

/// Asserts that pictures by planes and without planes are equal.
fn compare_pictures(cells: &[Cell], without: &[Cell], failures: &mut Vec<String>) {
    for cell in without {
        let same = |of: &&Cell| (of.scene, of.variant, of.core) == (cell.scene, cell.variant, cell.core);
        let by_planes = cells.iter().find(same).map(|of| of.crc);
        if by_planes != Some(cell.crc) {
            failures.push(format!("without planes: {cell}: by planes the picture is {by_planes:08x?}"));
        }
    }
}

fn measure_bands(failures: &mut Vec<String>) -> Result<Speed> {
    let m3 = Build { target: M3, level: "3" };
    let host = bands::host()?;
    m3.cargo("build", &bands::bins())?;
    bands::measure(m3, &host, failures)
}
