//! STL to triangles, binary or ASCII, by `stl_io`. Its normals are passed over.

use crate::{ImportError, Problem, Triangles};
use std::io::Cursor;
use std::path::Path;

/// Header, count and triangles of a binary file.
const HEADER: usize = 80;
const COUNT: usize = 4;
const TRIANGLE: usize = 50;

/// Reads STL; `file` is only named in errors. Vertices with the same bits are one.
pub(crate) fn read(bytes: &[u8], file: &Path) -> Result<Triangles, ImportError> {
    let error = |problem: Problem| problem.at(file, None);
    let mut bytes = bytes.to_vec();
    let declared = declared_length(&bytes);
    let starts_as_text = bytes.trim_ascii_start().starts_with(b"solid");
    if declared == Some(bytes.len() as u64) {
        // A binary file, whatever its header says: many begin with "solid", by which stl_io takes
        // them for text.
        bytes[0] = b' ';
    } else if !starts_as_text {
        let needed = declared.unwrap_or((HEADER + COUNT) as u64);
        if (bytes.len() as u64) < needed {
            return Err(error(Problem::Truncated { needed, given: bytes.len() as u64 }));
        }
    }
    // A text may hold several solids, of which stl_io reads the first.
    let is_text = declared != Some(bytes.len() as u64);
    let facets = is_text.then(|| bytes.windows(8).filter(|w| *w == b"endfacet").count());
    let mesh =
        stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|e| error(Problem::Format(e.to_string())))?;
    if let Some(facets) = facets.filter(|&facets| facets > mesh.faces.len()) {
        let read = mesh.faces.len();
        let problem = format!("has {facets} facets, of which {read} could be read: only one solid a file");
        return Err(error(Problem::Format(problem)));
    }
    let positions: Vec<_> = mesh.vertices.iter().map(|v| v.0.map(f64::from)).collect();
    if positions.iter().flatten().any(|c| !c.is_finite()) {
        return Err(error(Problem::NotFinite));
    }
    Ok(Triangles { positions, faces: mesh.faces.iter().map(|f| f.vertices).collect() })
}

/// How long a binary file with this start must be.
fn declared_length(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER..HEADER + COUNT)?;
    let count = u32::from_le_bytes(count.try_into().ok()?);
    Some((HEADER + COUNT) as u64 + u64::from(count) * TRIANGLE as u64)
}
