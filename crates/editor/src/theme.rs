//! Every colour and size of the editor: nothing else names one.
//!
//! Ground and ink are warm greys, so that the few colours that mean something stand out: the accent
//! for what is selected or can be taken hold of, and green, amber and red for verdicts, which
//! always come with a word or a sign too. Maps of quantities run through cividis, which people with
//! any kind of colour blindness read alike.

use eframe::egui::{self, Color32};
use sheetwright::check::Verdict;

/// Which colours people ask for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Look {
    /// As the system has it.
    #[default]
    System,
    /// Dark ink on light ground.
    Light,
    /// Light ink on dark ground.
    Dark,
    /// Black and white, and strong colours.
    HighContrast,
}

impl Look {
    /// Every look.
    pub const ALL: [Self; 4] = [Self::System, Self::Light, Self::Dark, Self::HighContrast];

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::System => "As the system",
            Self::Light => "Light",
            Self::Dark => "Dark",
            Self::HighContrast => "High contrast",
        }
    }
}

/// The colours of one look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Theme {
    /// Whether the ground is dark.
    pub is_dark: bool,
    /// The ground of bars and side panels.
    pub ground: Color32,
    /// The ground of the panes that are drawn on.
    pub paper: Color32,
    /// The ground of fields and buttons.
    pub field: Color32,
    /// Fine lines between things.
    pub line: Color32,
    /// Lines of the grid, fine and every tenth.
    pub grid: [Color32; 2],
    /// Text.
    pub ink: Color32,
    /// Text that steps back.
    pub faint: Color32,
    /// What is selected, or can be taken hold of.
    pub accent: Color32,
    /// Text on the accent.
    pub on_accent: Color32,
    /// Boundary curves.
    pub curve: Color32,
    /// Mirror lines.
    pub mirror: Color32,
    /// The sheet seen from the side that it faces, and from behind.
    pub sheet: [Color32; 2],
    /// Rungs on the sheet.
    pub rung: Color32,
    /// Lines that are cut, scored, engraved and for people alone.
    pub roles: [Color32; 4],
    /// Verdicts: fine, with care, no.
    pub verdicts: [Color32; 3],
    /// The axes x, y and z.
    pub axes: [Color32; 3],
}

const fn grey(v: u8) -> Color32 {
    Color32::from_rgb(v, v, v)
}

