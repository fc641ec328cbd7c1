//! One object in three forms, made from one set of bits: for the library, for the designs, and for the oracle.

use crate::bridge::pair::{CameraBits, ModelBits};
use crate::oracle::chain;
use designs::Object;
use pinhole::space::{Model, World};
use pinhole::{Affine, Camera};

pub(crate) struct Case {
    pub(crate) camera: Camera,
    pub(crate) model: Affine<Model, World>,
    pub(crate) object: Object,
}

impl Case {
    pub(crate) fn new(camera: &CameraBits, model: &ModelBits, exponent: i8) -> Self {
        let exact = camera.exact();
        let chain::Affine { m, t } = model.exact();
        let unit = f64::from(exponent).exp2();
        let [right, up, back] = exact.view.rows;
        let (width, height) = (exact.viewport.width, exact.viewport.height);
        let object = Object {
            model: m.map(|row| row.map(|c| c * unit)),
            place: t,
            axes: [right, up.map(|c| -c), back.map(|c| -c)],
            eye: exact.view.eye,
            focal: exact.projection[1][1] * height / 2.0,
            centre: [width / 2.0, height / 2.0],
            near: camera.projection.near(),
            far: camera.projection.far(),
        };
        Self { camera: camera.library(), model: model.library(), object }
    }
}
