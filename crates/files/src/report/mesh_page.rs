//! The section of `report.html` for a mesh: how far flattening stretches it, and where.

use super::flat_picture::CUT_AND_NET;
use super::heat_picture::{NO_ERROR, heat_picture};
use super::page::{Number, PartPage, table};
use crate::mesh::aim_name;
use crate::space::box_of;
use crate::wording::{
    area, decimal, degrees, millimetres, millimetres_fine, per_cent, plain_per_cent, refold,
    share_beyond_words, steradians,
};
use maud::{Markup, PreEscaped, html};
use sheetwright::edge::{Edge, EdgeSource};
use sheetwright::flatten::Aim;
use sheetwright::make::Given;
use sheetwright::material::stretch_limit;
use sheetwright::math::to_deg;
use sheetwright::pattern::seam_mark;

/// A part with its mesh.
pub(super) struct MeshPage<'a> {
    pub(super) page: &'a PartPage<'a>,
    pub(super) given: &'a Given,
}

impl MeshPage<'_> {
    /// The pictures with their captions.
    pub(super) fn figures(&self) -> Markup {
        let (part, material) = (self.page.part, self.page.material());
        let heat = part.measures.distortion.as_ref();
        let heat = heat.map(|distortion| heat_picture(part, self.given, distortion, material));
        html! {
            div.figures {
                (self.page.space_column(&self.space_caption(), "third", &self.gauss_caption()))
                div.column {
                    @if let Some(heat) = heat {
                        figure.second {
                            (PreEscaped(heat.inline()))
                            figcaption { (self.flat_caption()) }
                        }
                    }
                }
            }
        }
    }

    fn space_caption(&self) -> Markup {
        let size = box_of(self.page.part);
        html! {
            strong { "In space. " }
            "Blue is the side that the pattern shows, brown the other. "
            @if !self.page.part.sheet.seams().is_empty() { "The green lines are the cuts. " }
            "The panel fills a box of " (millimetres(size.x)) " × " (millimetres(size.y)) " × "
            (millimetres(size.z)) " (x, y, z)."
        }
    }

    fn gauss_caption(&self) -> Markup {
        html! {
            strong { "Which way it faces. " }
            "Every direction is a point on a ball. A line joins the directions of the two \
             triangles at each side of the mesh. If the lines lie on one curve, the panel lies flat \
             without stretching. If they form a net, the panel must stretch, and more for a larger \
             net. The area here is "
            (steradians(self.page.part.measures.gauss_area_sr))
            " of the 12.57\u{a0}sr of the whole ball."
        }
    }

    fn flat_caption(&self) -> Markup {
        let (part, material) = (self.page.part, self.page.material());
        let (measures, seams) = (&part.measures, part.sheet.seams());
        let by_area = measures.distortion.as_ref().map(|d| d.length_error_mean_by_area);
        let first = part.sheet.first_seam();
        html! {
            strong { "Laid flat. " }
            @if part.piece.has_net() { (CUT_AND_NET) }
            @if measures.length_error_max < NO_ERROR {
                "Every length is that in space."
            } @else {
                "The colour of a triangle shows the largest relative difference between the \
                 lengths of its sides, flat and in space. The largest of all is "
                (per_cent(measures.length_error_max)) " (ringed), the mean "
                (per_cent(measures.length_error_mean))
                @if let Some(by_area) = by_area { ", weighted by area " (per_cent(by_area)) }
                "."
            }
            @if measures.length_error_max > stretch_limit(material) {
                " The dashed line in the scale is the limit of "
                (material.map_or("a sheet of no named material", |m| &m.title)) "."
            }
            @if let Some(predicted) = &part.predicted {
                @if let Some(beyond) = share_beyond_words(predicted.strain) {
                    " In its shape, 5 % of the area of the sheet or more stretches or shrinks by "
                    (beyond)
                } @else {
                    " In its shape, 95 % of the area of the sheet stretches or shrinks by less than "
                    (plain_per_cent(predicted.strain))
                }
                ", on which the verdict rests."
                @if let Some(distance) = predicted.rest_distance_mm().filter(|mm| *mm > 0.0) {
                    " It lies up to " (millimetres_fine(distance)) " off the surface."
                }
            }
            @if seams.len() == 1 {
                " Join the two sides that are marked " b { (seam_mark(first)) } "."
            } @else if !seams.is_empty() {
                " Join the sides that have the same mark, " b { (seam_mark(first)) } " to "
                b { (seam_mark(first + seams.len() - 1)) } "."
            }
            (self.angles())
            (self.edges())
        }
    }

    /// How many folds of a net have no room for their angles.
    fn angles(&self) -> Markup {
        let (left_out, of) = self.page.part.piece.folds_without_angle();
        html! {
            @if self.given.is_net && left_out > 0 {
                " " (left_out) " of " (of) " folds have no room for their angles."
            }
        }
    }

    /// The edges that are not sides of cuts, if the part has more than one.
    fn edges(&self) -> Markup {
        let is_cut = |edge: &&Edge| matches!(edge.source, EdgeSource::Cut { .. });
        let edges = &self.page.part.edges;
        html! {
            @if edges.len() > 1 {
                ul.edges {
                    @for edge in edges.iter().filter(|edge| !is_cut(edge)) {
                        li { (self.page.edge_text(edge, &millimetres(edge.length_flat_mm))) }
                    }
                }
            }
        }
    }

    /// The seams along which it is cut open.
    pub(super) fn seams(&self) -> Markup {
        let part = self.page.part;
        let labels = ["In space", "One side, flat", "Other side, flat"];
        let rows = part.sheet.seams().iter().enumerate().map(|(n, seam)| {
            let [one, other] = seam.sides_flat_mm(&part.flat.points);
            let mark = seam_mark(part.sheet.first_seam() + n);
            (mark, [seam.length_mm, one, other].map(millimetres_fine).to_vec())
        });
        html! {
            @if !part.sheet.seams().is_empty() {
                h3 { "Seams" }
                (table(None, "Seam", &labels, rows))
            }
        }
    }

    /// The lines along which it is joined to other parts.
    pub(super) fn joints(&self) -> Markup {
        let (made, flat) = (self.page.made, &self.page.part.flat.points);
        let rows = self.given.joints.iter().map(|joint| {
            let lengths = [joint.length_mm, joint.flat_mm(flat)].map(millimetres_fine);
            let [space, flat] = lengths;
            (&joint.mark, vec![made.parts[joint.with].name.clone(), space, flat])
        });
        html! {
            @if !self.given.joints.is_empty() {
                h3 { "Joined to other panels" }
                (table(None, "Mark", &["With", "In space", "Flat"], rows))
            }
        }
    }

    /// All measures, with their labels.
    pub(super) fn numbers(&self) -> Vec<Number> {
        let (measures, sheet) = (&self.page.part.measures, self.page.part.sheet.mesh());
        let aim = match self.given.aim {
            Aim::Mean => "mean length error",
            Aim::Max => "largest length error",
            Aim::Seams => "border kept exact",
        };
        let mut rows = vec![
            ("Triangles", sheet.triangles().len().to_string()),
            ("Vertices", self.given.mesh.positions().len().to_string()),
            ("Method", "mesh".to_owned()),
            ("Aim", format!("{} ({aim})", aim_name(self.given.aim))),
            ("Holes of the pattern", (sheet.loops().len() - 1).to_string()),
            ("Largest crease", degrees(to_deg(measures.crease_max))),
            ("Area of the Gauss image", steradians(measures.gauss_area_sr)),
            ("Length error, largest", per_cent(measures.length_error_max)),
            ("Length error, mean", per_cent(measures.length_error_mean)),
            ("Area in space", area(measures.area_space_mm2)),
            ("Area of the pattern", area(measures.area_flat_mm2)),
            ("Refold error", refold(self.page.refold_error_mm)),
        ];
        if let Some(distortion) = &measures.distortion {
            rows.push(("Length error, by area", per_cent(distortion.length_error_mean_by_area)));
            rows.push(("Stretch, most", decimal(distortion.stretch_max, 6)));
            rows.push(("Stretch, least", decimal(distortion.stretch_min, 6)));
        }
        if let Some(predicted) = &self.page.part.predicted {
            rows.push(("Strain, at 95 % of the area", plain_per_cent(predicted.strain)));
            rows.push(("Strain that the sheet takes", plain_per_cent(predicted.limits.strain)));
            if let Some(distance) = predicted.rest_distance_mm() {
                rows.push(("The sheet leaves the surface by", millimetres_fine(distance)));
            }
        }
        if let Some(rebuilt) = &self.given.rebuilt {
            rows.push(("From its border, largest", millimetres_fine(rebuilt.distance_max_mm)));
            rows.push(("From its border, mean", millimetres_fine(rebuilt.distance_mean_mm)));
        }
        rows
    }
}
