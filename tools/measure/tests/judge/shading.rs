//! Colours of scenes: light, emission, translucency, fog and smooth lines, against mixes computed here.

use crate::harness::{changed, mix, scene, with, Folder};
use serde_json::{json, Value};

const SKY: [u8; 3] = [0, 0, 255];
const FLAT: [&str; 4] = ["--mode", "flat", "--background", "#0000ff"];

/// The picture of a scene that fills it with two squares, one behind the other.
fn squares(to: &Folder, changes: Value, options: &[&str]) -> Vec<[u8; 3]> {
    let square = |z: f64| [[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]];
    let (near, far) = ([200, 100, 0], [40, 80, 120]);
    let vertices = [square(0.5), square(0.0)].concat();
    let scene = json!({
        "vertices": vertices,
        // The near one comes first, so that blending must sort.
        "triangles": [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
        "colors": [near, near, far, far], "width": 16, "height": 8
    });
    to.draw(&changed(with(scene), changes), &[&FLAT, options].concat()).picture
}

#[test]
fn lights_are_those_of_the_scene() {
    let to = Folder::new("lights");
    let lit = |lights: &Value| -> [u8; 3] {
        let scene = json!({"lights": lights, "colors": [[200, 100, 50], [200, 100, 50]]});
        to.draw(&with(scene), &FLAT).picture[5 * 8 + 1]
    };
    let usual = lit(&Value::Null);
    assert_eq!(lit(&json!(["key", "fill", "ambient"])), usual);
    let [key, fill, ambient] = ["key", "fill", "ambient"].map(|name| u32::from(lit(&json!([name]))[0]));
    assert!((key + fill + ambient).abs_diff(usual[0].into()) <= 2 && key > fill && fill > 0 && ambient > 0);
    // The faces look along z. Levels by Lambert's law, within one of 256.
    let near = |color: [u8; 3], level: f64| {
        let full = [200.0, 100.0, 50.0].into_iter().zip(color);
        full.into_iter().all(|(full, is)| (f64::from(is) - full * level / 256.0).abs() <= 1.3)
    };
    for (lights, level) in [
        (json!([]), 0.0),
        (json!([{"ambient": 128}]), 128.0),
        (json!([{"towards": [0, 0, 1], "level": 256}]), 256.0),
        (json!([{"towards": [0, 3, 3], "level": 256}]), 256.0 * 0.5f64.sqrt()),
        (json!([{"towards": [0, 0, -1], "level": 256}]), 0.0),
        (json!([{"towards": [0, 0, 2], "level": 100}, {"ambient": 28}]), 128.0),
        (json!([{"towards": [0, 0, 1], "from": "camera", "level": 64}, {"ambient": 256}]), 256.0),
    ] {
        let color = lit(&lights);
        assert!(near(color, level), "{lights}: {color:?}");
    }
    // A lamp of the camera moves with it, a lamp of the world does not: seen from the side, (1, 0, 0) is right of the camera.
    for (from, level) in [("world", 256.0), ("camera", 256.0 * 0.6)] {
        let turned = json!({"lights": [{"towards": [0, 0, 1], "from": from, "level": 256}],
            "colors": [[200, 100, 50], [200, 100, 50]],
            "view": [[0.6, 0, -0.8, 0], [0, 1, 0, 0], [0.8, 0, 0.6, 0], [0, 0, 0, 1]],
            "projection": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -0.2, 0], [0, 0, 0, 1]]});
        let picture = to.draw(&with(turned), &FLAT).picture;
        assert!(near(picture.into_iter().find(|color| color[0] > 0).unwrap(), level), "{from}");
    }
}

#[test]
fn faces_may_emit_light() {
    let to = Folder::new("emission");
    // Two triangles beside each other, of one colour.
    let scene = with(json!({
        "vertices": [[-1, -1, 0], [0, -1, 0], [0, 1, 0], [0, -1, 0], [1, -1, 0], [1, 1, 0]],
        "colors": [[200, 100, 40], [200, 100, 40]], "width": 16, "height": 8
    }));
    let emission = [0, 90, 251];
    let lamp = changed(scene.clone(), json!({"emission": [[0, 0, 0], emission]}));
    for mode in ["flat", "solid"] {
        let drawn = |scene: &Value, options: &[&str]| {
            let pixels = to.draw(scene, &[&["--mode", mode], options].concat()).picture;
            [pixels[5 * 16 + 6], pixels[5 * 16 + 14]]
        };
        let [dark, _] = drawn(&scene, &[]);
        assert!(dark[0] > 20 && dark[0] < 200, "{dark:?}");
        // Light is added whole after the other is rounded: levels of eight bits.
        let wanted = [0, 1, 2].map(|i| (u16::from(dark[i]) + emission[i]).min(255) as u8);
        assert_eq!(drawn(&lamp, &[]), [dark, wanted], "{mode}");
        // A colour that is asked for replaces both.
        assert_eq!(drawn(&lamp, &["--colour", "#c86428"]), [dark; 2], "{mode}");
    }
}

