//! The firmware of a choice: the files of a template in `boards`, changed to draw the page's picture.

use crate::choice::{Choice, Style};
use crate::display::Format;
use crate::lens::{direction, Lens};
use crate::texture::{TextureImage, UNIT};
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::pixelcolor::{BinaryColor, Rgb565, RgbColor};
use pinhole::{camera::Window, math::Sphere};
use pinhole_import::{Axis, Edges, ImportedMesh};

/// A template's file, given by its path in the folder that `boards/new` makes of it, changed for the firmware of a choice. `model` is the name of
/// the model's file, `sphere` the mesh's bounding sphere. Fails if no template draws such a picture, or the template lacks the text
/// to replace.
pub(crate) fn file(
    path: &str,
    text: &str,
    choice: &Choice,
    model: &str,
    sphere: &Sphere,
) -> Result<String, String> {
    match path {
        "src/picture.rs" => picture(text, choice, sphere).map(|text| with_rows(&text, choice)),
        "src/main.rs" => Ok(with_rows(text, choice)),
        // Only the board that takes any display has this file.
        "src/display.rs" => {
            let [usual, size] = [Choice::default().size, choice.size];
            let of = |size: Size| format!("SIZE: Size = Size::new({}, {})", size.width, size.height);
            replaced(text, &of(usual), &of(size))
        }
        "build.rs" => script(text, choice, model),
        "Cargo.toml" => manifest(text, choice),
        "README.md" => Ok(readme(text, choice)),
        _ => Ok(text.into()),
    }
    .map_err(|problem| format!("{path}: {problem}"))
}

/// The name of the model's file in the folder of the firmware.
pub(crate) fn model_file(name: &str) -> &'static str {
    match name.rsplit_once('.') {
        Some((_, extension)) if extension.eq_ignore_ascii_case("obj") => "model.obj",
        _ => "model.stl",
    }
}

/// Replaces a text that the template must contain exactly once.
fn replaced(text: &str, from: &str, to: &str) -> Result<String, String> {
    if text.matches(from).count() != 1 {
        return Err(format!("the template does not have `{from}` once"));
    }
    Ok(text.replace(from, to))
}

/// A file that may have the rows of a band, with those of the choice.
fn with_rows(text: &str, choice: &Choice) -> String {
    let rows = choice.rows();
    let template = text.split_once("const ROWS: u32 = ");
    let parts = template.and_then(|(before, after)| Some((before, after.split_once(';')?.1)));
    parts.map_or(text.into(), |(before, after)| format!("{before}const ROWS: u32 = {rows};{after}"))
}

/// Text of drawing code that draws hidden lines, and of drawing code that draws faces.
const HIDDEN_LINES: &str = "hidden_line(BinaryColor::On, ";
const FACES: &str = "color(face, level(face))";

/// The drawing code, changed to draw as the choice says.
fn picture(text: &str, choice: &Choice, sphere: &Sphere) -> Result<String, String> {
    let is_for_lines = text.contains(HIDDEN_LINES);
    let draws = match (choice.style, choice.format) {
        (Style::HiddenLine, Format::Mono) => is_for_lines,
        (Style::Flat | Style::Gouraud | Style::Textured, Format::Rgb565) => text.contains(FACES),
        _ => false,
    };
    match draws {
        true if is_for_lines => lines(text, choice, sphere),
        true => faces(text, choice, sphere),
        false => Err("this board draws something else: stm32-ssd1306 draws hidden lines in black and white, the others \
                      flat, Gouraud and textured faces in 16-bit colour"
            .into()),
    }
}

/// The drawing code with the camera of the choice.
fn with_camera(text: &str, choice: &Choice, sphere: &Sphere) -> Result<String, String> {
    let [yaw, pitch] = direction(choice).map(angle);
    let usual =
        "let (field_of_view, yaw, pitch) = (Angle::degrees(40), Angle::degrees(30), Angle::degrees(20));";
    match Lens::new(choice, sphere) {
        Lens::Framing { field_of_view, .. } => {
            let angles = format!("(Angle::degrees({field_of_view}), {yaw}, {pitch})");
            replaced(text, usual, &format!("let (field_of_view, yaw, pitch) = {angles};"))
        }
        lens => {
            let text = replaced(text, usual, &format!("let (yaw, pitch) = ({yaw}, {pitch});"))?;
            let framing = "Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch)";
            replaced(&text, framing, &camera(&lens))
        }
    }
}

