#![doc = include_str!("../book/links.md")]
//! Numbers, angles, points and affine transforms, in integers. Start with [`Affine`] and [`Scalar`]; points and vectors have the tags of
//! [`space`](crate::space).
//!
#![doc = include_str!("../book/numbers.md")]

mod affine;
mod angle;
pub(crate) mod cores;
mod determinant;
pub(crate) mod float;
pub(crate) mod form;
mod halfword;
pub(crate) mod hints;
mod math_error;
mod normal;
pub(crate) mod num;
mod point;
pub(crate) mod quaternion;
#[cfg(test)]
pub(crate) mod random;
pub(crate) mod row;
mod scalar;
mod sphere;
pub(crate) mod unit;
pub(crate) mod unrolled;
mod vector;

pub use affine::Affine;
pub(crate) use affine::{matrix_product, to_scalar};
pub use angle::Angle;
pub(crate) use cores::LinearForm;
pub(crate) use determinant::determinant;
pub(crate) use form::ClipCoords;
pub(crate) use form::{Coordinate, Inside};
pub use math_error::MathError;
pub(crate) use normal::component_to_q15;
pub(crate) use normal::NormalMatrix;
pub use point::{Point3, Vector3};
pub(crate) use row::{homogeneous, Row};
pub use scalar::Scalar;
pub(crate) use sphere::stretched;
pub use sphere::Sphere;