#[test]
fn faces_may_be_translucent() {
    let to = Folder::new("translucent");
    let draw = |options: &[&str]| squares(&to, json!({}), options);
    let opaque = draw(&[]);
    let near = opaque[0];
    assert!(opaque.iter().all(|&pixel| pixel == near));
    // A door of nothing, of everything, and of half of the pixels, in a chequered pattern.
    assert!(draw(&["--door", "0"]).iter().all(|&pixel| pixel == SKY));
    assert_eq!(draw(&["--door", "64"]), opaque);
    for (at, pixel) in draw(&["--door", "32"]).into_iter().enumerate() {
        assert_eq!(pixel, if (at % 16 + at / 16) % 2 == 0 { near } else { SKY }, "{at}");
    }
    // The far one over the sky, and the near one over both. Both have the light of the near one: its ratio is that of their colours.
    let far = [near[0] / 5; 3];
    for (options, alpha) in [
        (&["--alpha", "0"][..], 0),
        (&["--alpha", "8"], 8),
        (&["--alpha", "20"], 20),
        (&["--alpha", "32"], 32),
        (&["--half"], 16),
    ] {
        let [red, _, _] = mix(near, mix(far, SKY, alpha), alpha);
        assert!(draw(options).iter().all(|pixel| pixel[0].abs_diff(red) <= 1), "{options:?}");
    }
    // In every pixel format.
    for format in ["rgb565", "rgb666", "gray8", "gray4", "gray2", "mono"] {
        let plain = ["--format", format, "--no-dither"];
        assert_eq!(draw(&[&plain[..], &["--alpha", "32"]].concat()), draw(&plain), "{format}");
    }
}

/// Fog of the background's colour, by definition: the near square is a quarter of the way from −1 to 1 before the camera.
#[test]
fn faces_may_be_in_fog() {
    let to = Folder::new("fog");
    let near = squares(&to, json!({}), &[])[0];
    // 32·64^(−1/4) is 11.3, 32·64^(−1/16) is 24.7.
    for (fog, factor) in [
        ("-1,1", 24),
        ("-1,1,linear", 24),
        ("-1,1,exponential", 11),
        ("-1,1,squared", 25),
        ("0,1", 32),
        ("auto", 32),
        ("auto,squared", 32),
    ] {
        let drawn = squares(&to, json!({}), &["--fog", fog]);
        assert!(drawn.iter().all(|&pixel| pixel == mix(near, SKY, factor)), "{fog}: {:?}", drawn[0]);
    }
    // A scene's own fog, which --fog replaces.
    let own = json!({"fog": [-1, 1]});
    assert_eq!(squares(&to, own.clone(), &[])[0], mix(near, SKY, 24));
    assert_eq!(squares(&to, own, &["--fog", "0,1"])[0], near);
}

#[test]
fn lines_may_be_smooth() {
    let to = Folder::new("smooth");
    for mode in ["wireframe", "hidden-line"] {
        let fixed = ["--colour", "black", "--background", "white", "--mode", mode];
        let draw = |options: &[&str]| to.draw(&scene(), &[&fixed, options].concat()).picture;
        let (plain, smooth) = (draw(&[]), draw(&["--smooth-lines"]));
        let grey = |pixels: &[[u8; 3]]| pixels.iter().filter(|pixel| ![0, 255].contains(&pixel[0])).count();
        assert!(grey(&plain) == 0 && grey(&smooth) > 5, "{mode}");
        // As much ink, but for diagonals, which are √2 as long as they have pixels.
        let ink = |pixels: &[[u8; 3]]| pixels.iter().map(|pixel| 255 - u32::from(pixel[0])).sum::<u32>();
        assert!(2 * ink(&smooth) > ink(&plain) && ink(&smooth) < 2 * ink(&plain), "{mode}");
    }
}