/// The drawing code of hidden lines, with the colours and the camera of the choice. The text on top gets the colour of the lines.
fn lines(text: &str, choice: &Choice, sphere: &Sphere) -> Result<String, String> {
    let [color, background]: [BinaryColor; 2] = [choice.color.into(), choice.background.into()];
    let (before, after) = text
        .split_once("BinaryColor::Off")
        .filter(|(_, after)| !after.contains("BinaryColor::Off"))
        .ok_or("the template does not have `BinaryColor::Off` once")?;
    let lines = |text: &str| text.replace("BinaryColor::On", &format!("BinaryColor::{color:?}"));
    let text = format!("{}BinaryColor::{background:?}{}", lines(before), lines(after));
    with_camera(&text, choice, sphere)
}

/// The drawing code of faces, with the colours, the light, the camera and the shader of the choice.
fn faces(text: &str, choice: &Choice, sphere: &Sphere) -> Result<String, String> {
    let usual = Choice::default();
    let mut text = with_camera(text, choice, sphere)?;
    let mut replace = |from: &str, to: &str| replaced(&text, from, to).map(|new| text = new);
    if choice.background != usual.background {
        replace(
            "BACKGROUND: Rgb565 = Rgb565::BLACK",
            &format!("BACKGROUND: Rgb565 = {}", color(choice.background.into())),
        )?;
    }
    if choice.color != usual.color {
        replace(
            "COLOR: Rgb565 = Rgb565::CSS_GOLD",
            &format!("COLOR: Rgb565 = {}", color(choice.color.into())),
        )?;
    }
    replace("AMBIENT: u16 = 48", &format!("AMBIENT: u16 = {}", choice.ambient))?;
    let [x, y, z] = choice.light;
    replace("Vector3::from_ints(2, 3, 4)", &format!("Vector3::from_ints({x}, {y}, {z})"))?;

    if choice.style == Style::Textured {
        replace(FACES, "texture::at(mesh, face).lit([level(face); 3])")?;
        replace("color: impl Fn(usize, u16) -> Rgb565", "_: impl Fn(usize, u16) -> Rgb565")?;
        // With a path, because a host program that includes the file does so from another folder.
        replace("\nconst BACKGROUND", "\n#[path = \"texture.rs\"]\nmod texture;\n\nconst BACKGROUND")?;
        return Ok(without_unused(text));
    }
    let shader = match (choice.style, choice.dither) {
        (Style::Gouraud, dither) => {
            replace(
                "mesh.normals().get(face).map_or(256, |&normal| light.level(normal))",
                "mesh.corners_of(face, mesh.vertex_normals()).map(|normal| light.level(normal))",
            )?;
            Some(("Gouraud", dither))
        }
        (_, true) => Some(("Flat", true)),
        (_, false) => None,
    };
    if let Some((shader, dither)) = shader {
        let dithered = if dither { ".dithered()" } else { "" };
        let lit = format!("{shader}::lit(color(face, 256).into(), level(face)){dithered}");
        replace(FACES, &lit)?;
    }
    Ok(without_unused(text))
}

