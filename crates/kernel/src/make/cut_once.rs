//! Lines that two parts on a sheet have in common, cut once.
//!
//! Of two cut lines that run along one another, the later loses what the earlier cuts already. What
//! is left of it are open lines from one end of a common line to the next.

use crate::pattern::{PatternPath, Role};
use sheetwright_geometry::math::Point2;
use sheetwright_geometry::predicate::Box2;

/// Lines that come nearer to one another than this are one, mm. Far less than any kerf, and more
/// than the distance at which parts with cuts in common are laid.
const ONE_LINE_MM: f64 = 5e-3;
/// A common line that is shorter is cut twice, mm: machines lose more by stopping.
const LEAST_MM: f64 = 1.0;

/// Leaves out what cut lines of one drawing have in common with earlier ones.
pub(super) fn cut_once(paths: Vec<PatternPath>) -> Vec<PatternPath> {
    let mut kept: Vec<PatternPath> = Vec::with_capacity(paths.len());
    // Whole lines to cut so far, with the boxes around them.
    let mut cut: Vec<(Box2, Vec<[Point2; 2]>)> = Vec::new();
    for path in paths {
        let around = Box2::of_points(path.points.iter().copied());
        let (Role::Cut | Role::Inner, Some(around)) = (path.role, around) else {
            kept.push(path);
            continue;
        };
        let edges = edges(&path);
        let near: Vec<[Point2; 2]> = cut
            .iter()
            .filter(|(other, _)| overlap(other, &around))
            .flat_map(|(_, edges)| edges)
            .filter(|edge| {
                Box2::of_points(edge.iter().copied()).is_some_and(|edge| overlap(&edge, &around))
            })
            .copied()
            .collect();
        let left: Vec<Vec<[Point2; 2]>> = edges.iter().map(|edge| without(*edge, &near)).collect();
        let is_whole =
            left.iter().zip(&edges).all(|(left, edge)| left.len() == 1 && left[0] == *edge);
        match is_whole {
            true => kept.push(path),
            false => kept.extend(chained(&left.concat()).into_iter().map(|points| PatternPath {
                points,
                closed: false,
                ..path.clone()
            })),
        }
        cut.push((around, edges));
    }
    kept
}

fn edges(path: &PatternPath) -> Vec<[Point2; 2]> {
    let open = path.points.windows(2).map(|pair| [pair[0], pair[1]]);
    let last = match (path.closed, path.points.first(), path.points.last()) {
        (true, Some(&first), Some(&last)) => Some([last, first]),
        _ => None,
    };
    open.chain(last).collect()
}

fn overlap(a: &Box2, b: &Box2) -> bool {
    (a.min.x - ONE_LINE_MM <= b.max.x && b.min.x - ONE_LINE_MM <= a.max.x)
        && (a.min.y - ONE_LINE_MM <= b.max.y && b.min.y - ONE_LINE_MM <= a.max.y)
}

/// What of an edge does not run along one of the others, in order.
fn without([from, to]: [Point2; 2], others: &[[Point2; 2]]) -> Vec<[Point2; 2]> {
    let (way, length) = (to - from, from.distance(to));
    let shares = |other: &[Point2; 2]| {
        let share = |p: Point2| (p - from).dot(way) / (length * length);
        let [a, b] = other.map(share);
        let [low, high] = [a.min(b).max(0.0), a.max(b).min(1.0)];
        // Both ends of what lies beside the edge must lie on its line.
        let on = |at: f64| {
            let along = (at - a) / (b - a);
            let p = other[0].lerp(other[1], along);
            from.lerp(to, at).distance(p) < ONE_LINE_MM
        };
        (a != b && low < high && on(low) && on(high)).then_some([low, high])
    };
    let mut pieces: Vec<[f64; 2]> = others.iter().filter_map(shares).collect();
    pieces.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // What is shorter than the width of a line is nothing.
    let least = ONE_LINE_MM / length.max(f64::MIN_POSITIVE);
    // The sides of the other line that follow one another are one.
    let mut gone: Vec<[f64; 2]> = Vec::new();
    for [low, high] in pieces {
        match gone.last_mut() {
            Some(last) if low - last[1] <= least => last[1] = high.max(last[1]),
            _ => gone.push([low, high]),
        }
    }
    gone.retain(|[low, high]| (high - low) * length >= LEAST_MM.min(0.5 * length));
    if gone.is_empty() {
        return vec![[from, to]];
    }
    let mut left = Vec::new();
    let mut at = 0.0;
    for [low, high] in gone.into_iter().chain([[1.0, 1.0]]) {
        if low - at > least {
            let end = |share: f64| match share {
                0.0 => from,
                1.0 => to,
                _ => from.lerp(to, share),
            };
            left.push([end(at), end(low)]);
        }
        at = high.max(at);
    }
    left
}

