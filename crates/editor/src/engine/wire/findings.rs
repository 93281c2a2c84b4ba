//! What was found of a panel: values, which the page makes into sentences.

use super::{Wire, fields, kinds, variants};
use sheetwright::bend::Mitred;
use sheetwright::check::{
    Bend, BorderSide, CutWay, Division, Finding, FindingKind, Hindrance, LinePlace, MeshSetting,
    Movement, Place, PointReach, SeamCause, SeamPlace, TooTight,
};
use sheetwright::divide::DivideFault;
use sheetwright::elastic::Basis;
use sheetwright::fair::Ended;
use sheetwright::mark::MarkNote;
use sheetwright::mesh::{Damage, Skin};
use sheetwright::trim::TrimNote;

fields!(Finding { kind, place });
variants!(FindingKind {
    StrainTooLarge { strain, limit, sheet, thickest_mm, basis },
    NeedsForce { strain, limit, outer_fibre, sheet, moment_n, is_formed, basis },
    Roll { radius_mm, from_mm, sheet },
    CantTell { strain, limit, sheet, basis },
    RadiusUnsure { least_mm, limit_mm, is_coarse, sheet },
    FoldsNotNeeded { count, sharpest },
    RadiusTooSmall { least_mm, limit_mm, sheet, thickest_mm },
    SheetTooThick { drawn_mm, inside_mm, thickness_mm },
    Points { count, turn, reach, too_tight },
    SelfCrossing {},
    Overlap {},
    RungWithoutPlane { count },
    BetterWithoutPlane { with, without },
    TwoSurfaces { apart_mm, is_one_pattern, other },
    NoOtherSurface {},
    StrainNotReached { wanted, reached },
    BendsDivided { parts, way, strain, verdict },
    DividedInVain { most },
    NotProven { gap, cut_short },
    Folds { count, sharpest, stiff },
    Creases { count, sharpest, stiff },
    FoldedFacets { mountains, valleys, sharpest, stiff },
    FacetsMeant { facets, turn, overlaps },
    FacetsFew { facets },
    NoEffect { settings, is_net },
    PieceTooLarge { size_mm, within_mm, is_facet, is_trimmed },
    BendLines { count, sharpest },
    LengthError { largest, closes_holes },
    WindowGap { widest_mm },
    Seams { count, length_mm, why },
    Divide { cut, has_darts, has_creases },
    Stretch { stretch, shrink },
    BorderNotTrue { largest },
    Flipped { count },
    TrianglesLeftOut { count },
    PartsLeftOut { count },
    Healed { damage, count },
    TwoSkins { count, bodies, thickness_mm, laid },
    NotTwoSkins {},
    PointContacts { count },
    RoundedCorner { curve, turn },
    UnfairLine { curve, at, fair },
    SplineBulge { curve, at, by_mm },
    OffTolerance { distance_mm, shorter_mm, tolerance_mm, samples, is_rails, is_usual, is_most },
    JointsSmoothed { count, deviation_mm },
    RanOn { bulges_mm, bends },
    StayedStraight { cause },
    TurnedRound { panels, first },
    Moved { movement, ended, hindrance },
    NotMoved { movement, wanted, is_above, hindrance },
    WarpNotReached { movement, wanted, ended },
    Refold { error_mm, limit_mm },
    NotReadBack { cause },
    QuadsOffBoundary { off_mm },
    QuadsNotPlanar { uneven_mm, off_mm },
    PdfReduced { sheets, scale, most, is_full },
    TooLarge { size_mm, room_mm },
    NoSheet { is_too_large },
    Divided { piece, division },
    Strap { joint, width_mm },
    NotDivided { fault },
    Read { note },
    Trimmed { note },
    Marked { note },
    LinesClose { count, nearest_mm, least_mm },
    LinesLong { count, longest_mm, most_mm },
    FlangeShort { count, shortest_mm, least_mm },
    FoldsMitred { count, of, why }
});
variants!(TrimNote {
    NoRoomForTabs { joints, covered },
    HolesLeftOut { edge, left_out, of },
    FlangeStretches { edge, flat_mm, bent_mm },
    Closes { of_net, of_cut },
    NotProved { outside_mm2 },
    Overlaps {}
});
variants!(MarkNote {
    StationMissed { name, axis, at_mm, reach_mm },
    PlaceFar { what, at, off_mm, within_mm },
    OverTheEdge { what, at, radius_mm },
    SquareToPart { what },
    CurvedFold { edge, off_mm },
    CurvedFrame { name, off_mm, length_mm }
});
variants!(Place {
    Whole {},
    Rungs { numbers },
    Samples { numbers },
    Triangles { corners },
    Sides { sides },
    Seams { seams },
    Points { at },
    Lines { lines },
    CurvePoints { curve, numbers }
});
variants!(Ended {
    NothingToDo {},
    Converged {},
    NoGain {},
    Rounds {},
    Stopped {},
    Reached {},
    Closest { wanted, before, reached, resisting }
});
fields!(Division { pieces, joints, joint, lap_mm, length_mm, room_mm });
kinds!(DivideFault { NoThickness, Seams, NoPlace, Pinched, TooThin });
fields!(PointReach { reach_mm, limit_mm, folds });
fields!(TooTight { sheet, limit_mm, needed_mm });
fields!(Bend { warp, radius_mm });
fields!(Movement { curves, moved_max_mm, moved_total_mm, size_mm, warp, twist });
fields!(BorderSide { corners, samples });
fields!(SeamPlace { number, ends });
fields!(LinePlace { at, on_part });
kinds!(CutWay { Across, Lengthwise });
kinds!(MeshSetting { Aim, SplitCreases, Darts, PiecesWithin });
kinds!(SeamCause { NotFlat, Closed, Chosen, Darts, Facets });
kinds!(Mitred { Meets, NotFlat, Narrow, Untrue });
kinds!(Skin { Outer, Inner });
kinds!(Damage { Filler, Doubled, Seam, OnSide, Branch, Turned, InsideOut });
kinds!(Hindrance { Strain, Radius, Other });
kinds!(Basis { Computed, Screen, NoNet, NoRest, TooTight, Pattern });
