//! Hints for designs that can't be made: what to do about each cause.

use sheetwright::boundary::{BoundaryError, JoinCause, PlaneError};
use sheetwright::check::Remedy;
use sheetwright::curve::{CurveError, SampleError};
use sheetwright::design::{Design, PanelShape};
use sheetwright::fair::VaryCause;
use sheetwright::flatten::{FlattenError, RelaxError};
use sheetwright::make::{MakeCause, MakeError};
use sheetwright::mark::MarkFault;
use sheetwright::mesh::{MeshError, SeamFault};
use sheetwright::sample::PanelCause;
use sheetwright::surface::ConnectivityError;
use sheetwright::triangulate::TriangulateError;
use sheetwright::trim::TrimFault;

/// The hint of errors that only the developers can mend.
pub const FAULT: &str = "This is a fault of the program: please report it with the input.";

/// What to do about the error: one sentence or more.
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
        MakeCause::Components { .. } => {
            "Its triangles do not share corners, as after an export without welding. Merge its \
             points by distance in the program that exported it, or export it as STL."
                .to_owned()
        }
        MakeCause::Seam(fault) => sewing(*fault).to_owned(),
        MakeCause::Relax(error) => relaxing(*error).to_owned(),
        MakeCause::Trim(fault) => trimming(fault).to_owned(),
        MakeCause::Mark(fault) => marking(fault).to_owned(),
    }
}

/// What to do about a seam that can't be cut.
fn sewing(fault: SeamFault) -> &'static str {
    match fault {
        SeamFault::Off { .. } => "Give points of the mesh, in the units of the design.",
        SeamFault::Apart { .. } => "Begin another seam where the next part begins.",
        SeamFault::TooLong => {
            "Give every vertex that the seams pass, and merge the points of the mesh by distance."
        }
    }
}

/// What to do about a trim that can't be made.
fn trimming(fault: &TrimFault) -> &'static str {
    match fault {
        TrimFault::NoSuchEdge { .. } => {
            "Name one of these, or write all, free, joined, cuts or holes."
        }
        TrimFault::NoMate { .. } => {
            "Leave this edge out, or let the panel beside it use one curve with this one."
        }
        TrimFault::TooWide { .. } => "Make it narrower than the part.",
        TrimFault::SlotsMeet { .. } => "Make the pitch larger, or the tabs shorter.",
        TrimFault::DogboneWide { .. } => "Take a cutter that is no wider than the slots.",
        TrimFault::TooDense { .. } => "Make the pitch larger than the diameter.",
        TrimFault::OverTheLine { .. } => "Set an inset of the radius or more.",
        TrimFault::TooDeep { .. } => {
            "Make it shallower, add an allowance there, or choose a form that stands out: v-out or \
             castle."
        }
        TrimFault::TooLarge { .. } => "Check its units, or leave its trims out.",
        TrimFault::Parted { .. } => {
            "Make sockets and knobs smaller, or the distance between them larger."
        }
    }
}

/// What to do about a mark that can't be made.
fn marking(fault: &MarkFault) -> &'static str {
    match fault {
        MarkFault::NoSuchPart { .. } => "Name one of these, or write all.",
        MarkFault::NoSuchEdge { .. } => "Name one of these, without its part.",
        MarkFault::TooManyStations { .. } => "Make the pitch larger.",
    }
}

/// What to do about a panel that can't be triangulated; `of` is the curve at fault, if one is.
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
            "Give both curves the same end point, or put '-' before the name of '{next}' or of \
             this curve to reverse it."
        ),
        PanelCause::SameRails => "Name two different curves.".to_owned(),
        PanelCause::RunOn => {
            "Leave `run_on` out, or name two open curves as the rails of the panel.".to_owned()
        }
        PanelCause::NoRails => {
            "Give the panel two rails, or set the method to optimal or bridge.".to_owned()
        }
        PanelCause::UnknownPanel { .. } => "Check the names of the panels.".to_owned(),
        PanelCause::NoCurves { .. } => {
            "Join panels that are bounded by curves. Join meshes in the program that exported them."
                .to_owned()
        }
        PanelCause::JoinOfJoins { .. } => "Name the panels that it joins.".to_owned(),
        PanelCause::Join { cause, .. } => join(cause).to_owned(),
        PanelCause::Sampling(SampleError::TooFew { needed, .. }) => {
            format!("Use {needed} samples or more; a few hundred are enough for most panels.")
        }
        PanelCause::Boundary(error) => boundary(error).to_owned(),
        PanelCause::Plane(error) => plane(error).to_owned(),
        PanelCause::Triangulate(error) => triangulation(error).to_owned(),
    }
}

/// [`hint_for`]; for a panel that has holes, also how to make a panel of each of its curves, since
/// users expect that of a table with many curves.
pub fn hint_in_design(error: &MakeError, design: &Design) -> String {
    let hint = hint_for(error);
    // Such as waterlines of a table of offsets.
    if let (MakeCause::NoPanels, [first, second, ..]) = (&error.cause, &design.curves[..]) {
        let [first, second] = [&first.name, &second.name];
        return format!(
            "Convert it to a design (.sheet.json) and name two of its curves as the rails of a \
             panel: \"panels\": [{{ \"name\": \"side\", \"rails\": [\"{first}\", \"{second}\"] }}]."
        );
    }
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
             holes. To make a panel of each curve, list the panels in a design: \"panels\": \
             [{{ \"name\": \"a\", \"boundary\": [\"a\"] }}, …]. Otherwise: {hint}",
            if count == 1 { "hole" } else { "holes" }
        ),
        _ => hint,
    }
}

