//! Draws a scene for people: lit, in any pixel format of a display, and in bands as firmware draws.

use crate::bands::{around, in_memory, Colour, Out, Plan, Report, Send};
use crate::light;
use crate::parts::{parts, Part};
use crate::picture::{by_format, Format};
use crate::quantised::Quantised;
use crate::scene::Scene;
use crate::shades::Shades;
use crate::sprite_paint::Sprites;
use crate::style::{Mode, Style, Translucency};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::{draw_target::DrawTarget, geometry::Size};
use pinhole::{
    color::{Alpha, Half},
    draw::{BinnedEdges, ShaderFor, TransformedMesh},
    prelude::*,
    shading::{AntiAliased, SpanShader, Translucent},
};
use std::convert::Infallible;

/// Data of a mesh that do not depend on the camera.
pub struct Subject {
    pub parts: Vec<Part>,
    /// Normals at the corners of the triangles.
    normals: Vec<[[i16; 3]; 3]>,
}

impl Subject {
    /// The data that a style needs, with the edges that are usual in its mode.
    pub fn new(scene: &Scene, style: &Style) -> Self {
        Self::with_edges(scene, style, style.mode.least_turn())
    }

    /// As [`Subject::new`], in modes of lines with the edges at which the surface turns by more than some degrees, or ends, or with all.
    pub fn with_edges(scene: &Scene, style: &Style, degrees: Option<f64>) -> Self {
        let mut parts = parts(&scene.vertices, &scene.triangles);
        let (mut normals, crease) = (Vec::new(), style.mode.crease());
        let find = |part: &mut Part, degrees| part.find_edges(&scene.vertices, degrees);
        if style.mode.of_lines() {
            parts.iter_mut().for_each(|part| find(part, degrees));
        } else {
            normals = light::normals(&scene.vertices, &scene.triangles, crease);
            if style.smooth_faces {
                parts.iter_mut().for_each(|part| find(part, Some(crease)));
            }
        }
        Self { parts, normals }
    }
}

/// Draws a frame in bands, through a strip with room for `rows` rows of the picture. `plan` gets the area that will be drawn and
/// chooses the areas to send; `send` gets every band.
pub fn paint(
    subject: &Subject,
    scene: (&Scene, &Quantised),
    style: &Style,
    format: Format,
    rows: u32,
    plan: Plan<'_>,
    send: Send<'_>,
) -> Result<Report, String> {
    by_format!(format, C => paint_in::<C>(subject, scene, style, rows, plan, send))
}

/// [`paint`] in colours of this type.
fn paint_in<C: Colour>(
    subject: &Subject,
    (scene, quantised): (&Scene, &Quantised),
    style: &Style,
    rows: u32,
    plan: Plan<'_>,
    send: Send<'_>,
) -> Result<Report, String> {
    // Faces that are mixed with what is behind them are drawn from far to near.
    let sorted = (style.translucency.blends() && !style.mode.of_lines()).then(|| Sorted::new(scene));
    let parts = sorted.as_ref().map_or(&subject.parts, |sorted| &sorted.parts);
    let vertices: Vec<_> = parts.iter().map(|part| part.vertices(&quantised.vertices)).collect();
    // A wireframe shows the mesh itself; hidden lines show a body, with its outline.
    let facings = (style.mode == Mode::HiddenLine).then(|| scene.facings());
    let edges_of = |part: &Part| match style.smooths() {
        true => part.all_edges(),
        false => part.drawn_edges(facings.as_deref()),
    };
    let edges: Vec<_> = parts.iter().map(edges_of).collect();
    let meshes = parts.iter().zip(&vertices).zip(&edges).map(|((part, vertices), (edges, beside))| {
        Mesh::from_fixed(vertices, &part.faces)?.with_edges(edges)?.with_edge_faces(beside)
    });
    let meshes = meshes.collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
    let (camera, cull) = (quantised.camera(), if scene.cull { Cull::Back } else { Cull::None });
    let instances: Vec<MeshInstance<'_, Scalar>> =
        meshes.iter().map(|mesh| camera.place(mesh, &quantised.model).with_cull(cull)).collect();

    // Lines are not in fog.
    let fog = style.fog.or(scene.fog).filter(|_| !style.mode.of_lines() || !scene.sprites.is_empty());
    let fog = fog.map(|fog| fog.table(scene, quantised, C::from(style.background))).transpose()?;
    let sprites = Sprites::new(scene, quantised, fog.as_ref())?;
    let out = Out { size: Size::new(scene.width, scene.height), style, rows, plan, send, sprites };
    match style.mode {
        Mode::Wireframe => wireframe(out, &instances),
        Mode::HiddenLine => hidden_lines(out, &instances),
        Mode::Solid | Mode::Flat | Mode::Gouraud => {
            let texels = scene.texture.as_ref().and_then(|texture| texture.colours::<C>());
            let texels = texels.as_deref().filter(|_| style.own_colours);
            let order = sorted.as_ref().map(|sorted| &*sorted.order);
            let shades = Shades::new((scene, quantised), style, &subject.normals, order, texels)?;
            let shader = |part: &Part, face| shades.brush(part, face);
            let is_crease = |part: &Part, edge| shades.is_crease(part, edge);
            let Some(fog) = &fog else { return faces(out, &instances, parts, shader, is_crease) };
            faces(out, &instances, parts, |part, face| Fogged::new(shader(part, face), fog), is_crease)
        }
    }
}

