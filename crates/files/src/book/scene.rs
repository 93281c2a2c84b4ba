//! Parts in space on a page: shaded, with their outlines; some of them stand back.

use crate::pdf::{PdfPage, Pen};
use crate::space::{
    Drawn, Facet, Fill, LIES_ON, LIGHT, Placing, Ramp, Scene, SeenLines, Shade, Solid, View,
    coarse_shade, faint, in_ramp, shades_of, view_of,
};
use sheetwright::make::Part;
use sheetwright::math::{Point2, Point3, Vec2, Vec3};
use sheetwright::predicate::Box2;

/// The width of a picture in its own units, about the pixels of a page.
const WIDTH: f64 = 480.0;
const MARGIN: f64 = 14.0;
/// The most triangles of a picture that are drawn one by one: more become cells, so that a book of
/// many steps stays small.
const MOST_PATHS: usize = 3_000;
/// If less of a part than this share is seen, it is looked at from elsewhere.
const SEEN_ENOUGH: f64 = 0.3;

/// The shades of a part that is added: darker than those of the others, also on a grey print.
const ADDED: [Ramp; 2] =
    [[[44.0, 96.0, 150.0], [150.0, 196.0, 232.0]], [[140.0, 98.0, 46.0], [226.0, 190.0, 140.0]]];
/// The shades of a part that stands already.
const STANDING: Ramp = [[196.0, 200.0, 204.0], [250.0, 250.0, 250.0]];

/// The height of parts in their best view over their width.
pub(super) fn height_per_width(parts: &[Part]) -> f64 {
    let view = view_of(parts);
    let points = parts.iter().flat_map(|part| part.sheet.mesh().positions());
    let around = Box2::of_points(points.map(|&p| view.project(p)));
    around.map_or(1.0, |around| {
        let size = around.max - around.min;
        size.y / size.x.max(1e-12)
    })
}

/// Where a picture lies on its page.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    /// Its lower left corner, mm.
    pub(super) corner: Point2,
    /// Its size, mm.
    pub(super) size: Vec2,
}

/// All parts of a design as they are seen from one direction.
struct Seen {
    view: View,
    drawn: Vec<Drawn>,
    shades: Vec<Vec<u16>>,
    placing: Placing,
}

/// The parts of a design, for pictures of one shape.
pub(super) struct Stage {
    /// The best view first, then those that show what it hides.
    seen: Vec<Seen>,
    /// The height of a picture in its own units.
    height: f64,
    is_coarse: bool,
}

/// What is drawn besides the parts themselves, in space, mm.
#[derive(Default)]
pub(super) struct Extras {
    /// Lines of edges that are joined.
    pub(super) joined: Vec<Vec<Point3>>,
    /// Distances to measure.
    pub(super) measured: Vec<[Point3; 2]>,
}

/// A place of a picture on its page.
pub(super) struct Projected<'a> {
    seen: &'a Seen,
    frame: Frame,
    height: f64,
    /// How it is looked at, if not in the best view.
    pub(super) from: Option<&'static str>,
}

impl Projected<'_> {
    /// Where a point in space lies on the page, mm.
    pub(super) fn place(&self, point: Point3) -> Point2 {
        on_page(self.seen.placing.place(self.seen.view.project(point)), self.frame, self.height)
    }
}

fn on_page(p: Point2, frame: Frame, height: f64) -> Point2 {
    let scale = frame.size.x / WIDTH;
    frame.corner + Vec2::new(p.x, height - p.y) * scale
}

impl Stage {
    /// The parts in pictures of a size, mm.
    pub(super) fn new(parts: &[Part], size: Vec2) -> Self {
        let height = WIDTH * size.y / size.x;
        let best = view_of(parts);
        let toward = best.toward;
        let behind = View::from(Vec3::new(-toward.x, -toward.y, toward.z));
        let below = View::from(Vec3::new(toward.x, toward.y, -0.6 - toward.z.abs()));
        let seen = [best, behind, below].map(|view| Seen::new(parts, view, height));
        let count: usize = parts.iter().map(|part| part.sheet.mesh().triangles().len()).sum();
        Self { seen: seen.into(), height, is_coarse: count > MOST_PATHS }
    }

