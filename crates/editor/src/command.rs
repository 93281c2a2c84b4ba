//! Everything that a person can ask for by name: menus, keys, buttons and the palette share it.

use crate::document::Plan;
use crate::room::WindowPart;
use crate::theme::Look;
use crate::views::Navigation;
use crate::views::SurfaceView;
use eframe::egui::{Key, KeyboardShortcut, Modifiers};

/// A command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// An empty design.
    New,
    /// The start page, with templates, examples and recent files.
    Start,
    /// A design from a file.
    Open,
    /// To the file that it came from.
    Save,
    /// To another file.
    SaveAs,
    /// The files that a workshop uses.
    Export,
    /// Back by a step.
    Undo,
    /// And forth again.
    Redo,
    /// Draw curves by hand.
    Draw,
    /// An outline with four corners, to be shaped by its numbers.
    AddRectangle,
    /// A round outline, likewise.
    AddCircle,
    /// Select and move handles.
    Select,
    /// Select every handle.
    SelectAll,
    /// Remove what is selected.
    Delete,
    /// A handle becomes a corner, or smooth again.
    ToggleCorner,
    /// A span of a curve becomes straight, or can be bent again.
    ToggleStraight,
    /// Two open curves become one, or one is closed.
    Join,
    /// The other way round.
    Reverse,
    /// What is drawn is the same on both sides of a line.
    ToggleMirror,
    /// Handles snap to the grid.
    ToggleGrid,
    /// A picture to draw after.
    AddReference,
    /// Without the picture.
    RemoveReference,
    /// Two points of the picture with a known distance make it true to scale.
    CalibrateReference,
    /// Which plane the plan shows.
    PlanOf(Plan),
    /// How surfaces look in space.
    View(SurfaceView),
    /// One part of the window, where there is no room for all.
    Show(WindowPart),
    /// Everything in sight.
    Fit,
    /// Parallel lines stay parallel, or meet far away.
    ToggleOrthographic,
    /// What the buttons of the mouse do in space.
    Navigate(Navigation),
    /// The rung with the largest warp angle.
    WorstRung,
    /// The panel that moves points so that the sheet bends.
    Vary,
    /// A name or a key of every command.
    Palette,
    /// The five steps from an outline to a pattern.
    Tour,
    /// The keys of all commands.
    Keys,
    /// The colours.
    Look(Look),
    /// Larger.
    ZoomIn,
    /// Smaller.
    ZoomOut,
    /// As large as they were made.
    ZoomReset,
    /// Stop what is at work.
    Stop,
    /// Ends the tool, then the selection.
    Escape,
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

