"""Read a mesh file unchanged, and place it in the asset frame: Z up, metres, standing on the ground, centered.

Files without a unit, or with an implausible one, are scaled to the usual size of their kind (`kinds/usual.py`), the longest
side of the closed object [m]. A size is accepted within a factor of 3.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.entry_points import CREDITS, DAE_FRAME, LOAD_ZIPPED, READERS, TELLING_PIVOTS, USUAL_SIZE, resolve
from anymesh.errors import AnymeshError, InputError, OptionError
from anymesh.loading.files import ARCHIVE, FORMATS, MAX_FACES, FileMesh, Folder, check_file
from anymesh.loading.scene_graph import scene_of_objects
from anymesh.loading.upright import AUTO, AXES, INFER, Up, infer_up, read_up, up_of
from anymesh.types import Brief, Mesh
from anymesh.types.triangles import bounds_of

FARTHEST = 1e12  # coordinates above are no plausible lengths
MAX_UV = 1e6  # a larger texture coordinate in single precision does not tell the place in the picture
BELIEVED_FACTOR = 3.0  # a size is accepted within this factor of the usual one
PLAUSIBLE = (0.02, 12.0)  # [m] diagonals of typical objects, from a knob to a van
EXPECTED = (0.01, 20.0)  # [m] other diagonals in the unit of the file get a warning; as in anymesh check
MIN_UP_PROBABILITY = 0.6  # an up axis inferred with less gets a warning
ABSURD = (0.001, 1000.0)  # [m] a format's unit is ignored beyond these diagonals
GIVEN = (1e-6, 1e6)  # [m] beyond these diagonals, masses and inertias in an output would be lost in rounding, or overflow
UNITS = (("millimetres", 0.001), ("centimetres", 0.01), ("inches", 0.0254))


@dataclass(frozen=True, eq=False)
class LoadedMesh:
    """A mesh in the coordinates of its file, with the axis and unit that the file states."""

    mesh: Mesh
    path: str
    sha256: str
    format_up: str | None  # "x", "y" or "z" if the format states it
    unit_in_metres: float | None  # if the format states it
    warnings: tuple[str, ...]
    references: str = ""  # digest of the other files that were read, and of the warnings
    credits: Mapping[str, str] = field(default_factory=dict)  # as of a `Source`


def reads_joints(animation: str) -> bool:
    """Return whether joints that a file states are read, by the option. Raise OptionError if it is not valid."""
    if animation not in ("read", "ignore"):
        raise OptionError(f"--animation: found {animation!r}; valid are read and ignore")
    return animation == "read"


def load_mesh(path: str | Path, *, root: str | Path | None = None, animation: str = "read") -> LoadedMesh:
    """Read a file of a format of `entry_points.READERS`, or a zip of one with what it refers to.

    root: the folder within which the files that the mesh refers to may be read, by default its own folder. A texture or a
    material library that cannot be read there is left out with a warning; animation: read, or ignore for a mesh without the
    joints that animations, physics extensions and bones of the file state.

    Raise InputError, with one line, for anything that is no usable mesh, and OptionError for a root that is not valid.
    """
    path = Path(path)
    data = check_file(path, (*FORMATS, ARCHIVE))
    folder = Folder(path, root, reads_joints(animation))
    suffix = path.suffix.lower()
    if suffix == ARCHIVE:
        inner, name, warnings = resolve(LOAD_ZIPPED)(path, FORMATS, lambda p, top: load_mesh(p, root=top, animation=animation))
        sha256, credits = hashlib.sha256(data).hexdigest(), inner.credits or resolve(CREDITS)(folder)
        warnings = (*warnings, *folder.warnings, *inner.warnings)
        return replace(inner, path=str(path / name), sha256=sha256, warnings=warnings, credits=credits)
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            framed = read_framed(suffix, data, folder)
            mesh = resolve(TELLING_PIVOTS)(_with_usable_uv(scene_of_objects(framed.mesh, folder), folder), framed.up)
    except AnymeshError:
        raise
    except Exception as error:  # readers raise many types of errors for broken files
        cause = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise InputError(f"{path.name} is not a valid {suffix[1:].upper()} file, it is broken or truncated ({cause})") from None
    if len(mesh.faces) > MAX_FACES:
        raise InputError(f"{path.name} has {len(mesh.faces)} faces; at most {MAX_FACES} are handled")
    _check_numbers(path.name, mesh)
    sha256, credits = hashlib.sha256(data).hexdigest(), resolve(CREDITS)(folder)
    return LoadedMesh(mesh, str(path), sha256, framed.up, framed.unit, tuple(folder.warnings), folder.digest(), credits)


def read_framed(suffix: str, data: bytes, folder: Folder) -> FileMesh:
    """Return what the reader of a suffix reads; joints and pivots only if those of the folder are read."""
    read = resolve(READERS[suffix])(data, folder)
    framed = read if isinstance(read, FileMesh) else FileMesh(read, *_frame(suffix, data))
    return framed if folder.joints else replace(framed, mesh=framed.mesh.without_joints())


def _with_usable_uv(mesh: Mesh, folder: Folder) -> Mesh:
    """Return the mesh with texture coordinates that are not finite, or too large to mean a place, replaced by 0."""
    for name, uv in (("corner_uv", mesh.corner_uv), ("corner_more_uv", mesh.corner_more_uv)):
        if uv is not None and not (usable := np.abs(uv) <= MAX_UV).all():
            folder.warn(f"texture coordinates that are not finite or above {MAX_UV:.0e} are taken for 0")
            mesh = replace(mesh, **{name: np.where(usable, uv, np.float32(0))})
    return mesh


def _check_numbers(name: str, mesh: Mesh) -> None:
    farthest = float(np.abs(mesh.bounds).max())
    if farthest > FARTHEST:
        raise InputError(f"{name}: found a coordinate of {farthest:.3g}; at most {FARTHEST:.0e} is sensible")
    if mesh.diagonal <= 1e-12 * max(1.0, farthest) or mesh.face_areas.max() <= 0:
        raise InputError(f"{name}: the mesh has no extent, all faces are degenerate")


def _frame(suffix: str, data: bytes) -> tuple[str | None, float | None]:
    """Return the up axis and the unit that the format or the file states."""
    if suffix in (".glb", ".gltf"):
        return "y", 1.0
    return resolve(DAE_FRAME)(data) if suffix == ".dae" else (None, None)


@dataclass(frozen=True, eq=False)
class PlacedMesh(Brief):
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
    low, high = bounds_of(turned)
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
    names = [Path(part).stem for part in Path(loaded.path).parts if part.lower().endswith(ARCHIVE)] + [Path(loaded.path).stem]
    usual_size = resolve(USUAL_SIZE)
    by_name = next((usual for name in names if (usual := usual_size(name))), None)
    prior = usual_size(category) if category else by_name if unit is None else None
    if prior is not None:  # a unit in the file has priority over the file's name, but not over the user's category
        return _scale_of_kind(extents, unit, *prior)
    if unit is not None:
        if ABSURD[0] <= diagonal * unit <= ABSURD[1]:
            return unit, f"scale {unit:g} (the file's unit)", _doubted(diagonal, unit, float(extents.max()), by_name)
        warning = f"the file's unit makes the object {diagonal * unit:.3g} m large; it was scaled to a diagonal of 1 m"
        return 1 / diagonal, f"scale {1 / diagonal:g} (normalised)", (warning,)
    if PLAUSIBLE[0] <= diagonal <= PLAUSIBLE[1]:
        return 1.0, "scale 1 (the file has no unit; taken as metres)", ()
    for name, factor in UNITS:
        if PLAUSIBLE[0] <= diagonal * factor <= PLAUSIBLE[1] / 4:
            return factor, f"scale {factor:g} (inferred: a diagonal of {diagonal:.4g} is taken as {name})", ()
    warning = f"no unit makes a diagonal of {diagonal:.3g} plausible; the object was scaled to a diagonal of 1 m"
    return 1 / diagonal, f"scale {1 / diagonal:g} (normalised)", (warning,)


def _doubted(diagonal: float, unit: float, longest: float, usual: tuple[str, float] | None) -> tuple[str, ...]:
    """Return a warning if the file's unit gives no plausible size, with the unit that gives the most plausible one."""
    if EXPECTED[0] <= diagonal * unit <= EXPECTED[1]:
        return ()
    size = usual[1] / longest if usual else 1 / diagonal
    name, factor = min((("metres", 1.0), *UNITS), key=lambda u: abs(math.log(u[1] / size)))
    told = f"the file's unit makes the object {diagonal * unit:.3g} m large; plausible is {EXPECTED[0]:g} to {EXPECTED[1]:g} m"
    if factor == unit:
        return (f"{told}; if that is wrong, set it with --scale",)
    return (f"{told}: it is probably in {name}; if so, give --scale {factor:g}",)


def _scale_of_kind(extents: np.ndarray, unit: float | None, kind: str, usual: float) -> tuple[float, str, tuple[str, ...]]:
    """Return the file's unit, or a common one, that gives the object a plausible size for its kind; else the usual size."""
    longest, kind = float(extents.max()), kind.replace("_", " ")
    a_kind = f"{'an' if kind[:1] in 'aeiou' else 'a'} {kind}"
    units = [("the file's unit", unit)] if unit is not None else [("metres", 1.0), *UNITS]
    for name, factor in units:
        if usual / BELIEVED_FACTOR <= longest * factor <= usual * BELIEVED_FACTOR:
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
