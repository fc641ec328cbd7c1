//! The way from a model of a file to a mesh, stage by stage.

use crate::attributes::Attributes;
use crate::exact::Exact;
use crate::mesh::{ImportedMesh, Report};
use crate::model::Model;
use crate::rounded::Rounded;
use crate::winding::Winding;
use crate::{derive, order, Axis, Edges, Options, Preview, Problem, Step, Triangles, Warning};
use std::mem::take;

/// Makes a mesh of triangles: welds, centres, quantises, derives edges and normals. Scales and orders nothing: it has the
/// default [`Options`], and y is up.
///
/// **Error.** Let E be the largest extent and h = E/2 the largest distance of a coordinate from the centre. The exponent
/// is the least with `round(h / 2^exponent) <= 32767`, so one less would have given `h / 2^(exponent-1) >= 32767.5`, that
/// is `2^exponent <= 2h / 32767.5 = E / 32767.5`. Rounding errs by half a step: **E / 65535 for each coordinate**. The
/// centre is first rounded to 2⁻¹⁶ model units, so that an `I16F16` holds exactly what was subtracted; that moves it by
/// at most 2⁻¹⁷ and makes h larger by as much. It is only done where E ≥ 2⁻⁶: the error stays below
/// `(E + 2⁻¹⁶) / 65535 <= E / 65471`, less than E / 65000. (All this up to the 53 bits of `f64`.)
///
/// About the file's origin ([`Centre::Origin`](crate::Centre::Origin)) h is the largest coordinate, and the error below
/// h / 32767.5.
///
/// # Errors
///
/// [`Problem::NotFinite`], [`Problem::NoFaces`], [`Problem::NoArea`], [`Problem::TooThin`],
/// [`Problem::NoSuchVertex`], [`Problem::TooManyVertices`], [`Problem::Extent`].
pub fn quantise(model: &Triangles) -> Result<ImportedMesh, Problem> {
    let model = Model { triangles: model.clone(), ..Model::default() };
    let made = make(model, Axis::Y, &Options::default(), &mut |_| ())?;
    Ok(ImportedMesh { warnings: made.warnings, ..made.mesh? })
}

/// Makes a mesh of a model as the options say; `up` is the axis of the file that becomes +y. The mesh is without the warnings.
pub(crate) fn make(
    mut model: Model,
    up: Axis,
    options: &Options,
    begins: &mut dyn FnMut(Step),
) -> Result<Preview, Problem> {
    options.check()?;
    if options.edges == Edges::None {
        model.lines.clear();
    }
    model.check()?;

    begins(Step::Weld);
    let mut exact = Exact::weld(take(&mut model.triangles), take(&mut model.lines))?;
    exact.place(up, options)?;
    if let Some(wanted) = options.decimate.filter(|&wanted| wanted < exact.welded.faces.len()) {
        begins(Step::Decimate);
        model.warnings.extend(exact.decimate(wanted, options)?);
    }

    begins(Step::Quantise);
    let texture = model.texture.as_ref().filter(|_| exact.decimated.is_none());
    let (rounded, mut surface) = Rounded::of(&exact, texture, options)?;
    let fetches = order::order(&mut surface, options, begins);
    surface.add_lines(&rounded.ends_of_lines);

    begins(Step::Derive);
    let winding = Winding::of(&mut surface, options);
    model.warnings.extend(rounded.warnings(&exact, &model.places));
    if !options.two_sided {
        model.warnings.extend(winding.warnings(&surface, &model.places, options.flip));
    }
    if exact.decimated.is_some() && (model.colors.is_some() || model.texture.is_some()) {
        model.colors = None;
        model.warnings.push(Warning::DecimatedMaterials);
    }
    let attributes = Attributes::of(&mut surface, &mut model, options)?;

    let report = Report::of(&exact, &rounded, &winding, fetches);
    let mut preview = Preview {
        triangles: surface.in_file(&rounded.grid, exact.scale, up),
        colors: attributes.colors.of_faces(&attributes.colors.palette),
        emission: attributes.colors.of_faces(&attributes.colors.emission),
        texture: take(&mut surface.coords),
        backs: report.backs,
        up,
        files: model.files.clone(),
        mesh: derive::mesh(surface, &winding, attributes, &rounded.grid, report, options),
        warnings: model.warnings,
    };
    if let Ok(mesh) = &mut preview.mesh {
        preview.warnings.extend(mesh.doubts());
        mesh.files = model.files;
    }
    Ok(preview)
}
