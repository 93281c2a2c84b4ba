//! The look of the page and of its pictures: all colours and letter sizes, light and dark.
//!
//! Blue means good, orange means a problem: readers with any kind of colour vision can tell these
//! colours apart. Words, dashes and thickness repeat the distinction.

use crate::space::{LIGHT, Ramp, SHADES, in_ramp};
use std::fmt::Write as _;

/// The side that the surface faces, and the other, on a dark page.
const DARK: [Ramp; 2] =
    [[[36.0, 62.0, 88.0], [122.0, 165.0, 204.0]], [[82.0, 64.0, 40.0], [178.0, 150.0, 110.0]]];

/// Steps of the colour map of errors.
pub(super) const HEATS: usize = 12;

/// From no error to the largest, on a light page: paper, yellow, orange, dark red. Brightness falls
/// all the way, so that any kind of colour vision reads it, and a grey print too.
const LIGHT_HEAT: [[f64; 3]; 4] =
    [[240.0, 244.0, 248.0], [252.0, 214.0, 112.0], [226.0, 110.0, 30.0], [122.0, 18.0, 22.0]];
/// From no error to the largest, on a dark page: dark blue, dark red, orange, light yellow.
/// Brightness rises all the way.
const DARK_HEAT: [[f64; 3]; 4] =
    [[30.0, 42.0, 54.0], [130.0, 52.0, 36.0], [226.0, 122.0, 40.0], [255.0, 232.0, 150.0]];

/// The rules that pictures need.
pub(super) fn picture_style() -> String {
    let mut css = String::from(PICTURE);
    shades(&mut css, &LIGHT);
    heats(&mut css, &LIGHT_HEAT);
    css.push_str("@media (prefers-color-scheme:dark){");
    css.push_str(PICTURE_DARK);
    shades(&mut css, &DARK);
    heats(&mut css, &DARK_HEAT);
    css.push('}');
    // Paper is white, also with a dark theme.
    css.push_str("@media print{");
    css.push_str(PICTURE_PRINT);
    shades(&mut css, &LIGHT);
    heats(&mut css, &LIGHT_HEAT);
    css.push('}');
    css
}

/// All rules of the page.
pub(super) fn page_style() -> String {
    format!("{PAGE}{}", picture_style())
}

fn shades(css: &mut String, ramps: &[Ramp; 2]) {
    for (side, ramp) in ["f", "b"].into_iter().zip(ramps) {
        for n in 0..SHADES {
            let _ = write!(css, ".{side}{n}{{color:#");
            for part in in_ramp(ramp, n) {
                let _ = write!(css, "{:02x}", part.round() as u8);
            }
            css.push('}');
        }
    }
}

fn heats(css: &mut String, ramp: &[[f64; 3]; 4]) {
    for n in 0..HEATS {
        let at = n as f64 / (HEATS - 1) as f64 * (ramp.len() - 1) as f64;
        let from = (at as usize).min(ramp.len() - 2);
        let share = at - from as f64;
        let _ = write!(css, ".k{n}{{color:#");
        for (low, high) in ramp[from].iter().zip(ramp[from + 1]) {
            let _ = write!(css, "{:02x}", (low + share * (high - low)).round() as u8);
        }
        css.push('}');
    }
}

