//! The order of rungs along a surface: strips of triangles that hang together one after the other.

use sheetwright::index::SampleIndex;
use sheetwright::surface::Connectivity;

/// A rung of a strip: its number, and its ends, of which the first always lies on one side of the
/// strip.
pub(super) type StripRung = (usize, [SampleIndex; 2]);

/// All rungs in strips: from one triangle that ends a strip (it has one rung, or three) to the
/// next. Every rung stands in exactly one strip.
pub(super) fn strips(connectivity: &Connectivity) -> Vec<Vec<StripRung>> {
    let hinges = connectivity.hinges();
    let of_triangles = connectivity.hinges_of_triangles();
    let through = |triangle: usize| of_triangles[triangle].len() == 2;
    let mut seen = vec![false; hinges.len()];
    let mut found = Vec::new();
    // Strips that have an end begin there; the remaining strips are rings.
    for ends_only in [true, false] {
        for first in 0..hinges.len() {
            let triangles = hinges[first].triangles.map(|t| t.get());
            let Some(start) = triangles.into_iter().find(|&t| !ends_only || !through(t)) else {
                continue;
            };
            if seen[first] {
                continue;
            }
            seen[first] = true;
            let mut strip = vec![(first, hinges[first].rung.ends())];
            let (mut rung, mut behind) = (first, start);
            loop {
                let [a, b] = hinges[rung].triangles.map(|t| t.get());
                let ahead = if a == behind { b } else { a };
                let next = of_triangles[ahead].iter().copied().find(|&h| h != rung && !seen[h]);
                let Some(next) = next.filter(|_| through(ahead)) else { break };
                seen[next] = true;
                let sides = sides_after(strip[strip.len() - 1].1, hinges[next].rung.ends());
                strip.push((next, sides));
                (rung, behind) = (next, ahead);
            }
            found.push(strip);
        }
    }
    found
}

/// The ends of the next rung, in the order of the sides of the last: the two share one end.
fn sides_after(last: [SampleIndex; 2], next: [SampleIndex; 2]) -> [SampleIndex; 2] {
    if last[0] == next[1] || last[1] == next[0] { [next[1], next[0]] } else { next }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn connectivity(samples: usize, triangles: &[[usize; 3]]) -> Connectivity {
        let triangles = triangles.iter().map(|t| t.map(SampleIndex::new)).collect();
        Connectivity::new(std::slice::from_ref(&(0..samples)), triangles).unwrap()
    }

    fn numbers(connectivity: &Connectivity) -> Vec<Vec<[usize; 2]>> {
        let plain = |strip: Vec<StripRung>| strip.iter().map(|r| r.1.map(|s| s.get())).collect();
        strips(connectivity).into_iter().map(plain).collect()
    }

    #[test]
    fn a_band_is_one_strip_with_its_sides_kept() {
        let band = connectivity(6, &[[0, 1, 5], [1, 4, 5], [1, 2, 4], [2, 3, 4]]);
        assert_eq!(numbers(&band), vec![vec![[1, 5], [1, 4], [2, 4]]]);
    }

    #[test]
    fn a_triangle_with_three_rungs_ends_three_strips() {
        let star = connectivity(6, &[[0, 1, 2], [2, 3, 4], [0, 4, 5], [0, 2, 4]]);
        assert_eq!(numbers(&star), vec![vec![[0, 2]], vec![[0, 4]], vec![[2, 4]]]);
    }
}
