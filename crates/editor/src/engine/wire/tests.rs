use super::*;
use crate::engine::shown::{Shown, ShownPanel};
use sheetwright::boundary::{Continuity, PlaneChoice, Within};
use sheetwright::check::{Finding, Place};
use sheetwright::design::{
    BendMarks, BendRule, Bends, CurveUse, Design, DesignPanel, Dimensions, Join, MovedBy,
    PanelShape, Vary, VaryGoal,
};
use sheetwright::make::make;
use sheetwright::material::{
    Deduction, Deductions, Grain, GrainBending, KFactor, KFactors, Material, Sourced,
};
use sheetwright::template::{catalogue, template};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::findings::one_of_each;

/// Numbers that look random and are the same everywhere.
struct Dice(u64);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 33) as usize % bound
    }
}

fn shown(design: &Design) -> Vec<ShownPanel> {
    let panel =
        |panel| ShownPanel { name: String::from("a-1"), panel: String::from("a"), made: Ok(panel) };
    let made = make(design, &mut Unwatched).unwrap();
    made.parts.iter().map(|made| panel(Shown::new(made, design.material.as_ref()))).collect()
}

/// The designs of all templates as they come.
fn designs() -> impl Iterator<Item = Design> {
    catalogue().iter().filter_map(|template| template.defaults().design().ok())
}

/// A design with one of everything.
fn odd_design() -> Design {
    let mut design = template("cone").unwrap().defaults().design().unwrap();
    design.material = sheetwright_files::material_named("card-0.3mm", &[]);
    let source = "measured".to_owned();
    let bending = |modulus, radius| GrainBending {
        modulus_n_per_mm2: Sourced::assumed(modulus),
        bend_radius_mm: Sourced::assumed(radius),
    };
    design.materials = vec![Material {
        name: "my-ply".to_owned(),
        title: "ply from the shed, 4 mm".to_owned(),
        thickness_mm: Sourced { value: 3.8, source },
        bend_radius_mm: Sourced::assumed(300.0),
        warp_limit_deg: Sourced::assumed(5.0),
        stretch_limit: Sourced::assumed(1e-3),
        modulus_n_per_mm2: Some(Sourced::assumed(6_400.0)),
        poisson: Some(Sourced::assumed(0.1)),
        yield_strain: None,
        density_kg_per_m3: Some(Sourced::assumed(660.0)),
        k_factors: Some(KFactors {
            rows: vec![KFactor { radius_per_thickness: 1.0, k: 0.38 }],
            source: "bent in the shed".to_owned(),
        }),
        deductions: Some(Deductions {
            rows: vec![Deduction { radius_mm: 2.0, angle_deg: 90.0, deduction_mm: 3.4 }],
            source: "bent twice".to_owned(),
        }),
        grain: Some(Grain { along: bending(11_800.0, 960.0), across: bending(1_040.0, 300.0) }),
    }];
    design.match_seams = true;
    design.bends = Bends { rule: BendRule::Angle(0.125), marks: BendMarks::Lines };
    (design.dimensions, design.thickness_mm) = (Some(Dimensions::Outside), Some(1.5));
    (design.bend_radius_mm, design.arcs_mm) = (Some(2.5), Some(0.05));
    let own = Bends { rule: BendRule::Number(7), marks: BendMarks::None };
    design.panels[0].bends = Some(own);
    design.curves[0].points[0].at.x = -0.0;
    design.curves[0].points[0].move_mm = f64::INFINITY;
    let a = |reversed| CurveUse { name: "a".to_owned(), reversed };
    let join = Join {
        parts: vec!["a".to_owned(), "ß".to_owned()],
        smooth: Continuity::G2,
        within: Within::Share(0.25),
        keep_parts: true,
    };
    let shapes = [
        PanelShape::Rails([a(true), a(false)]),
        PanelShape::Loops { outer: vec![], holes: vec![vec![a(true)], vec![]] },
        PanelShape::Join(join),
    ];
    design.panels.extend(shapes.map(|shape| DesignPanel::new("p", shape, 7)));
    design.panels[0].plane = PlaneChoice::Normal(Vec3::new(1.0, 2.0, 3.0));
    design.vary = vec![Vary {
        panels: vec!["p".to_owned()],
        goal: VaryGoal::Warp { largest: 0.1 },
        limit_mm: Some(2.0),
        by: MovedBy::Samples,
        ..Vary::default()
    }];
    design
}

/// Findings on where to divide parts.
fn advice() -> Vec<(String, Finding)> {
    let is_advice = |finding: &Finding| matches!(finding.place, Place::Lines { .. });
    let found = one_of_each().into_iter().filter(is_advice);
    found.map(|finding| ("side-1".to_owned(), finding)).collect()
}