const PICTURE: &str = "\
.pic{--ink:#16202a;--quiet:#5a6672;--paper:#fff;--line:#173a5e;--bad:#b83c05;--warm:#8a5a00;\
--tint:#eef4fa;--bar:#2f6ea8;--force:#fbf0d6;--beyond:#fbe0d3;--other:#0b6b57;--tight:#86198f;\
font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif}\
.pic path,.pic circle,.pic rect{vector-effect:non-scaling-stroke}\
.pic path{fill:none;stroke-linejoin:round;stroke-linecap:round}\
.pic path[class^=f],.pic path[class^=b]{fill:currentColor;stroke:currentColor;stroke-width:.8}\
.pic path[class^=k]{fill:currentColor;stroke:currentColor;stroke-width:.6}\
.pic path.cells{stroke:none}\
.pic .here{fill:none;stroke:var(--ink);stroke-width:2}\
.pic .frame{fill:none;stroke:var(--quiet);stroke-width:1}\
.pic .seam{stroke:var(--other);stroke-width:2.4}\
.pic text{font-size:13px;fill:var(--ink)}\
.pic .ts{text-anchor:start}.pic .tm{text-anchor:middle}.pic .te{text-anchor:end}\
.pic .quiet{fill:var(--quiet)}\
.pic .halo{paint-order:stroke;stroke:var(--paper);stroke-width:4px;stroke-linejoin:round}\
.pic .band{fill:var(--warm)}\
.pic .letter{font-weight:600}\
.pic .r{stroke:var(--line);stroke-width:.7;stroke-opacity:.5}\
.pic .turn{stroke:var(--line);stroke-width:.9;stroke-opacity:.7}\
.pic .net{stroke:var(--line);stroke-width:.6;stroke-opacity:.55}\
.pic .x{stroke:var(--bad);stroke-width:1}\
.pic .w{stroke:var(--bad);stroke-width:3}\
.pic .t{stroke:var(--tight);stroke-width:2;stroke-dasharray:3 4}\
.pic .e{stroke:var(--ink);stroke-width:2}\
.pic .cut{stroke:var(--ink);stroke-width:2}.pic .thin{stroke-width:1}\
.pic .sheet-edge{fill:none;stroke:var(--line);stroke-width:1.5}\
.pic .paper{fill:var(--paper)}.pic .sheet{fill:var(--tint)}\
.pic .net{stroke:var(--ink);stroke-width:1;stroke-dasharray:4 3}\
.pic .score{stroke:var(--line);stroke-width:1.4;stroke-dasharray:7 4}\
.pic .tick{stroke:var(--line);stroke-width:1.6}\
.pic .axis{stroke:var(--quiet);stroke-width:1.1}\
.pic .tag{fill:var(--paper);stroke:var(--quiet);stroke-width:1}\
.pic .ring{fill:none;stroke:var(--bad);stroke-width:2}\
.pic .beyond{fill:var(--beyond)}\
.pic .limit{stroke:var(--bad);stroke-width:1.8;stroke-dasharray:8 4}\
.pic path.bar{fill:none;stroke:var(--bar);stroke-width:1.5;stroke-linecap:butt;vector-effect:none}\
.pic path.over{stroke:var(--bad);stroke-width:2}\
.pic path.unsure{stroke:var(--warm);stroke-width:2;stroke-dasharray:3 2}\
.pic .head{fill:var(--bar)}.pic circle.over{fill:var(--bad)}.pic circle.unsure{fill:var(--warm)}\
.pic .ball{fill:var(--tint);stroke:var(--quiet);stroke-width:1.2}\
.pic .grid{stroke:var(--quiet);stroke-width:.6;stroke-opacity:.4}\
.pic .curve{stroke:var(--bar);stroke-width:2.4}.pic .few{stroke-width:1.2}\
.pic .other{stroke:var(--other);stroke-dasharray:5 5}\
.pic .behind{stroke-dasharray:2 4;stroke-width:1.4}\
@media screen and (max-width:560px){.pic text{font-size:17px}}";

const PICTURE_DARK: &str = "\
.pic{--ink:#e9eff5;--quiet:#9daab7;--paper:#12181f;--line:#dbe9f7;--bad:#ff9257;--warm:#e9bd5c;\
--tint:#1b2733;--bar:#6db1ee;--force:#33290f;--beyond:#421f10;--other:#5fd0b4;--tight:#e58cf0}";

const PICTURE_PRINT: &str = "\
.pic{--ink:#16202a;--quiet:#5a6672;--paper:#fff;--line:#173a5e;--bad:#b83c05;--warm:#8a5a00;\
--tint:#eef4fa;--bar:#2f6ea8;--force:#fbf0d6;--beyond:#fbe0d3;--other:#0b6b57;--tight:#86198f}\
.pic text{font-size:16px}";

