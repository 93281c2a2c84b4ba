//! The flat pattern: all parts beside one another, as they will be cut, with their dimensions.
//!
//! Where parts lie depends on their shapes and on the pane alone, not on what is looked at, and
//! stays while a button is down. Files have each piece as the kernel laid it.

mod arrange;
mod pack;
mod paint;
mod view;

use super::measured::{Quantity, worst_of_all};
use super::space::legend::Legend;
use super::space::pick::share_along;
use super::words::{length, length_bare};
use crate::document::Selection;
use crate::document::edit::why_no_panel;
use crate::engine::shown::Shown;
use crate::panes::marks::Marks;
use crate::scene::{Act, Scene};
use crate::views::SurfaceView;
use arrange::{Arrangement, ShownPart};
use eframe::egui::accesskit::Role;
use eframe::egui::emath::GuiRounding as _;
use eframe::egui::{
    Align2, EventFilter, FontId, InputState, Key, Modifiers, Pos2, Rect, Response, Sense, Stroke,
    StrokeKind, Ui, UiBuilder, Vec2, WidgetInfo, vec2,
};
use sheetwright::check::Place;
use sheetwright::design::Design;
use sheetwright::math::{Point2, Vec2 as Way, pow};
use sheetwright_files::Units;
use view::{PatternView, box_of};

/// A pane of this height has room for a legend, points.
const LEGEND_FROM: f32 = 360.0;
/// Names that a hint lists, at the most.
const LISTED: usize = 12;

/// A rung is hit within this, points.
const NEAR: f32 = 6.0;
/// How high a legend is with the room around it, points.
const LEGEND: f32 = 102.0;
/// How far an arrow key shifts, points.
const ARROW: f32 = 40.0;

/// The pane, with what it keeps from frame to frame.
#[derive(Debug)]
pub struct PatternPane {
    view: PatternView,
    arrangement: Arrangement,
    /// What it is the arrangement of.
    arranged: Option<Arranged>,
    /// Whether everything is kept in sight, until the hand moves the view.
    follows: bool,
    /// A panel and a place on it that are to be brought into sight.
    to_bring: Option<(usize, Place)>,
}

/// What parts are arranged for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Arranged {
    panels_version: u64,
    units: Units,
    pane: Vec2,
}

impl Default for PatternPane {
    fn default() -> Self {
        let arrangement = Arrangement::default();
        let view = PatternView::default();
        Self { view, arrangement, arranged: None, follows: true, to_bring: None }
    }
}

impl PatternPane {
    /// A pane that keeps everything in sight.
    pub fn new() -> Self {
        Self::default()
    }

    /// Brings everything into sight, and keeps it there until the hand moves the view.
    pub fn fit(&mut self) {
        self.follows = true;
    }

    /// Brings a place on a panel into sight, where it is not.
    pub(crate) fn bring_into_sight(&mut self, panel: usize, place: Place) {
        self.to_bring = Some((panel, place));
    }

    /// Moves what is to be seen into the middle, unless it is in sight.
    fn bring(&mut self, scene: &Scene<'_>, parts: &[ShownPart], rect: Rect) {
        let Some((panel, place)) = self.to_bring.take() else { return };
        let piece = parts.iter().map(|part| &part.placed).find(|piece| piece.panel == panel);
        let Some((piece, shown)) = piece.zip(made(scene, panel)) else { return };
        let points = Marks::of(&place, shown).flat_points();
        let seen = points.iter().map(|&p| self.view.seen(piece.on_paper(p), rect));
        let seen: Vec<Pos2> = seen.collect();
        if !seen.iter().all(|&at| rect.contains(at)) {
            self.view.pan(rect.center() - Rect::from_points(&seen).center());
            self.follows = false;
        }
    }

