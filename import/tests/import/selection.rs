//! Objects of a file by their names, and several parts on one grid.

use crate::common::{obj as import, Random};
use pinhole_import::{import_bytes, Centre, ImportedMesh, Options, Problem, Remedy};

/// A box from one corner to the other, with eight vertices.
fn cuboid(low: [f64; 3], high: [f64; 3]) -> String {
    let mut text = String::new();
    for corner in 0..8 {
        let at = [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] });
        text += &format!("v {} {} {}\n", at[0], at[1], at[2]);
    }
    text + "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n"
}

#[test]
fn objects_and_groups_are_chosen_by_their_names() {
    let [plate, lever, pin] = [
        cuboid([0.0; 3], [9.0, 1.0, 9.0]),
        cuboid([0.0, 1.0, 0.0], [1.0, 5.0, 1.0]),
        cuboid([5.0; 3], [6.0; 3]),
    ];
    let text = format!("o plate\n{plate}l 1 8\np 1\no lever arm\ng moving steel\n{lever}g pin\n{pin}f 1 2\n");
    let of = |names: &[&str]| {
        let objects = names.iter().map(|name| name.to_string()).collect();
        import(&text, &Options { objects, ..Options::default() })
    };
    for (names, faces, extent) in [
        (&[][..], 36, 9.0),
        (&["plate"], 12, 9.0),
        (&["lever arm"], 24, 6.0),
        (&["steel"], 12, 4.0),
        (&["moving steel"], 12, 4.0),
        (&["pin"], 12, 1.0),
        (&["plate", "pin"], 24, 9.0),
    ] {
        let mesh = of(names).unwrap();
        assert_eq!((mesh.faces.len(), mesh.report.extent), (faces, extent), "{names:?}");
        let has_plate = names.is_empty() || names.contains(&"plate");
        let said = |start: &str| mesh.warnings.iter().any(|warning| warning.to_string().starts_with(start));
        assert_eq!(
            (said("points"), mesh.edges.len() > mesh.faces.len() * 3 / 2),
            (has_plate, has_plate),
            "{names:?}"
        );
    }
    let error = of(&["plate", "lid"]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "model.obj: has no object lid; its objects and groups are plate, lever arm, moving steel, moving, steel, pin"
    );
    assert!(matches!(&error.problem, Problem::NoSuchObject { name, .. } if name == "lid"));
    let options = Options { objects: vec!["lid".into()], ..Options::default() };
    let error = import(&plate, &options).unwrap_err();
    assert_eq!(error.to_string(), "model.obj: has no object lid, as none has a name");
    let error = import_bytes(vec![0; 84], "model.stl".as_ref(), &[], &options).unwrap_err();
    assert_eq!(error.to_string(), "model.stl: has no object lid, as none has a name");
}

/// The positions of vertices in units of 2^-48, exactly.
fn positions(mesh: &ImportedMesh) -> Vec<[i128; 3]> {
    let bits = |number: f64| {
        let scaled = number * 2f64.powi(48);
        assert_eq!(scaled.fract(), 0.0);
        scaled as i128
    };
    let at = |vertex: &[i16; 3]| {
        [0, 1, 2].map(|axis| (i128::from(vertex[axis]) << (mesh.exponent + 48)) + bits(mesh.offset[axis]))
    };
    mesh.vertices.iter().map(at).collect()
}

/// Of two boxes that share the corners of a side, these have equal positions, on each of many grids.
#[test]
fn parts_of_one_step_share_their_corners() {
    let mut random = Random(1);
    for case in 0..400 {
        let exponent = -(case % 26);
        let step = 2f64.powi(exponent);
        let mut steps = |most: f64| match case % 4 {
            0 => (random.unit() * most).floor(),
            _ => random.unit() * most,
        };
        // In some cases all corners lie half way between grid points.
        let low = [(); 3].map(|()| (steps(1e4) - 5e3 + 0.5) * step);
        let wide = (steps(5e3) + 1.0) * step;
        let shared = low[0] + wide;
        let high = [shared, low[1] + wide, low[2] + wide];
        let left = cuboid(low, high);
        let right = cuboid([shared, low[1], low[2]], [shared + 3.0 * wide, high[1], high[2]]);
        for centre in [Centre::Box, Centre::Origin] {
            let options = Options { step: Some(step), centre, ..Options::default() };
            let [left, right] = [&left, &right].map(|text| import(text, &options).unwrap());
            assert_eq!([left.exponent, right.exponent], [exponent as i8; 2]);
            let (left_positions, right_positions) = (positions(&left), positions(&right));
            let both = left_positions.iter().filter(|position| right_positions.contains(position)).count();
            assert_eq!(both, 4, "{options:?}: {left_positions:?} {right_positions:?}");
            assert!(left.report.error <= step / 2.0 && right.report.error <= step / 2.0);
        }
    }
}

#[test]
fn a_step_that_does_not_fit_names_one_that_does() {
    let text = cuboid([0.0; 3], [100.0, 1.0, 1.0]);
    let with = |step: f64| import(&text, &Options { step: Some(step), ..Options::default() });
    let error = with(2f64.powi(-12)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "model.obj: does not fit the grid: the finest step that it fits is 2^-9: use --step 2^-9"
    );
    assert_eq!(error.problem.remedies(), [Remedy::Step(-9)]);
    assert_eq!(with(2f64.powi(-9)).unwrap().exponent, -9);
    assert_eq!(with(0.25).unwrap().exponent, -2);
    for step in [0.3, 0.0, -0.5, f64::NAN, f64::INFINITY, 2f64.powi(16), 2f64.powi(-33)] {
        let error = with(step).unwrap_err();
        assert!(error.to_string().contains("the step is not a power of two from 2^-32 to 2^15"), "{error}");
    }
}
