//! Fog into the background's colour: the option `--fog`, and a scene's `"fog"`.

use crate::bands::Colour;
use crate::quantised::Quantised;
use crate::scene::Scene;
use pinhole::fog::{Fog, FogTable};

/// Where fog begins and where it is full, and how it grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FogStyle {
    /// Distances before the camera, in the scene's units; `None` is from the nearest vertex to the farthest.
    pub range: Option<[f64; 2]>,
    pub profile: Profile,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Profile {
    #[default]
    Linear,
    Exponential,
    Squared,
}

impl Profile {
    const ALL: [(&'static str, Self); 3] =
        [("linear", Self::Linear), ("exponential", Self::Exponential), ("squared", Self::Squared)];
}

impl FogStyle {
    /// Linear fog over the model.
    pub const AUTO: Self = Self { range: None, profile: Profile::Linear };

    /// Linear fog between two distances.
    pub(crate) fn between(range: [f64; 2]) -> Result<Self, String> {
        match range {
            [start, end] if start >= end => {
                Err(format!("begins at {start} and should end farther away than {end}"))
            }
            _ => Ok(Self { range: Some(range), profile: Profile::Linear }),
        }
    }

    /// Parses the text of `--fog`.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "{text} is not auto or START,END, two distances such as 2,8; either may be followed by ,linear or ,exponential or ,squared"
            )
        };
        let (range, profile) = Profile::ALL
            .into_iter()
            .find_map(|(name, profile)| Some((text.strip_suffix(name)?.strip_suffix(',')?, profile)))
            .unwrap_or((text, Profile::Linear));
        if range == "auto" {
            return Ok(Self { profile, ..Self::AUTO });
        }
        let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        let (start, end) = range.split_once(',').ok_or_else(wrong)?;
        let range = number(start).zip(number(end)).ok_or_else(wrong)?;
        Ok(Self { profile, ..Self::between(range.into())? })
    }

    /// The table of this fog in the colour `color`, for a scene.
    pub(crate) fn table<C: Colour>(
        &self,
        scene: &Scene,
        quantised: &Quantised,
        colour: C,
    ) -> Result<FogTable<C>, String> {
        let range = self.range.unwrap_or_else(|| extent(scene));
        let [start, end] = range.map(|distance| quantised.distance(distance));
        if start == end {
            let ([from, to], [nearest, farthest]) = (range, extent(scene));
            return Err(format!(
                "fog: {from} to {to} is not where the scene is: its vertices are {nearest} to {farthest} before the camera"
            ));
        }
        let camera = quantised.camera();
        match self.profile {
            Profile::Linear => Fog::new(start, end).and_then(|fog| FogTable::new(&fog, &camera, colour)),
            Profile::Exponential => {
                Fog::new(start, end).and_then(|fog| FogTable::exponential(&fog, &camera, colour))
            }
            Profile::Squared => Fog::new(start, end).and_then(|fog| FogTable::squared(&fog, &camera, colour)),
        }
        .map_err(|e| format!("fog: {e}"))
    }
}

/// The distances of the nearest and the farthest vertex before the camera.
fn extent(scene: &Scene) -> [f64; 2] {
    let distances = scene.vertices.iter().map(|&vertex| scene.distance(scene.in_the_world(vertex)));
    distances.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], d| [low.min(d), high.max(d)])
}
