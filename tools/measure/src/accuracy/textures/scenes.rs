//! The faces on which the error of textures is measured: in view space, with the texture coordinates of their corners.

use crate::bridge::pair::{CameraBits, ONE};
use crate::oracle::chain::V3;
use crate::oracle::rng::Rng;
use pinhole::draw::Cull;

/// Width and height of the picture.
pub(crate) const SIDE: u32 = 240;

/// A face: its corners in units of 2^exponent, in view space, and their coordinates in 1/16 texel.
pub(crate) type Face = ([[i16; 3]; 3], [[i16; 2]; 3]);

pub(crate) struct Scene {
    pub(crate) name: &'static str,
    /// The benchmark's name for it, if it has one.
    pub(crate) cell: Option<&'static str>,
    pub(crate) about: &'static str,
    pub(crate) faces: Vec<Face>,
    pub(crate) exponent: i8,
    pub(crate) cull: Cull,
}

/// An eye at the origin that looks along −z, 60° wide, from ½ to 2000.
pub(crate) const CAMERA: CameraBits = CameraBits::perspective(0x2aaa_aaab, (SIDE, SIDE), ONE / 2, 2000 * ONE);

pub(crate) fn all() -> Vec<Scene> {
    let floors = [
        (
            ("floor", Some("X2"), "over the whole picture, w 1 : 5.6"),
            [[-1025, -1025, -1741], [1025, -1025, -1741], [5729, 5729, -9728], [-5729, 5729, -9728]],
            (-10, 128),
        ),
        (
            ("rolled floor", Some("X3"), "by 25°, cut by the near plane"),
            [[-5136, -3525, -410], [6001, 1669, -410], [6001, 1669, -9728], [-5136, -3525, -9728]],
            (-10, 64),
        ),
        (
            ("horizon", Some("X4"), "rolled by 20°, w 1 : 1000, 1600 texels a side"),
            [[-27052, -9880, -29], [27074, 9820, -29], [27074, 9820, -32000], [-27052, -9880, -32000]],
            (-5, 1600),
        ),
        (
            ("wall", None, "along the line of sight, w 1 : 1000 across columns, 400 texels a side"),
            [[-16, -480, -19], [-16, 480, -19], [-16, 480, -19200], [-16, -480, -19200]],
            (-4, 400),
        ),
    ];
    // The corners' unit as a power of two, and the number of texels along the sides.
    let floors = floors.map(|(named, [a, b, c, d], (exponent, texels)): (_, [[i16; 3]; 4], (_, i16))| {
        let t = 16 * texels;
        let faces = [([a, b, c], [[0, t], [t, t], [t, 0]]), ([a, c, d], [[0, t], [t, 0], [0, 0]])];
        Scene::two_sided(named, exponent, faces)
    });
    [torus()].into_iter().chain(floors).chain([needles(), soup()]).collect()
}

impl Scene {
    fn two_sided(
        (name, cell, about): (&'static str, Option<&'static str>, &'static str),
        exponent: i8,
        faces: impl IntoIterator<Item = Face>,
    ) -> Self {
        Self { name, cell, about, faces: faces.into_iter().collect(), exponent, cull: Cull::None }
    }
}

/// X1: S3's torus of 1000 triangles, 64 × 64 texels once round.
fn torus() -> Scene {
    const RINGS: usize = 25;
    const RING: usize = 20;
    // Of tools/bench/scenes.json.
    const TURNED: [V3; 3] = [
        [0.861_919_3, -0.490_591_1, 0.128_123],
        [0.071_478_3, 0.367_724, 0.927_183_9],
        [-0.501_982, -0.789_999_7, 0.352_015_1],
    ];
    let turn = |i: usize, of: usize| (i as f64 / of as f64 * core::f64::consts::TAU).sin_cos();
    let corner = |[i, j]: [usize; 2]| {
        let ((s, c), (t, d)) = (turn(i, RINGS), turn(j, RING));
        let at = [(1.0 + 0.42 * d) * c, (1.0 + 0.42 * d) * s, 0.42 * t];
        let seen = TURNED.map(|row| (0..3).map(|k| row[k] * at[k]).sum::<f64>());
        let [x, y, z] = [seen[0], seen[1], seen[2] - 3.3846].map(|c| (c * 4096.0).round() as i16); // below 5
        ([x, y, z], [1024 * i / RINGS, 1024 * j / RING].map(|c| c as i16)) // 64 texels
    };
    let field = |n: usize| {
        let (i, j) = (n / RING, n % RING);
        let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(corner);
        [[a, b, c], [a, c, d]].map(|corners| (corners.map(|(at, _)| at), corners.map(|(_, uv)| uv)))
    };
    Scene {
        name: "torus",
        cell: Some("X1"),
        about: "1000 triangles, 64 × 64 texels once round",
        faces: (0..RINGS * RING).flat_map(field).collect(),
        exponent: -12,
        cull: Cull::Back,
    }
}

/// 150 slender triangles, many times as far at one end.
fn needles() -> Scene {
    let mut rng = Rng::new(61);
    let faces = (0..150).map(|_| {
        let mut end = |low: f64, high: f64| {
            let w = rng.log(low, high);
            [rng.real(-0.5, 0.5) * w, rng.real(-0.5, 0.5) * w, -w]
        };
        let (near, far) = (end(0.7, 3.0), end(3.0, 400.0));
        let thin = near.map(|c| c + rng.real(-0.05, 0.05));
        let uv = [(); 3].map(|()| [(); 2].map(|()| rng.int(-1600, 1600) as i16));
        ([near, far, thin].map(|at| at.map(|c| (c * 64.0).round() as i16)), uv)
    });
    Scene::two_sided(("needles", None, "150 slender triangles, coordinates to ±100 texels"), -6, faces)
}

/// Random triangles before the near plane and across it.
fn soup() -> Scene {
    let mut rng = Rng::new(62);
    let faces = (0..480).map(|i: usize| {
        let reach = [300, 2000][i / 3 % 2];
        let size = [1000, 200, 40][i % 3];
        let middle = [rng.int(-reach, reach), rng.int(-reach, reach), -rng.int(70, 3070)];
        let corners = [(); 3].map(|()| [0, 1, 2].map(|k: usize| (middle[k] + rng.int(-size, size)) as i16));
        (corners, [(); 3].map(|()| [(); 2].map(|()| rng.int(-16_000, 16_000) as i16)))
    });
    let about = "480 random triangles, cut by near and guard band, coordinates to ±1000 texels";
    Scene::two_sided(("soups", None, about), -6, faces)
}
