//! What to do about a design that can't be made: one sentence for each cause.

use sheetwright::boundary::{BoundaryError, JoinCause, PlaneError};
use sheetwright::check::Remedy;
use sheetwright::curve::{CurveError, SampleError};
use sheetwright::design::{Design, PanelShape};
use sheetwright::fair::VaryCause;
use sheetwright::flatten::{FlattenError, RelaxError};
use sheetwright::make::{MakeCause, MakeError};
use sheetwright::mesh::MeshError;
use sheetwright::sample::PanelCause;
use sheetwright::surface::ConnectivityError;
use sheetwright::triangulate::TriangulateError;

const FAULT: &str = "This is a fault of the program: please report it with the input.";

/// What a person can do about the error.
pub fn hint_for(error: &MakeError) -> String {
    match &error.cause {
        MakeCause::NoPanels => {
            "Add a panel, such as { \"name\": \"side\", \"boundary\": [\"rim\"] }.".to_owned()
        }
        MakeCause::Panel(cause) => panel(cause, error.curve.as_deref()),
        MakeCause::Surface(error) => surface(error).to_owned(),
        MakeCause::Flatten(error) => flat(error).to_owned(),
        MakeCause::Vary(cause) => varying(cause).to_owned(),
        MakeCause::Mesh { error, .. } => mesh(*error).to_owned(),
        MakeCause::Pieces { .. } => {
            "Its triangles do not share corners, as after an export without welding: merge its \
             points by distance in the program that it is from, or export STL."
                .to_owned()
        }
        MakeCause::Relax(error) => relaxing(*error).to_owned(),
    }
}

/// About a panel that can't be triangulated; `of` is the curve, where it is one.
fn panel(cause: &PanelCause, of: Option<&str>) -> String {
    match cause {
        PanelCause::UnknownCurve => "Check the names of the curves.".to_owned(),
        PanelCause::Curve(error) => curve(error).to_owned(),
        PanelCause::ClosedCurve => {
            "A rail, or a curve chained with others, has two ends: leave `closed` out, or make the \
             closed curve the only one of its loop."
                .to_owned()
        }
        PanelCause::NotChained { next, .. } if of == Some(next) => {
            "Close the curve (\"closed\": true), or add the curves that lead back to its beginning."
                .to_owned()
        }
        PanelCause::NotChained { next, .. } => format!(
            "Give both curves the same end point, or put '-' before '{next}' or this one to run it \
             the other way."
        ),
        PanelCause::SameRails => "Name two different curves.".to_owned(),
        PanelCause::RunOn => {
            "Leave `run_on` out, or name two open curves as the rails of the panel.".to_owned()
        }
        PanelCause::NoRails => {
            "Give the panel two rails, or take the method optimal or bridge.".to_owned()
        }
        PanelCause::UnknownPanel { .. } => "Check the names of the panels.".to_owned(),
        PanelCause::NoCurves { .. } => {
            "Join panels that are bounded by curves; meshes are joined in the program that they \
             are from."
                .to_owned()
        }
        PanelCause::JoinOfJoins { .. } => "Name the panels that it is made of.".to_owned(),
        PanelCause::Join { cause, .. } => join(cause).to_owned(),
        PanelCause::Sampling(SampleError::TooFew { needed, .. }) => {
            format!("Ask for {needed} samples or more; a few hundred show most panels well.")
        }
        PanelCause::Boundary(error) => boundary(error).to_owned(),
        PanelCause::Plane(error) => plane(error).to_owned(),
        PanelCause::Triangulate(error) => triangulation(error).to_owned(),
    }
}

/// [`hint_for`], and of a panel that has many holes how to make its curves panels instead: people
/// expect of a table of many curves that each becomes one.
pub fn hint_in_design(error: &MakeError, design: &Design) -> String {
    let hint = hint_for(error);
    let holes = design.panels.iter().find(|panel| panel.name == error.panel).map(|panel| {
        let PanelShape::Loops { holes, .. } = &panel.shape else { return 0 };
        holes.len()
    });
    let is_of_holes = matches!(
        error.cause,
        MakeCause::Panel(
            PanelCause::Plane(PlaneError::HoleOutside { .. })
                | PanelCause::Triangulate(TriangulateError::TooLarge { .. })
        )
    );
    match holes {
        Some(count) if count > 0 && is_of_holes => format!(
            "This is one panel with {count} {}: its first curve is the outline, all others are \
             holes. To make a panel each, list them in a design: \"panels\": [{{ \"name\": \"a\", \
             \"boundary\": [\"a\"] }}, …]. Else: {hint}",
            if count == 1 { "hole" } else { "holes" }
        ),
        _ => hint,
    }
}

