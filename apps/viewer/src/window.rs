//! The window: its events, and the pixels in it.

use crate::{open, tell};
use embedded_graphics::geometry::Size;
use pinhole_apps_support::command;
use pinhole_import::Options;
use pinhole_viewer::{write_png, Action, Placement, Source, State, Viewer};
use softbuffer::{Context, Surface};
use std::fmt::Display;
use std::num::NonZeroU32;
use std::panic;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

/// How often the model moves, and how often files are looked at.
const TICK: Duration = Duration::from_micros(16_667);
const LOOK: Duration = Duration::from_millis(250);

pub(crate) struct Settings {
    /// How files are imported.
    pub(crate) options: Options,
    /// The size of the display, if it is not that of a scene.
    pub(crate) size: Option<Size>,
    /// Magnification of the display at first.
    pub(crate) scale: u32,
    /// How long a script shows the window.
    pub(crate) stay: Option<Duration>,
}

/// Shows the window until it is closed.
pub(crate) fn run(viewer: Viewer, state: State, settings: Settings) -> Result<(), String> {
    let usual = refuse_by_panic();
    let events = EventLoop::new().map_err(refused)?;
    let now = Instant::now();
    let mut shown = Shown {
        viewer,
        state,
        end: settings.stay.map(|stay| now + stay),
        settings,
        screen: None,
        drawn: None,
        time: Duration::ZERO,
        cursor: [0.0; 2],
        held: None,
        next_tick: now,
        next_look: now + LOOK,
        usual: Some(usual),
        problem: None,
    };
    events.run_app(&mut shown).map_err(refused)?;
    shown.problem.map_or(Ok(()), Err)
}

fn refused(problem: impl Display) -> String {
    format!("no window can be opened: {problem}")
}

type Hook = Box<dyn Fn(&panic::PanicHookInfo<'_>) + Sync + Send>;

/// Where a library of X is missing, winit panics. Until the window is open, a panic prints one line and ends the program, because
/// a release build aborts and cannot catch it.
fn refuse_by_panic() -> Hook {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(|why| {
        let text = why.payload().downcast_ref::<String>().cloned();
        let text = text.or_else(|| Some((*why.payload().downcast_ref::<&str>()?).to_string()));
        command::complain(refused(text.unwrap_or_default().replace('\n', " ")));
        std::process::exit(2)
    }));
    usual
}

/// The window and its pixels.
struct Screen {
    window: Rc<Window>,
    surface: Surface<Rc<Window>, Rc<Window>>,
}

impl Screen {
    fn open(events: &ActiveEventLoop, display: Size, scale: u32) -> Result<Self, String> {
        let size = |factor: u32| PhysicalSize::new(display.width * factor, display.height * factor);
        let attributes = Window::default_attributes()
            .with_title("pinhole: h for the keys")
            .with_inner_size(size(scale))
            .with_min_inner_size(size(1));
        let window = Rc::new(events.create_window(attributes).map_err(refused)?);
        let context = Context::new(window.clone()).map_err(refused)?;
        let surface = Surface::new(&context, window.clone()).map_err(refused)?;
        Ok(Self { window, surface })
    }

    fn placement(&self, display: Size) -> Placement {
        Placement::new(display, self.window.inner_size().into())
    }
}

/// The content of the window, and the input of the user.
struct Shown {
    viewer: Viewer,
    state: State,
    settings: Settings,
    screen: Option<Screen>,
    /// The state in the window.
    drawn: Option<State>,
    /// The duration of a frame, smoothed over some frames.
    time: Duration,
    /// Where the mouse is in the window, and the pixel of the display that it drags.
    cursor: [f64; 2],
    held: Option<[i32; 2]>,
    next_tick: Instant,
    next_look: Instant,
    /// The end of a script.
    end: Option<Instant>,
    /// The panic hook for the time after the window is open.
    usual: Option<Hook>,
    problem: Option<String>,
}

impl Shown {
    fn draw(&mut self) -> Result<(), String> {
        let Some(screen) = &mut self.screen else { return Ok(()) };
        let size = screen.window.inner_size();
        let sides = NonZeroU32::new(size.width).zip(NonZeroU32::new(size.height));
        let Some((width, height)) = sides else { return Ok(()) }; // minimised
        let start = Instant::now();
        self.viewer.draw(&self.state)?;
        if self.drawn != Some(self.state) {
            let first = self.drawn.is_none();
            self.time = if first { start.elapsed() } else { (self.time * 7 + start.elapsed()) / 8 };
            self.drawn = Some(self.state);
        }
        let time = self.settings.stay.is_none().then_some(self.time);
        let picture = self.viewer.picture(&self.state, time);
        let placement = screen.placement(self.viewer.size());
        screen.surface.resize(width, height).map_err(refused)?;
        let mut cells = screen.surface.buffer_mut().map_err(refused)?;
        placement.fill(&picture, &mut cells);
        cells.present().map_err(refused)
    }