/// The triangles of a scene from far to near, by the mean depth of their corners, as [`pinhole::draw::Painter`] sorts them.
struct Sorted {
    parts: Vec<Part>,
    /// The number that each triangle has in the scene.
    order: Vec<usize>,
}

impl Sorted {
    fn new(scene: &Scene) -> Self {
        let depths: Vec<f64> =
            scene.vertices.iter().map(|&vertex| crate::scene::depth(scene.clip(vertex))).collect();
        let depth =
            |triangle: usize| -> f64 { scene.triangles[triangle].iter().map(|&vertex| depths[vertex]).sum() };
        let mut order: Vec<usize> = (0..scene.triangles.len()).collect();
        order.sort_by(|&a, &b| depth(b).total_cmp(&depth(a)));
        let triangles: Vec<_> = order.iter().map(|&triangle| scene.triangles[triangle]).collect();
        Self { parts: parts(&scene.vertices, &triangles), order }
    }
}

/// Draws the edges of all meshes.
fn wireframe<C: Colour>(out: Out<'_, C>, instances: &[MeshInstance<'_, Scalar>]) -> Result<Report, String> {
    let (color, smooth) = (C::from(out.style.colour), out.style.smooth_lines);
    let mut caches = storage(instances, ScreenVertex::EMPTY, |mesh| mesh.vertices().len());
    // Lines without depth test: no far plane may clip them.
    let transformed: Vec<_> = instances.iter().zip(&mut caches).map(|(p, c)| p.transform(c)).collect();
    let mut bins = storage(instances, 0, |mesh| mesh.edge_bins_len());
    let (mut edges, statistics, bounds) = binned_edges(&transformed, &mut bins)?;
    out.bands(statistics, bounds, smooth, |band, _| {
        in_memory(band, |pixels| {
            for edges in &mut edges {
                let Ok(()) = match smooth {
                    false => edges.draw(color, pixels),
                    true => edges.draw(AntiAliased(color), pixels),
                };
            }
        });
    })
}

