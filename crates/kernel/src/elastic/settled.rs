//! The sheet of a net at rest, and its pattern fitted to it.
//!
//! A pattern that was laid flat by lengths of sides is wrong by more than the sheet is strained. So
//! it is fitted in turns: the sheet comes to rest, the pattern goes where that sheet would rather
//! have it (`fit`), the sheet comes to rest again, while the mean square of its strain falls.
//!
//! Thin sheet has many places of rest, of which most are crumpled, and which one it finds is
//! chance. So where it stays strained much, it begins anew as a sheet that is far stiffer in
//! bending, which lies smooth, and is made softer step by step until it is itself (continuation
//! \[AllgowerGeorg2003\]).

use super::coarser::Begin;
use super::energy::{Energy, Stiffness, largest_principal};
use super::net::Net;
use super::newton::{Rest, rest};
use super::{DECIDES, ElasticError, ElasticOptions, at_share, fit};
use sheetwright_geometry::math::{Point2, Point3, Vec2};
use sheetwright_geometry::watch::Watch;

/// The pattern is fitted to the surface itself so often: the fit is linear, and lengths that are
/// wrong by some per cent take a second and a third one.
const SURFACE_FITS: usize = 3;
/// A sheet begins so many times as stiff in bending as it is. On saddles of thin sheet, the first
/// of these starts ends crumpled one time in two.
const STARTS: [f64; 2] = [1.0, 100.0];
/// A sheet that begins on a folded surface begins so many times as stiff in bending: it unfolds.
const STIFF_FOLD: f64 = 1000.0;
/// A stiffer sheet is made so many times softer at each step; its pattern is fitted once before.
const SOFTER: f64 = 3.2;
/// On the way from stiff to soft a sheet buckles, which may take so many times the steps.
const PATIENCE: usize = 3;
/// Another start is made while the strain is more than so many times that which is to be reached.
const SETTLED: f64 = 2.0;
/// A fit goes so many times as far as the sheet at rest asks, and by this share of the last move
/// besides: pattern and sheet follow one another slowly (over-relaxation with momentum
/// \[Polyak1964\]). Where that leaves more strain, it goes as far as the sheet asks.
const FIT_STEPS: [[f64; 2]; 2] = [[2.5, 0.5], [1.0, 0.0]];
/// Fitting ends where it leaves more than this share of the mean square of the strain.
const HARDLY_LESS: f64 = 0.98;

/// A sheet at rest, and how far the pattern was moved for it at every node, mm.
#[derive(Clone)]
pub(super) struct Settled {
    pub(super) energy: Energy,
    pub(super) at_rest: Rest,
    pub(super) moves: Vec<Vec2>,
}

impl Settled {
    /// The place of rest next below where the nodes begin.
    fn new(
        net: &Net,
        stiffness: Stiffness,
        begin: Vec<Point3>,
        options: &ElasticOptions,
        watch: &mut dyn Watch,
    ) -> Result<Self, ElasticError> {
        let energy = Energy::new(net, stiffness).ok_or(ElasticError::NoNet)?;
        let energy = match options.band_mm {
            Some(half_mm) => energy.within(net, half_mm),
            None => energy,
        };
        let at_rest = rest(net, &energy, begin, options.most_steps, watch)?;
        Ok(Self { energy, at_rest, moves: vec![Vec2::ZERO; net.flat.len()] })
    }

    /// The largest principal strain of every triangle.
    fn strains(&self) -> Vec<f64> {
        let strains = self.energy.strains(&self.at_rest.positions).into_iter();
        strains.map(largest_principal).collect()
    }

    /// The strain that decides.
    fn strain(&self) -> f64 {
        at_share(&self.strains(), &self.energy.areas(), DECIDES)
    }

    /// The mean square of the largest principal strain, by area.
    fn mean_square(&self) -> f64 {
        let areas = self.energy.areas();
        let squares =
            self.strains().into_iter().zip(&areas).map(|(strain, area)| strain * strain * area);
        squares.sum::<f64>() / areas.iter().sum::<f64>()
    }
}