    fn act(&mut self, action: Action, events: &ActiveEventLoop) -> Result<(), String> {
        match action {
            Action::Quit => events.exit(),
            Action::Screenshot => {
                let file = free_name();
                write_png(&file, self.viewer.size(), &self.viewer.picture(&self.state, None))?;
                command::say(format_args!("{}: what the window shows", file.display()))?;
            }
            action => self.state.apply(action),
        }
        Ok(())
    }

    /// Shows another file, as if the program had been started with it.
    fn show(&mut self, file: &Path) -> Result<(), String> {
        let source = Source::read(file, &self.settings.options)?;
        let state = source.state();
        let mut viewer = open(source, self.settings.size)?;
        viewer.draw(&state)?;
        tell(viewer.source())?;
        (self.viewer, self.state) = (viewer, state);
        if let Some(screen) = &self.screen {
            let Size { width, height } = self.viewer.size();
            screen.window.set_min_inner_size(Some(PhysicalSize::new(width, height)));
        }
        Ok(())
    }

    fn redraw(&mut self) {
        self.drawn = None;
        self.screen.iter().for_each(|screen| screen.window.request_redraw());
    }

    fn event(&mut self, event: WindowEvent, events: &ActiveEventLoop) -> Result<(), String> {
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::RedrawRequested => return self.draw(),
            WindowEvent::Resized(_) => self.redraw(),
            WindowEvent::KeyboardInput { event, .. } if event.state == ElementState::Pressed => {
                if let Some(action) = name(&event.logical_key).and_then(State::key) {
                    return self.act(action, events);
                }
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let steps = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => lines.round() as i32,
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y.signum() as i32,
                };
                self.state.apply(Action::Zoom(steps));
            }
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => {
                self.held = self.pointed_at().filter(|_| state == ElementState::Pressed);
            }
            WindowEvent::CursorMoved { position, .. } => {
                self.cursor = position.into();
                if let Some(([from_x, from_y], [x, y])) = self.held.zip(self.pointed_at()) {
                    self.state.drag(x - from_x, y - from_y);
                    self.held = Some([x, y]);
                }
            }
            WindowEvent::DroppedFile(file) => {
                if let Err(problem) = self.show(&file) {
                    command::complain(&problem);
                    self.viewer.set_notice(problem);
                }
                self.redraw();
            }
            _ => {}
        }
        Ok(())
    }

    /// The pixel of the display under the mouse.
    fn pointed_at(&self) -> Option<[i32; 2]> {
        Some(self.screen.as_ref()?.placement(self.viewer.size()).pixel(self.cursor))
    }

    fn end_with(&mut self, result: Result<(), String>, events: &ActiveEventLoop) {
        if let Err(problem) = result {
            self.problem = Some(problem);
            events.exit();
        }
    }
}

impl ApplicationHandler for Shown {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let opened = Screen::open(events, self.viewer.size(), self.settings.scale);
        let opened = opened.map(|screen| self.screen = Some(screen));
        self.end_with(opened, events);
        self.usual.take().into_iter().for_each(panic::set_hook);
        self.redraw();
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let result = self.event(event, events);
        self.end_with(result, events);
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let now = Instant::now();
        if self.end.is_some_and(|end| now >= end) {
            return events.exit();
        }
        if now >= self.next_tick {
            self.state.tick();
            self.next_tick = now + TICK;
        }
        if now >= self.next_look {
            self.next_look = now + LOOK;
            if self.viewer.reload() {
                self.redraw();
            }
        }
        if self.drawn.is_some_and(|drawn| drawn != self.state) {
            self.screen.iter().for_each(|screen| screen.window.request_redraw());
        }
        events.set_control_flow(ControlFlow::WaitUntil(self.next_tick));
    }
}

/// The first file name `viewer-N.png` that does not exist.
fn free_name() -> PathBuf {
    let mut names = (1..).map(|number| PathBuf::from(format!("viewer-{number}.png")));
    names.find(|file| !file.exists()).unwrap_or_default()
}

/// The key's name for [`State::key`].
fn name(key: &Key) -> Option<&str> {
    Some(match key {
        Key::Character(character) => character,
        Key::Named(NamedKey::Space) => "space",
        Key::Named(NamedKey::ArrowLeft) => "left",
        Key::Named(NamedKey::ArrowRight) => "right",
        Key::Named(NamedKey::ArrowUp) => "up",
        Key::Named(NamedKey::ArrowDown) => "down",
        _ => return None,
    })
}