const fn hex(rgb: u32) -> Color32 {
    Color32::from_rgb((rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8)
}

const LIGHT: Theme = Theme {
    is_dark: false,
    ground: hex(0xf3f1ed),
    paper: hex(0xfcfbf9),
    field: hex(0xffffff),
    line: hex(0xd8d4cc),
    grid: [hex(0xeeebe5), hex(0xdedad2)],
    ink: hex(0x24221f),
    faint: hex(0x67625a),
    accent: hex(0x1763c7),
    on_accent: hex(0xffffff),
    curve: hex(0x2c3540),
    mirror: hex(0x9a4fb5),
    sheet: [hex(0xb9cde0), hex(0xe0cdb0)],
    rung: hex(0x56708c),
    roles: [hex(0xc22f2f), hex(0x1763c7), hex(0x24221f), hex(0x8b857b)],
    verdicts: [hex(0x1f7a3e), hex(0x9a6200), hex(0xb3261e)],
    axes: [hex(0xc0392b), hex(0x2e8b3d), hex(0x2d6fc4)],
};

const DARK: Theme = Theme {
    is_dark: true,
    ground: hex(0x23252a),
    paper: hex(0x1a1c20),
    field: hex(0x2f3238),
    line: hex(0x3d4047),
    grid: [hex(0x24272c), hex(0x32363d)],
    ink: hex(0xe8e6e1),
    faint: hex(0xa5a29b),
    accent: hex(0x6aaeff),
    on_accent: hex(0x10151c),
    curve: hex(0xd5dbe3),
    mirror: hex(0xcf9be4),
    sheet: [hex(0x6d8dae), hex(0x9c8560)],
    rung: hex(0xb9cbe0),
    roles: [hex(0xff7d72), hex(0x6aaeff), hex(0xe8e6e1), hex(0x8f8b84)],
    verdicts: [hex(0x6fd08c), hex(0xf0b849), hex(0xff8a80)],
    axes: [hex(0xf07167), hex(0x72c97f), hex(0x6aaeff)],
};

const HIGH_CONTRAST: Theme = Theme {
    is_dark: true,
    ground: grey(0),
    paper: grey(0),
    field: grey(0),
    line: grey(255),
    grid: [hex(0x2a2a2a), hex(0x5a5a5a)],
    ink: grey(255),
    faint: grey(230),
    accent: hex(0xffe14d),
    on_accent: grey(0),
    curve: grey(255),
    mirror: hex(0xff9dff),
    sheet: [hex(0x3f6fa8), hex(0xa87a2e)],
    rung: grey(255),
    roles: [hex(0xff8a80), hex(0x7fd0ff), grey(255), hex(0xc8c8c8)],
    verdicts: [hex(0x7dff9c), hex(0xffd84d), hex(0xff9a90)],
    axes: [hex(0xff8a80), hex(0x7dff9c), hex(0x7fd0ff)],
};

/// A value of 0 ..= 1 on cividis \[Nunez2018\], by straight lines between nine of its colours.
pub fn mapped(value: f64) -> Color32 {
    const STOPS: [u32; 9] =
        [0x00224e, 0x223b6e, 0x434e6c, 0x5d626e, 0x777776, 0x948e77, 0xb5a771, 0xd6c160, 0xfee838];
    let at = value.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let below = (at as usize).min(STOPS.len() - 2);
    let share = (at - below as f64) as f32;
    hex(STOPS[below]).lerp_to_gamma(hex(STOPS[below + 1]), share)
}

impl Theme {
    /// The colours of a look, where the system is dark or not.
    pub fn of(look: Look, system_is_dark: bool) -> &'static Self {
        match look {
            Look::System if system_is_dark => &DARK,
            Look::Dark => &DARK,
            Look::System | Look::Light => &LIGHT,
            Look::HighContrast => &HIGH_CONTRAST,
        }
    }

    /// The colour of a verdict.
    pub fn verdict(&self, verdict: Verdict) -> Color32 {
        match verdict {
            Verdict::Bends | Verdict::Roll | Verdict::BendsAndFolds => self.verdicts[0],
            Verdict::BendsWithForce | Verdict::Undecided => self.verdicts[1],
            Verdict::WillNotBend => self.verdicts[2],
        }
    }

    /// The fonts: what Ubuntu's lacks (arrows, signs, the narrow blank between digits) is in Hack.
    pub fn load_fonts(ctx: &egui::Context) {
        let mut fonts = egui::FontDefinitions::default();
        if let Some(family) = fonts.families.get_mut(&egui::FontFamily::Proportional) {
            family.push("Hack".to_owned());
        }
        ctx.set_fonts(fonts);
    }

    /// Dresses everything that egui draws itself.
    pub fn apply(&self, ctx: &egui::Context) {
        let visuals = if self.is_dark { egui::Visuals::dark() } else { egui::Visuals::light() };
        let mut style = egui::Style { visuals, ..egui::Style::default() };
        let v = &mut style.visuals;
        v.panel_fill = self.ground;
        v.window_fill = self.ground;
        v.extreme_bg_color = self.field;
        v.faint_bg_color = self.paper;
        // No colour over all text: what is selected has the ink of its ground.
        v.override_text_color = None;
        v.weak_text_color = Some(self.faint);
        v.hyperlink_color = self.accent;
        v.selection.bg_fill = self.accent;
        v.selection.stroke = egui::Stroke::new(1.0, self.on_accent);
        v.window_stroke = egui::Stroke::new(1.0, self.line);
        v.warn_fg_color = self.verdicts[1];
        v.error_fg_color = self.verdicts[2];
        let widgets = &mut v.widgets;
        widgets.noninteractive.bg_fill = self.ground;
        widgets.noninteractive.bg_stroke = egui::Stroke::new(1.0, self.line);
        widgets.noninteractive.fg_stroke = egui::Stroke::new(1.0, self.ink);
        for widget in
            [&mut widgets.inactive, &mut widgets.hovered, &mut widgets.active, &mut widgets.open]
        {
            widget.bg_fill = self.field;
            widget.weak_bg_fill = self.field;
            widget.fg_stroke = egui::Stroke::new(1.0, self.ink);
            widget.bg_stroke = egui::Stroke::new(1.0, self.line);
            widget.corner_radius = egui::CornerRadius::same(5);
        }
        widgets.hovered.bg_stroke = egui::Stroke::new(1.5, self.accent);
        widgets.active.bg_stroke = egui::Stroke::new(2.0, self.accent);
        widgets.active.weak_bg_fill = self.line;
        style.spacing.item_spacing = egui::vec2(8.0, 7.0);
        style.spacing.button_padding = egui::vec2(10.0, 5.0);
        style.spacing.interact_size = egui::vec2(40.0, 26.0);
        style.spacing.window_margin = egui::Margin::same(14);
        // Seen wherever there is more than fits, and beside what scrolls instead of over it.
        style.spacing.scroll = egui::style::ScrollStyle {
            bar_width: SCROLL_BAR,
            floating_width: SCROLL_BAR,
            floating_allocated_width: SCROLL_BAR + 4.0,
            foreground_color: true,
            dormant_background_opacity: 0.0,
            active_background_opacity: 0.0,
            interact_background_opacity: 0.0,
            dormant_handle_opacity: 0.3,
            active_handle_opacity: 0.45,
            interact_handle_opacity: 0.7,
            ..egui::style::ScrollStyle::floating()
        };
        use egui::{FontFamily::Proportional, FontId, TextStyle};
        style.text_styles.insert(TextStyle::Body, FontId::new(14.0, Proportional));
        style.text_styles.insert(TextStyle::Button, FontId::new(14.0, Proportional));
        style.text_styles.insert(TextStyle::Small, FontId::new(12.0, Proportional));
        style.text_styles.insert(TextStyle::Heading, FontId::new(19.0, Proportional));
        ctx.set_global_style(style);
    }
}

