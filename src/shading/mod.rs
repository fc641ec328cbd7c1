//! Shaders and light: the colours of a face's pixels. The rasteriser does not depend on this module.

mod corner_values;
mod depth_tested;
mod dither;
mod emission;
mod flat;
mod fog;
mod gouraud;
mod highlight;
mod lambert;
mod levels;
mod light_error;
mod lights;
mod lit;
mod matcap;
mod normal_space;
mod point_light;
mod screen_door;
mod shader;
mod smooth;
mod sprite;
mod stroke;
mod table;
mod table_shader;
mod texture;
mod translucent;

pub use corner_values::CornerValues;
pub use depth_tested::DepthTested;
pub use dither::Dithered;
pub(crate) use dither::{Bayer, DitheredColor};
pub use flat::Flat;
pub use fog::{ExponentialFog, Fog, FogProfile, FogTable, Fogged, LinearFog, SquaredFog, VertexFog};
pub(crate) use fog::{FogBounds, FogLevel};
pub use gouraud::Gouraud;
pub(crate) use gouraud::{ChannelGradients, Nearest};
pub use highlight::BlinnPhong;
pub use lambert::{Lambert, RigidLambert};
pub use light_error::LightError;
pub use lights::{DirectionalLight, Lights};
pub use lit::Lit;
pub use matcap::Matcap;
pub use point_light::PointLight;
pub use screen_door::ScreenDoor;
pub(crate) use shader::{DrawLevels, DrawRuns};
pub use shader::{Shader, SpanShader};
pub(crate) use sprite::SpriteSize;
pub use sprite::{SolidTexel, Sprite, SpriteImage, SpriteSource};
pub use stroke::{AntiAliased, Stroke};
pub use table::{ShadeTable, TableShader};
pub use texture::{
    Accuracy, ClampedTexels, ColorKeyed, IndexKeyed, IndexedTexels, LitIndexedTexels, LitPalette, LitTexels,
    LitTextured, TexelSlice, Texels, Texture, TextureError, Textured,
};
pub(crate) use texture::{Line, PackedLine};
pub use translucent::{Blended, HalfBlended, Translucent};
