//! The state of the simulator, and how keys and mouse change it.

use pinhole_render::picture::Format;
use pinhole_render::projections::Named;
use pinhole_render::style::{Mode, Translucency};

/// Everything that a picture depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Angles of the eye in degrees.
    pub(crate) yaw: f64,
    pub(crate) pitch: f64,
    pub(crate) zoom: f64,
    /// The projection; `None` is the scene's own camera.
    pub(crate) projection: Option<Named>,
    pub(crate) mode: Mode,
    pub(crate) format: Format,
    pub(crate) dither: bool,
    pub(crate) translucency: Translucency,
    /// Whether lines and the edges of opaque faces are anti-aliased, and whether a texture is lit.
    pub(crate) smooth: bool,
    pub(crate) lit_texture: bool,
    /// Whether there is fog over the model.
    pub(crate) fog: bool,
    /// Whether back faces are culled.
    pub(crate) cull: bool,
    /// Rows of a band; `None` draws the picture in one piece.
    pub(crate) rows: Option<u32>,
    pub(crate) turning: bool,
    /// Which overlays are shown.
    pub(crate) outlines: bool,
    pub(crate) information: bool,
    pub(crate) help: bool,
    /// Whether the scene has a camera of its own.
    own: bool,
    /// The initial value of `cull`.
    own_cull: bool,
}

/// The effect of a key, or of the mouse's wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Turns the eye by degrees to the right and up.
    Orbit(f64, f64),
    /// Magnifies by a number of steps of 10 %.
    Zoom(i32),
    /// Changes the state as the key does that has this number in the list of keys.
    Key(usize),
    /// Writes the picture to a file; the window does that.
    Screenshot,
    /// Ends the program; the window does that.
    Quit,
}

/// A change of the state.
type Change = fn(&mut State);

/// What each key changes. Keys are named by their characters, or `left`, `right`, `up`, `down`, `space`.
const CHANGES: [(&str, Change); 28] = [
    ("left", |state| state.orbit(-STEP, 0.0)),
    ("right", |state| state.orbit(STEP, 0.0)),
    ("up", |state| state.orbit(0.0, STEP)),
    ("down", |state| state.orbit(0.0, -STEP)),
    ("+", |state| state.apply(Action::Zoom(1))),
    ("-", |state| state.apply(Action::Zoom(-1))),
    ("s", |state| state.mode = Mode::Solid),
    ("f", |state| state.mode = Mode::Flat),
    ("g", |state| state.mode = Mode::Gouraud),
    ("w", |state| state.mode = Mode::Wireframe),
    ("l", |state| state.mode = Mode::HiddenLine),
    ("p", |state| state.project(1)),
    ("P", |state| state.project(-1)),
    ("c", |state| state.format = next(&Format::ALL.map(|(_, format)| format), state.format, 1)),
    ("C", |state| state.format = next(&Format::ALL.map(|(_, format)| format), state.format, -1)),
    ("d", |state| state.dither ^= true),
    ("t", |state| state.translucency = next(&TRANSLUCENCIES, state.translucency, 1)),
    ("a", |state| state.smooth ^= true),
    ("n", |state| state.lit_texture ^= true),
    ("o", |state| state.fog ^= true),
    ("k", |state| state.cull ^= true),
    ("b", |state| state.rows = next(&ROWS, state.rows, 1)),
    ("B", |state| state.rows = next(&ROWS, state.rows, -1)),
    ("r", |state| state.outlines ^= true),
    ("i", |state| state.information ^= true),
    ("h", |state| state.help ^= true),
    ("space", |state| state.turning ^= true),
    ("0", |state| *state = State { help: state.help, ..State::new(state.own, state.own_cull) }),
];

/// Keys and what they do.
pub(crate) const KEYS: [(&str, &str); 13] = [
    ("drag, arrows", "orbit"),
    ("wheel, + -", "zoom"),
    ("s f g w l", "solid flat Gouraud wire hidden line"),
    ("p P", "projection"),
    ("c C", "colour format"),
    ("d", "dither"),
    ("t a n", "translucent, smooth edges, lit texture"),
    ("b B", "rows of a band"),
    ("k o", "cull faces turned away, fog"),
    ("r", "rectangles that were sent"),
    ("i h", "information, help"),
    ("space 0", "turn, reset"),
    ("x q", "screenshot, quit"),
];