/// What may be set about the error, beside what [`hint_for`] says.
pub fn remedy_for(error: &MakeError) -> Option<Remedy> {
    match &error.cause {
        MakeCause::Mesh { error: MeshError::TooSmall, .. } => Some(Remedy::Units),
        MakeCause::Relax(RelaxError::Stopped | RelaxError::TooLarge) => None,
        MakeCause::Relax(_) => Some(Remedy::SplitCreases),
        _ => None,
    }
}

fn mesh(error: MeshError) -> &'static str {
    match error {
        MeshError::Empty => "Export the surface as a mesh of triangles or polygons.",
        MeshError::NotManifold { .. } => {
            "A sheet has one side or two along every line: take out what is inside, or make what \
             branches a group of its own."
        }
        MeshError::NotOrientable { .. } => {
            "Cut it through once, so that it has a front and a back, and export it again."
        }
        MeshError::TooSmall => "Check the units that the coordinates of the file are in.",
        MeshError::Degenerate { .. } => {
            "Take the triangle out, or merge its points by distance, in the program that it is from."
        }
        MeshError::TooMany { .. } => MORE_COARSELY,
        _ => FAULT,
    }
}

const MORE_COARSELY: &str =
    "Export it more coarsely: some ten thousand triangles show most shapes well.";

fn relaxing(error: RelaxError) -> &'static str {
    match error {
        RelaxError::Stopped => "Start it again to finish it.",
        RelaxError::TooLarge => MORE_COARSELY,
        _ => "Divide it into simpler panels in the program that it is from.",
    }
}

fn varying(cause: &VaryCause) -> &'static str {
    match cause {
        VaryCause::Joined => {
            "Vary the panels before they are joined, in a design of their own, and join what comes \
             out; or name other `curves` to move."
        }
        VaryCause::RunsOn => {
            "Leave `run_on` out, or name `curves` to move that bound other panels."
        }
        VaryCause::UnknownPanel { .. } => {
            "Name panels that are made: not those that a join takes the place of."
        }
        VaryCause::NoCurves => "Name panels that are bounded by curves, or leave `vary` out.",
        VaryCause::BoundsNothing => {
            "Leave it out of `vary`, or name a panel that it bounds among its `panels`."
        }
        VaryCause::MovedTwice => {
            "Write one `vary` for the whole design, beside `panels`, or name the `curves` that each \
             may move."
        }
        VaryCause::TooManyPoints { .. } => {
            "Name the `curves` that may move, or draw them with fewer points."
        }
        VaryCause::Failed(_) => "Let the boundary move less far, or change it where it is said.",
    }
}

fn curve(error: &CurveError) -> &'static str {
    match error {
        CurveError::TooFewPoints { .. } => {
            "An open curve takes two points or more, a closed one three or more."
        }
        CurveError::OutOfRange { .. } => {
            "Lengths are finite numbers within ±1e9 mm: check the units and the numbers."
        }
        CurveError::Repeated { .. } => {
            "Remove one of the two; a closed curve does not repeat its first point."
        }
    }
}

fn boundary(error: &BoundaryError) -> &'static str {
    match error {
        BoundaryError::TooFewSamples { .. } => {
            "A panel has three corners or more: add points, or ask for more samples."
        }
        BoundaryError::TooManySamples { .. } => "Ask for fewer samples.",
        BoundaryError::OutOfRange { .. } => {
            "Lengths are finite numbers within ±1e9 mm: check the units and the numbers."
        }
        BoundaryError::TooSmall => "Check the units: all points lie on one spot, or nearly.",
        BoundaryError::Repeated { .. } => {
            "A loop passes each place once: remove the repeated point, or divide the panel where \
             the loop meets itself."
        }
        BoundaryError::OneSided { .. } => {
            "Leave a gap between the two ends of the band and join them after cutting, or take out \
             the half turn."
        }
        BoundaryError::OnOneLine { .. } => {
            "A panel needs area: check that the points do not all lie in a row."
        }
        BoundaryError::BoundsNothing { .. } => {
            "A loop goes round something: name curves that enclose the panel."
        }
        BoundaryError::Crossing { .. } => {
            "Order the points along the boundary, or divide the panel where it crosses itself."
        }
    }
}