/// The texture and its coordinates as Rust, for a file beside the drawing code. `picture` is the template's drawing code.
pub(crate) fn texture(picture: &str, mesh: &mut ImportedMesh, image: &TextureImage) -> String {
    let library = if picture.contains("embedded_graphics_core::") {
        "embedded_graphics_core"
    } else {
        "embedded_graphics"
    };
    let picture = image.picture(format!("{library}::pixelcolor::Rgb565"));
    let bits = picture.bits();
    mesh.picture = Some(picture);
    let by_sides = BY_SIDES.split_once("use pinhole::Mesh;\n").map_or("", |(_, function)| function);
    let (unit, unused, corners, function) = match mesh.texture_faces.is_empty() {
        false => ("MODEL_TEXTURE.exponent()".into(), "_", "MODEL_TEXTURE.corners(face)", ""),
        true => (UNIT.to_string(), "", "corners(mesh, face)", by_sides),
    };
    let lists = mesh.to_rust_texture("MODEL");
    mesh.picture = None;
    format!(
        "//! What the faces of the model show, and where on it they lie. For another model, save the firmware again.

use {library}::pixelcolor::Rgb565;
use pinhole::texture::{{IndexedTexels, Texture, Textured}};
use pinhole::Mesh;

/// A face with the picture on it.
pub fn at({unused}mesh: &Mesh<'_>, face: usize) -> Textured<IndexedTexels<'static, Rgb565, {bits}>> {{
    let texture = Texture::new(MODEL_TEXELS).with_exponent({unit});
    texture.unwrap_or_else(|_| Texture::new(MODEL_TEXELS)).at({corners})
}}
{function}{lists}"
    )
}

/// The page's own function, which the firmware gets too.
const BY_SIDES: &str = include_str!("corners.rs");

/// Removes imports of colour traits that no constant needs.
fn without_unused(mut text: String) -> String {
    for (name, users) in [("WebColors", &["CSS_"][..]), ("RgbColor", &["::BLACK", "::WHITE"])] {
        if !users.iter().any(|user| text.contains(user)) {
            text = text.replace(&format!(", {name}"), "");
        }
    }
    text.replace("pixelcolor::{Rgb565};", "pixelcolor::Rgb565;")
}

fn color(color: Rgb565) -> String {
    format!("Rgb565::new({}, {}, {})", color.r(), color.g(), color.b())
}

/// An angle in hundredths of a degree, as Rust.
fn angle(hundredths: i32) -> String {
    match hundredths % 100 {
        0 => format!("Angle::degrees({})", hundredths / 100),
        _ => format!("Angle::turns({hundredths}, 36_000)"),
    }
}

/// The camera as Rust, an expression of type `Result`. Numbers are written as bits, so that they equal the page's exactly.
fn camera(lens: &Lens) -> String {
    let bits = |scalar: pinhole::Scalar| format!("pinhole::Scalar::from_bits({})", scalar.to_bits());
    let rectangle = |Window { left, right, bottom, top }: Window| {
        let [left, right, bottom, top] = [left, right, bottom, top].map(bits);
        format!("pinhole::camera::Window {{ left: {left}, right: {right}, bottom: {bottom}, top: {top} }}")
    };
    let mut target = String::from("centre.x(), centre.y(), centre.z()");
    let (distance, projection) = match *lens {
        Lens::Framing { .. } => return String::new(), // the template has it
        Lens::Frustum { aside, distance, window, near, far } => {
            if aside != [pinhole::Scalar::ZERO; 3] {
                let parts = ["x", "y", "z"].iter().zip(aside);
                let parts: Vec<_> = parts.map(|(axis, c)| format!("centre.{axis}() + {}", bits(c))).collect();
                target = parts.join(", ");
            }
            (bits(distance), format!("frustum({}, {}, {})", rectangle(window), bits(near), bits(far)))
        }
        Lens::Orthographic { window, depth } => (
            "pinhole::Scalar::ZERO".into(),
            format!("orthographic({}, {}, {})", rectangle(window), bits(-depth), bits(depth)),
        ),
        Lens::Oblique { window, depth, angle: slant, factor } => (
            "pinhole::Scalar::ZERO".into(),
            format!(
                "oblique({}, {}, {}, {}, {})",
                rectangle(window),
                bits(-depth),
                bits(depth),
                angle(slant),
                bits(factor)
            ),
        ),
        Lens::Matrix(matrix) => {
            let rows = matrix.map(|row| format!("[{}]", row.map(|c| format!("{c}f64")).join(", ")));
            ("pinhole::Scalar::ZERO".into(), format!("from_matrix(&[{}])", rows.join(", ")))
        }
    };
    format!(
        "pinhole::Projection::{projection}.map(|projection| {{
            let centre = mesh.bounding_sphere().centre;
            let centre = pinhole::Point3::new({target});
            let view = pinhole::ViewTransform::orbit(centre, {distance}, yaw, pitch);
            Camera::new(&view, &projection, &viewport)
        }})"
    )
}

