//! Which sets of triangles are triangulations of a domain with holes: the definition, checked side
//! by side and vertex by vertex, as an oracle for faster programs.

use std::ops::Range;

/// What is wrong with `triangles` as a triangulation of the domain that `loops` bound (numbers of
/// samples, loop after loop), in words; `None` if nothing is. A triangulation
/// 1. has every sample on a triangle, and every triangle three samples;
/// 2. uses each pair of samples at most once as a side of a triangle in each direction, so that two
///    triangles at a side run along it in opposite directions;
/// 3. has every edge of the boundary as a side of one triangle, in the direction of its loop, and
///    every other side twice;
/// 4. has one fan of triangles at each sample, from the next sample of its loop to the previous;
/// 5. is connected, with the Euler characteristic 1 − h for h holes.
pub fn fault(loops: &[Range<usize>], triangles: &[[usize; 3]]) -> Option<String> {
    let m = loops.iter().map(|l| l.end).max()?;
    let (mut next, mut previous) = (vec![m; m], vec![m; m]);
    for of_loop in loops {
        for i in of_loop.clone() {
            let after = if i + 1 == of_loop.end { of_loop.start } else { i + 1 };
            (next[i], previous[after]) = (after, i);
        }
    }
    // after[a][b]: the third corner of the triangle that runs from a to b.
    let mut after: Vec<Vec<Option<usize>>> = vec![vec![None; m]; m];
    for &[a, b, c] in triangles {
        if a == b || b == c || c == a || a >= m || b >= m || c >= m {
            return Some(format!("{a}, {b}, {c} is no triangle"));
        }
        for (from, to, third) in [(a, b, c), (b, c, a), (c, a, b)] {
            if after[from][to].replace(third).is_some() {
                return Some(format!("two triangles run from {from} to {to}"));
            }
        }
    }
    let mut sides = 0;
    for a in 0..m {
        for b in 0..m {
            let (used, back) = (after[a][b].is_some(), after[b][a].is_some());
            if next[a] == b && !used {
                return Some(format!("no triangle at the edge from {a} to {b}"));
            }
            if next[a] == b && back {
                return Some(format!("a triangle outside the edge from {a} to {b}"));
            }
            if used && !back && next[a] != b {
                return Some(format!("the side from {a} to {b} is open"));
            }
            sides += usize::from(a < b && (used || back));
        }
    }
    for v in 0..m {
        let of_sample = triangles.iter().filter(|t| t.contains(&v)).count();
        let (mut at, mut fan) = (next[v], 0);
        while let Some(third) = after[v][at] {
            (at, fan) = (third, fan + 1);
        }
        if at != previous[v] || fan != of_sample {
            return Some(format!("sample {v} has a fan of {fan} of its {of_sample} triangles"));
        }
    }
    let parts = parts(m, triangles);
    if parts != 1 {
        return Some(format!("the surface falls into {parts} parts"));
    }
    // V − E + F = 2 − loops, without going below zero.
    if m + triangles.len() + loops.len() != sides + 2 {
        return Some(format!("{m} samples, {sides} sides, {} triangles", triangles.len()));
    }
    None
}

/// The number of connected parts that the triangles make of the samples.
fn parts(m: usize, triangles: &[[usize; 3]]) -> usize {
    let mut part: Vec<usize> = (0..m).collect();
    for &[a, b, c] in triangles {
        for other in [b, c] {
            let (from, to) = (part[other], part[a]);
            for p in part.iter_mut().filter(|p| **p == from) {
                *p = to;
            }
        }
    }
    (0..m).filter(|&i| part[i] == i).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six triangles round a ring of three and three samples.
    const ROUND: [[usize; 3]; 6] =
        [[0, 1, 3], [5, 3, 1], [1, 2, 5], [4, 5, 2], [2, 0, 4], [3, 4, 0]];

    #[test]
    fn a_ring_is_a_triangulation_and_what_is_none_is_named() {
        let loops = [0..3, 3..6];
        assert_eq!(fault(&loops, &ROUND), None);
        let named = |triangles: &[[usize; 3]], words: &str| {
            let fault = fault(&loops, triangles).unwrap_or_default();
            assert!(fault.contains(words), "{fault:?} says nothing of {words:?}");
        };
        named(&ROUND[1..], "no triangle at the edge from 0 to 1");
        named(&ROUND.map(|[a, b, c]| [a, c, b]), "no triangle at the edge from 0 to 1");
        let over_the_edge =
            fault(std::slice::from_ref(&(0..4)), &[[0, 1, 2], [0, 2, 3], [1, 0, 3]]);
        assert!(over_the_edge.is_some_and(|f| f.contains("outside the edge from 0 to 1")));
        named(&[&ROUND[..], &[[0, 1, 4]]].concat(), "two triangles run from 0 to 1");
        named(&[&ROUND[..], &[[0, 0, 4]]].concat(), "is no triangle");
        named(&[[0, 1, 2], [3, 4, 5]], "2 parts");
    }
}
