//! Colours by name.

use embedded_graphics::pixelcolor::{Rgb888, WebColors};

macro_rules! css {
    ($($name:ident)*) => {
        /// The CSS names as `embedded-graphics` spells them: capitals, with underscores between words.
        const CSS: &[(&str, Rgb888)] = &[$((stringify!($name), Rgb888::$name)),*];
    };
}

css! {
    CSS_ALICE_BLUE CSS_ANTIQUE_WHITE CSS_AQUA CSS_AQUAMARINE CSS_AZURE CSS_BEIGE CSS_BISQUE CSS_BLACK
    CSS_BLANCHED_ALMOND CSS_BLUE CSS_BLUE_VIOLET CSS_BROWN CSS_BURLY_WOOD CSS_CADET_BLUE CSS_CHARTREUSE
    CSS_CHOCOLATE CSS_CORAL CSS_CORNFLOWER_BLUE CSS_CORNSILK CSS_CRIMSON CSS_CYAN CSS_DARK_BLUE
    CSS_DARK_CYAN CSS_DARK_GOLDENROD CSS_DARK_GRAY CSS_DARK_GREEN CSS_DARK_KHAKI CSS_DARK_MAGENTA
    CSS_DARK_OLIVE_GREEN CSS_DARK_ORANGE CSS_DARK_ORCHID CSS_DARK_RED CSS_DARK_SALMON CSS_DARK_SEA_GREEN
    CSS_DARK_SLATE_BLUE CSS_DARK_SLATE_GRAY CSS_DARK_TURQUOISE CSS_DARK_VIOLET CSS_DEEP_PINK
    CSS_DEEP_SKY_BLUE CSS_DIM_GRAY CSS_DODGER_BLUE CSS_FIRE_BRICK CSS_FLORAL_WHITE CSS_FOREST_GREEN
    CSS_FUCHSIA CSS_GAINSBORO CSS_GHOST_WHITE CSS_GOLD CSS_GOLDENROD CSS_GRAY CSS_GREEN CSS_GREEN_YELLOW
    CSS_HONEYDEW CSS_HOT_PINK CSS_INDIAN_RED CSS_INDIGO CSS_IVORY CSS_KHAKI CSS_LAVENDER
    CSS_LAVENDER_BLUSH CSS_LAWN_GREEN CSS_LEMON_CHIFFON CSS_LIGHT_BLUE CSS_LIGHT_CORAL CSS_LIGHT_CYAN
    CSS_LIGHT_GOLDENROD_YELLOW CSS_LIGHT_GRAY CSS_LIGHT_GREEN CSS_LIGHT_PINK CSS_LIGHT_SALMON
    CSS_LIGHT_SEA_GREEN CSS_LIGHT_SKY_BLUE CSS_LIGHT_SLATE_GRAY CSS_LIGHT_STEEL_BLUE CSS_LIGHT_YELLOW
    CSS_LIME CSS_LIME_GREEN CSS_LINEN CSS_MAGENTA CSS_MAROON CSS_MEDIUM_AQUAMARINE CSS_MEDIUM_BLUE
    CSS_MEDIUM_ORCHID CSS_MEDIUM_PURPLE CSS_MEDIUM_SEA_GREEN CSS_MEDIUM_SLATE_BLUE
    CSS_MEDIUM_SPRING_GREEN CSS_MEDIUM_TURQUOISE CSS_MEDIUM_VIOLET_RED CSS_MIDNIGHT_BLUE CSS_MINT_CREAM
    CSS_MISTY_ROSE CSS_MOCCASIN CSS_NAVAJO_WHITE CSS_NAVY CSS_OLD_LACE CSS_OLIVE CSS_OLIVE_DRAB CSS_ORANGE
    CSS_ORANGE_RED CSS_ORCHID CSS_PALE_GOLDENROD CSS_PALE_GREEN CSS_PALE_TURQUOISE CSS_PALE_VIOLET_RED
    CSS_PAPAYA_WHIP CSS_PEACH_PUFF CSS_PERU CSS_PINK CSS_PLUM CSS_POWDER_BLUE CSS_PURPLE CSS_REBECCAPURPLE
    CSS_RED CSS_ROSY_BROWN CSS_ROYAL_BLUE CSS_SADDLE_BROWN CSS_SALMON CSS_SANDY_BROWN CSS_SEA_GREEN
    CSS_SEASHELL CSS_SIENNA CSS_SILVER CSS_SKY_BLUE CSS_SLATE_BLUE CSS_SLATE_GRAY CSS_SNOW
    CSS_SPRING_GREEN CSS_STEEL_BLUE CSS_TAN CSS_TEAL CSS_THISTLE CSS_TOMATO CSS_TURQUOISE CSS_VIOLET
    CSS_WHEAT CSS_WHITE CSS_WHITE_SMOKE CSS_YELLOW CSS_YELLOW_GREEN
}

/// Parses `gold`, `dark-sea-green`, `#ffd700` or `#fd0`. The error lists the names.
pub(crate) fn parse(text: &str) -> Result<Rgb888, String> {
    if let Some(digits) = text.strip_prefix('#') {
        return hexadecimal(digits)
            .ok_or_else(|| format!("{text} is not a colour: # needs 6 or 3 hexadecimal digits"));
    }
    let wanted = plain(text).replace("grey", "gray");
    let named = CSS.iter().find(|(name, _)| css(name) == wanted);
    named.map(|(_, colour)| *colour).ok_or_else(|| {
        let names: Vec<_> = CSS.iter().map(|(name, _)| css(name)).collect();
        format!("{text} is not a colour: use #rrggbb or a CSS name: {}", names.join(", "))
    })
}

fn hexadecimal(digits: &str) -> Option<Rgb888> {
    if !digits.chars().all(|c| c.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    let channels = match digits.len() {
        3 => [8, 4, 0].map(|shift| (number >> shift & 15) * 17),
        6 => [16, 8, 0].map(|shift| number >> shift & 255),
        _ => return None,
    };
    let [r, g, b] = channels.map(|c| c as u8); // at most 255
    Some(Rgb888::new(r, g, b))
}

/// A colour's name as CSS spells it.
fn css(name: &str) -> String {
    plain(name.trim_start_matches("CSS"))
}

fn plain(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphabetic).map(|c| c.to_ascii_lowercase()).collect()
}