/// The build script, with the options of the choice.
fn script(text: &str, choice: &Choice, model: &str) -> Result<String, String> {
    let options = choice.options();
    let mut fields = String::new();
    let axis = options.up.and_then(|up| Some((up, Axis::ALL.iter().find(|(_, axis)| *axis == up)?.0)));
    if let Some((up, _)) = axis {
        fields += &format!(", up: Some(pinhole_import::Axis::{up:?})");
    }
    if let Some(faces) = options.decimate {
        fields += &format!(", decimate: Some({faces})");
    }
    let switches = [
        (options.flip, "flip"),
        (options.fix_winding, "fix_winding"),
        (options.two_sided, "two_sided"),
        (options.vertex_normals, "vertex_normals"),
    ];
    for (_, name) in switches.iter().filter(|(is_on, _)| *is_on) {
        fields += &format!(", {name}: true");
    }
    let text = replaced(text, "FILE: &str = \"model.stl\"", &format!("FILE: &str = \"{model}\""))?;
    match options.edges {
        // The template of hidden lines has edge faces already.
        Edges::Feature { degrees } => {
            replaced(&text, "degrees: 30.0 }", &format!("degrees: {degrees:.1} }}{fields}"))
        }
        _ => replaced(&text, "edges: Edges::None, ..", &format!("edges: Edges::None{fields}, ..")),
    }
}

/// The manifest, with the importer's feature for decimation if it is used: it compiles C++.
fn manifest(text: &str, choice: &Choice) -> Result<String, String> {
    let plain = "pinhole-import = { version = \"0.1\", default-features = false }";
    match choice.decimate {
        0 => Ok(text.into()),
        _ => replaced(text, plain, &plain.replace(" }", ", features = [\"decimate\"] }")),
    }
}

/// The README for a folder that is complete, so it does not say how to make one from the template.
fn readme(text: &str, choice: &Choice) -> String {
    let text: String =
        text.split_inclusive('\n').filter(|line| !line.contains("pinhole/boards/new ")).collect();
    let (title, rest) = text.split_once('\n').unwrap_or((&text, ""));
    let rows = choice.rows();
    let decimated = match choice.decimate {
        0 => "",
        _ => " The build decimates the model by a library in C++: install g++ or clang first.",
    };
    format!(
        "{title}\n\nSaved by pinhole's planner, with bands of {rows} rows. The folder is complete: your model is in it, and what is said \
         below of making a copy and of putting your model into it is done.{decimated} The figures below are those of the template, which \
         shows a gear.\n{rest}"
    )
}

#[cfg(test)]
mod tests {
    use super::{picture, script, texture};
    use crate::choice::Choice;
    use crate::texture::TextureImage;
    use pinhole::{math::Sphere, Point3, Scalar};
    use pinhole_import::{import_bytes, ImportedMesh, Options};

    const PICTURE: &str = include_str!("../../../boards/common/embassy/src/picture.rs");
    const CORE_PICTURE: &str = include_str!("../../../boards/common/two-strips/src/picture.rs");
    const LINE_PICTURE: &str = include_str!("../../../boards/stm32-ssd1306/src/picture.rs");
    const SCRIPT: &str = include_str!("../../../boards/common/all/build.rs");

    fn choice(text: &str) -> Choice {
        Choice::parse(text).expect("a choice")
    }