    /// Draws some parts into a frame, those in `added` before the others, which stand back; with no
    /// part added, all are drawn alike. Looks from where the added ones are seen.
    pub(super) fn draw(
        &self,
        page: &mut PdfPage,
        frame: Frame,
        standing: &[usize],
        added: &[usize],
        extras: &Extras,
    ) -> Projected<'_> {
        let shown = |seen: &Seen| {
            let facets = seen.facets(standing, added, self.is_coarse);
            let count: usize = added.iter().map(|&n| seen.shades[n].len()).sum();
            let scene = self.scene(seen, &facets);
            scene.share_seen(facets.len() - count..facets.len())
        };
        let shares: Vec<f64> = if added.is_empty() || standing.is_empty() {
            vec![1.0]
        } else {
            self.seen.iter().map(shown).collect()
        };
        let most = shares.iter().copied().fold(0.0, f64::max);
        let is_enough = |share: &f64| *share >= SEEN_ENOUGH.min(most);
        let chosen = shares.iter().position(is_enough).unwrap_or(0);
        let seen = &self.seen[chosen];
        let from = [None, Some("seen from behind"), Some("seen from below")][chosen];
        let facets = seen.facets(standing, added, self.is_coarse);
        let scene = self.scene(seen, &facets);
        let is_all = added.is_empty();
        for fill in scene.fills() {
            self.fill(page, frame, &fill, is_all);
        }
        let placed = |line: &Vec<Point2>| -> Vec<Point2> {
            line.iter().map(|&p| on_page(p, frame, self.height)).collect()
        };
        let with_pens =
            standing.iter().map(|&n| (n, if is_all { Pen::OUTLINE } else { Pen::FAINT }));
        for (n, pen) in with_pens.chain(added.iter().map(|&n| (n, Pen::OUTLINE))) {
            if pen == Pen::OUTLINE && !is_all {
                let hidden = seen.drawn[n].solid.border.iter().map(|ends| {
                    ends.iter().map(|&v| placed(&vec![seen.drawn[n].points[v]])[0]).collect()
                });
                page.lines(&chained(hidden), Pen::HIDDEN);
            }
            let lines = SeenLines::of(&seen.drawn[n], &seen.shades[n], &scene);
            let rings = lines.rings.iter().map(|ring| {
                let mut ring = placed(ring);
                ring.extend(ring.first().copied());
                ring
            });
            page.lines(&rings.collect::<Vec<_>>(), pen);
            for (runs, pen) in [
                (&lines.turns, pen),
                (&lines.creases, Pen::FAINT),
                (&lines.border, pen),
                (&lines.cuts, pen),
            ] {
                page.lines(&runs.iter().map(placed).collect::<Vec<_>>(), pen);
            }
        }
        let projected = Projected { seen, frame, height: self.height, from };
        let on = |line: &[Point3]| line.iter().map(|&p| projected.place(p)).collect();
        let joined: Vec<Vec<Point2>> = extras.joined.iter().map(|line| on(line)).collect();
        page.lines(&joined, Pen::JOINED);
        let measured: Vec<Vec<Point2>> = extras.measured.iter().map(|line| on(line)).collect();
        page.lines(&measured, Pen::MEASURE);
        projected
    }

    fn scene<'a>(&self, seen: &Seen, facets: &'a [Facet]) -> Scene<'a> {
        let enough = seen.placing.millimetres(LIES_ON);
        Scene::in_paths(Vec2::new(WIDTH, self.height), facets, enough, MOST_PATHS)
    }

    fn fill(&self, page: &mut PdfPage, frame: Frame, fill: &Fill, is_all: bool) {
        let ramps = if is_all { &LIGHT } else { &ADDED };
        let colour = |shade: u16| match Shade::of(shade) {
            Shade::Front(level) => in_ramp(&ramps[0], level.into()),
            Shade::Back(level) => in_ramp(&ramps[1], level.into()),
            Shade::Heat(level) | Shade::Faint(level) => in_ramp(&STANDING, level.into()),
        };
        let place = |p: Point2| on_page(p, frame, self.height);
        match fill {
            Fill::Triangles { shade, triangles } => {
                let placed: Vec<[Point2; 3]> = triangles.iter().map(|t| t.map(place)).collect();
                page.fill(placed.iter().map(|t| &t[..]), colour(*shade));
            }
            Fill::Cells { shade, rows } => {
                let corners = rows.iter().map(|row| {
                    let (a, c) = (row.corner, row.corner + row.size);
                    [a, Point2::new(c.x, a.y), c, Point2::new(a.x, c.y)].map(place)
                });
                let placed: Vec<[Point2; 4]> = corners.collect();
                page.fill(placed.iter().map(|t| &t[..]), colour(*shade));
            }
        }
    }
}

impl Seen {
    fn new(parts: &[Part], view: View, height: f64) -> Self {
        let solids: Vec<Solid> = parts.iter().map(|part| Solid::of(part, None)).collect();
        let projected: Vec<Vec<Point2>> = solids
            .iter()
            .map(|solid| solid.positions.iter().map(|&p| view.project(p)).collect())
            .collect();
        let most_height = height - 2.0 * MARGIN;
        let placing = Placing::new(projected.iter().flatten(), WIDTH, MARGIN, most_height);
        // In the middle of a picture that is higher.
        let placing = placing.moved(0.5 * (height - placing.height));
        let drawn = solids.into_iter().zip(&projected).map(|(solid, points)| {
            let points = points.iter().map(|&p| placing.place(p)).collect();
            Drawn::new(solid, &view, points)
        });
        let drawn: Vec<Drawn> = drawn.collect();
        let areas: Vec<Vec<Vec3>> = drawn.iter().map(|part| part.solid.areas.clone()).collect();
        let shades = shades_of(&view, &areas);
        Self { view, drawn, shades, placing }
    }

    /// The triangles of some parts; those that are added come last.
    fn facets(&self, standing: &[usize], added: &[usize], is_coarse: bool) -> Vec<Facet> {
        let of_part = |n: usize, back: bool| {
            let shade = move |shade: u16| {
                let shade = if is_coarse { coarse_shade(shade) } else { shade };
                if back { faint(shade) } else { shade }
            };
            let facets = self.drawn[n].facets(&self.shades[n]);
            facets.map(move |facet| Facet { class: shade(facet.class), ..facet })
        };
        let back = standing.iter().flat_map(|&n| of_part(n, !added.is_empty()));
        back.chain(added.iter().flat_map(|&n| of_part(n, false))).collect()
    }
}

/// Steps that follow one another as one line.
fn chained(steps: impl Iterator<Item = Vec<Point2>>) -> Vec<Vec<Point2>> {
    let mut runs: Vec<Vec<Point2>> = Vec::new();
    for step in steps {
        match runs.last_mut() {
            Some(run) if run.last() == step.first() => run.extend(&step[1..]),
            _ => runs.push(step),
        }
    }
    runs
}
