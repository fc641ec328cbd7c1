//! The scenes of `scenes.json`: a row is a scene and what its outputs are.
//!
//! A row's scene is its base with the fields of `scene` in place of the base's, drawn with `options`; or it is a whole command line,
//! `line`. Every other field but `about` is an expectation: see [`Row::holds`].

use crate::harness::{changed, numbers, used, Drawn, Folder};
use crate::sprites;
use pinhole_apps_support::bodies::{cuboid, obj};
use serde_json::{json, Map, Value};
use std::collections::BTreeSet;
use support::oracle::picture::Scene;

const TEAPOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/teapot.obj");

struct Table {
    to: Folder,
    data: Value,
}

#[derive(Clone, Copy)]
struct Row<'t> {
    table: &'t Table,
    fields: &'t Map<String, Value>,
}

#[test]
fn scenes_are_drawn_as_their_rows_say() {
    let data = include_str!("scenes.json").replace("$TEAPOT", TEAPOT);
    let table = Table { to: Folder::new("scenes"), data: serde_json::from_str(&data).unwrap() };
    let Table { to, data } = &table;
    std::fs::create_dir(to.0.join("below")).unwrap();
    for (name, text) in data["files"].as_object().unwrap() {
        to.write(name, text.as_str().unwrap());
    }
    to.write("cube.obj", obj(&cuboid([1.0; 3])));
    to.png("texture.png", [16, 8], texture);
    to.png("picture.png", sprites::SIZE, sprites::texel);
    to.png("keyed.png", sprites::SIZE, sprites::keyed);
    let mut rows = 0;
    for (group, list) in data["groups"].as_object().unwrap() {
        for fields in list.as_array().unwrap() {
            println!("{group}\n{fields}");
            Row { table: &table, fields: fields.as_object().unwrap() }.check();
            rows += 1;
        }
    }
    assert!(rows > 130, "{rows}");
}

/// The texture of scenes that show a file's.
fn texture(column: u32, row: u32) -> [u8; 4] {
    [column as u8 * 16, row as u8 * 32, 99, 255]
}