    fn sphere() -> Sphere {
        Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_int(1) }
    }

    /// A shared file as `boards/new` writes it.
    fn in_copy(text: &str) -> String {
        text.replace("../common/all/", "")
    }

    #[test]
    fn the_default_is_the_template() {
        assert_eq!(picture(PICTURE, &Choice::default(), &sphere()).as_deref(), Ok(PICTURE));
        let in_copy = in_copy(SCRIPT);
        assert_eq!(script(&in_copy, &Choice::default(), "model.stl").as_deref(), Ok(&in_copy[..]));
        let lines = choice("mesh=cube&format=mono&style=hidden-line&color=ffffff");
        assert_eq!(picture(LINE_PICTURE, &lines, &sphere()).as_deref(), Ok(LINE_PICTURE));
    }

    /// The cases of `firmware.txt`.
    #[test]
    fn files_are_changed_as_the_choice_says() {
        for block in include_str!("firmware.txt").split("\n\n").skip(1) {
            let mut lines = block.lines().skip_while(|line| line.starts_with("//"));
            let (file, text) =
                lines.next().and_then(|line| line.split_once(' ')).expect("a file and a choice");
            let (_, path) = file.trim_start_matches("common/").split_once('/').expect("a folder and a path");
            let template = format!("{}/../../boards/{file}", env!("CARGO_MANIFEST_DIR"));
            let template = in_copy(&std::fs::read_to_string(template).expect(file));
            let made = super::file(path, &template, &choice(text), "model.obj", &sphere()).expect(block);
            check_paths(&template, &made);
            for line in lines.map(|line| line.replace("\\n", "\n")) {
                let is_right = match line.strip_prefix("! ") {
                    Some(unwanted) => !made.contains(unwanted),
                    None => made.contains(&line) && !template.contains(&line),
                };
                assert!(is_right, "{block}: {line}\n{made}");
            }
        }
    }

    /// Paths that compile, as they stand in files.
    macro_rules! paths {
        ($($path:path),* $(,)?) => {
            const PATHS: &[&str] = &[$(stringify!($path)),*];
            $(const _: () = { #[allow(unused_imports)] use $path as _; };)*
        };
    }

    paths! {
        pinhole::Mesh, pinhole::Point3, pinhole::Projection, pinhole::Scalar, pinhole::ViewTransform, pinhole::camera::Window,
        pinhole::mesh::TextureCoords, pinhole::texture::IndexedTexels, pinhole::prelude::Flat, pinhole::prelude::Gouraud,
    }

    /// What the page writes into a file of a template names what there is.
    fn check_paths(template: &str, made: &str) {
        for line in
            made.lines().filter(|line| !template.contains(line.trim()) && !line.trim().starts_with("use "))
        {
            for (at, _) in line.match_indices("pinhole::") {
                let known = |path: &&&str| line.get(at..).is_some_and(|rest| rest.starts_with(**path));
                assert!(PATHS.iter().find(known).is_some(), "a path that is not known to compile: {line}");
            }
            for name in ["Flat::", "Gouraud::"] {
                assert!(!line.contains(name) || template.contains("prelude::*"), "{line}");
            }
        }
    }

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

    fn mesh(obj: String) -> ImportedMesh {
        let options = Options { two_sided: true, ..Options::default() };
        import_bytes(obj.into_bytes(), "part.obj".as_ref(), &[], &options).expect("a mesh")
    }

    /// A picture of two colours on the page has one bit per texel in the firmware.
    #[test]
    fn a_texture_is_a_file_of_its_own() {
        let image = TextureImage::ready(&choice("style=textured&texture=grid")).expect("a ready pattern");
        for (template, library) in [(PICTURE, "embedded_graphics"), (CORE_PICTURE, "embedded_graphics_core")]
        {
            let mut plain = mesh(format!("{TRIANGLE}f 1 2 3\n"));
            let before = plain.clone();
            let made = texture(template, &mut plain, &image);
            assert!(plain == before, "the mesh has become another one");
            for wanted in [
                format!("use {library}::pixelcolor::Rgb565;"),
                format!("MODEL_TEXELS: pinhole::texture::IndexedTexels<'static, {library}::pixelcolor::Rgb565, 1>"),
                "with_exponent(-14)".into(),
                ".at(corners(mesh, face))".into(),
                "fn corners(mesh: &Mesh<'_>, face: usize)".into(),
            ] {
                assert!(made.contains(&wanted), "{wanted}\n{made}");
            }
            let mut mapped = mesh(format!("{TRIANGLE}vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"));
            let made = texture(template, &mut mapped, &image);
            let corners = ".at(MODEL_TEXTURE.corners(face))";
            assert!(made.contains(corners) && !made.contains("fn corners"), "{made}");
            assert!(made.contains("MODEL_TEXTURE: pinhole::mesh::TextureCoords<'static>"), "{made}");
        }
    }

    #[test]
    fn a_template_of_other_pictures_is_refused() {
        for text in ["style=hidden-line&format=mono", "style=wireframe", "format=mono", "format=gray4"] {
            let problem = picture(PICTURE, &choice(text), &sphere()).expect_err(text);
            assert!(problem.starts_with("this board draws something else"), "{problem}");
        }
    }

    #[test]
    fn bands_have_the_rows_of_the_choice() {
        let main = include_str!("../../../boards/rp2040-st7789/src/main.rs");
        for (path, template, usual, rows) in
            [("src/main.rs", main, 8, 12), ("src/picture.rs", PICTURE, 32, 40)]
        {
            let made = super::file(path, template, &choice(&format!("rows={rows}")), "model.stl", &sphere());
            let expected =
                template.replace(&format!("ROWS: u32 = {usual};"), &format!("ROWS: u32 = {rows};"));
            assert_ne!(expected, template);
            assert_eq!(made.as_deref(), Ok(&expected[..]));
        }
    }
}