fn answers() -> Vec<Answer> {
    let refusal = Refusal { message: "no".to_owned(), hint: "ask again".to_owned() };
    let design = template("cone").unwrap().defaults().design().unwrap();
    let mut panels = shown(&design);
    panels.push(ShownPanel {
        name: String::new(),
        panel: String::new(),
        made: Err(refusal.clone()),
    });
    let varied = |moved| {
        let (before, after) = (panels.clone(), Vec::new());
        Answer::Varied {
            number: 3,
            outcome: Ok(Box::new(Varied { moved, moved_max_mm: 1.5, before, after })),
        }
    };
    let file = OutputFile { name: "a.svg".to_owned(), bytes: (0..=255).collect() };
    vec![
        Answer::Shown { number: u64::MAX, detail: Detail::Coarse, panels: panels.clone() },
        varied(None),
        varied(Some(odd_design())),
        Answer::Varied { number: 4, outcome: Err(refusal.clone()) },
        Answer::Files { number: 5, outcome: Ok(vec![file]) },
        Answer::Files { number: 6, outcome: Err(refusal) },
        Answer::Advised { number: 8, advice: advice(), is_over: false },
        Answer::Progress {
            number: 7,
            stage: Stage::Nest,
            text: "sampling bottom".to_owned(),
            done: 0.5,
        },
    ]
}

#[test]
fn what_is_shown_of_every_template_comes_back() {
    let mut count = 0;
    for design in designs() {
        let panels = shown(&design);
        count += panels.len();
        let answer = Answer::Shown { number: 1, detail: Detail::Full, panels };
        assert_eq!(answer_of(&answer_bytes(&answer)), Some(answer), "{}", design.name);
    }
    assert!(count > 30, "{count}");
}

#[test]
fn every_kind_of_answer_comes_back() {
    for answer in answers() {
        assert_eq!(answer_of(&answer_bytes(&answer)), Some(answer));
    }
}

#[test]
fn every_kind_of_job_comes_back() {
    for design in designs().chain([odd_design(), Design::default()]).map(Arc::new) {
        for job in [
            Job::Show { number: 1, design: design.clone(), detail: Detail::Coarse },
            Job::Advise { number: 4, design: design.clone() },
            Job::Vary { number: 2, design: design.clone() },
            Job::Export { number: 3, design: design.clone(), formats: Format::ALL.to_vec() },
        ] {
            let bytes = job_bytes(&job);
            assert_eq!(job_of(&bytes), Some(job.clone()), "{}", design.name);
            // A zero below zero is another zero, which `==` does not see.
            assert_eq!(job_bytes(&job_of(&bytes).unwrap()), bytes);
        }
    }
}

/// Changes, cuts off, removes or adds some bytes.
fn corrupted(bytes: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let at = dice.below(bytes.len());
    match dice.below(5) {
        0 => bytes.truncate(at),
        1 => drop(bytes.remove(at)),
        2 => bytes.insert(at, dice.below(256) as u8),
        3 => bytes[at] = bytes[at].wrapping_add(1 + dice.below(255) as u8),
        _ => {
            let end = (at + 8).min(bytes.len());
            bytes[at..end].fill(0xff);
            bytes[at] = 0x7f;
        }
    }
    bytes
}

#[test]
fn broken_bytes_are_no_answer() {
    let mut dice = Dice(1);
    let whole: Vec<Vec<u8>> = answers().iter().map(answer_bytes).collect();
    for n in 0..10_000 {
        let bytes = &whole[n % whole.len()];
        let broken = corrupted(bytes, &mut dice);
        assert!(broken == *bytes || answer_of(&broken).is_none(), "{n}");
    }
}

/// Without the check sum before them: what is read is nothing, or something that reads the same
/// again, and nothing panics.
#[test]
fn broken_bytes_that_look_whole_do_no_harm() {
    let mut dice = Dice(2);
    let whole: Vec<Vec<u8>> =
        answers().iter().map(|answer| opened(&answer_bytes(answer)).unwrap().to_vec()).collect();
    let (mut none, mut some) = (0, 0);
    for n in 0..10_000 {
        let broken = corrupted(&whole[n % whole.len()], &mut dice);
        let Some(answer) = answer_of(&sealed(&broken)) else {
            none += 1;
            continue;
        };
        some += 1;
        assert!(opened(&answer_bytes(&answer)) == Some(&broken[..]), "{n}");
    }
    assert!(none > 1000 && some > 1000, "{none} and {some}");
}

#[test]
fn a_length_beyond_all_bounds_takes_no_memory() {
    for length in [u64::MAX, 1 << 62, 1 << 40, 100] {
        let mut bytes = vec![2];
        bytes.extend(7_u64.to_le_bytes());
        bytes.push(1);
        bytes.extend(length.to_le_bytes());
        assert_eq!(answer_of(&sealed(&bytes)), None);
    }
}

#[test]
fn findings_of_every_kind_come_back() {
    for finding in one_of_each() {
        let back: Option<Finding> = of_bytes(&bytes_of(&finding));
        assert_eq!(back.as_ref(), Some(&finding));
    }
}