/// Draws the parts of edges that no face hides.
fn hidden_lines<C: Colour>(
    out: Out<'_, C>,
    instances: &[MeshInstance<'_, Scalar>],
) -> Result<Report, String> {
    let (color, smooth) = (C::from(out.style.colour), out.style.smooth_lines);
    let mut caches = storage(instances, ScreenVertex::EMPTY, |mesh| mesh.vertices().len());
    let transformed: Vec<_> = instances.iter().zip(&mut caches).map(|(p, c)| p.transform_depth(c)).collect();
    let mut face_bins = storage(instances, 0, |mesh| mesh.face_bins_len());
    let mut edge_bins = storage(instances, 0, |mesh| mesh.edge_bins_len());
    let mut faces = binned_faces(&transformed, &mut face_bins)?;
    let (mut edges, statistics, bounds) = binned_edges(&transformed, &mut edge_bins)?;
    out.bands(statistics, bounds, smooth, |band, depth| {
        // Any part may hide any other.
        faces.iter_mut().for_each(|faces| faces.depth_only(depth));
        in_memory(band, |pixels| {
            let mut target = pixels.depth_tested(depth);
            for edges in &mut edges {
                let Ok(()) = match smooth {
                    false => edges.hidden_line(color, &mut target),
                    true => edges.hidden_line(AntiAliased(color), &mut target),
                };
            }
        });
    })
}

/// Draws the faces with a shader for each, given its part and its number there, and smooths silhouettes and these creases.
fn faces<C: Colour, I: SpanShader<C, Ink = C>>(
    out: Out<'_, C>,
    instances: &[MeshInstance<'_, Scalar>],
    parts: &[Part],
    shader: impl Fn(&Part, usize) -> I,
    is_crease: impl Fn(&Part, usize) -> bool,
) -> Result<Report, String> {
    let mut caches = storage(instances, ScreenVertex::EMPTY, |mesh| mesh.vertices().len());
    let transformed: Vec<_> = instances.iter().zip(&mut caches).map(|(p, c)| p.transform_depth(c)).collect();
    let mut bins = storage(instances, 0, |mesh| mesh.face_bins_len());
    let mut faces = binned_faces(&transformed, &mut bins)?;
    let statistics =
        faces.iter().map(BinnedFaces::statistics).fold(Statistics::default(), core::ops::Add::add);
    let bounds = around(faces.iter().map(BinnedFaces::bounds));
    if out.style.smooths() {
        let mut bins = storage(instances, 0, |mesh| mesh.smooth_bins_len());
        let edges = transformed.iter().zip(parts).zip(&mut bins).map(|((transformed, part), bins)| {
            transformed.bin_smooth_edges(|edge| is_crease(part, edge), bins)
        });
        let mut edges = edges.collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
        // Smoothed in one piece, which bands equal in every format.
        let picture = out.in_one_piece(|band, depth| {
            solid(parts, &mut faces, &shader, depth, band);
            in_memory(band, |pixels| C::smooth(pixels, depth, &mut edges));
        })?;
        let width = out.size.width as usize;
        return out.bands(statistics, bounds, true, |band, depth| {
            // For sprites.
            faces.iter_mut().for_each(|faces| faces.depth_only(depth));
            let area = band.area();
            let (left, columns) = (area.top_left.x as usize, area.size.width as usize); // in the picture
            let rows = picture.chunks(width.max(1)).skip(area.top_left.y as usize);
            let _ = band.fill_contiguous(&area, rows.flat_map(|row| &row[left..left + columns]).copied());
        });
    }
    let translucency = out.style.translucency;
    out.bands(statistics, bounds, false, |band, depth| match translucency {
        Translucency::Opaque => solid(parts, &mut faces, &shader, depth, band),
        Translucency::Door(of_64) => {
            let shader = |part: &Part, face| ScreenDoor::new(shader(part, face), of_64);
            solid(parts, &mut faces, shader, depth, band);
        }
        Translucency::Half => in_memory(band, |pixels| {
            let shader = |part: &Part, face| Translucent::new(shader(part, face), Half);
            solid(parts, &mut faces, shader, depth, pixels);
        }),
        Translucency::Alpha(of_32) => in_memory(band, |pixels| {
            let shader = |part: &Part, face| Translucent::new(shader(part, face), Alpha::new(of_32));
            solid(parts, &mut faces, shader, depth, pixels);
        }),
    })
}

/// Draws the faces of all parts.
fn solid<T: Surface<Error = Infallible>, I: ShaderFor<T>>(
    parts: &[Part],
    faces: &mut [BinnedFaces<'_, Scalar, true>],
    shader: impl Fn(&Part, usize) -> I,
    depth: &mut DepthBuffer<'_>,
    target: &mut T,
) {
    for (part, faces) in parts.iter().zip(faces) {
        let Ok(()) = faces.draw(|face| shader(part, face), &mut target.depth_tested(depth));
    }
}

/// Storage of some length for each mesh.
fn storage<T: Clone>(
    instances: &[MeshInstance<'_, Scalar>],
    empty: T,
    len: impl Fn(&Mesh<'_, Scalar>) -> usize,
) -> Vec<Vec<T>> {
    instances.iter().map(|instance| vec![empty.clone(); len(instance.mesh())]).collect()
}

/// The faces of all parts. Their visibility is decided once for all bands.
fn binned_faces<'a>(
    transformed: &[TransformedMesh<'a, Scalar, true>],
    storage: &'a mut [Vec<u16>],
) -> Result<Vec<BinnedFaces<'a, Scalar, true>>, String> {
    let faces = transformed.iter().zip(storage).map(|(transformed, storage)| transformed.bin_faces(storage));
    faces.collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())
}

/// The edges of all parts, their statistics and the area that they cover.
fn binned_edges<'a, const DEPTH: bool>(
    transformed: &[TransformedMesh<'a, Scalar, DEPTH>],
    storage: &'a mut [Vec<u16>],
) -> Result<(Vec<BinnedEdges<'a, Scalar, DEPTH>>, Statistics, Rectangle), String> {
    let edges = transformed.iter().zip(storage).map(|(transformed, storage)| transformed.bin_edges(storage));
    let edges = edges.collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
    let statistics =
        edges.iter().map(BinnedEdges::statistics).fold(Statistics::default(), core::ops::Add::add);
    let bounds = around(edges.iter().map(BinnedEdges::bounds));
    Ok((edges, statistics, bounds))
}
