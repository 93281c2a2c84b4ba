//! What the colours of a sheet mean: a scale with its unit, and the limit of the material on it.

use crate::engine::shown::{Shown, ShownStrain};
use crate::panes::measured::{EXACT, NO_TWIST, PALE, Quantity, twist_max, unsure_max};
use crate::panes::words::{degrees, error, per_cent};
use crate::scene::Scene;
use crate::theme::{Theme, mapped};
use eframe::egui::accesskit::Role;
use eframe::egui::{
    Align2, Color32, FontId, Mesh, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo,
    pos2, vec2,
};
use sheetwright_files::share_beyond_words;

const WIDTH: f32 = 200.0;
const BAR: f32 = 10.0;
const EDGE: f32 = 12.0;
const HEIGHT: f32 = 68.0;
/// Height of the note below the scale, points.
const LINE: f32 = 18.0;

/// What stands on a scale.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Legend {
    title: String,
    /// What there is to know besides: what pale colours mean, if there are any.
    note: String,
    /// The words at its ends.
    ends: [String; 2],
    /// Where on it something is marked, and what.
    mark: Option<(f64, String)>,
    /// Whether there are colours at all.
    coloured: bool,
}

impl Legend {
    /// Of the panels of a scene.
    pub(crate) fn of(scene: &Scene<'_>, quantity: Quantity) -> Self {
        let panels = || scene.made().map(|(_, shown)| shown);
        let most = |of: fn(&Shown) -> f64| panels().map(of).fold(0.0, f64::max);
        match quantity {
            Quantity::Warp(top) => {
                let limit = most(|shown| shown.warp_limit_deg);
                let largest = most(twist_max);
                let unsure = most(unsure_max);
                let said = match (largest > NO_TWIST, unsure > 0.0) {
                    (true, _) => format!(", at most {}", degrees(largest)),
                    (false, true) => ": none that is sure".to_owned(),
                    (false, false) => ": none".to_owned(),
                };
                let note = format!("Pale: up to {}, maybe from coarse samples", degrees(unsure));
                Self {
                    title: format!("° of twist{said}"),
                    note: if unsure > 0.0 { note } else { String::new() },
                    ends: ["0°".to_owned(), degrees(top)],
                    mark: (top > 0.0).then(|| (limit / top, format!("limit {}", degrees(limit)))),
                    coloured: true,
                }
            }
            Quantity::Strain(top) if top <= 0.0 => Self {
                title: "Strain: not known yet".to_owned(),
                note: String::new(),
                ends: ["it is computed when the hand rests".to_owned(), String::new()],
                mark: None,
                coloured: false,
            },
            Quantity::Strain(top) => {
                let of = |of: fn(&ShownStrain) -> f64| {
                    let known = panels().filter_map(|shown| shown.strain.as_ref());
                    known.map(of).fold(0.0, f64::max)
                };
                let (limit, decides) = (of(|s| s.limit), of(|s| s.decides));
                Self {
                    title: match share_beyond_words(decides) {
                        Some(beyond) => format!("% of strain, 5 % by {beyond}"),
                        None => format!("% of strain, 95 % below {}", per_cent(decides)),
                    },
                    note: String::new(),
                    ends: ["0 %".to_owned(), format!("{} or more", per_cent(top))],
                    mark: Some((limit / top, format!("limit {}", per_cent(limit)))),
                    coloured: true,
                }
            }
            Quantity::LengthError(top) if top < EXACT => Self {
                title: "Lengths: exact".to_owned(),
                note: String::new(),
                ends: ["no side is longer or shorter".to_owned(), String::new()],
                mark: None,
                coloured: false,
            },
            Quantity::LengthError(top) => Self {
                title: "Longer or shorter than the sheet".to_owned(),
                note: String::new(),
                ends: ["0".to_owned(), error(top)],
                mark: None,
                coloured: true,
            },
        }
    }

    /// In a sentence.
    fn spoken(&self) -> String {
        let [low, high] = &self.ends;
        let to = if high.is_empty() { String::new() } else { format!(" to {high}") };
        let mark = self.mark.as_ref().map_or(String::new(), |(_, what)| format!(", {what}"));
        let note = if self.note.is_empty() { String::new() } else { format!(". {}", self.note) };
        format!("Legend: {}, {low}{to}{mark}{note}", self.title)
    }