/// Edges that follow one another as lines.
fn chained(edges: &[[Point2; 2]]) -> Vec<Vec<Point2>> {
    let mut lines: Vec<Vec<Point2>> = Vec::new();
    for &[from, to] in edges {
        match lines.last_mut() {
            Some(line) if line.last() == Some(&from) => line.push(to),
            _ => lines.push(vec![from, to]),
        }
    }
    // The last may go on in the first, where a closed line was begun in the middle of one.
    if lines.len() > 1
        && lines.last().and_then(|line| line.last()) == lines.first().and_then(|it| it.first())
        && let Some(mut last) = lines.pop()
    {
        last.extend(lines[0].drain(1..));
        lines[0] = last;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::PathKind;

    fn square(x: f64, y: f64, side: f64) -> PatternPath {
        let at = |dx: f64, dy: f64| Point2::new(x + dx * side, y + dy * side);
        PatternPath {
            role: Role::Cut,
            kind: PathKind::Outline,
            points: vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
            closed: true,
        }
    }

    fn length(paths: &[PatternPath]) -> f64 {
        paths.iter().flat_map(edges).map(|[a, b]| a.distance(b)).sum()
    }

    #[test]
    fn a_line_of_two_squares_is_cut_once() {
        let two = vec![square(0.0, 0.0, 100.0), square(100.002, 0.0, 100.0)];
        let once = cut_once(two);
        assert_eq!(once.len(), 2);
        assert!((length(&once) - 700.0).abs() < 0.01, "{}", length(&once));
        assert_eq!((once[1].closed, once[1].points.len()), (false, 4));
        // The fourth of a block has two sides left.
        let four = [[0.0, 0.0], [100.0, 0.0], [0.0, 100.0], [100.0, 100.0]];
        let once = cut_once(four.iter().map(|&[x, y]| square(x, y, 100.0)).collect());
        assert!((length(&once) - 1200.0).abs() < 0.01);
    }

    #[test]
    fn a_shorter_side_takes_out_a_piece_and_others_stay() {
        let two = vec![square(0.0, 0.0, 100.0), square(40.0, 100.0, 30.0)];
        assert!((length(&cut_once(two)) - 490.0).abs() < 1e-9);
        let two = vec![square(40.0, 100.0, 30.0), square(0.0, 0.0, 100.0)];
        let once = cut_once(two);
        assert!((length(&once) - 490.0).abs() < 1e-9);
        assert_eq!(once.len(), 2, "one line, from one end of the common line round to the other");
        // A side beside one of many short sides.
        let many = |by: f64| {
            let mut other = square(100.0, 0.0, 100.0);
            let count = (100.0 / by) as usize;
            let side = (1..count).map(|n| Point2::new(100.0, 100.0 - n as f64 * by));
            other.points.extend(side);
            other
        };
        for two in
            [vec![square(0.0, 0.0, 100.0), many(0.5)], vec![many(0.5), square(0.0, 0.0, 100.0)]]
        {
            assert!((length(&cut_once(two)) - 700.0).abs() < 0.01);
        }
        // A side of some micrometres stays.
        let mut tiny = square(0.0, 0.0, 100.0);
        tiny.points.insert(1, Point2::new(99.997, 0.0));
        tiny.points.insert(2, Point2::new(99.997, 0.0));
        assert_eq!(cut_once(vec![tiny.clone()]), [tiny]);
        let apart = vec![square(0.0, 0.0, 100.0), square(100.5, 0.0, 100.0)];
        assert_eq!(cut_once(apart.clone()), apart);
    }
}