/// The sheet at rest. If that is strained by more than `options.fitted`, its pattern is fitted to
/// it as often as `options` say while strain falls, from the pattern that fits the surface itself
/// (three more fits): so the sheet is the same however the surface was divided into triangles, and
/// laid flat. Where that comes to no rest, from the pattern as it was given.
pub(super) fn settled(
    net: &mut Net,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Settled, ElasticError> {
    let as_given = net.flat.clone();
    if options.fits_anyway {
        return match fitted(net, stiffness, options, watch) {
            Err(ElasticError::NoRest) => {
                net.flat = as_given;
                let given = Settled::new(net, stiffness, net.space.clone(), options, watch)?;
                fitted_on(given, net, stiffness, options, watch)
            }
            found => found,
        };
    }
    let given = if options.begins_stiff {
        let still = vec![Vec2::ZERO; net.flat.len()];
        let unfitted = ElasticOptions { fits: 0, ..*options };
        fitted_from(STIFF_FOLD, still, net, stiffness, &unfitted, watch)
    } else {
        Settled::new(net, stiffness, net.space.clone(), options, watch)
    };
    let is_to_fit = match &given {
        Ok(now) => now.strain() > options.fitted,
        Err(error) => *error == ElasticError::NoRest,
    };
    if options.fits == 0 || !is_to_fit {
        return given;
    }
    let mut fitted = fitted(net, stiffness, options, watch);
    if let (Ok(given), Err(ElasticError::NoRest)) = (&given, &fitted) {
        net.flat.clone_from(&as_given);
        fitted = fitted_on(given.clone(), net, stiffness, options, watch);
    }
    match (given, fitted) {
        (_, Err(ElasticError::Stopped)) => Err(ElasticError::Stopped),
        (given, Ok(fitted)) if given.as_ref().map_or(true, |g| fitted.strain() < g.strain()) => {
            Ok(fitted)
        }
        (given, _) => {
            net.flat = as_given;
            given
        }
    }
}

/// The sheet at rest, from a beginning. Its pattern is fitted on where it was fitted there, and
/// left as given where no fit helped. Where it needed none there and needs one now, all is done
/// anew.
pub(super) fn settled_from(
    begin: Begin,
    net: &mut Net,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Settled, ElasticError> {
    if begin.is_fitted {
        net.flat = moved(&net.flat, &begin.moves, 1.0);
        let mut now = Settled::new(net, stiffness, begin.positions, options, watch)?;
        now.moves = begin.moves;
        return fitted_on(now, net, stiffness, options, watch);
    }
    let found = Settled::new(net, stiffness, begin.positions, options, watch)?;
    let no_fit_helps = options.fits == 0 || begin.strain > options.fitted;
    if no_fit_helps || found.strain() <= options.fitted {
        return Ok(found);
    }
    settled(net, stiffness, options, watch)
}

/// The sheet of the pattern that fits the surface itself, then fitted to its sheet at rest again
/// and again, from one start after the other until one is strained by little; else the best.
fn fitted(
    net: &mut Net,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Settled, ElasticError> {
    let sum = fit_surface(net, stiffness)?;
    let of_surface = net.flat.clone();
    let mut best: Result<(Settled, Vec<Point2>), ElasticError> = Err(ElasticError::NoRest);
    let starts = if options.starts_anew { &STARTS[..] } else { &STARTS[..1] };
    for &stiffer in starts {
        net.flat.clone_from(&of_surface);
        match fitted_from(stiffer, sum.clone(), net, stiffness, options, watch) {
            Err(ElasticError::Stopped) => return Err(ElasticError::Stopped),
            Ok(found) if best.as_ref().map_or(true, |(b, _)| found.strain() < b.strain()) => {
                best = Ok((found, net.flat.clone()));
            }
            _ => {}
        }
        if best.as_ref().is_ok_and(|(best, _)| best.strain() <= SETTLED * options.fitted) {
            break;
        }
    }
    let (best, flat) = best?;
    net.flat = flat;
    Ok(best)
}

/// Fits the pattern to the surface itself: how far each node was moved, mm.
pub(super) fn fit_surface(net: &mut Net, stiffness: Stiffness) -> Result<Vec<Vec2>, ElasticError> {
    let mut sum = vec![Vec2::ZERO; net.flat.len()];
    for _ in 0..SURFACE_FITS {
        let energy = Energy::new(net, stiffness).ok_or(ElasticError::NoNet)?;
        let moves = fit::displacement(net, &energy, &net.space).ok_or(ElasticError::NoNet)?;
        net.flat = moved(&net.flat, &moves, 1.0);
        sum = added(&sum, &moves, 1.0);
    }
    Ok(sum)
}

/// The sheet whose pattern is moved so far, fitted again and again. It begins as one that is so
/// many times as stiff in bending, which is made softer step by step.
fn fitted_from(
    stiffer: f64,
    moves: Vec<Vec2>,
    net: &mut Net,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Settled, ElasticError> {
    let (mut begin, mut moves) = (net.space.clone(), moves);
    let patience = if stiffer > 1.0 && !options.begins_stiff { PATIENCE } else { 1 };
    let patient = ElasticOptions { most_steps: patience * options.most_steps, ..*options };
    let once = ElasticOptions { fits: options.fits.min(1), ..*options };
    let mut stiffer = stiffer;
    while stiffer > 1.0 {
        let stiff = Stiffness { bending_n_mm: stiffness.bending_n_mm * stiffer, ..stiffness };
        let mut softer = Settled::new(net, stiff, begin, &patient, watch)?;
        softer.moves = moves;
        let softer = fitted_on(softer, net, stiff, &once, watch)?;
        (begin, moves) = (softer.at_rest.positions, softer.moves);
        stiffer /= SOFTER;
    }
    let mut now = Settled::new(net, stiffness, begin, &patient, watch)?;
    now.moves = moves;
    fitted_on(now, net, stiffness, options, watch)
}

/// The sheet with its pattern fitted to it again and again while the mean square of its strain
/// falls, and of these sheets the one whose strain that decides is least. That strain itself goes
/// up and down on the way: it is of the triangles that are strained most.
fn fitted_on(
    mut now: Settled,
    net: &mut Net,
    stiffness: Stiffness,
    options: &ElasticOptions,
    watch: &mut dyn Watch,
) -> Result<Settled, ElasticError> {
    let mut best = (now.clone(), net.flat.clone());
    let mut last = vec![Vec2::ZERO; net.flat.len()];
    for _ in 0..options.fits {
        let mean_square = now.mean_square();
        if now.strain() <= options.fitted {
            break;
        }
        let Some(moves) = fit::displacement(net, &now.energy, &now.at_rest.positions) else {
            break;
        };
        let before = net.flat.clone();
        let mut next = None;
        for [far, again] in FIT_STEPS {
            let way = moves.iter().zip(&last).map(|(&way, &last)| way * far + last * again);
            let way: Vec<Vec2> = way.collect();
            net.flat = moved(&before, &way, 1.0);
            let begin = now.at_rest.positions.clone();
            match Settled::new(net, stiffness, begin, options, watch) {
                Err(ElasticError::Stopped) => return Err(ElasticError::Stopped),
                Ok(found) if found.mean_square() < mean_square => {
                    next = Some((found, way));
                    break;
                }
                _ => {}
            }
        }
        let Some((found, way)) = next else { break };
        let (sum, steps) = (added(&now.moves, &way, 1.0), now.at_rest.steps);
        now = found;
        now.moves = sum;
        now.at_rest.steps += steps;
        last = way;
        if now.strain() < best.0.strain() {
            best = (now.clone(), net.flat.clone());
        }
        if now.mean_square() > HARDLY_LESS * mean_square {
            break;
        }
    }
    let (best, flat) = best;
    net.flat = flat;
    Ok(best)
}

/// Points moved so many times as far as these ways.
fn moved(points: &[Point2], ways: &[Vec2], far: f64) -> Vec<Point2> {
    points.iter().zip(ways).map(|(&p, &way)| p + way * far).collect()
}

/// Ways and so many times these.
fn added(sums: &[Vec2], ways: &[Vec2], far: f64) -> Vec<Vec2> {
    sums.iter().zip(ways).map(|(&sum, &way)| sum + way * far).collect()
}
