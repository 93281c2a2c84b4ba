//! How parts with their texts are packed into a pane, at the largest scale.
//!
//! Texts have the same size however large parts are shown, and a part is shown with its dimensions
//! from a size on. So parts may fit at a scale and not at a smaller one: scales are tried from the
//! largest possible downwards, by three hundredths, until one fits. Most that are too large have
//! more area than the pane, which is seen at once.
//!
//! At a scale parts lie in rows, the highest first, each in the first row with room for it; if that
//! does not fit, in columns, the widest first.

use eframe::egui::{Pos2, Vec2};

/// The room between parts, points.
pub(super) const CLEAR: f32 = 12.0;
/// One scale that is tried is larger than the next by this factor.
const STEP: f64 = 1.03;
/// So often the step between a scale that fits and one that does not is halved: to a thousandth.
const HALVED: usize = 5;

/// The room that a part takes with its texts, points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) size: Vec2,
    /// Where the middle of the part lies in it.
    pub(super) middle: Vec2,
}

impl Cell {
    fn transposed(self) -> Self {
        Self { size: self.size.yx(), middle: self.middle.yx() }
    }
}

/// Where the middles of parts lie, and the box around all, points.
#[derive(Debug)]
pub(super) struct Packed {
    pub(super) middles: Vec<Pos2>,
    pub(super) size: Vec2,
}

impl Packed {
    fn transposed(self) -> Self {
        let middles = self.middles.into_iter().map(|at| Pos2::new(at.y, at.x)).collect();
        Self { middles, size: self.size.yx() }
    }
}

/// The largest scale between two, the least excluded, at which all cells fit into a room, to a
/// thousandth, and how they lie there. `None` if there is no such scale.
pub(super) fn largest(
    cells: impl Fn(f64) -> Vec<Cell>,
    room: Vec2,
    least: f64,
    most: f64,
) -> Option<(f64, Packed)> {
    let mut scale = most;
    while scale > least {
        if let Some(packed) = packed(&cells(scale), room) {
            let mut found = (scale, packed);
            let mut too_large = (STEP * scale).min(most);
            for _ in 0..HALVED {
                let between = (found.0 * too_large).sqrt();
                match self::packed(&cells(between), room) {
                    Some(packed) => found = (between, packed),
                    None => too_large = between,
                }
            }
            return Some(found);
        }
        scale /= STEP;
    }
    None
}

/// Cells in a room, in rows or in columns; `None` where they don't fit.
fn packed(cells: &[Cell], room: Vec2) -> Option<Packed> {
    let around = |size: Vec2| (size.x + CLEAR) * (size.y + CLEAR);
    let area: f32 = cells.iter().map(|cell| around(cell.size)).sum();
    let fits = |cell: &Cell| cell.size.x <= room.x && cell.size.y <= room.y;
    if area > around(room) || !cells.iter().all(fits) {
        return None;
    }
    in_rows(cells, room).or_else(|| {
        let turned: Vec<Cell> = cells.iter().map(|cell| cell.transposed()).collect();
        in_rows(&turned, room.yx()).map(Packed::transposed)
    })
}

/// Cells in rows, the highest first, each in the first row with room for it; `None` if the rows are
/// higher than the room.
fn in_rows(cells: &[Cell], room: Vec2) -> Option<Packed> {
    struct Row {
        top: f32,
        taken: f32,
    }
    let mut order: Vec<usize> = (0..cells.len()).collect();
    order.sort_by(|&a, &b| cells[b].size.y.total_cmp(&cells[a].size.y));
    let mut rows: Vec<Row> = Vec::new();
    let mut middles = vec![Pos2::ZERO; cells.len()];
    let mut size = Vec2::ZERO;
    for n in order {
        let Cell { size: of, middle } = cells[n];
        let found = rows.iter().position(|row| row.taken + CLEAR + of.x <= room.x);
        let at = found.unwrap_or_else(|| {
            let top = if rows.is_empty() { 0.0 } else { size.y + CLEAR };
            rows.push(Row { top, taken: -CLEAR });
            size.y = top + of.y;
            rows.len() - 1
        });
        if size.y > room.y {
            return None;
        }
        let row = &mut rows[at];
        middles[n] = Pos2::new(row.taken + CLEAR, row.top) + middle;
        row.taken += CLEAR + of.x;
        size.x = size.x.max(row.taken);
    }
    Some(Packed { middles, size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Rect, vec2};

    /// Sizes, with texts beside the parts that are large enough.
    fn cells(sizes: &[[f32; 2]]) -> impl Fn(f64) -> Vec<Cell> + '_ {
        |scale| {
            let cell = |&[x, y]: &[f32; 2]| {
                let of = vec2(x, y) * scale as f32;
                let beside = if of.max_elem() > 72.0 { 40.0 } else { 0.0 };
                let size = vec2(beside + of.x, 20.0 + of.y);
                Cell { size, middle: vec2(beside, 20.0) + 0.5 * of }
            };
            sizes.iter().map(cell).collect()
        }
    }

    fn kinds() -> Vec<Vec<[f32; 2]>> {
        let mixed = (1..30).map(|n| [20.0 * n as f32, 300.0 / n as f32]).collect();
        vec![vec![[300.0, 200.0]], vec![[900.0, 80.0]; 12], vec![[80.0, 500.0]; 36], mixed]
    }

    #[test]
    fn cells_fit_into_the_room_and_cover_no_other() {
        for sizes in kinds() {
            for room in [vec2(640.0, 260.0), vec2(300.0, 500.0)] {
                let cells = cells(&sizes);
                let (scale, packed) = largest(&cells, room, 1e-4, 10.0).unwrap();
                assert!(packed.size.x <= room.x && packed.size.y <= room.y);
                let places = cells(scale).into_iter().zip(&packed.middles);
                let boxes: Vec<Rect> = places
                    .map(|(cell, &middle)| Rect::from_min_size(middle - cell.middle, cell.size))
                    .collect();
                let all = Rect::from_min_size(Pos2::ZERO, packed.size).expand(0.01);
                for (n, a) in boxes.iter().enumerate() {
                    assert!(all.contains_rect(*a));
                    assert!(boxes[..n].iter().all(|b| !a.shrink(0.01).intersects(*b)));
                }
            }
        }
    }

    #[test]
    fn no_larger_scale_fits() {
        for sizes in kinds() {
            for room in [vec2(640.0, 260.0), vec2(300.0, 500.0)] {
                let (scale, _) = largest(cells(&sizes), room, 1e-4, 10.0).unwrap();
                let mut larger = 1.002 * scale;
                for _ in 0..40 {
                    assert!(packed(&cells(&sizes)(larger), room).is_none(), "{scale} {larger}");
                    larger *= STEP;
                }
                assert!(largest(cells(&sizes), room, 1.01 * scale, 10.0).is_none());
            }
        }
    }
}
