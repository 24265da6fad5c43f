//! Read access to a tree on the host.

use std::ops::Range;

use glam::{DMat3, DVec3, DVec4, Vec4};

use super::{TREE_BODY, TREE_CENTER, TREE_DEMAND, TREE_ID, TREE_MASS, TREE_SHAPE, Tree};
use crate::error::Error;
use crate::kernel::{Host, Reading};

/// The fields of a tree. Nodes are numbered as in a heap, from 1 on.
pub struct Nodes<'a> {
    tree: Tree,
    ids: Reading<'a, u32>,
    bodies: Reading<'a, Vec4>,
    center: Reading<'a, Vec4>,
    mass: Reading<'a, Vec4>,
    shape: Reading<'a, Vec4>,
    demand: Option<Reading<'a, f32>>,
}

impl<'a> Nodes<'a> {
    /// Opens the fields of a tree.
    ///
    /// # Errors
    /// When the host lacks one of them, or one is being written; the opening criteria of groups are optional.
    pub fn of(tree: &Tree, host: &'a Host) -> Result<Self, Error> {
        let vectors = |name| host.reading::<Vec4>(&tree.field(name).1);
        Ok(Self {
            tree: tree.of_rows(host.world().count),
            ids: host.reading(&tree.field(TREE_ID).1)?,
            bodies: vectors(TREE_BODY)?,
            center: vectors(TREE_CENTER)?,
            mass: vectors(TREE_MASS)?,
            shape: vectors(TREE_SHAPE)?,
            demand: host.reading(&tree.field(TREE_DEMAND).1).ok(),
        })
    }
    /// Ids in the order of the curve.
    #[must_use]
    pub fn ids(&self) -> &[u32] {
        &self.ids
    }
    /// Positions and masses in that order.
    #[must_use]
    pub fn bodies(&self) -> &[DVec4] {
        &self.bodies
    }
    /// Whether there is such a node.
    #[must_use]
    pub fn exists(&self, n: u32) -> bool {
        self.tree.exists(n)
    }
    /// Whether a node is a leaf.
    #[must_use]
    pub fn is_leaf(&self, n: u32) -> bool {
        self.tree.is_leaf(n)
    }
    /// The bodies of a node, by their indices in [`Nodes::bodies`].
    #[must_use]
    pub fn range(&self, n: u32) -> Range<usize> {
        self.tree.range(n)
    }
    /// A node's centre of mass; of its box, where its mass is 0.
    #[must_use]
    pub fn center(&self, n: u32) -> DVec3 {
        element(&self.center, n).truncate()
    }
    /// The distance of a target from a node's centre below which it is opened \[length\], in single precision as on the device.
    #[must_use]
    pub fn reach(&self, n: u32) -> f32 {
        element(&self.center, n).as_vec4().w
    }
    /// A node's mass.
    #[must_use]
    pub fn mass(&self, n: u32) -> f64 {
        element(&self.mass, n).w
    }
    /// A node's second moments Σ m y yᵀ about its centre of mass.
    #[must_use]
    pub fn moments(&self, n: u32) -> DMat3 {
        let ([xx, xy, xz, _], [yy, yz, zz, _]) =
            (element(&self.mass, n).to_array(), element(&self.shape, n).to_array());
        DMat3::from_cols_array_2d(&[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    }
    /// The longest side of a node's tight box \[length\].
    #[must_use]
    pub fn length(&self, n: u32) -> f64 {
        element(&self.shape, n).w
    }
    /// The relative opening criterion of a group of targets: G / (α a), or 0 if a body has no acceleration yet, or the criterion is geometric.
    #[must_use]
    pub fn demand(&self, group: usize) -> f64 {
        self.demand.as_ref().and_then(|demand| demand.get(group)).copied().unwrap_or(0.0)
    }
}

/// `None` for a node that does not exist.
fn element(field: &[DVec4], n: u32) -> DVec4 {
    field.get(n as usize).copied().unwrap_or(DVec4::ZERO)
}