impl Row<'_> {
    fn text(&self, field: &str) -> &str {
        self.fields.get(field).and_then(Value::as_str).unwrap_or_default()
    }

    fn base(&self) -> &Value {
        &self.table.data["bases"][self.text("base")]
    }

    fn scene(&self) -> Value {
        changed(self.base()["scene"].clone(), self.fields.get("scene").unwrap_or(&Value::Null))
    }

    /// The outputs of the scene, with further options.
    fn draw(&self, more: &str) -> Drawn {
        if let Some(line) = self.fields.get("line").and_then(Value::as_str) {
            let (file, options) = line.split_once(' ').unwrap_or((line, ""));
            return self.table.to.draw_file(file, options, false);
        }
        let (own, base) = (self.text("options"), self.base()["options"].as_str().unwrap());
        // A mode replaces the base's.
        let base = if own.contains("--mode") { base.replace("--mode flat", "") } else { base.into() };
        self.table.to.draw(&self.scene(), &format!("{base} {own} {more}"))
    }

    fn check(&self) {
        if let Some(each) = self.fields.get("each").and_then(Value::as_array) {
            return each.iter().for_each(|more| assert!(self.is_same(more.as_str().unwrap()), "{more}"));
        }
        let drawn = self.draw("");
        for (name, wanted) in self.fields {
            assert!(self.holds(&drawn, name, wanted), "{name}: {drawn:?}");
        }
    }

    /// Whether the picture, or the ids where rounding may change a pixel or two, is that of the scene `same`.
    fn is_same(&self, more: &str) -> bool {
        let fields = self.fields["same"].as_object().unwrap();
        let [ours, theirs] = [self, &Row { fields, ..*self }].map(|row| row.draw(more));
        let differ = ours.ids.iter().zip(&theirs.ids).filter(|(a, b)| a != b).count() as u64;
        match self.fields.get("but").and_then(Value::as_u64) {
            Some(allowed) => differ <= allowed && ours.ids.iter().any(|id| *id >= 0),
            None => differ == 0 && ours.picture == theirs.picture,
        }
    }

    /// Whether an expectation holds.
    fn holds(&self, drawn: &Drawn, name: &str, wanted: &Value) -> bool {
        let within = self.fields.get("within").and_then(Value::as_f64).unwrap_or(0.0);
        let near = |color: &[u8; 3], wanted: [f64; 3]| {
            color.iter().zip(wanted).all(|(is, wanted)| (f64::from(*is) - wanted).abs() <= within)
        };
        let id = |id: &i32| u32::try_from(*id).map_or('.', |id| char::from_digit(id, 10).unwrap_or('?'));
        let place = |index: usize| [index % drawn.width, index / drawn.width];
        let (Drawn { ids, depth, texels, picture, .. }, scene) = (drawn, used(&drawn.used));
        let list = || wanted.as_array().unwrap().iter();
        let entries = || wanted.as_object().unwrap().iter();
        match name {
            "about" | "base" | "scene" | "options" | "line" | "within" | "but" => true,
            "same" => self.is_same(""),
            // Rows of the indices of triangles.
            "ids" => ids.iter().map(id).eq(list().flat_map(|row| row.as_str().unwrap().chars())),
            // The depth of each triangle, to a step.
            "depths" => ids.iter().zip(depth).all(|(of, depth)| {
                wanted[id(of).to_string()]
                    .as_u64()
                    .is_some_and(|wanted| wanted.abs_diff((*depth).into()) <= 1)
            }),
            // The colour of all pixels, or two by turns.
            "all" => picture.iter().enumerate().all(|(index, color)| {
                let [x, y] = place(index);
                near(color, numbers(&wanted[(x + y) % list().len()]))
            }),
            // The colours of pixels by column and row.
            "pixels" => entries().all(|(at, wanted)| {
                let [x, y] = numbers(&serde_json::from_str(&format!("[{at}]")).unwrap()).map(|c| c as usize);
                near(&picture[y * drawn.width + x], numbers(wanted))
            }),
            // How many colours there are, at least and at most.
            "colors" => is_between(picture.iter().collect::<BTreeSet<_>>().len(), wanted),
            // How many pixels show a triangle or have a colour, at least and at most.
            "counts" => entries().all(|(what, wanted)| {
                let of_ids = ids.iter().filter(|of| *what == id(of).to_string()).count();
                let of_colors = picture.iter().filter(|color| *what == format!("{color:?}")).count();
                is_between(of_ids + of_colors, wanted)
            }),
            // The texel of each pixel, by the columns and rows of the picture; 0 where no triangle is.
            "texels" => (0..ids.len()).all(|index| {
                let [x, y] = place(index);
                let [column, row] = [&wanted["columns"][x], &wanted["rows"][y]].map(|v| v.as_u64().unwrap());
                u64::from(texels[index]) == if ids[index] < 0 { 0 } else { (1 << 15) + 16 * row + column }
            }),
            // Texels of the file, at this level of light.
            "shows" => texels.iter().zip(picture).all(|(&texel, color)| {
                let [red, green, blue, _] = texture(u32::from(texel) % 16, u32::from(texel) / 16 % 8);
                near(color, [red, green, blue].map(|c| f64::from(c) * wanted.as_f64().unwrap() / 256.0))
            }),
            // Fields of the scene as it was used; null is one that it has not.
            "used" => entries().all(|(field, value)| drawn.used[field] == *value),
            // Points of the world, and where they are seen: from -1 to 1, x and y, or also z/w.
            "projects" => list().all(|pair| {
                let [x, y, z, w] = scene.clip(numbers(&pair[0]));
                let wanted = pair[1].as_array().unwrap().iter().filter_map(Value::as_f64);
                w > 0.0 && [x, y, z].iter().zip(wanted).all(|(is, wanted)| (is / w - wanted).abs() < 1e-6)
            }),
            // All vertices are between near and far, which their depths use well.
            "deep" => {
                let depths: Vec<_> =
                    scene.vertices.iter().map(|v| scene.clip(*v)).map(|p| p[2] / p[3]).collect();
                let [least, most] = ends(&depths);
                least > -1.0 && most < 1.0 && most - least > 1.0
            }
            // Where a cube's axes point, and how long they are, from every corner; the cube is in the middle of 92 of 100 columns
            // or rows.
            "axes" => {
                let known: Vec<usize> = (0..3).filter(|axis| !wanted[*axis].is_null()).collect();
                let is_good = |corner: &[f64; 3]| {
                    let ours: Vec<_> = known.iter().map(|&axis| way(&scene, *corner, axis)).collect();
                    let theirs: Vec<_> = known.iter().map(|&axis| numbers(&wanted[axis])).collect();
                    let is_near = |[a, b]: [[f64; 2]; 2]| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-5);
                    scaled(ours).into_iter().zip(scaled(theirs)).all(|(a, b)| is_near([a, b]))
                };
                let [[left, right], [bottom, top]] =
                    [0, 1].map(|i| ends(&corners().map(|corner| screen(&scene, corner)[i])));
                let is_framed =
                    [left + right, bottom + top, right.max(top) - 0.92].iter().all(|c| c.abs() < 0.01);
                is_framed && corners().iter().all(is_good)
            }
            // Whether the cube's upright edges are not upright in the picture.
            "leans" => corners().map(|at| way(&scene, at, 1)).iter().any(|[x, y]| x.abs() > 0.05 * y.abs()),
            // The sides of the cube that are seen.
            "sides" => {
                let sides: BTreeSet<_> =
                    ids.iter().filter(|id| **id >= 0).map(|id| i64::from(id / 2)).collect();
                sides.into_iter().eq(list().filter_map(Value::as_i64))
            }
            // Sprites are drawn over the scene without them, as they are defined.
            "sprites" => {
                let (scene, law) = (self.scene(), self.text("options"));
                let without = changed(scene.clone(), &json!({"sprites": null}));
                let fields = json!({"base": self.text("base"), "scene": without, "options": law});
                let base = Row { fields: fields.as_object().unwrap(), ..*self }.draw("");
                sprites::over(&base, &scene, law, &self.table.data["discs"]) == *picture
                    && *picture != base.picture
            }
            "said" => drawn.said.contains(wanted.as_str().unwrap()),
            _ => panic!("no such expectation"),
        }
    }
}