/// The size of a handle that a finger can take hold of, points.
pub const TOUCH: f32 = 40.0;
/// The radius of a handle as it is drawn, points.
pub const HANDLE: f32 = 5.0;
/// The width of a scroll bar, points.
pub const SCROLL_BAR: f32 = 7.0;
/// The width of a boundary curve, points.
pub const CURVE_WIDTH: f32 = 2.0;

#[cfg(test)]
mod tests {
    use super::*;

    /// How much lighter one colour is than another, 1 ..= 21, as WCAG 2 measures it; here with
    /// powers of 2.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let light = |c: Color32| {
            let [r, g, b] =
                [c.r(), c.g(), c.b()].map(|v| (f32::from(v) / 255.0) * (f32::from(v) / 255.0));
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (a, b) = (light(a) + 0.05, light(b) + 0.05);
        (a / b).max(b / a)
    }

    #[test]
    fn what_is_selected_can_be_read() {
        for look in Look::ALL {
            let ctx = egui::Context::default();
            let theme = Theme::of(look, false);
            theme.apply(&ctx);
            let visuals = ctx.global_style().visuals.clone();
            // A colour over all text would be that of selected text too.
            assert_eq!(visuals.override_text_color, None);
            let selected = contrast(visuals.selection.stroke.color, visuals.selection.bg_fill);
            let usual = contrast(visuals.text_color(), visuals.panel_fill);
            assert!(selected > 4.5 && usual > 4.5, "{look:?}: {selected} {usual}");
            assert_eq!(visuals.text_color(), theme.ink);
            assert_eq!(visuals.strong_text_color(), theme.ink);
        }
    }
}
