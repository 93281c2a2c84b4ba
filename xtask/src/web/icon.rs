//! The icon: a bent sheet with its rungs, over the flat pattern of it.

use std::fmt::Write;

/// Rungs that are drawn across the sheet.
const RUNGS: usize = 5;

/// A point of a cubic Bézier curve.
fn at(curve: [[f64; 2]; 4], t: f64) -> [f64; 2] {
    let mix = |a: [f64; 2], b: [f64; 2]| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
    let [a, b, c, d] = curve;
    let [ab, bc, cd] = [mix(a, b), mix(b, c), mix(c, d)];
    mix(mix(ab, bc), mix(bc, cd))
}

fn path([a, b, c, d]: [[f64; 2]; 4], begin: char) -> String {
    format!("{begin}{} {}C{} {} {} {} {} {}", a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1])
}

/// The icon as SVG, 64 units wide and high. `colour` gives the colours of the theme by name.
pub(super) fn svg(colour: &dyn Fn(&str) -> Result<String, String>) -> Result<String, String> {
    let near = [[9.0, 46.0], [20.0, 20.0], [36.0, 58.0], [55.0, 34.0]];
    let far = [[17.0, 25.0], [28.0, 1.0], [40.0, 35.0], [53.0, 14.0]];
    let back = [far[3], far[2], far[1], far[0]];
    let mut out =
        String::from("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 64 64\">\n");
    let mut add =
        |line: std::fmt::Arguments<'_>| out.write_fmt(line).map_err(|_| "no memory".to_owned());
    add(format_args!(
        "<rect width=\"64\" height=\"64\" rx=\"14\" fill=\"{}\"/>\n",
        colour("accent")?
    ))?;
    add(format_args!(
        "<path d=\"{}{}Z\" fill=\"{}\"/>\n",
        path(near, 'M'),
        path(back, 'L'),
        colour("sheet")?
    ))?;
    let mut rungs = String::new();
    for n in 1..=RUNGS {
        let t = n as f64 / (RUNGS + 1) as f64;
        let ([x, y], [u, v]) = (at(near, t), at(far, t));
        write!(rungs, "M{x:.2} {y:.2}L{u:.2} {v:.2}").map_err(|_| "no memory".to_owned())?;
    }
    add(format_args!(
        "<path d=\"{rungs}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
        colour("rung")?
    ))?;
    add(format_args!(
        "<path d=\"{}{}Z\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\"/>\n",
        path(near, 'M'),
        path(back, 'L'),
        colour("on_accent")?
    ))?;
    out.push_str("</svg>\n");
    Ok(out)
}