/// The option that helps against the error, beside the advice of [`hint_for`].
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
            "In a sheet, one or two triangles share a side. Remove inner walls, or make each \
             branch a group of its own."
        }
        MeshError::NotOrientable { .. } => {
            "Cut it through once, so that it has a front and a back, and export it again."
        }
        MeshError::TooSmall => "Check the units of the coordinates in the file.",
        MeshError::Degenerate { .. } => {
            "Remove the triangle, or merge its points by distance, in the program that exported it."
        }
        MeshError::TooMany { .. } => MORE_COARSELY,
        _ => FAULT,
    }
}

const MORE_COARSELY: &str =
    "Export it with fewer triangles; ten thousand are enough for most shapes.";

fn relaxing(error: RelaxError) -> &'static str {
    match error {
        RelaxError::Stopped => "Start it again to finish it.",
        RelaxError::TooLarge => MORE_COARSELY,
        _ => "Divide it into simpler panels in the program that exported it.",
    }
}

fn varying(cause: &VaryCause) -> &'static str {
    match cause {
        VaryCause::Joined => {
            "Vary the panels in a design without the join, and join the moved panels; or name \
             other `curves` to move."
        }
        VaryCause::RunsOn => "Leave `run_on` out, or name `curves` that bound other panels.",
        VaryCause::UnknownPanel { .. } => {
            "Name panels that are made. Those that a join replaces are not made."
        }
        VaryCause::NoCurves => "Name panels that are bounded by curves, or leave `vary` out.",
        VaryCause::BoundsNothing => {
            "Leave the curve out of `vary`, or add a panel that it bounds to the `panels` of \
             `vary`."
        }
        VaryCause::MovedTwice => {
            "Write one `vary` for the whole design, beside `panels`, or name the `curves` that \
             each panel may move."
        }
        VaryCause::TooManyPoints { .. } => {
            "Name the `curves` that may move, or draw them with fewer points."
        }
        VaryCause::Failed(_) => "Set a smaller limit, or change the boundary at the place named.",
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
            "A panel has three corners or more: add points, or use more samples."
        }
        BoundaryError::TooManySamples { .. } => "Use fewer samples.",
        BoundaryError::OutOfRange { .. } => {
            "Lengths are finite numbers within ±1e9 mm: check the units and the numbers."
        }
        BoundaryError::TooSmall => "Check the units: all points lie in one place, or nearly.",
        BoundaryError::Repeated { .. } => {
            "A loop passes each place once: remove the repeated point, or divide the panel where \
             the loop meets itself."
        }
        BoundaryError::OneSided { .. } => {
            "Leave a gap between the two ends of the band and join them after cutting, or take out \
             the half turn."
        }
        BoundaryError::OnOneLine { .. } => "A panel needs area: move a point off the line.",
        BoundaryError::BoundsNothing { .. } => "Name curves that enclose an area.",
        BoundaryError::Crossing { .. } => {
            "Order the points along the boundary, or divide the panel where it crosses itself."
        }
    }
}

fn join(cause: &JoinCause) -> &'static str {
    match cause {
        JoinCause::TooFew => "Name two panels or more.",
        JoinCause::TooLarge { .. } => {
            "Use fewer samples, or remove points; a few hundred are enough for most panels."
        }
        JoinCause::Within => "Set a distance above 0, or a share above 0 and up to 0.5.",
        JoinCause::Apart => {
            "Panels are joined along curves that they share: name the same curve in both, or give \
             their curves the same points."
        }
        JoinCause::LooseSamples { .. } => {
            "Use the same curve in both panels where they meet: two curves through the same points \
             differ between those points."
        }
        JoinCause::ManySheets => "Join two panels along an edge, and make the third separately.",
        JoinCause::OneSided => {
            "Leave one panel out: a band that closes with half a turn has one side only."
        }
        JoinCause::Handle | JoinCause::Closed => "Leave one panel out and make it separately.",
        JoinCause::NoRoom => "Use more samples.",
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
            "Choose a normal along which the boundary is seen without crossings, or \"auto\" or \
             \"none\"."
        }
    }
}

fn triangulation(error: &TriangulateError) -> &'static str {
    match error {
        TriangulateError::Holes { .. } => {
            "Set the method to optimal. If the curves are two open edges, name them as the rails \
             of a panel in a design."
        }
        TriangulateError::GoalWithHoles { .. } => "Leave `goal` out, or fill the holes.",
        TriangulateError::TooLarge { .. } => {
            "Use fewer samples; for a panel of two rails, the method rails needs far less memory."
        }
        TriangulateError::Fold => "Set a fold price from 0 (twist alone) to 10.",
        TriangulateError::Rails => "Use more samples.",
        TriangulateError::NoneInside => {
            "Set the method to optimal, or choose another plane (\"none\" admits every \
             triangulation)."
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
            "Three samples lie on one line or in one place there. Move the boundary, or change the \
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