    /// Shows the pieces and answers the hand.
    pub fn ui(&mut self, ui: &mut Ui, scene: &Scene<'_>, view: SurfaceView, acts: &mut Vec<Act>) {
        let (rect, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
        let rect = rect.round_to_pixels(ui.pixels_per_point());
        if !rect.is_positive() {
            return;
        }
        let mut ui = ui.new_child(UiBuilder::new().max_rect(rect).id_salt("pattern"));
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        let ui = &ui;
        let theme = scene.theme;
        ui.painter().rect_filled(rect, 0.0, theme.paper);
        let ground = ui.interact(rect, ui.scope_id().with("ground"), Sense::click_and_drag());
        name(ui, &ground, scene);
        self.navigate(ui, rect, &ground);
        if ground.clicked() || ground.drag_started() {
            ground.request_focus();
        }
        let by = Quantity::of(view, scene.made().map(|(_, shown)| shown));
        let worst = worst_of_all(scene).map(|(panel, _)| panel);
        self.arrange(ui, scene, rect);
        let parts = self.arrangement.shown(scene, worst, &self.view);
        self.bring(scene, &parts, rect);
        let mut clicked = ground.clicked().then(|| ground.interact_pointer_pos()).flatten();
        for part in &parts {
            let piece = &part.placed;
            let Some(shown) = made(scene, piece.panel) else { continue };
            let around = box_of(piece, &self.view, rect);
            clicked = clicked.or(Self::part(ui, scene, part, around, acts));
            let is_worst = worst == Some(piece.panel);
            let name = self.arrangement.is_named.then_some(&part.name[..]);
            let look = paint::Look {
                view: &self.view,
                rect,
                piece,
                by,
                detail: view,
                is_worst,
                name,
                free: part.free,
            };
            paint::piece(ui.painter(), scene, shown, &look);
        }
        if let Some(at) = clicked {
            let found = self.selected(scene, &parts, rect, at);
            if ground.double_clicked() && found.is_empty() {
                self.fit();
                ui.ctx().request_repaint();
            } else if found != *scene.selection {
                acts.push(Act::Select(found));
            }
        }
        if ground.has_focus() {
            let ring = Stroke::new(1.5, theme.accent);
            ui.painter().rect_stroke(rect, 0.0, ring, StrokeKind::Inside);
        }
        // The pane of space has the same, and a low pane no room for it.
        let has_room = rect.height() > LEGEND_FROM;
        if let Some(by) = by.filter(|_| !parts.is_empty() && has_room) {
            Legend::of(scene, by).ui(ui, rect, theme);
        }
        words(ui, scene, rect);
    }

    /// Lays the parts out, if there are other ones, or other shapes and no hand at work; and brings
    /// all into sight where that is kept up.
    fn arrange(&mut self, ui: &Ui, scene: &Scene<'_>, rect: Rect) {
        // The legend has the lower edge for itself, whether or not it is shown now.
        let legend = if rect.height() > LEGEND_FROM { LEGEND } else { 0.0 };
        let free = rect.with_max_y(rect.bottom() - legend);
        let now = Arranged {
            panels_version: scene.panels_version,
            units: scene.document.drawing.units,
            pane: rect.size(),
        };
        if self.arranged != Some(now) {
            let is_resized = self.arranged.is_none_or(|then| then.pane != now.pane);
            let is_held = ui.input(|i| i.pointer.any_down()) && !is_resized;
            if is_held && self.arrangement.is_of(scene) {
                // It stays as it is until the hand rests.
            } else if !self.follows && self.arrangement.renewed(scene) {
                self.arranged = Some(now);
            } else {
                let texts = |members: &[usize]| {
                    let size = made(scene, members[0]).map_or(Way::ZERO, |s| s.piece.size);
                    paint::texts(ui.painter(), scene, &arrange::name(scene, members), size)
                };
                self.arrangement = Arrangement::new(scene, free.size(), texts, paint::takes);
                self.arranged = Some(now);
            }
        }
        if self.follows {
            self.view = self.arrangement.view;
            self.view.pan(free.center() - rect.center());
        }
    }

    /// The widgets of a part, one for each of its panels: it can have the focus, and a key selects
    /// the panel. A click of the hand comes back.
    fn part(
        ui: &Ui,
        scene: &Scene<'_>,
        part: &ShownPart,
        around: Rect,
        acts: &mut Vec<Act>,
    ) -> Option<Pos2> {
        let mut by_hand = None;
        let units = scene.document.drawing.units;
        for &panel in &part.members {
            let Some(shown) = made(scene, panel) else { continue };
            let response =
                ui.interact(around, ui.scope_id().with(("piece", panel)), Sense::click());
            let text = format!("{}, {}", scene.panels[panel].name, size(shown.piece.size, units));
            let chosen = scene.selection.panel == Some(panel);
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, &text));
            if response.has_focus() {
                let ring = Stroke::new(1.5, scene.theme.accent);
                ui.painter().rect_stroke(around.expand(6.0), 4.0, ring, StrokeKind::Middle);
            }
            if response.clicked() {
                by_hand = response.interact_pointer_pos();
                if by_hand.is_none() {
                    let panel = Some(panel);
                    acts.push(Act::Select(Selection { panel, ..Selection::default() }));
                }
            }
            response.on_hover_ui(|ui| {
                ui.label(hint(scene, part));
            });
        }
        by_hand
    }

    fn navigate(&mut self, ui: &Ui, rect: Rect, ground: &Response) {
        let before = self.view;
        if let Some(touch) = ui.input(InputState::multi_touch) {
            if rect.contains(touch.center_pos) {
                self.view.pan(touch.translation_delta);
                self.view.zoom(f64::from(touch.zoom_delta), touch.center_pos, rect);
            }
        } else {
            self.view.pan(ground.drag_delta());
            let (at, scrolled, pinched) =
                ui.input(|i| (i.pointer.hover_pos(), i.smooth_scroll_delta(), i.zoom_delta()));
            if let Some(at) = at.filter(|_| ui.rect_contains_pointer(rect)) {
                self.view.zoom(pow(2.0, f64::from(scrolled.y) / 240.0), at, rect);
                self.view.zoom(f64::from(pinched), at, rect);
            }
        }
        if ground.has_focus() {
            let arrows = EventFilter {
                horizontal_arrows: true,
                vertical_arrows: true,
                ..EventFilter::default()
            };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(ground.id, arrows));
            let (way, closer) = ui.input_mut(|i| {
                let mut pressed = |key| i.count_and_consume_key(Modifiers::NONE, key) as f32;
                let x = pressed(Key::ArrowLeft) - pressed(Key::ArrowRight);
                let y = pressed(Key::ArrowUp) - pressed(Key::ArrowDown);
                let closer = pressed(Key::Plus) + pressed(Key::Equals) - pressed(Key::Minus);
                (Vec2::new(x, y) * ARROW, closer)
            });
            self.view.pan(way);
            self.view.zoom(pow(1.25, f64::from(closer)), rect.center(), rect);
        }
        if self.view != before {
            self.follows = false;
        }
    }

    /// What a click selects: the rung there, else the piece.
    fn selected(&self, scene: &Scene<'_>, parts: &[ShownPart], rect: Rect, at: Pos2) -> Selection {
        let mut best: Option<(f32, Selection)> = None;
        for piece in parts.iter().map(|part| &part.placed) {
            let Some(shown) = made(scene, piece.panel) else { continue };
            let seen = |n: u32| {
                let p = shown.flat.get(n as usize).copied().unwrap_or_default();
                self.view.seen(piece.on_paper(p), rect)
            };
            for (n, rung) in shown.rungs.iter().enumerate() {
                let [a, b] = rung.flat_ends.map(seen);
                let apart = a.lerp(b, share_along(a, b, at)).distance(at);
                if apart <= NEAR && best.as_ref().is_none_or(|(least, _)| apart < *least) {
                    best = Some((apart, Selection::of_rung(piece.panel, n)));
                }
            }
        }
        if let Some((_, found)) = best {
            return found;
        }
        let place = self.view.under(at, rect);
        let on = |part: &&ShownPart| {
            let own = part.placed.on_piece(place);
            made(scene, part.placed.panel).is_some_and(|shown| covers(shown, own))
        };
        let panel = parts.iter().find(on).map(|part| part.placed.panel);
        Selection { panel, ..Selection::default() }
    }
}