impl Command {
    /// Every command, in the order of the palette.
    pub fn all() -> Vec<Self> {
        let mut all = vec![
            Self::Start,
            Self::New,
            Self::Open,
            Self::Save,
            Self::SaveAs,
            Self::Export,
            Self::Undo,
            Self::Redo,
            Self::Draw,
            Self::AddRectangle,
            Self::AddCircle,
            Self::Select,
            Self::SelectAll,
            Self::Delete,
            Self::ToggleCorner,
            Self::ToggleStraight,
            Self::Join,
            Self::Reverse,
            Self::ToggleMirror,
            Self::ToggleGrid,
            Self::AddReference,
            Self::CalibrateReference,
            Self::RemoveReference,
        ];
        all.extend(Plan::ALL.map(Self::PlanOf));
        all.extend(SurfaceView::ALL.map(Self::View));
        all.extend(WindowPart::ALL.map(Self::Show));
        all.extend([
            Self::Fit,
            Self::ToggleOrthographic,
            Self::WorstRung,
            Self::Vary,
            Self::Palette,
            Self::Tour,
            Self::Keys,
        ]);
        all.extend(Navigation::ALL.map(Self::Navigate));
        all.extend(Look::ALL.map(Self::Look));
        all.extend([Self::ZoomIn, Self::ZoomOut, Self::ZoomReset, Self::Stop, Self::Escape]);
        all
    }

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::New => "New",
            Self::Start => "Start page",
            Self::Open => "Open…",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::Export => "Export…",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::Draw => "Draw",
            Self::AddRectangle => "Add rectangle",
            Self::AddCircle => "Add circle",
            Self::Select => "Select",
            Self::SelectAll => "Select all",
            Self::Delete => "Delete",
            Self::ToggleCorner => "Corner or smooth",
            Self::ToggleStraight => "Straight or curved",
            Self::Join => "Join or close",
            Self::Reverse => "Turn round",
            Self::ToggleMirror => "Mirror",
            Self::ToggleGrid => "Snap to grid",
            Self::AddReference => "Picture to trace…",
            Self::RemoveReference => "Remove picture",
            Self::CalibrateReference => "Scale picture",
            Self::PlanOf(Plan::Top) => "Plan: top",
            Self::PlanOf(Plan::Front) => "Plan: front",
            Self::PlanOf(Plan::Side) => "Plan: side",
            Self::View(view) => view.name(),
            Self::Show(WindowPart::Plan) => "Show the plan",
            Self::Show(WindowPart::Space) => "Show space",
            Self::Show(WindowPart::Pattern) => "Show the pattern",
            Self::Show(WindowPart::Answer) => "Show the answer",
            Self::Fit => "Fit",
            Self::ToggleOrthographic => "Perspective on or off",
            Self::Navigate(navigation) => navigation.name(),
            Self::WorstRung => "Show worst rung",
            Self::Vary => "Make it bend…",
            Self::Palette => "Find a command…",
            Self::Tour => "Tour",
            Self::Keys => "Keys",
            Self::Look(Look::System) => "Colours: as the system",
            Self::Look(Look::Light) => "Colours: light",
            Self::Look(Look::Dark) => "Colours: dark",
            Self::Look(Look::HighContrast) => "Colours: high contrast",
            Self::ZoomIn => "Larger text",
            Self::ZoomOut => "Smaller text",
            Self::ZoomReset => "Normal text",
            Self::Stop => "Stop",
            Self::Escape => "End tool or selection",
        }
    }

    /// What it does, in a sentence.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::New => "Begin with an empty sheet.",
            Self::Start => "Templates, examples and recent files.",
            Self::Open => "Open a design or a table of points.",
            Self::Save => "Save to the file it came from.",
            Self::SaveAs => "Save to a new file.",
            Self::Export => "Write the patterns and the report to cut by.",
            Self::Undo => "Take the last step back.",
            Self::Redo => "Do it again.",
            Self::Draw => "Draw an outline or a hole on the plan with mouse, pen or finger.",
            Self::AddRectangle => "Put an outline with four corners on the plan.",
            Self::AddCircle => "Put a round outline on the plan.",
            Self::Select => "Select handles and move them. Double click on a curve adds one.",
            Self::SelectAll => "Select the handles of all curves.",
            Self::Delete => "Remove the selected handles; without any, the selected curve.",
            Self::ToggleCorner => "Make the selected handles corners, or smooth again.",
            Self::ToggleStraight => "Make the side after the selected handle straight, or bend it.",
            Self::Join => "Join two open curves at their nearest ends, or close one.",
            Self::Reverse => "Run the selected curve from its end to its beginning.",
            Self::ToggleMirror => "Draw both sides of a line at once.",
            Self::ToggleGrid => "Let handles settle on the lines of the grid.",
            Self::AddReference => "Put a photograph or a scanned plan under the drawing.",
            Self::RemoveReference => "Take the picture away.",
            Self::CalibrateReference => {
                "Click two places on the picture and type how far apart they are."
            }
            Self::PlanOf(Plan::Top) => "Draw as seen from above; handles lift along z.",
            Self::PlanOf(Plan::Front) => "Draw as seen from the front; handles lift along y.",
            Self::PlanOf(Plan::Side) => "Draw as seen from the side; handles lift along x.",
            Self::View(view) => view.tooltip(),
            Self::Show(WindowPart::Plan) => "Where outlines are drawn and handles moved.",
            Self::Show(WindowPart::Space) => "The sheet in space, where handles are lifted.",
            Self::Show(WindowPart::Pattern) => "The sheet laid flat, with its dimensions.",
            Self::Show(WindowPart::Answer) => {
                "Will it bend? And typed values for what is selected."
            }
            Self::Fit => "Bring everything into sight.",
            Self::ToggleOrthographic => "Let lines that are parallel stay so, or meet far away.",
            Self::Navigate(navigation) => navigation.tooltip(),
            Self::WorstRung => "Select the line where the sheet twists most.",
            Self::Vary => "Let points move a little so that the sheet bends.",
            Self::Palette => "Type a few letters of what you want.",
            Self::Tour => "Five steps from an outline to a pattern.",
            Self::Keys => "The keys of all commands.",
            Self::Look(_) => "Change the colours of the program.",
            Self::ZoomIn => "Make everything larger.",
            Self::ZoomOut => "Make everything smaller.",
            Self::ZoomReset => "Make everything as large as it was.",
            Self::Stop => "Stop what is being worked out. The best layout so far is kept.",
            Self::Escape => "End the tool; without one, select nothing.",
        }
    }

    /// Its key. Browsers keep many keys with Ctrl and Alt for themselves, so that most are letters.
    pub fn key(self) -> KeyboardShortcut {
        let (modifiers, key) = match self {
            Self::Start => (NONE, Key::H),
            Self::New => (CTRL, Key::N),
            Self::Open => (CTRL, Key::O),
            Self::Save => (CTRL, Key::S),
            Self::SaveAs => (CTRL_SHIFT, Key::S),
            Self::Export => (CTRL, Key::E),
            Self::Undo => (CTRL, Key::Z),
            Self::Redo => (CTRL_SHIFT, Key::Z),
            Self::Draw => (NONE, Key::D),
            Self::AddRectangle => (NONE, Key::B),
            Self::AddCircle => (NONE, Key::N),
            Self::Select => (NONE, Key::S),
            Self::SelectAll => (CTRL, Key::A),
            Self::Delete => (NONE, Key::Delete),
            Self::ToggleCorner => (NONE, Key::C),
            Self::ToggleStraight => (NONE, Key::L),
            Self::Join => (NONE, Key::J),
            Self::Reverse => (NONE, Key::R),
            Self::ToggleMirror => (NONE, Key::M),
            Self::ToggleGrid => (NONE, Key::G),
            Self::AddReference => (NONE, Key::P),
            Self::CalibrateReference => (NONE, Key::K),
            Self::RemoveReference => (SHIFT, Key::K),
            Self::PlanOf(Plan::Top) => (NONE, Key::Num7),
            Self::PlanOf(Plan::Front) => (NONE, Key::Num8),
            Self::PlanOf(Plan::Side) => (NONE, Key::Num9),
            Self::View(view) => (NONE, view.key()),
            Self::Show(part) => (SHIFT, part.key()),
            Self::Fit => (NONE, Key::F),
            Self::ToggleOrthographic => (NONE, Key::O),
            Self::WorstRung => (NONE, Key::W),
            Self::Vary => (NONE, Key::V),
            Self::Palette => (CTRL, Key::K),
            Self::Tour => (NONE, Key::F1),
            Self::Keys => (NONE, Key::F2),
            Self::ZoomIn => (CTRL, Key::Plus),
            Self::ZoomOut => (CTRL, Key::Minus),
            Self::ZoomReset => (CTRL, Key::Num0),
            Self::Navigate(Navigation::Sheetwright) => (SHIFT, Key::Z),
            Self::Navigate(Navigation::Blender) => (SHIFT, Key::X),
            Self::Navigate(Navigation::SketchUp) => (SHIFT, Key::C),
            Self::Navigate(Navigation::Rhino) => (SHIFT, Key::V),
            Self::Look(Look::System) => (SHIFT, Key::Y),
            Self::Look(Look::Light) => (SHIFT, Key::L),
            Self::Look(Look::Dark) => (SHIFT, Key::N),
            Self::Look(Look::HighContrast) => (SHIFT, Key::H),
            Self::Stop => (CTRL, Key::Period),
            Self::Escape => (NONE, Key::Escape),
        };
        KeyboardShortcut::new(modifiers, key)
    }
}