/// Opaque, a screen door with half of the pixels, blended in equal parts, and blended with a quarter of the face's colour.
const TRANSLUCENCIES: [Translucency; 4] =
    [Translucency::Opaque, Translucency::Door(32), Translucency::Half, Translucency::Alpha(8)];
const ROWS: [Option<u32>; 5] = [Some(1), Some(4), Some(8), Some(16), None];
/// Degrees that one key press turns the eye.
const STEP: f64 = 5.0;
/// Degrees per pixel of mouse movement.
const DRAG: f64 = 0.5;

impl State {
    /// The initial state: a model in the default perspective, or a scene with its own camera, with or without back-face
    /// culling.
    pub fn new(own_camera: bool, cull: bool) -> Self {
        let usual = Named::ALL[0];
        Self {
            yaw: if own_camera { 0.0 } else { usual.yaw },
            pitch: if own_camera { 0.0 } else { usual.pitch },
            zoom: 1.0,
            projection: (!own_camera).then_some(usual),
            mode: Mode::Solid,
            format: Format::Rgb565,
            dither: true,
            translucency: Translucency::Opaque,
            smooth: false,
            lit_texture: false,
            fog: false,
            cull,
            rows: Some(8),
            turning: false,
            outlines: false,
            information: true,
            help: false,
            own: own_camera,
            own_cull: cull,
        }
    }

    /// The action of a key.
    pub fn key(name: &str) -> Option<Action> {
        let name = match name {
            "x" => return Some(Action::Screenshot),
            "q" => return Some(Action::Quit),
            "=" => "+",
            "?" => "h",
            name => name,
        };
        CHANGES.iter().position(|(key, _)| *key == name).map(Action::Key)
    }

    /// Applies an action; actions of the window change nothing.
    pub fn apply(&mut self, action: Action) {
        match action {
            Action::Orbit(right, up) => self.orbit(right, up),
            Action::Zoom(steps) => self.zoom = (self.zoom * 1.1f64.powi(steps)).clamp(0.2, 20.0),
            Action::Key(number) => CHANGES.get(number).into_iter().for_each(|(_, change)| change(self)),
            Action::Screenshot | Action::Quit => {}
        }
    }

    /// Turns the model after a drag of the mouse, in pixels to the right and down.
    pub fn drag(&mut self, right: i32, down: i32) {
        self.orbit(-DRAG * f64::from(right), DRAG * f64::from(down));
    }

    /// Advances time by 1/60 s.
    pub fn tick(&mut self) {
        if self.turning {
            self.orbit(-1.0, 0.0);
        }
    }

    fn orbit(&mut self, right: f64, up: f64) {
        self.yaw = (self.yaw + right + 180.0).rem_euclid(360.0) - 180.0;
        let steepest = self.projection.map_or(90.0, |named| named.kind.steepest());
        self.pitch = (self.pitch + up).clamp(-steepest, steepest);
    }

    /// Chooses a projection, with its default direction.
    fn project(&mut self, by: i32) {
        let mut all: Vec<_> = Named::ALL.map(Some).to_vec();
        if self.own {
            all.insert(0, None);
        }
        self.projection = next(&all, self.projection, by);
        (self.yaw, self.pitch) = self.projection.map_or((0.0, 0.0), |named| (named.yaw, named.pitch));
    }

    /// Whether both states draw equal pictures, apart from overlays.
    pub(crate) fn draws_as(&self, other: &Self) -> bool {
        let bare = |state: &Self| Self {
            turning: false,
            outlines: false,
            information: false,
            help: false,
            ..*state
        };
        bare(self) == bare(other)
    }
}

/// The item `by` positions further in a list that wraps around.
fn next<T: Copy + PartialEq>(list: &[T], now: T, by: i32) -> T {
    let place = list.iter().position(|item| *item == now).unwrap_or_default();
    let further = (place as i64 + i64::from(by)).rem_euclid(list.len().max(1) as i64);
    list.get(further as usize).copied().unwrap_or(now)
}