/// Whether a place of the sheet is on one of its triangles.
fn covers(shown: &Shown, p: Point2) -> bool {
    let at = |n: u32| shown.flat.get(n as usize).copied().unwrap_or_default();
    let side = |a: Point2, b: Point2| (b - a).perp_dot(p - a);
    shown.flat_triangles.iter().any(|t| {
        let [a, b, c] = t.map(at);
        let turns = [side(a, b), side(b, c), side(c, a)];
        turns.iter().all(|&turn| turn >= 0.0) || turns.iter().all(|&turn| turn <= 0.0)
    })
}

fn made<'a>(scene: &Scene<'a>, panel: usize) -> Option<&'a Shown> {
    scene.panels.get(panel)?.made.as_ref().ok()
}

/// What a part is, how large, and what for: `gore ×12`, `812 × 340 mm each`, and its panels.
fn hint(scene: &Scene<'_>, part: &ShownPart) -> String {
    let Some(shown) = made(scene, part.placed.panel) else { return String::new() };
    let size = size(shown.piece.size, scene.document.drawing.units);
    let [_, _, ..] = part.members[..] else { return format!("{}\n{size}", part.name) };
    let names = part.members.iter().map(|&n| scene.panels[n].name.as_str());
    let names: Vec<&str> = names.take(LISTED).collect();
    let more = if part.members.len() > LISTED { ", …" } else { "" };
    format!("{}\n{size} each\n{}{more}", part.name, names.join(", "))
}

