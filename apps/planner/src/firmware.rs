//! The firmware of a choice: the files of a template in `boards`, changed to draw the page's picture.

use crate::choice::{Choice, Style};
use crate::display::Format;
use crate::lens::{direction, Lens};
use crate::texture::{TextureImage, UNIT};
use crate::tricolor::Tricolor;
use embedded_graphics_core::pixelcolor::{BinaryColor, Gray2, Gray4, GrayColor, Rgb565, Rgb888, RgbColor};
use pinhole::{camera::Window, math::Sphere};
use pinhole_import::{Axis, Edges, ImportedMesh};

/// A file of a template, given by its path in the folder that `boards/new` makes of it, changed for the firmware of a choice: the drawing code or
/// the build script. Other files stay as they are. `model` is the name of the model's file, `sphere` the mesh's bounding sphere. Fails if the
/// template lacks the text to replace.
pub(crate) fn file(
    path: &str,
    text: &str,
    choice: &Choice,
    model: &str,
    sphere: &Sphere,
) -> Result<String, String> {
    match path {
        "src/picture.rs" => picture(text, choice, sphere),
        "build.rs" => script(text, choice, model),
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

/// Text of drawing code that draws faces.
const FACES: &str = "color(face, level(face))";

/// The drawing code of the way to draw, changed to draw as the choice says.
fn picture(text: &str, choice: &Choice, sphere: &Sphere) -> Result<String, String> {
    match text.contains("BinaryColor::Off") {
        true => lines(text, choice, sphere),
        false => scene(text, choice, sphere),
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

/// The drawing code of boards in 16-bit colour and for any display, with the colours, the light, the camera and the shader of the choice.
fn scene(text: &str, choice: &Choice, sphere: &Sphere) -> Result<String, String> {
    let usual = Choice::default();
    let mut text = with_camera(text, choice, sphere)?;
    let mut replace = |from: &str, to: &str| replaced(&text, from, to).map(|new| text = new);
    let is_in_few_bits = choice.format != Format::Rgb565;
    if is_in_few_bits || choice.background != usual.background {
        replace(
            "BACKGROUND: Rgb565 = Rgb565::BLACK",
            &format!("BACKGROUND: {}", constant(choice.format, choice.background)),
        )?;
    }
    // Faces are shaded from colours of 16 bits, in which a model has its own.
    let format = if choice.style.is_of_lines() { choice.format } else { Format::Rgb565 };
    if format != Format::Rgb565 || choice.color != usual.color {
        replace("COLOR: Rgb565 = Rgb565::CSS_GOLD", &format!("COLOR: {}", constant(format, choice.color)))?;
    }
    if !choice.style.is_of_lines() {
        replace("AMBIENT: u16 = 48", &format!("AMBIENT: u16 = {}", choice.ambient))?;
        let [x, y, z] = choice.light;
        replace("Vector3::from_ints(2, 3, 4)", &format!("Vector3::from_ints({x}, {y}, {z})"))?;
    }
    let dithered =
        |shader: &str| if choice.dithers() { format!("Dithered({shader})") } else { shader.into() };
    match choice.style {
        Style::Textured => {
            replace(FACES, "texture::at(mesh, face).lit([level(face); 3])")?;
            replace("color: impl Fn(usize, u16) -> Rgb565", "_: impl Fn(usize, u16) -> Rgb565")?;
            // With a path, because a host program that includes the file does so from another folder.
            replace("\n/// Of a", "\n\n#[path = \"texture.rs\"]\nmod texture;\n\n/// Of a")?;
        }
        Style::Gouraud => {
            replace(
                "mesh.normals().get(face).map_or(256, |&normal| light.level(normal))",
                "mesh.corners_of(face, mesh.vertex_normals()).map(|normal| light.level(normal))",
            )?;
            replace(FACES, &dithered("Gouraud::lit(color(face, 256).into(), level(face))"))?;
        }
        Style::Flat if choice.dithers() => {
            replace(FACES, &dithered("Flat::lit(color(face, 256).into(), level(face))"))?;
        }
        _ => {}
    }
    Ok(text)
}

/// The name of a format's colour type.
fn name(format: Format) -> &'static str {
    match format {
        Format::Rgb565 => "Rgb565",
        Format::Mono => "BinaryColor",
        Format::Gray2 => "Gray2",
        Format::Gray4 => "Gray4",
        Format::Tricolor => "Tricolor",
    }
}

/// The type and the value of a constant.
fn constant(format: Format, color: Rgb888) -> String {
    let name = name(format);
    let value = match format {
        Format::Rgb565 => {
            let color = Rgb565::from(color);
            format!("new({}, {}, {})", color.r(), color.g(), color.b())
        }
        Format::Gray2 => format!("new({})", Gray2::from(color).luma()),
        Format::Gray4 => format!("new({})", Gray4::from(color).luma()),
        Format::Mono => format!("{:?}", BinaryColor::from(color)),
        Format::Tricolor => format!("{:?}", Tricolor::from(color)),
    };
    format!("{name} = {name}::{value}")
}

/// The texture and its coordinates as Rust, for a file beside the drawing code. `picture` is the template's drawing code.
pub(crate) fn texture(
    picture: &str,
    mesh: &mut ImportedMesh,
    image: &TextureImage,
    format: Format,
) -> String {
    let library = if picture.contains("embedded_graphics_core::") {
        "embedded_graphics_core"
    } else {
        "embedded_graphics"
    };
    let name = name(format);
    // Colours without numbers get their names afterwards.
    let numbers = if matches!(format, Format::Mono | Format::Tricolor) { "Rgb888" } else { name };
    let picture = image.picture(format!("{library}::pixelcolor::{numbers}"));
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
        "//! What the faces of the model show, and where. For another model, save the firmware again.

use {library}::pixelcolor::{name};
use pinhole::texture::{{IndexedTexels, Texture, Textured}};
use pinhole::Mesh;

/// A face with the picture on it.
pub fn at({unused}mesh: &Mesh<'_>, face: usize) -> Textured<IndexedTexels<'static, {name}, {bits}>> {{
    let texture = Texture::new(MODEL_TEXELS).with_exponent({unit});
    texture.unwrap_or_else(|_| Texture::new(MODEL_TEXELS)).at({corners})
}}
{function}{lists}"
    )
}

/// The page's own function, which the firmware gets too.
const BY_SIDES: &str = include_str!("corners.rs");

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
        (choice.style == Style::HiddenLine, "edge_faces"),
    ];
    for (_, name) in switches.iter().filter(|(is_on, _)| *is_on) {
        fields += &format!(", {name}: true");
    }
    let text = replaced(text, "FILE: &str = \"model.stl\"", &format!("FILE: &str = \"{model}\""))?;
    let edges = match options.edges {
        Edges::All => "All".into(),
        Edges::Feature { degrees } => format!("Feature {{ degrees: {degrees:.1} }}"),
        _ => String::from("None"),
    };
    replaced(&text, "Edges::None", &format!("Edges::{edges}{fields}"))
}

#[cfg(test)]
mod tests {
    use super::{picture, script, texture};
    use crate::choice::Choice;
    use crate::display::Format;
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
            let made = texture(template, &mut plain, &image, Format::Rgb565);
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
            let made = texture(template, &mut mapped, &image, Format::Rgb565);
            let corners = ".at(MODEL_TEXTURE.corners(face))";
            assert!(made.contains(corners) && !made.contains("fn corners"), "{made}");
            assert!(made.contains("MODEL_TEXTURE: pinhole::mesh::TextureCoords<'static>"), "{made}");
        }
    }
}
