//! The room inside the loops of a piece: which places lie inside, and how far from the lines.

use sheetwright_geometry::math::{Point2, Vec2};
use sheetwright_geometry::predicate::{Box2, orientation, segments_touch};

/// Places of the grid that is laid over a piece, about.
const PLACES: f64 = 240.0;
/// The sides of a piece are sorted into so many rows at the most.
const ROWS: usize = 256;

/// A place inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot {
    pub(crate) at: Point2,
    /// How far it is from the nearest line, mm.
    pub(crate) clearance_mm: f64,
    /// The direction of that line.
    pub(crate) way: Vec2,
}

/// The inside of some loops, each with the sheet to its left.
pub(crate) struct Room {
    sides: Vec<[Point2; 2]>,
    around: Box2,
    /// The numbers of the sides that pass through each row of the box, from below.
    rows: Vec<Vec<u32>>,
}

impl Room {
    /// That inside some loops.
    pub(crate) fn new<'a>(loops: impl IntoIterator<Item = &'a [Point2]>) -> Self {
        let sides = loops.into_iter().flat_map(|line| {
            let next = line.iter().cycle().skip(1);
            line.iter().zip(next).map(|(&a, &b)| [a, b])
        });
        let sides: Vec<[Point2; 2]> = sides.collect();
        let none = Box2 { min: Point2::default(), max: Point2::default() };
        let around = Box2::of_points(sides.iter().map(|side| side[0])).unwrap_or(none);
        let rows = vec![Vec::new(); sides.len().clamp(1, ROWS)];
        let mut room = Self { sides, around, rows };
        for (n, &[a, b]) in room.sides.iter().enumerate() {
            let [low, high] = [a.y.min(b.y), a.y.max(b.y)].map(|y| room.row(y));
            room.rows[low..=high].iter_mut().for_each(|row| row.push(n as u32));
        }
        room
    }

    /// The row at a height, or the nearest one.
    fn row(&self, y: f64) -> usize {
        let share = (y - self.around.min.y) / (self.around.max.y - self.around.min.y);
        // The conversion saturates; of no number it is 0.
        ((share * self.rows.len() as f64) as usize).min(self.rows.len() - 1)
    }

    /// The box around it.
    pub(crate) fn around(&self) -> Box2 {
        self.around
    }

    /// Whether a point lies inside: the loops wind round it.
    pub(crate) fn holds(&self, p: Point2) -> bool {
        let passes = self.rows[self.row(p.y)].iter().map(|&n| {
            let [a, b] = self.sides[n as usize];
            if a.y <= p.y && p.y < b.y && orientation(a, b, p).is_gt() {
                1
            } else if b.y <= p.y && p.y < a.y && orientation(a, b, p).is_lt() {
                -1
            } else {
                0
            }
        });
        passes.sum::<i32>() != 0
    }

    /// A point as a place.
    pub(crate) fn spot(&self, at: Point2) -> Spot {
        let mut spot = Spot { at, clearance_mm: f64::INFINITY, way: Vec2::X };
        for &side in &self.sides {
            let off_mm = at.distance_to_segment(side);
            if off_mm < spot.clearance_mm {
                spot = Spot { at, clearance_mm: off_mm, way: side[1] - side[0] };
            }
        }
        spot
    }

    /// How far a point is from the nearest line, mm.
    pub(crate) fn clearance(&self, p: Point2) -> f64 {
        self.spot(p).clearance_mm
    }

    /// How far the line through a point runs inside, mm, ahead and back; 0 for a point outside.
    pub(crate) fn reach(&self, p: Point2, way: Vec2) -> [f64; 2] {
        if !self.holds(p) {
            return [0.0; 2];
        }
        let mut reach = [f64::INFINITY; 2];
        for [a, b] in &self.sides {
            let (to_a, to_b) = (*a - p, *b - p);
            let (left_a, left_b) = (way.perp_dot(to_a), way.perp_dot(to_b));
            if (left_a < 0.0) == (left_b < 0.0) {
                continue;
            }
            let share = left_a / (left_a - left_b);
            let along = way.dot(to_a) + share * way.dot(to_b - to_a);
            let end = usize::from(along < 0.0);
            reach[end] = reach[end].min(along.abs());
        }
        reach
    }

    /// Whether a line lies inside, without touching another.
    pub(crate) fn holds_line(&self, line: &[Point2]) -> bool {
        let crosses = |from, to| self.sides.iter().any(|&[a, b]| segments_touch(a, b, from, to));
        line.iter().all(|&p| self.holds(p)) && !line.windows(2).any(|w| crosses(w[0], w[1]))
    }

    /// Places inside, the farthest from the nearest line first: those of a grid and some more.
    pub(crate) fn places(&self, more: impl IntoIterator<Item = Point2>) -> Vec<Spot> {
        let size = self.around.max - self.around.min;
        let step = (size.x * size.y / PLACES).sqrt();
        let [columns, rows] = [size.x, size.y].map(|length| (length / step).ceil().min(PLACES));
        let mut tried: Vec<Point2> = more.into_iter().collect();
        if columns.is_finite() && rows.is_finite() {
            for row in 0..rows as u32 {
                for column in 0..columns as u32 {
                    let share = |n: u32, count: f64| (f64::from(n) + 0.5) / count;
                    let at = Vec2::new(size.x * share(column, columns), size.y * share(row, rows));
                    tried.push(self.around.min + at);
                }
            }
        }
        let inside = tried.into_iter().filter(|&p| self.holds(p));
        let mut places: Vec<Spot> = inside.map(|p| self.spot(p)).collect();
        places.sort_by(|a, b| b.clearance_mm.total_cmp(&a.clearance_mm));
        places
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::math::{cos, sin};
    use sheetwright_geometry::random::Random;

    #[test]
    fn rows_change_nothing() {
        let mut random = Random::new(5);
        let star: Vec<Point2> = (0..900)
            .map(|n| {
                let (angle, r) =
                    (std::f64::consts::TAU * f64::from(n) / 900.0, random.between(3.0, 9.0));
                // Some sides are level.
                Point2::new(r * cos(angle), (r * sin(angle) * 8.0).round() / 8.0)
            })
            .collect();
        let room = Room::new([&star[..]]);
        let sides = room.sides.clone();
        let all = (0..sides.len() as u32).collect();
        let plain = Room { sides, around: room.around, rows: vec![all] };
        let mut inside = 0;
        for n in 0..3_000 {
            let p = match star.get(n) {
                Some(&corner) => Point2::new(corner.x + random.between(-1.0, 1.0), corner.y),
                None => Point2::new(random.between(-10.0, 10.0), random.between(-10.0, 10.0)),
            };
            assert_eq!(room.holds(p), plain.holds(p), "{p:?}");
            inside += usize::from(room.holds(p));
        }
        assert!((500..2_500).contains(&inside), "{inside}");
    }

    #[test]
    fn a_square_with_a_hole_has_room_around_the_hole() {
        let p = Point2::new;
        let square =
            |low: f64, high: f64| vec![p(low, low), p(high, low), p(high, high), p(low, high)];
        let mut hole = square(4.0, 6.0);
        hole.reverse();
        let outline = square(0.0, 10.0);
        let room = Room::new([&outline[..], &hole[..]]);
        assert!(room.holds(p(1.0, 1.0)) && !room.holds(p(5.0, 5.0)) && !room.holds(p(11.0, 5.0)));
        assert_eq!(room.reach(p(2.0, 5.0), Vec2::X), [2.0, 2.0]);
        assert_eq!(room.reach(p(2.0, 2.0), Vec2::X), [8.0, 2.0]);
        assert!(room.holds_line(&[p(1.0, 1.0), p(9.0, 1.0)]));
        assert!(!room.holds_line(&[p(1.0, 5.0), p(9.0, 5.0)]));
        let places = room.places([]);
        assert!(
            places.len() > 200 && places.windows(2).all(|w| w[0].clearance_mm >= w[1].clearance_mm)
        );
        assert!((places[0].clearance_mm - 2.0).abs() < 0.5, "{places:?}");
        assert_eq!(Room::new([]).places([]), []);
    }
}