/// Width and height: `812 × 340 mm`.
fn size(of: Way, units: Units) -> String {
    format!("{} × {}", length_bare(of.x, units), length(of.y, units))
}

/// The name of the pane and what there is to say of it.
fn name(ui: &Ui, ground: &Response, scene: &Scene<'_>) {
    ground.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Flat pattern"));
    ui.ctx().accesskit_node_builder(ground.id, |node| {
        let units = scene.document.drawing.units;
        let of = |(n, shown): (usize, &Shown)| {
            format!("{} {}", scene.panels[n].name, size(shown.piece.size, units))
        };
        let pieces: Vec<String> = scene.made().map(of).collect();
        let text = match &pieces[..] {
            [] => "No pieces.".to_owned(),
            [one] => format!("1 piece: {one}."),
            more => format!("{} pieces: {}.", more.len(), more.join("; ")),
        };
        node.set_description(text);
    });
}

/// What there is no pattern of, and why.
fn words(ui: &Ui, scene: &Scene<'_>, rect: Rect) {
    let theme = scene.theme;
    let font = FontId::proportional(14.0);
    let refused: Vec<String> = scene
        .panels
        .iter()
        .filter_map(|panel| {
            let refusal = panel.made.as_ref().err()?;
            Some(format!("{}: {} {}", panel.name, refusal.message, refusal.hint))
        })
        .collect();
    if !refused.is_empty() && scene.made().next().is_some() {
        // Why stands on their cards, and would hide the patterns here.
        let text = match refused.len() {
            1 => "1 panel has no pattern yet".to_owned(),
            count => format!("{count} panels have no pattern yet"),
        };
        let foot = rect.left_bottom() + vec2(14.0, -LEGEND);
        ui.painter().text(foot, Align2::LEFT_BOTTOM, text, font, theme.verdicts[2]);
    } else if !refused.is_empty() {
        let width = (rect.width() - 28.0).max(80.0);
        let galley = ui.painter().layout(refused.join("\n"), font, theme.verdicts[2], width);
        let response = ui.interact(
            Rect::from_min_size(rect.min + vec2(14.0, 12.0), galley.size()),
            ui.scope_id().with("refused"),
            Sense::hover(),
        );
        let text = galley.text().to_owned();
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &text));
        ui.painter().galley(rect.min + vec2(14.0, 12.0), galley, theme.verdicts[2]);
    } else if scene.panels.is_empty() {
        let Design { curves, panels, .. } = &scene.document.design;
        let text = match (curves.is_empty(), panels.is_empty()) {
            (true, true) => "Draw a closed outline on the plan to see its pattern here.".to_owned(),
            (true, false) => "Working it out…".to_owned(),
            (false, _) => why_no_panel(scene.document),
        };
        let galley = ui.painter().layout(text.clone(), font, theme.faint, rect.width() - 40.0);
        let at = Align2::CENTER_CENTER.anchor_size(rect.center(), galley.size());
        let response = ui.interact(at, ui.scope_id().with("empty"), Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &text));
        ui.painter().galley(at.min, galley, theme.faint);
    }
}
