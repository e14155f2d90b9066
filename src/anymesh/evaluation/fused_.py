"""One surface of many bodies: wrapped on a grid with libigl (MPL-2), or united exactly with manifold3d (Apache-2.0)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int
from scipy import ndimage

from anymesh.errors import MissingExtraError, pip_install
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.topology import weld
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types.triangles import normals_and_areas

OFFSET = 0.6  # [cells] offset of the wrap; from 0.5 on, sheets have no leaks
BAND = 2  # [cells] distance from the surface within which distances are computed
MIN_WRAP_CELLS = 1e-3  # [cells] minimum distance between the wrap and a grid node, to avoid degenerate triangles
DENSITY = 6  # points per cell of surface area, to find that band

_CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])  # libigl's order


def wrapped(triangles: Float[np.ndarray, "F 3 3"], cell: float) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "R 3"]]:
    """Compute the closed surface at OFFSET cells around the triangles, as seen from outside.

    The triangles may be open and need no consistent winding. Gaps narrower than twice the offset close, and what they enclose
    is removed.
    """
    import igl

    low = triangles.min((0, 1)) - (BAND + 2) * cell
    field = _field(triangles, low, cell)
    corners = _CUBE + np.argwhere(_on_both_sides(field))[:, None]
    number = np.ravel_multi_index(tuple(corners.reshape(-1, 3).T), field.shape)
    used, cubes = np.unique(number, return_inverse=True)
    nodes = np.stack(np.unravel_index(used, field.shape), 1) * cell + low
    vertices, faces = igl.marching_cubes(field.reshape(-1)[used], nodes, cubes.reshape(-1, 8).astype(np.int64), 0.0)[:2]
    return np.asarray(vertices, np.float64), np.asarray(faces).astype(np.int64)


def _field(triangles: np.ndarray, low: np.ndarray, cell: float) -> np.ndarray:
    """Compute the signed distance to the wrap at the nodes of a grid [m], negative inside.

    Beyond BAND only its sign is valid.
    """
    shape = tuple(np.ceil((triangles.max((0, 1)) - low) / cell).astype(int) + BAND + 3)
    count = int(DENSITY * normals_and_areas(triangles)[1].sum() / cell**2) + 1
    at = np.rint((sample_surface(triangles, count, 0, at_least=1).points - low) / cell).astype(int)
    band = np.zeros(shape, bool)
    band[tuple(at.T)] = True
    band = ndimage.binary_dilation(band, np.ones((3, 3, 3)), iterations=BAND)
    field = np.full(shape, BAND * cell)
    field[band] = distance_to_triangles(np.argwhere(band) * cell + low, triangles)
    field -= OFFSET * cell
    region = ndimage.label(field >= 0)[0]
    outside = (field >= MIN_WRAP_CELLS * cell) & (region == region[0, 0, 0])
    field[~outside] = np.minimum(-np.abs(field[~outside]), -MIN_WRAP_CELLS * cell)  # no grid node lies on the surface
    return field


def _on_both_sides(field: np.ndarray) -> np.ndarray:
    """Return the cubes that the surface passes through, by their first corner."""
    x, y, z = (n - 1 for n in field.shape)
    inside = np.sum([field[i : x + i, j : y + j, k : z + k] < 0 for i, j, k in _CUBE], 0)
    return (inside > 0) & (inside < 8)


def joined(solids: Sequence[np.ndarray]) -> Float[np.ndarray, "R 3 3"]:
    """Compute the union of closed, outward surfaces (n, 3, 3). Touching bodies are merged; non-manifold ones stay unchanged.

    Raise MissingExtraError without manifold3d.
    """
    try:
        from manifold3d import Error, Manifold, OpType
        from manifold3d import Mesh as Triangles
    except ImportError:
        raise MissingExtraError(f"manifold3d is missing; {pip_install('test')} has it") from None
    usable, others = [], []
    for triangles in solids:
        corners = triangles.reshape(-1, 3)
        _, first, inverse = np.unique(weld(corners), return_index=True, return_inverse=True)
        faces = inverse.reshape(-1, 3)
        made = Manifold(Triangles(corners[first].astype(np.float32), faces.astype(np.uint32)))
        good = made.status() == Error.NoError and not made.is_empty()
        (usable if good else others).append(made if good else triangles)
    union = Manifold.batch_boolean(usable, OpType.Add).to_mesh() if usable else None
    merged = [np.asarray(union.vert_properties, np.float64)[:, :3][union.tri_verts]] if union else []
    return np.concatenate([*merged, *others])
