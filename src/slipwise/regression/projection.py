"""Projection away from what free numbers can do (Frisch, Waugh 1933; Lovell 1963)."""

from collections.abc import Callable

import numpy as np

from slipwise.arrays import Array


def _basis_of(jacobian: Array) -> Array:
    """Return an orthonormal basis (m, <= k) of what the columns (m, k) of a Jacobian can do."""
    scale = np.sqrt(np.einsum("ij,ij->j", jacobian, jacobian))
    kept = jacobian[:, scale > 0.0] / scale[scale > 0.0]
    basis, triangle = np.linalg.qr(kept)
    return basis[:, np.abs(np.diag(triangle)) > 1e-9]


def make_projector(jacobian: Array) -> Callable[[Array], Array]:
    """Return the projection away from the columns (m, k) of a Jacobian."""
    basis = _basis_of(jacobian)
    return lambda v: v - basis @ (basis.T @ v)