fn is_between(count: usize, ends: &Value) -> bool {
    let [least, most] = numbers(ends);
    (least..=most).contains(&(count as f64))
}

/// The least and the largest of numbers, or 0.
fn ends(of: &[f64]) -> [f64; 2] {
    [f64::min, f64::max].map(|f| of.iter().copied().fold(0.0, f))
}

/// Vectors of which the longest has the length 1.
fn scaled(vectors: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let longest = vectors.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    vectors.into_iter().map(|v| v.map(|c| c / longest)).collect()
}

/// The corners of the cube.
fn corners() -> [[f64; 3]; 8] {
    core::array::from_fn(|i| [0, 1, 2].map(|axis| f64::from(i as u32 >> axis & 1)))
}

/// Where a point is seen: from -1 to 1.
fn screen(scene: &Scene, at: [f64; 3]) -> [f64; 2] {
    let [x, y, _, w] = scene.clip(at);
    [x / w, y / w]
}

/// The edge of the cube along an axis, in the picture, that has this corner.
fn way(scene: &Scene, mut corner: [f64; 3], axis: usize) -> [f64; 2] {
    let [low, high] = [0.0, 1.0].map(|end| {
        corner[axis] = end;
        screen(scene, corner)
    });
    [high[0] - low[0], high[1] - low[1]]
}
