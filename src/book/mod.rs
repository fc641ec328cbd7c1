//! The book: what a user needs to know beyond the documentation of single items.
//!
//! 1. [The pipeline, type by type](ch1_tour)
//! 2. [Spaces, axes and signs](ch2_coordinates), with a figure
//! 3. [Choosing a projection](ch3_projections), with the gallery
//! 4. [Hidden-surface removal](ch4_visibility): the mesh's order, painter's order, a depth buffer, hidden lines
//! 5. [Bands and DMA](ch5_bands)
//! 6. [Estimating RAM, flash and frame time](ch6_budget)
//! 7. [Number formats and errors](ch7_numbers)
//! 8. [From embedded-gfx and embedded-3dgfx](ch8_porting)
//! 9. [Cookbook](ch9_cookbook): eight whole programs, with their pictures
//! 10. [Measuring on your board](ch10_measuring): clock cycles, waiting, bytes, and logs
//! 11. [Changing the firmware's picture](ch11_changes): colours, a second object, a texture, fog, a label, a button
//! 12. [Tearing](ch12_tearing), with a figure
//!
//! If you have a firmware from a template and want to change its picture, begin with chapter 11.
//!
//! The module exists in the documentation only: it has nothing to import.

#[doc = include_str!("ch1_tour.md")]
pub mod ch1_tour {}

#[doc = include_str!("ch2_coordinates.md")]
#[doc = ""] // an empty line ends the text before it, and the figure
#[doc = include_str!("coordinates.svg")]
#[doc = ""]
#[doc = include_str!("ch2_signs.md")]
pub mod ch2_coordinates {}

#[doc = include_str!("ch3_projections.md")]
pub mod ch3_projections {}

#[doc = include_str!("links.md")]
#[doc = include_str!("ch4_visibility.md")]
pub mod ch4_visibility {}

#[doc = include_str!("ch5_bands.md")]
pub mod ch5_bands {}

#[doc = include_str!("links.md")]
#[doc = include_str!("ch6_budget.md")]
pub mod ch6_budget {}

#[doc = include_str!("links.md")]
#[doc = include_str!("ch7_numbers.md")]
pub mod ch7_numbers {}

#[doc = include_str!("links.md")]
#[doc = include_str!("ch8_porting.md")]
pub mod ch8_porting {}

#[doc = include_str!("ch11_changes.md")]
pub mod ch11_changes {}

#[doc = include_str!("ch12_tearing.md")]
#[doc = ""]
#[doc = include_str!("tearing.svg")]
#[doc = ""]
#[doc = include_str!("ch12_rules.md")]
pub mod ch12_tearing {}

pub mod ch10_measuring;
pub mod ch9_cookbook;
