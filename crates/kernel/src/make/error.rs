//! Why a design can't be made, in words.

use crate::design::Failure;
use crate::fair::{FairCause, FairError, VaryCause};
use crate::flatten::{FlattenError, RelaxError};
use crate::mark::MarkFault;
use crate::mesh::{MeshError, SeamFault};
use crate::sample::{PanelCause, PanelError};
use crate::surface::ConnectivityError;
use crate::trim::TrimFault;
use sheetwright_geometry::math::Point3;
use sheetwright_optimum::triangulate::TriangulateError;
use std::fmt;

/// Why a design can't be made: the panel or curve, and the cause.
pub type MakeError = Failure<MakeCause>;

/// The cause why a design can't be made.
#[derive(Clone, Debug, PartialEq)]
pub enum MakeCause {
    /// A design without panels.
    NoPanels,
    /// A panel that can't be sampled or triangulated.
    Panel(PanelCause),
    /// Triangles that are no surface.
    Surface(ConnectivityError),
    /// No flat pattern.
    Flatten(FlattenError),
    /// Curves that can't be moved.
    Vary(VaryCause),
    /// Triangles that are no mesh.
    Mesh {
        /// Why they are no mesh.
        error: MeshError,
        /// The vertices that the error names, mm; empty if it names none.
        places: Vec<Point3>,
    },
    /// A mesh with more separate parts than the limit.
    Components {
        /// How many there are.
        found: usize,
        /// The limit.
        most: usize,
    },
    /// A mesh that can't be cut along a seam.
    Seam(SeamFault),
    /// A mesh that can't be laid flat.
    Relax(RelaxError),
    /// A trim that can't be made.
    Trim(TrimFault),
    /// A mark that can't be made.
    Mark(MarkFault),
}

impl From<PanelCause> for MakeCause {
    fn from(cause: PanelCause) -> Self {
        Self::Panel(cause)
    }
}

impl From<TriangulateError> for MakeCause {
    fn from(error: TriangulateError) -> Self {
        Self::Panel(PanelCause::Triangulate(error))
    }
}

impl From<PanelError> for MakeError {
    fn from(error: PanelError) -> Self {
        error.caused(MakeCause::Panel)
    }
}

impl From<FairError> for MakeError {
    fn from(error: FairError) -> Self {
        error.caused(|cause| match cause {
            FairCause::Panel(cause) => MakeCause::Panel(cause),
            FairCause::Vary(cause) => MakeCause::Vary(cause),
        })
    }
}

impl fmt::Display for MakeCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPanels => write!(f, "the design has no panels"),
            Self::Panel(cause) => write!(f, "{cause}"),
            Self::Surface(error) => write!(f, "{error}"),
            Self::Flatten(error) => write!(f, "{error}"),
            Self::Vary(cause) => write!(f, "{cause}"),
            Self::Mesh { error, places } => write_mesh_error(f, *error, places),
            Self::Components { found, most } => {
                write!(f, "the mesh has {found} separate parts; the limit is {most}")
            }
            Self::Seam(fault) => write_seam_fault(f, *fault),
            Self::Relax(error) => write!(f, "{error}"),
            Self::Trim(fault) => write!(f, "{fault}"),
            Self::Mark(fault) => write!(f, "{fault}"),
        }
    }
}

fn place(p: &Point3) -> String {
    format!("({:.3}, {:.3}, {:.3}) mm", p.x + 0.0, p.y + 0.0, p.z + 0.0)
}

fn write_seam_fault(f: &mut fmt::Formatter<'_>, fault: SeamFault) -> fmt::Result {
    match fault {
        SeamFault::Off { at, distance_mm } => {
            let at = place(&at);
            write!(f, "a seam passes {at}, {distance_mm:.3} mm from the nearest vertex of the mesh")
        }
        SeamFault::Apart { ends: [a, b] } => write!(
            f,
            "a seam goes from {} to {}, which lie on parts that do not hang together",
            place(&a),
            place(&b)
        ),
        SeamFault::TooLong => f.write_str(
            "too many steps of seams are no sides of triangles, or join places where many vertices \
             lie",
        ),
    }
}

fn write_mesh_error(f: &mut fmt::Formatter<'_>, error: MeshError, at: &[Point3]) -> fmt::Result {
    match (error, at) {
        (MeshError::NotManifold { .. }, [a, b]) => {
            let (a, b) = (place(a), place(b));
            write!(f, "the side from {a} to {b} belongs to more than two triangles")
        }
        (MeshError::NotOrientable { .. }, [a, b]) => write!(
            f,
            "the mesh has one side only, as a Möbius strip or a Klein bottle: front and back meet \
             at the side from {} to {}",
            place(a),
            place(b)
        ),
        (MeshError::Degenerate { .. }, [a, b, c]) => {
            let [a, b, c] = [a, b, c].map(place);
            write!(f, "a triangle has no area: its corners {a}, {b} and {c} lie on one line")
        }
        _ => write!(f, "{error}"),
    }
}
