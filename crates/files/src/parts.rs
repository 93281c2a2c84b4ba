//! `parts.csv`: what is to be cut, a row a pattern. `docs/outputs.md` says what each column is for.

use crate::brake::mm;
use crate::sheets::{LaidPart, laid};
use crate::table::{guarded, quoted};
use sheetwright::make::{CutItem, Made};
use sheetwright::pattern::{PatternPath, Piece};

/// The bytes of the table of patterns.
pub(crate) fn write_parts(made: &Made, patterns: &[CutItem]) -> Vec<u8> {
    let columns = [
        "part",
        "count",
        "mirrored",
        "width_mm",
        "height_mm",
        "area_mm2",
        "cut_length_mm",
        "instances",
        "joined_to",
        "sheet",
        "x_mm",
        "y_mm",
        "turn_deg",
        "turned_over",
    ];
    // The places of each part.
    let mut places: Vec<Vec<LaidPart>> = made.parts.iter().map(|_| Vec::new()).collect();
    for it in made.nested.iter().flat_map(laid) {
        places[it.part].push(it);
    }
    let mut out = columns.join(",") + "\r\n";
    for item in patterns {
        let (piece, quantity) = (&made.parts[item.first()].piece, item.quantity());
        let cells = [
            guarded(&piece.name),
            quantity.count.to_string(),
            quantity.mirrored.to_string(),
            mm(piece.size.x),
            mm(piece.size.y),
            mm(piece.area_mm2()),
            mm(cut_length_mm(piece)),
            guarded(&instances(made, item)),
            guarded(&joined_to(made, item)),
        ];
        let on_sheets = on_sheets(made, item, &places);
        let cells = cells.iter().chain(&on_sheets).map(|cell| quoted(cell));
        out += &cells.collect::<Vec<_>>().join(",");
        out += "\r\n";
    }
    out.into_bytes()
}

/// Where each of those parts lies, in their order, as often as it is cut: the number of the sheet,
/// the middle of the box of the part on it, by how much it is turned, and whether it is turned
/// over. A part that lies on no sheet has nothing between the semicolons.
fn on_sheets(made: &Made, item: &CutItem, places: &[Vec<LaidPart>]) -> [String; 5] {
    let cell = |of: fn(&LaidPart) -> String| -> String {
        let of_part = |number: usize| {
            let count = made.wanted[number].count;
            (0..count).map(move |n| places[number].get(n).map_or_else(String::new, of))
        };
        let all = item.instances.iter().flat_map(|instance| of_part(instance.number));
        all.collect::<Vec<_>>().join("; ")
    };
    if made.nested.is_none() {
        return Default::default();
    }
    [
        cell(|it| (it.placement.sheet + 1).to_string()),
        cell(|it| mm(it.middle.x)),
        cell(|it| mm(it.middle.y)),
        cell(|it| mm(it.turn_deg())),
        cell(|it| if it.placement.is_over { "yes" } else { "no" }.to_owned()),
    ]
}

/// The parts that are cut from a pattern, separated by semicolons.
fn instances(made: &Made, item: &CutItem) -> String {
    let names = item.instances.iter().map(|instance| &made.parts[instance.number].name[..]);
    names.collect::<Vec<_>>().join("; ")
}

/// What each of those parts is joined to, in their order: `PART: PART/EDGE, PART/EDGE`.
fn joined_to(made: &Made, item: &CutItem) -> String {
    let of_part = |number: usize| {
        let part = &made.parts[number];
        let mates = part.edges.iter().flat_map(|edge| &edge.mates);
        let mates = mates.map(|mate| {
            let other = &made.parts[mate.part];
            format!("{}/{}", other.name, other.edges[mate.edge].name)
        });
        let mates: Vec<String> = mates.collect();
        (!mates.is_empty()).then(|| format!("{}: {}", part.name, mates.join(", ")))
    };
    let all = item.instances.iter().filter_map(|instance| of_part(instance.number));
    all.collect::<Vec<_>>().join("; ")
}

/// How long all cuts of a piece are, mm.
pub(crate) fn cut_length_mm(piece: &Piece) -> f64 {
    let length = |path: &PatternPath| {
        let closing = path.closed.then(|| [path.points[path.points.len() - 1], path.points[0]]);
        let steps = path.points.windows(2).map(|step| step[0].distance(step[1]));
        steps.sum::<f64>() + closing.map_or(0.0, |[a, b]| a.distance(b))
    };
    piece.paths.iter().filter(|path| path.role.is_cut()).map(length).sum()
}
