"""Placement of a mesh in the asset frame: Z up, metres, standing on the ground, centered."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.errors import OptionError
from anymesh.loading.load import LoadedMesh
from anymesh.loading.sizes import is_near, usual_size
from anymesh.loading.upright import AUTO, AXES, INFER, Up, infer_up, read_up, up_of
from anymesh.types import Mesh

PLAUSIBLE = (0.02, 12.0)  # [m] diagonals of typical objects, from a knob to a van
MAX_EXPECTED = 100.0  # [m] a larger diagonal in the unit of the file gets a warning
MIN_UP_PROBABILITY = 0.6  # an up axis inferred with less gets a warning
ABSURD = (0.001, 1000.0)  # [m] a format's unit is ignored beyond these diagonals
GIVEN = (1e-6, 1e6)  # [m] beyond these diagonals, masses and inertias in an output would be lost in rounding, or overflow
UNITS = (("millimetres", 0.001), ("centimetres", 0.01), ("inches", 0.0254))


@dataclass(frozen=True, eq=False)
class PlacedMesh:
    """A mesh in the asset frame [m, Z up].

    T_asset_source: (4, 4), from file coordinates; notes: how it was determined; metric: whether the scale is the unit that the
    file states.
    """

    mesh: Mesh
    T_asset_source: Float[np.ndarray, "4 4"]
    up: str
    notes: tuple[str, ...]
    warnings: tuple[str, ...]
    metric: bool = False


def place_mesh(loaded: LoadedMesh, *, up: str = "auto", scale: str = "auto", category: str | None = None) -> PlacedMesh:
    """Rotate and scale the mesh, and place it on the ground.

    category: of the object, which determines its usual size.

    Raise OptionError for an up or a scale that is not valid.
    """
    direction, up_note = _up(loaded, up)
    unsure = f"{up_note}: if this is wrong, set it with --up"
    doubts = (unsure,) if direction.probability is not None and direction.probability < MIN_UP_PROBABILITY else ()
    R = direction.to_z
    used = np.zeros(len(loaded.mesh.vertices), bool)
    used[loaded.mesh.faces] = True
    turned = loaded.mesh.vertices[used] @ R.T
    low, high = turned.min(0), turned.max(0)
    factor, scale_note, warnings = _scale(loaded, high - low, scale, category)
    T = np.eye(4)
    T[:3, :3] = factor * R
    low, high = factor * low, factor * high
    T[:3, 3] = -np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    metric = factor == loaded.unit_in_metres
    return PlacedMesh(loaded.mesh.transformed(T), T, direction.name, (up_note, scale_note), (*doubts, *warnings), metric)


def _up(loaded: LoadedMesh, text: str) -> tuple[Up, str]:
    stated = read_up(text)
    if stated is not None:
        return stated, f"up axis {stated.name} (given)"
    if text == AUTO and loaded.format_up is not None:
        return up_of(np.eye(3)[AXES.index(loaded.format_up)]), f"up axis {loaded.format_up} (defined by the format)"
    usual = None if text == INFER else "y" if loaded.path.lower().endswith(".obj") else "z"
    up = infer_up(loaded.mesh, usual)
    if up.probability is None:
        return up, f"up axis {up.name} (usual for the format; the mesh is flat)"
    return up, f"up axis {up.name} (inferred from how the object can stand, probability {up.probability:.2f})"


def _scale(loaded: LoadedMesh, extents: np.ndarray, scale: str, category: str | None) -> tuple[float, str, tuple[str, ...]]:
    diagonal = float(np.linalg.norm(extents))
    if scale != "auto":
        factor, note = _given_scale(extents, scale)
        if not GIVEN[0] <= diagonal * factor <= GIVEN[1]:
            effect = f"makes the object's diagonal {diagonal * factor:.3g} m"
            raise OptionError(f"--scale: found {scale!r}, which {effect}; valid are {GIVEN[0]:g} to {GIVEN[1]:g} m")
        return factor, note, ()
    unit = loaded.unit_in_metres
    prior = usual_size(category) if category else usual_size(Path(loaded.path).stem) if unit is None else None
    if prior is not None:  # a unit in the file has priority over the file's name, but not over the user's category
        return _scale_of_kind(extents, unit, *prior)
    if unit is not None:
        if ABSURD[0] <= diagonal * unit <= ABSURD[1]:
            large = f"the file's unit makes the object {diagonal * unit:.3g} m large; if that is wrong, set it with --scale"
            return unit, f"scale {unit:g} (the file's unit)", (large,) if diagonal * unit > MAX_EXPECTED else ()
        warning = f"the file's unit makes the object {diagonal * unit:.3g} m large; it was scaled to a diagonal of 1 m"
        return 1 / diagonal, f"scale {1 / diagonal:g} (normalised)", (warning,)
    if PLAUSIBLE[0] <= diagonal <= PLAUSIBLE[1]:
        return 1.0, "scale 1 (the file has no unit; taken as metres)", ()
    for name, factor in UNITS:
        if PLAUSIBLE[0] <= diagonal * factor <= PLAUSIBLE[1] / 4:
            return factor, f"scale {factor:g} (inferred: a diagonal of {diagonal:.4g} is taken as {name})", ()
    warning = f"no unit makes a diagonal of {diagonal:.3g} plausible; the object was scaled to a diagonal of 1 m"
    return 1 / diagonal, f"scale {1 / diagonal:g} (normalised)", (warning,)


def _scale_of_kind(extents: np.ndarray, unit: float | None, kind: str, usual: float) -> tuple[float, str, tuple[str, ...]]:
    """Return the file's unit, or a common one, that gives the object a plausible size for its kind; else the usual size."""
    longest, kind = float(extents.max()), kind.replace("_", " ")
    a_kind = f"{'an' if kind[:1] in 'aeiou' else 'a'} {kind}"
    units = [("the file's unit", unit)] if unit is not None else [("metres", 1.0), *UNITS]
    for name, factor in units:
        if is_near(longest * factor, usual):
            return factor, f"scale {factor:g} ({name}; plausible for {a_kind})", ()
    factor, (name, first) = usual / longest, units[0]
    warning = f"{name} would make the {kind} {longest * first:.3g} m long; it was scaled to {usual:g} m"
    return factor, f"scale {factor:g} (size prior: {a_kind} is about {usual:g} m long)", (warning,)


def _given_scale(extents: np.ndarray, scale: str) -> tuple[float, str]:
    valid = "valid are auto, a factor such as 0.001, or METRES:AXIS such as 0.45:z or 0.9:longest (x, y, z of the asset)"
    number, _, axis = scale.partition(":")
    try:
        value = float(number)
    except ValueError:
        raise OptionError(f"--scale: found {scale!r}; {valid}") from None
    if not (np.isfinite(value) and value > 0):
        raise OptionError(f"--scale: found {scale!r}; {valid}")
    if not axis and ":" not in scale:
        return value, f"scale {value:g} (given)"
    lengths = {**dict(zip(AXES, extents, strict=True)), "longest": extents.max(), "diagonal": np.linalg.norm(extents)}
    if axis not in lengths:
        raise OptionError(f"--scale: found the axis {axis!r}; {valid}, or diagonal")
    if lengths[axis] <= 0:
        raise OptionError(f"--scale: the object has no extent along {axis}")
    factor = value / float(lengths[axis])
    return factor, f"scale {factor:g} (given: {value:g} m along {axis})"