const PAGE: &str = "\
:root{color-scheme:light dark;--ink:#16202a;--quiet:#56626e;--paper:#fff;--rule:#d5dce3;\
--card:#f5f8fb;--good:#14598f;--warm:#8a5a00;--bad:#b83c05}\
@media (prefers-color-scheme:dark){:root{--ink:#e9eff5;--quiet:#a3b0bd;--paper:#12181f;\
--rule:#303b47;--card:#1a222b;--good:#8cc4f5;--warm:#e9bd5c;--bad:#ff9257}}\
*{box-sizing:border-box}\
html{-webkit-text-size-adjust:100%;text-size-adjust:100%}\
body{margin:0;background:var(--paper);color:var(--ink);\
font:16px/1.5 system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif}\
main{max-width:1160px;margin:0 auto;padding:28px 16px 64px}\
h1{font-size:1.8rem;line-height:1.2;margin:0 0 4px}\
h2{font-size:1.4rem;line-height:1.25;margin:0 0 10px}\
h3{font-size:1.05rem;margin:26px 0 8px}\
h1,h2,h3,p,li,a,tbody th{overflow-wrap:anywhere}td{overflow-wrap:break-word}tbody th{min-width:7em}\
p{margin:0 0 10px}\
.sub{color:var(--quiet);margin-bottom:22px}\
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,320px),1fr));gap:12px;\
padding:0;margin:0 0 26px;list-style:none}\
.card{background:var(--card);border:1px solid var(--rule);border-left:6px solid var(--good);\
border-radius:6px;padding:12px 14px}\
.card.warning{border-left-color:var(--warm)}.card.error{border-left-color:var(--bad)}\
.card a{color:inherit;font-weight:600;text-decoration-thickness:1px;text-underline-offset:3px}\
.card p{margin:6px 0 0}\
.verdict{display:inline-flex;align-items:center;gap:8px;font-weight:700;font-size:1.12rem;\
color:var(--good)}\
.verdict.warning{color:var(--warm)}.verdict.error{color:var(--bad)}\
.verdict b{display:inline-block;width:1.5em;height:1.5em;line-height:1.5em;border-radius:50%;\
text-align:center;font-size:.85em;background:currentColor}\
.verdict b i{font-style:normal;color:var(--paper)}\
.panel{border-top:2px solid var(--rule);padding-top:26px;margin-top:34px}\
.cuts,.joined{margin:26px 0}.cuts .sub{margin-top:8px}.whole{margin:0 0 26px}.whole svg{max-width:600px}.whole figcaption{text-align:center}\
.figures{display:grid;grid-template-columns:minmax(0,1fr) minmax(0,1fr);gap:22px 32px;\
align-items:start;margin-top:18px}\
.column{display:grid;gap:26px;min-width:0}\
figure{margin:0;min-width:0}\
figure svg{display:block;width:100%;height:auto;max-width:560px;margin:0 auto}\
figcaption{font-size:.92rem;color:var(--quiet);margin-top:6px}\
figcaption strong{color:var(--ink)}\
.edges{list-style:none;padding:0;margin:6px 0 0;display:flex;flex-wrap:wrap;gap:2px 18px;\
color:var(--ink)}\
.short td svg{display:block;width:96px;height:48px}.short .verdict{font-size:1rem}\
.short td .findings{margin-top:8px;font-size:.92rem}.short tr{break-inside:avoid}\
.findings{list-style:none;margin:0;padding:0}\
.findings li{border-left:4px solid var(--good);padding:2px 0 2px 12px;margin:0 0 12px}\
.findings li.warning{border-left-color:var(--warm)}.findings li.error{border-left-color:var(--bad)}\
.findings .kind{font-weight:700}\
.findings li.warning .kind{color:var(--warm)}.findings li.error .kind{color:var(--bad)}\
.findings .where{color:var(--quiet);display:block}\
code{font:.88em ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;color:var(--quiet)}\
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}\
caption{text-align:left;font-weight:600;padding-bottom:6px}\
th,td{text-align:left;vertical-align:top;padding:5px 12px 5px 0;border-bottom:1px solid var(--rule);\
font-weight:400}\
thead th{color:var(--quiet);font-size:.88rem;vertical-align:bottom}\
tbody th{font-weight:600}\
.numbers{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,250px),1fr));\
gap:0 32px;margin:0}\
.numbers div{display:flex;justify-content:space-between;gap:14px;padding:4px 0;\
border-bottom:1px solid var(--rule)}\
.numbers dt{color:var(--quiet)}.numbers dd{margin:0;text-align:right;white-space:nowrap;\
font-variant-numeric:tabular-nums}\
@media screen and (max-width:820px){.figures{grid-template-columns:minmax(0,1fr)}\
.column{display:contents}\
.first{order:1}.second{order:2}.third{order:3}.fourth{order:4}\
.summary thead{position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%)}\
.summary tr{display:block;padding:8px 0;border-bottom:1px solid var(--rule)}\
.summary th,.summary td{display:flex;justify-content:space-between;gap:14px;border:0;\
padding:2px 0;text-align:right}\
.summary th{text-align:left}\
.summary td::before{content:attr(data-label);color:var(--quiet);text-align:left}}\
@media print{:root{color-scheme:light;--ink:#16202a;--quiet:#56626e;--paper:#fff;--rule:#c5ccd3;\
--card:#fff;--good:#14598f;--warm:#8a5a00;--bad:#b83c05}\
@page{margin:14mm}\
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}\
body{font-size:10pt}main{max-width:none;padding:0}\
.panel{break-before:page;border:0;margin:0;padding:0}\
.panel:only-of-type{break-before:auto;margin-top:18px}\
.figures{grid-template-columns:minmax(0,1fr) minmax(0,1fr);gap:12px 20px}\
figcaption{font-size:8.5pt;line-height:1.4}.whole svg{max-width:105mm}\
.cards{grid-template-columns:repeat(auto-fill,minmax(54mm,1fr))}\
.numbers{grid-template-columns:repeat(3,1fr);gap:0 20px;font-size:8.5pt}\
.numbers div{padding:2px 0}.summary{font-size:8.5pt}.summary thead th{font-size:inherit}.summary th,.summary td{padding-right:8px}\
h1{font-size:18pt}h2{font-size:15pt}h3{margin-top:14px}\
figure,.card,.findings li,tr,.numbers div{break-inside:avoid}\
h2,h3{break-after:avoid}}";
