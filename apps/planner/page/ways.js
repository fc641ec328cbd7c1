// Ways to draw other than faces with depth in bands: what makes one of them of a template's sources. For the page and for node.
'use strict';

// Edits: what is replaced wherever it stands, and by what. Deletes the lines that have a text.
const lines = (...texts) => [new RegExp(`^.*(${texts.join('|')}).*\\n`, 'gm'), ''];

// No other board draws this.
const ALONE = [[/ It knows no board:[^]*?does\.| It draws the pixels of the\s+(\/\/! )?other boards' `picture\.rs`\./, '']];

const WITHOUT_DEPTH = [
  [/, with depth(?=,)/, ''],
  [/(, and the| with the) depths of (a band for each core|a band|its pixels)/, ''],
  [/(transform)_depth\(/g, '$1('],
  [/\.depth_tested\(&mut depth\)/g, ''],
  [/Binned(Faces|Edges)<('a|'_)>/g, 'Binned$1<$2, i16, false>'],
  [/(uffers!\([^()]*ROWS)\)/g, '$1, no depth)'],
  [/\(Some\(mesh\), Some\(depths\)\) = \(MESH\.try_take\(\), DEPTHS\.try_take\(\)\) else \{\s+(.*)\s+\};/, 'Some(mesh) = MESH.try_take() else { $1 };'],
  [/, depths: (\[depths, other_depths\] \} \} =\s+self|&mut \[u16\])/g, (_, of) => (of.startsWith('[') ? ' } } = self' : '')],
  [/Some\(depths\), (?=Some\(\[)/, ''],
  [/^\/\/\/ Pixels of a strip\.\nconst PIXELS.*\n/m, ''],
  lines('^ *(pub )?depths: ', 'let depths = singleton', 'DEPTHS:', 'With depth\\.', 'DepthBuffer::new', 'depth\\.map_err', 'depths\\.len', 'split_at_mut\\(half\\)', '\\[depths, other'),
  [/, (&mut strip\.)?(other_)?depths\b/g, ''],
  [/^pub const PIXELS.*\n(?=[^]*FONT_10X20)/m, ''],
  [/(self, Picture), PIXELS\b(?=\};\nuse crate)/, '$1'],
  [/=\s+(self\.faces\.draw\(.*band\.pixels\(\)\);)/, '= $1'],
];

const LINES = [
  [/lit(?=,)/, 'its edges'],
  [/any closed mesh/, 'any mesh'],
  [/, with the\n\/\/\/ normals[^]*?draw\./, ', and its\n/// edges.'],
  [/ *\/\/ A constant: what the model[^]*?\};\n/, ''],
  [/ `color` gives the colour of each face( at a level of light)?\./g, ''],
  lines('color: impl ', 'AMBIENT', 'Light on faces', 'let level', 'let shade', 'light: ', 'let light', ', light\\)', 'Of a model without', 'mesh: self\\.mesh,'),
  [/&?\bcolor, /g, ''],
  [/pub (const COLOR)/, '$1'],
  [/(struct Turned<'a> \{\n) *mesh: .*\n/, '$1'],
  [/use pinhole::\{(?=prelude[^]*BinnedFaces<)/, 'use pinhole::{draw::BinnedEdges, '],
];

const WIREFRAME = [
  // Of the board with an OLED.
  [/, without those that its own faces hide/, ''],
  [/which its surface turns[^]*?slowly\./, 'which its surface turns.'],
  [/\[(&'a mut \[u16\]); 2\]/, '$1'],
  [/\[(face_bins, |&mut mesh\.bins, )(.*?)\]/, '$2'],
  [/face_bins, |faces, (?=edges: MODEL)|faces and (?=edges)/g, ''],
  [/hidden_line\((.*), &mut band/, 'draw($1, &mut band'],
  [/(use picture::)\{(Picture), PIXELS\}/, '$1$2'],
  lines('face_bins', 'faces: BinnedFaces<.*(?=\\n.*BinnedEdges)', 'faces: faces\\.map_err.*(?=\\n.*edges\\.map)', 'self\\.faces\\.depth_only'),
  ...WITHOUT_DEPTH,
  ...LINES,
  [/picture::\{self, Picture\}/, 'picture::Picture'],
  [/faces\.draw\(.*\);/, 'edges.draw(COLOR, &mut band);'],
  [/(mesh\.)bins/g, '$1edge_bins'],
  [/(esh_?[bB]uffers!\()(?=MODEL)/g, '$1edges: '],
  // Of two cores.
  [/split_bin_faces\(bins, .*\);/, 'bin_faces(bins);'],
  [/\bfaces\b|(?<=Binned)Faces|(?<=bin_)faces/g, (text) => (text === 'Faces' ? 'Edges' : 'edges')],
];

const NO_ROOM = '|_| "no room for all edges: the bins are of another mesh"';
const HIDDEN_LINES = [
  ...LINES,
  [/picture::\{self, Picture, PIXELS\}/, 'picture::{Picture, PIXELS}'],
  [/( *)let Ok\(\(\)\) =\s+(self\.)?faces\.draw\(.*\n/, (_, indent, self = '') =>
    `${indent}${self}faces.depth_only(&mut depth);\n${indent}let Ok(()) = ${self}edges.hidden_line(COLOR, &mut band.depth_tested(&mut depth));\n`],
  [/( *)let faces = (.*?transform_depth\(.*?\))\.bin_faces\((.*)bins\);\n/, '$1let transformed = $2;\n$1let faces = transformed.bin_faces($3bins);\n$1let edges = transformed.bin_edges($3edge_bins);\n'],
  [/( *let (?:mut )?)faces = faces\.map_err[^]*?\?;\n/, `$&$1edges = edges.map_err(${NO_ROOM})?;\n`],
  [/^( *)faces,\n/m, '$&$1edges,\n'],
  [/( *)faces: faces\.map_err[^]*?\?,\n/, `$&$1edges: edges.map_err(${NO_ROOM})?,\n`],
  [/^ *bins: &'a mut \[u16\],\n/gm, (text) => text + text.replace('bins', 'edge_bins')],
  [/(?<!\.)bins, (?=strip|depths)/g, 'bins, edge_bins, '],
  [/&mut mesh\.bins/g, '$&, &mut mesh.edge_bins'],
  [/( *)faces: BinnedFaces<.*\n/, "$&$1edges: BinnedEdges<'a>,\n"],
  [/(esh_?[bB]uffers!\()(?=MODEL)/g, '$1faces, edges: '],
  [/faces(?=\.(statistics|bounds)\(\))/g, 'edges'],
  // Of two cores.
  [/ *pub (bins|cursor): .*\n/g, (text) => text + text.replace(/bins|cursor/, 'edge_$&')],
  [/(per 16 faces),/, '$1 and per 16 edges,'],
  [/(?<!_)bins, cursor, (?=depths)/, 'bins, edge_bins, cursor, edge_cursor, '],
  [/&mut mesh\.edge_bins, cursor/, 'edge_bins: &mut mesh.edge_bins, cursor, edge_cursor'],
  [/( *let )(cursor =\n.*MODEL\.)faces(.*MODEL\.)faces(.*\n)/, '$&$1edge_$2edges$3edges$4'],
  [/Some\(cursor\), /, '$&Some(edge_cursor), '],
  [/cursor, (?=strip)/, '$&edge_cursor, '],
  [/( *)let faces = transformed\.split_bin_faces.*\n/, '$&$1let edges = transformed.bin_edges(edge_bins);\n'],
  [/( *let )forks = faces(\.fork\()cursor\);\n.*forks(.*)\n/, '$1[mut ours, mut theirs] = faces$2cursor)$3\n$1[mut our_edges, mut their_edges] = edges$2edge_cursor)$3\n'],
  [/faces: &mut BinnedFaces<'_>, /, "$&edges: &mut BinnedEdges<'_>, "],
  [/&mut (our|their)s, /g, '$&&mut $1_edges, '],
];

const SORTED = `painter.clear();
    let faces = instance.faces(|face| color(face, level(face))).sorted(OF.painter);
    faces.map_err(|_| "no room for all faces: the painter is of another mesh")?;
`;
const PAINTER = [
  ...WITHOUT_DEPTH,
  // Room for the mesh.
  [/(vertex cache)(\n? *\/*) and bins/, 'painter$2 with room'],
  [/: `mesh_buffers!` and `strip_buffers!` declare it/, ''],
  [/MeshBuffers!\(MODEL\)/, 'Sorted'],
  [/mesh_buffers!\(MODEL\)/, 'Sorted::new()'],
  [/(include!.*\n)/, '$1\n/// Sorts the faces of the model.\ntype Sorted = Painter<Rgb565, { MODEL.vertices().len() }, { MODEL.faces().len() }>;\n'],
  [/(use embassy_time::Delay;\n)(?=use pinhole)/, '$1use embedded_graphics::pixelcolor::Rgb565;\n'],
  [/\bMESH\b/g, 'PAINTER'],
  [/let mesh(?= = singleton)|(?<=Some\()mesh|(?<== \()mesh(?=, )/g, (text) => text.replace('mesh', 'painter')],
  [/(pub )?cache: &'a mut \[ScreenVertex\],\n.*bins: .*\n(.*cursor: .*\n)?/g, "$1painter: &'a mut Painter<Rgb565, V, F>,\n"],
  [/&mut mesh\.cache, &mut mesh\.bins|cache: &mut mesh\.cache, bins: &mut mesh\.bins, cursor|cache, bins(, cursor)?/g, 'painter'],
  [/(struct|impl<'a>) (Memory|Picture)<'a>/g, (_, kind, name) => (kind === 'struct' ? `struct ${name}<'a, const V: usize, const F: usize>` : `impl<'a, const V: usize, const F: usize> ${name}<'a, V, F>`)],
  [/(memory|picture): (&mut )?(Memory|Picture)<('a|'_)>/g, '$1: $2$3<$4, V, F>'],
  [/(?<=pub (async )?fn draw)\((?=\n    (mesh|picture))/, '<const V: usize, const F: usize>('],
  // Sorts them.
  [/visible faces into the bins of the bands/i, 'visible faces from the farthest to the nearest'],
  [/    let faces = instance.*bin_faces.*\n *let mut faces = [^]*?\?;\n/, `    memory.${SORTED.replace('OF', 'memory')}    let faces = memory.painter.order();\n`],
  [/.*let \(mesh, light\).*\n.*\n/, ''],
  [/ *self\.instance = .*\n.*bin_faces.*\n/, `    let mesh = self.mesh;
    let light = Lambert::new(&model, Vector3::from_ints(2, 3, 4), AMBIENT).map_err(|_| "no light")?;
    let level = |face: usize| mesh.normals().get(face).map_or(256, |&normal| light.level(normal));
    let instance = self.camera.place(mesh, &model);
    self.${SORTED.replace('OF', 'self')}`.replace(/^/gm, '    ').trimEnd() + '\n'],
  [/( *)faces: faces\.map_err[^]*?\?,\n/, '$1faces: self.painter.order(),\n'],
  [/ *let faces = faces\.map_err[^]*?\?;\n/, ''],
  [/(?<=bounds = )faces\.bounds\(\)/, 'self.screen'],
  [/the rectangle around the mesh, as\n *\/\/\/ it is shown and as it will be/, 'all of the screen, as a painter has no bounds'],
  [/^( *)faces,\n/m, '$1faces: self.painter.order(),\n'],
  lines('light: ', 'instance: MeshInstance', 'let instance = camera.*identity', 'mesh: self\\.mesh,'),
  [/(struct Turned<'a> \{\n) *mesh: .*\n/, '$1'],
  [/camera, instance, |instance: camera.*identity\(\)\), /, (text) => (text.startsWith('camera') ? 'camera, ' : '')],
  [/use pinhole::\{(?=prelude[^]*struct Turned)/, 'use pinhole::{draw::PaintersOrder, '],
  [/BinnedFaces<'a, i16, false>/, "PaintersOrder<'a, Rgb565>"],
  // Draws them.
  [/(faces\.draw\()(\|face\| color\(face, level\(face\)\)|shade), /, '$1'],
  [/ *color: impl .*\n(?= *(strip|frame): )/, ''],
  [/(The next band.*?\.) (`color` gives .*? light\.)/, '$1'],
  [/(\/\/\/ A frame: vertices.*)(\n.*fn turned\()(&mut self), (.*)\)/, '$1 `color` gives the colour of each face at a level of light.$2\n        $3,\n        color: impl Fn(usize, u16) -> Rgb565,\n        $4,\n    )'],
  [/(?<=next_band\()&?color, /, ''],
  [/(?<=picture\.turned\()(?=step)/, '&color, '],
  [/(?<=picture\.turned\()(?=Angle)/, 'color, '],
  [/Rectangles around the mesh and around the text: nothing is drawn outside them/, 'All of the screen, as a painter has no bounds, and a rectangle around the text'],
  [/\[self\.faces\.bounds\(\)/, '[SCREEN'],
  // Of two cores.
  [/, one number per 16 faces\./, '.'],
  [/ *let cursor =\n.*\n/, ''],
  [/Some\(cursor\), |cursor, (?=strip)/g, ''],
  [/let transformed[^]*?(let statistics.*\n)[^]*?the cursor is.*\n/, `painter.clear();
        instance.faces(shade).sorted(painter).map_err(|_| "no room for all faces: the painter is of another mesh")?;
        let faces = painter.order();
        $1`],
  [/, faces: &mut BinnedFaces<'_, i16, false>/, ''],
  [/, &mut (ours|theirs)(?=, (upper|lower))/g, ''],
];

// The one band of the picture: a board with one strip can.
const WHOLE = [
  [/, in bands/, ''],
  [/, band by band/, ''],
  [/a strip of some rows/, 'a strip of all rows'],
];
const WITHOUT_BINS = [
  [/A vertex cache and bins for/, 'A vertex cache for'],
  [/: `mesh_buffers!` and `strip_buffers!` declare it/, ''],
  [/MeshBuffers!\((edges: )?MODEL\)/, '[ScreenVertex; MODEL.vertices().len()]'],
  [/mesh_buffers!\((edges: )?MODEL\)/, '[ScreenVertex::EMPTY; MODEL.vertices().len()]'],
  [/\bMESH\b/g, 'CACHE'],
  [/let mesh(?= = singleton)|(?<=Some\()mesh|(?<== \()mesh(?=, )/g, (text) => text.replace('mesh', 'cache')],
  [/^ *bins: &'a mut \[u16\],\n/gm, ''],
  [/&mut mesh\.cache, &mut mesh\.(edge_)?bins|cache, bins/, 'cache'],
  [/    \/\/ Once a frame.*\n/, ''],
  [/ *let (faces|edges) = instance\.transform.*\n *let mut .*map_err[^]*?\?;\n/, ''],
  [/    let mut bytes = 0;\n    while let Some\(mut band\) = (.*)\? \{\n([^]*?)\n    \}\n.*\n/, (_, band, body) =>
    `    let band = ${band}?;\n    let mut band = band.ok_or("the screen has no rows")?;\n${body.replace(/^    /gm, '').replace(/    bytes \+= (.*);(.*)/, '    Ok(Drawn { statistics, bytes: $1 })$2')}\n`],
  [/let Ok\(\(\)\) = faces\.draw\((.*level\(face\)\)), (.*)\);/, 'let faces = instance.faces($1).cached(memory.cache);\n    let Ok(statistics) = faces.draw($2);'],
  [/let Ok\(\(\)\) = edges\.draw.*/, 'let edges = instance.edges(|_| COLOR).cached(memory.cache);\n    let Ok(statistics) = edges.draw(&mut band.pixels());'],
];

const SMOOTH = ', smooth edges';
const LISTED_EDGES = [
  [/Edges::None/, 'Edges::CreasesFirst { degrees: 0.0 }, edge_faces: true'],
  [/without edges, which this picture does not draw/, 'all edges, first the creases, with the faces beside them, for smoothing'],
];
const COLORS = { mono: 'BinaryColor', gray2: 'Gray2', gray4: 'Gray4', tricolor: 'Tricolor' };

// For a display of yours in few bits a pixel. Faces are shaded from colours of 16 bits.
function inFewBits(color, isOfLines, isPlain) {
  const isOwn = color === 'Tricolor';
  const names = [...(isOwn ? [] : [color]), ...(isOfLines ? [] : ['Rgb565']), ...(isPlain ? ['Rgb888'] : []), 'RgbColor', 'WebColors'];
  const imports = `${isOwn && isOfLines ? '' : `$1{${names.join(', ')}};\n`}${isOwn ? 'use crate::tricolor::Tricolor;\n' : ''}`;
  return [
    [/band\.pixels\(\)/, 'band'],
    [/(use .*pixelcolor::)\{Rgb565, RgbColor, WebColors\};\n/, imports],
    ...(isPlain ? [[/(?<=\|face\| )color\(face, level\(face\)\)/, `${color}::from(Rgb888::from(color(face, 256))).dim(level(face))`]] : []),
    // The main file.
    [/pixelcolor::Rgb565, (?=primitives::Rectangle\};\nuse picture)/, isOwn ? '' : `pixelcolor::${color}, `],
    [/(uffers!\()Rgb565/g, `$1${color}`],
    ...(isOwn ? [[/mod stop;\n(?=\nuse clock)/, '$&mod tricolor;\n'], [/use stop::stop;\n(?=\ninclude)/, '$&use tricolor::Tricolor;\n']] : []),
    [/in 16-bit colour into a rectangle: row by row, the high byte of each first/, 'into a rectangle: row by row, each row from the highest bits of a byte'],
  ];
}

// Of a texture: colours that the library writes as numbers, in a format whose colours have names.
function namedColors(color) {
  const path = color === 'Tricolor' ? 'crate::tricolor::Tricolor' : 'embedded_graphics_core::pixelcolor::BinaryColor';
  const nameOf = ([r, g, b]) => (color === 'BinaryColor' ? (77 * r + 150 * g + 29 * b >= 128 << 8 ? 'On' : 'Off') : g > 127 ? 'White' : r > 127 ? 'Red' : 'Black');
  return [
    [/\w+::pixelcolor::Rgb888::new\((.*?)\)/g, (_, levels) => `${path}::${nameOf(levels.split(', '))}`],
    [/\w+::pixelcolor::(Rgb888|Tricolor)/g, path],
  ];
}

// A file with the hunks that a change of a template, in the format of `diff -u`, has for it.
const patched = (text, path, diff) => {
  const [, hunks = ''] = diff.split(`+++ ${path}\n`);
  return hunks.split(/^--- /m)[0].split(/^@@.*\n/m).slice(1).reduce((text, hunk) => {
    const [before, after] = ['+', '-'].map((other) => hunk.replace(new RegExp(`^\\${other}.*\\n`, 'gm'), '').replace(/^[-+ ]/gm, ''));
    if (text.split(before).length !== 2) throw new Error(`${path} does not have once what a change replaces:\n${before}`);
    return text.replace(before, () => after);
  }, text);
};

// The edits that make the files of a choice of those of a board, by its costs: those of all files, of sources, and of files that the library has
// changed; and whether edges are smoothed. `hasHiddenLines`: the board draws hidden lines as it is; `hasSmoothEdges`: there is a change of it that smooths edges.
function editsOf(choice, { ways }, hasHiddenLines, hasSmoothEdges) {
  const { name, order, rows, room, rom } = ways.find(({ chosen }) => chosen);
  const of = (key) => choice.get(key);
  const [style, color] = [of('style'), COLORS[of('format')]];
  const isOfLines = ['wireframe', 'hidden-line'].includes(style);
  const [width, height] = ['width', 'height'].map((side) => of(side) ?? 240);
  const isWhole = !rows && !color;
  const isSmoothed = hasSmoothEdges && name.endsWith(SMOOTH);
  const band = rows || (isWhole ? height : of('rows'));
  const decimates = of('decimate') > 0;
  const files = [
    [/const ROWS: u32 = \d+/, `const ROWS: u32 = ${band}`],
    [/SIZE: Size = Size::new\(\d+, \d+\)/, `SIZE: Size = Size::new(${width}, ${height})`],
    [/(pinhole-import = .*)(?= \})/, decimates ? '$1, features = ["decimate"]' : '$1'],
    // The importer's options are the library's.
    [/Feature \{ degrees: 30\.0 \},\n *edge_faces: true/, 'None'],
    // The memory of any chip.
    [/: these are the sizes that this firmware at least needs,/, ','],
    [/(FLASH .*LENGTH = )64K/, `$1${rom / 1024}K`],
    [/(RAM .*LENGTH = )20K/, `$1${room / 1024}K`],
    // The README.
    [/^\*\*Smooth edges\*\*.*\n\n/m, ''],
    [/^\*\*(Speed|Memory), smooth\.\*\*[^]*?\n\n/gm, ''],
    [/^.*pinhole\/boards\/new .*\n/gm, ''],
    [/^(# .*\n)/, `$1\nSaved by pinhole's planner. Way to draw: ${isSmoothed ? name : name.replace(SMOOTH, '')}. The folder is complete: your model is in it, and what is said below of making a copy and of putting your model into it is done.${decimates ? ` ${DECIMATES}` : ''} The figures below are those of the template as it is, with a gear.\n`],
  ];
  const sources = [];
  if (isSmoothed && style === 'gouraud') sources.push([/creases: MODEL_CREASES/, 'creases: 0']);
  if (isWhole || color || order !== 'depth' || isOfLines) sources.push(...ALONE);
  if (style === 'wireframe') sources.push(...WIREFRAME);
  if (style === 'hidden-line' && !hasHiddenLines) sources.push(...HIDDEN_LINES);
  if (order === 'painter') sources.push([/any closed mesh/, 'a mesh of small faces'], ...PAINTER);
  if (order === 'mesh') sources.push([/any closed mesh/, 'a convex mesh'], ...WITHOUT_DEPTH);
  if (isWhole) sources.push(...WHOLE, ...(order === 'painter' ? [] : WITHOUT_BINS));
  if (color) sources.push(...inFewBits(color, isOfLines, color.startsWith('Gray') && style === 'flat' && of('dither') !== '1'));
  const changed = { 'src/texture.rs': color ? namedColors(color) : [], 'build.rs': name.endsWith(SMOOTH) ? LISTED_EDGES : [] };
  return { files, sources, changed, isSmoothed };
}

// Imports the traits of colours that constants need.
const USERS = { RgbColor: /565::(BLACK|WHITE)/, WebColors: /CSS_/ };
const withoutUnused = (text) => text.replace(/pixelcolor::\{(.*)\};/, (_, names) => {
  const used = names.split(', ').filter((name) => !USERS[name] || USERS[name].test(text));
  return `pixelcolor::${used.length > 1 ? `{${used.join(', ')}}` : used};`;
});

const edited = (text, edits) => edits.reduce((text, [from, to]) => text.replace(from, to), text);

Object.assign(globalThis, { editsOf, edited, patched, withoutUnused });
