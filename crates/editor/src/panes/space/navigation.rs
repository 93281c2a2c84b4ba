//! What the hand does to the view: which button with which keys turns, shifts and zooms, in one
//! table, so that people find their way with the habits that they bring.

use super::camera::{ARROW_TURN, Camera};
use crate::views::Navigation;
use eframe::egui::{InputState, Key, Modifiers, PointerButton, Rect, Response, Ui, Vec2};
use sheetwright::math::pow;

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Round the target.
    Orbit,
    /// Across the picture.
    Pan,
    /// Closer or farther.
    Zoom,
}

/// A button, the keys held with it, and what a drag with it does.
type Binding = (PointerButton, Modifiers, Motion);

use Motion::{Orbit, Pan, Zoom};
use PointerButton::{Middle, Primary, Secondary};
const NONE: Modifiers = Modifiers::NONE;
const SHIFT: Modifiers = Modifiers::SHIFT;
const CTRL: Modifiers = Modifiers::CTRL;

impl Navigation {
    /// The table.
    fn bindings(self) -> &'static [Binding] {
        match self {
            Self::Sheetwright => &[
                (Primary, NONE, Orbit),
                (Primary, SHIFT, Pan),
                (Secondary, NONE, Orbit),
                (Secondary, SHIFT, Pan),
                (Middle, NONE, Pan),
            ],
            Self::Blender => &[(Middle, NONE, Orbit), (Middle, SHIFT, Pan), (Middle, CTRL, Zoom)],
            Self::SketchUp => &[(Middle, NONE, Orbit), (Middle, SHIFT, Pan)],
            Self::Rhino => {
                &[(Secondary, NONE, Orbit), (Secondary, SHIFT, Pan), (Secondary, CTRL, Zoom)]
            }
        }
    }

    /// What a drag with a button does.
    pub fn motion(self, button: PointerButton, held: Modifiers) -> Option<Motion> {
        let held = Modifiers { alt: false, mac_cmd: false, command: false, ..held };
        let mut bindings = self.bindings().iter();
        bindings.find(|(b, keys, _)| *b == button && *keys == held).map(|&(_, _, motion)| motion)
    }
}

/// How much a step of a wheel's scroll zooms, per point.
const WHEEL: f64 = 1.0 / 240.0;
/// How much a key zooms.
const KEY_ZOOM: f64 = 1.25;

/// Moves the camera as the hand does on the ground of the pane; whether it did.
pub fn drag(camera: &mut Camera, by: Navigation, ground: &Response, rect: Rect, ui: &Ui) -> bool {
    let (held, touched) = ui.input(|i| (i.modifiers, i.any_touches()));
    if ui.input(InputState::multi_touch).is_some() {
        return false;
    }
    for button in [Primary, Secondary, Middle] {
        if !ground.dragged_by(button) {
            continue;
        }
        // One finger always turns: it has no other button.
        let motion = if touched { Some(Orbit) } else { by.motion(button, held) };
        let way = ground.drag_delta();
        match motion {
            Some(Orbit) => camera.orbit(way, rect),
            Some(Pan) => camera.pan(way, rect),
            Some(Zoom) => camera.zoom(pow(1.01, -f64::from(way.y)), rect.center(), rect),
            None => continue,
        }
        return way != Vec2::ZERO;
    }
    false
}

/// Wheel, pinch and two fingers; whether they did anything.
pub fn wheel(camera: &mut Camera, rect: Rect, ui: &Ui) -> bool {
    if let Some(touch) = ui.input(InputState::multi_touch) {
        if !rect.contains(touch.center_pos) {
            return false;
        }
        camera.pan(touch.translation_delta, rect);
        camera.zoom(f64::from(touch.zoom_delta), touch.center_pos, rect);
        return true;
    }
    let (at, scrolled, pinched) =
        ui.input(|i| (i.pointer.hover_pos(), i.smooth_scroll_delta(), i.zoom_delta()));
    let Some(at) = at.filter(|_| ui.rect_contains_pointer(rect)) else { return false };
    let factor = pow(2.0, f64::from(scrolled.y) * WHEEL) * f64::from(pinched);
    if factor == 1.0 {
        return false;
    }
    camera.zoom(factor, at, rect);
    true
}

/// Keys while the pane has the focus; whether they did anything.
pub fn keys(camera: &mut Camera, rect: Rect, ui: &Ui) -> bool {
    let before = *camera;
    ui.input_mut(|i| {
        let mut pressed = |key| f64::from(i.count_and_consume_key(NONE, key) as u32);
        let turn = pressed(Key::ArrowRight) - pressed(Key::ArrowLeft);
        let lift = pressed(Key::ArrowUp) - pressed(Key::ArrowDown);
        let closer = pressed(Key::Plus) + pressed(Key::Equals) - pressed(Key::Minus);
        camera.turn(turn * ARROW_TURN, lift * ARROW_TURN);
        camera.zoom(pow(KEY_ZOOM, closer), rect.center(), rect);
    });
    *camera != before
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_habit_turns_and_shifts_by_a_drag() {
        for by in Navigation::ALL {
            let motions: Vec<Motion> = by.bindings().iter().map(|b| b.2).collect();
            assert!(motions.contains(&Orbit) && motions.contains(&Pan), "{}", by.name());
            for (n, a) in by.bindings().iter().enumerate() {
                let again = by.bindings()[..n].iter().any(|b| (b.0, b.1) == (a.0, a.1));
                assert!(!again, "{}: {:?} twice", by.name(), a.0);
            }
        }
        assert_eq!(Navigation::Blender.motion(Middle, SHIFT), Some(Pan));
        assert_eq!(Navigation::Rhino.motion(Primary, NONE), None);
    }
}
