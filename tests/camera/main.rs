//! The vertex chain, from model coordinates to the screen: transforms, views, projections, viewports, and the way back
//! from a pixel to a ray. The expectations are computed in f64 from the quantized inputs, or worked out by hand.

mod matrices;
mod modelling;
mod picking;
mod projections;
mod ranges;
mod rotated;
mod spheres;
mod vertex_chain;