fn join(cause: &JoinCause) -> &'static str {
    match cause {
        JoinCause::TooFew => "Name two panels or more.",
        JoinCause::TooLarge { .. } => {
            "Ask for fewer samples, or leave points out; a few hundred show most panels well."
        }
        JoinCause::Within => "Ask for a distance above 0, or for a share above 0 and up to 0.5.",
        JoinCause::Apart => {
            "Panels are joined along curves that both have: name the same curve in both, or give \
             their curves the same points."
        }
        JoinCause::LooseSamples { .. } => {
            "Let both run along the same curve where they meet: two curves that only pass through \
             the same points differ between them."
        }
        JoinCause::ManySheets => "Join two panels along an edge, and make the third by itself.",
        JoinCause::OneSided => {
            "Leave one of them out: a band that closes with half a turn has no side to face."
        }
        JoinCause::Handle | JoinCause::Closed => "Leave one of them out and make it by itself.",
        JoinCause::NoRoom => "Ask for more samples.",
        JoinCause::Boundary(error) => boundary(error),
    }
}

fn plane(error: &PlaneError) -> &'static str {
    match error {
        PlaneError::NoDirection => "Give a normal such as [0, 0, 1], or \"auto\".",
        PlaneError::HoleOutside { .. } => {
            "Move the hole inside the outline, or write \"plane\": \"none\" for a tube."
        }
        PlaneError::Crossing { .. } => {
            "Choose a normal along which the boundary is seen as a simple loop, or \"auto\" or \
             \"none\"."
        }
    }
}

fn triangulation(error: &TriangulateError) -> &'static str {
    match error {
        TriangulateError::Holes { .. } => {
            "Take the method optimal. If the curves are two open edges, name them as the rails of \
             a panel in a design."
        }
        TriangulateError::GoalWithHoles { .. } => "Leave `goal` out, or fill the holes.",
        TriangulateError::TooLarge { .. } => {
            "Ask for fewer samples; for a panel of two rails, the method rails needs far less."
        }
        TriangulateError::Fold => "Ask for a fold price of 0 (twist alone) to 10.",
        TriangulateError::Rails => "Ask for more samples.",
        TriangulateError::NoneInside => {
            "Take the method optimal, or another plane (\"none\" admits every triangulation)."
        }
        TriangulateError::Stopped => "Start it again to finish it.",
    }
}

fn surface(error: &ConnectivityError) -> &'static str {
    match error {
        ConnectivityError::NotManifold { .. }
        | ConnectivityError::OpenSide { .. }
        | ConnectivityError::BadTriangle(_) => FAULT,
    }
}

fn flat(error: &FlattenError) -> &'static str {
    match error {
        FlattenError::Cycle | FlattenError::Pieces => FAULT,
        FlattenError::NoTriangle { .. } => {
            "Three samples lie on one line or spot there: move the boundary apart, or change the \
             number of samples."
        }
        FlattenError::Stopped => "Start it again to finish it.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hint_is_a_sentence_of_its_own() {
        let causes = [
            MakeCause::NoPanels,
            MakeCause::Panel(PanelCause::NotChained { next: "keel".into(), gap_mm: 1.0 }),
            MakeCause::Panel(PanelCause::Sampling(SampleError::TooFew { asked: 1, needed: 3 })),
            TriangulateError::Holes { count: 1 }.into(),
            TriangulateError::GoalWithHoles { count: 1 }.into(),
        ];
        for cause in causes {
            let error = MakeError { panel: "p".into(), curve: None, cause };
            let hint = hint_for(&error);
            assert!(hint.ends_with(['.', '?']), "{hint}");
            assert!(!error.to_string().contains(&hint));
        }
    }
}