    /// In the lower left corner of a pane.
    pub(crate) fn ui(&self, ui: &Ui, pane: Rect, theme: &Theme) {
        let painter = ui.painter();
        let small = FontId::proportional(12.0);
        let note = painter.layout_no_wrap(self.note.clone(), small.clone(), theme.faint);
        let noted = if self.note.is_empty() { 0.0 } else { LINE };
        let height = noted + if self.coloured { HEIGHT } else { HEIGHT - 20.0 };
        let low = pane.left_bottom() + vec2(EDGE, -EDGE - height);
        let width = WIDTH.max(note.size().x) + 2.0 * EDGE;
        let rect = Rect::from_min_size(low, vec2(width, height));
        if !pane.contains_rect(rect) {
            return;
        }
        let response = ui.interact(rect, ui.scope_id().with("legend"), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, self.spoken()));
        let edge = Stroke::new(1.0, theme.line);
        painter.rect(rect, 6.0, theme.paper.gamma_multiply(0.92), edge, StrokeKind::Inside);
        painter.galley(rect.left_bottom() + vec2(EDGE, -6.0 - LINE), note, theme.faint);
        let text = |at: Pos2, anchor: Align2, text: &str, colour| {
            painter.text(at, anchor, text, small.clone(), colour);
        };
        let title_at = rect.min + vec2(EDGE, 8.0);
        text(title_at, Align2::LEFT_TOP, &self.title, theme.ink);
        if !self.coloured {
            text(title_at + vec2(0.0, 18.0), Align2::LEFT_TOP, &self.ends[0], theme.faint);
            return;
        }
        let bar = Rect::from_min_size(rect.min + vec2(EDGE, 28.0), vec2(WIDTH, BAR));
        painter.add(scale(bar, mapped));
        if noted > 0.0 {
            let pale = |share| theme.sheet[0].lerp_to_gamma(mapped(share), PALE);
            painter.add(scale(bar.split_top_bottom_at_fraction(0.5).1, pale));
        }
        painter.rect_stroke(bar, 0.0, edge, StrokeKind::Outside);
        let below = bar.bottom() + 6.0;
        let x_of = |share: f64| bar.left() + bar.width() * share as f32;
        let mut free = [true; 2];
        if let Some((share, what)) = &self.mark {
            let x = x_of(share.clamp(0.0, 1.0)).clamp(bar.left() + 1.0, bar.right() - 1.0);
            let tick = [pos2(x, bar.top() - 4.0), pos2(x, bar.bottom() + 4.0)];
            painter.line_segment(tick, Stroke::new(4.0, theme.paper));
            painter.line_segment(tick, Stroke::new(2.0, theme.ink));
            let anchor = match *share {
                s if s > 0.8 => Align2::RIGHT_TOP,
                s if s < 0.2 => Align2::LEFT_TOP,
                _ => Align2::CENTER_TOP,
            };
            free = [*share >= 0.2 + 0.15, *share <= 0.8 - 0.15];
            if *share > 0.8 {
                free[0] = true;
            }
            if *share < 0.2 {
                free[1] = true;
            }
            let at = match anchor {
                Align2::CENTER_TOP => x,
                Align2::RIGHT_TOP => bar.right(),
                _ => bar.left(),
            };
            text(pos2(at, below), anchor, what, theme.ink);
        }
        if free[0] {
            text(pos2(bar.left(), below), Align2::LEFT_TOP, &self.ends[0], theme.faint);
        }
        if free[1] {
            text(pos2(bar.right(), below), Align2::RIGHT_TOP, &self.ends[1], theme.faint);
        }
    }
}

/// The colours from 0 to 1, left to right.
fn scale(bar: Rect, of: impl Fn(f64) -> Color32) -> Shape {
    const STEPS: u32 = 48;
    let mut mesh = Mesh::default();
    for n in 0..=STEPS {
        let share = n as f32 / STEPS as f32;
        let x = bar.left() + share * bar.width();
        let colour = of(f64::from(share));
        mesh.colored_vertex(pos2(x, bar.top()), colour);
        mesh.colored_vertex(pos2(x, bar.bottom()), colour);
        if n > 0 {
            let last = 2 * n;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last + 1, last);
        }
    }
    Shape::mesh(mesh)
}
