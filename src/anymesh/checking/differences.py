"""Differences of two assets: which parts and joints differ, as displacement of points [mm]; and of two collections by name.

Bytes are compared first, and only what differs is opened.
"""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from scipy.optimize import linear_sum_assignment
from scipy.spatial import ConvexHull, QhullError

from anymesh.checking.content import Content, Solid, read_content
from anymesh.checking.engines.locate import MJCF, find_description, kind_of
from anymesh.checking.engines.mjcf_ import read_mjcf
from anymesh.checking.engines.robot import RobotJoint, read_urdf
from anymesh.checking.schema_ import check_tree
from anymesh.errors import AnymeshError, InputError
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.runtime import read_json
from anymesh.types import Brief

UNCOMPARED = ("timing.json", "certificate.json")  # files of an asset, beside hidden ones and the saved stages
STAGES, RECORD = "stages", "asset.json"
BLOCK = 1 << 20  # [bytes] compared at a time
MAX_DEPTH = 8  # folders of a collection within each other
ALIKE = 0.05  # of the diagonal, by box and area: two parts that differ less are the same one, whatever their names (estimate)
SAME_SHAPE = 0.01  # difference of sizes and area of a part that was moved and renamed (estimate)
SAME = 1e-6  # [m, rad, and relative]: smaller differences are those of numbers with ten digits
POSES = 17  # of a range, at which a part is compared
MANY = 3000  # points of a surface whose distance to another one is measured
DYNAMICS = ("effort", "velocity", "friction", "damping", "armature", "mimic")


@dataclass(frozen=True, eq=False)
class PlacedPart(Brief):
    """A link of an asset at rest. T: (4, 4), from its frame to the root's; joint: that carries it, None for the root."""

    name: str
    triangles: Float[np.ndarray, "F 3 3"]
    T: Float[np.ndarray, "4 4"]
    T_parent: Float[np.ndarray, "4 4"]
    joint: RobotJoint | None
    content: Content

    @cached_property
    def features(self) -> Float[np.ndarray, " 7"]:
        """Return the corners of its box and the root of its area [m]."""
        points = self.triangles.reshape(-1, 3) if len(self.triangles) else self.T[None, :3, 3]
        sides = np.diff(self.triangles, axis=1) if len(self.triangles) else np.zeros((1, 2, 3))
        area = float(np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2)
        return np.array([*points.min(0), *points.max(0), math.sqrt(area)])

    def motion(self, amount: float) -> Float[np.ndarray, "4 4"]:
        """Return what its own joint does to its points at rest, in the root's frame, with all others at rest."""
        if self.joint is None:
            return np.eye(4)
        return self.T_parent @ self.joint.transform(amount) @ np.linalg.inv(self.T_parent @ self.joint.T_parent_joint)

    @property
    def line(self) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]]:
        """Return a point and the unit direction of its joint's axis in the root's frame."""
        joint = self.joint
        if joint is None or not joint.moves:
            return self.T[:3, 3], np.zeros(3)
        T = self.T_parent @ joint.T_parent_joint
        return T[:3, 3], T[:3, :3] @ joint.axis / np.linalg.norm(joint.axis)


def differences(a: str | Path, b: str | Path) -> dict[str, Any]:
    """Return what differs between two assets, or between two collections (folders of assets), as docs/check.md describes it.

    Raise InputError if one of them is neither, or if only one is a collection.
    """
    a, b = Path(a), Path(b)
    alone = [_is_asset(path) for path in (a, b)]
    if all(alone):
        return compare(a, b)
    if any(alone):
        raise InputError(f"{a} and {b}: one is an asset, and the other is not; valid are two assets or two folders of assets")
    return _collections(a, b)


def _is_asset(path: Path) -> bool:
    if not path.exists():
        raise InputError(f"{path} is not there; valid are assets, and folders of assets")
    return path.is_file() or (path / RECORD).is_file() or any(p.suffix.lower() in (".urdf", ".xml") for p in path.iterdir())


def _collections(a: Path, b: Path) -> dict[str, Any]:
    ours, theirs = (dict(_assets(folder, 0)) for folder in (a, b))
    for folder, assets in ((a, ours), (b, theirs)):
        if not assets:
            raise InputError(f"{folder} holds no asset; valid is a folder of folders with {RECORD} or a URDF")
    changed: dict[str, Any] = {}
    for name in sorted(ours.keys() & theirs.keys()):
        if files := different_files(ours[name], theirs[name]):
            try:
                changed[name] = compare(ours[name], theirs[name], files)
            except AnymeshError as error:
                changed[name] = {"same": False, "error": str(error), "files": files}
    lost, fresh = sorted(ours.keys() - theirs.keys()), sorted(theirs.keys() - ours.keys())
    same = not (changed or lost or fresh)
    compared = len(ours.keys() & theirs.keys())
    return {"a": str(a), "b": str(b), "same": same, "assets": compared, "added": fresh, "removed": lost, "changed": changed}


def _assets(folder: Path, depth: int, name: str = "") -> Iterator[tuple[str, Path]]:
    """Yield the assets below a folder with their relative paths; links of folders are not followed."""
    with os.scandir(folder) as entries:
        inside = sorted((e for e in entries if not e.name.startswith(".")), key=lambda e: e.name)
    if depth and any(e.name == RECORD or e.name.lower().endswith((".urdf", ".xml")) for e in inside):
        yield name, folder
    elif depth < MAX_DEPTH:
        for e in inside:
            if e.is_dir(follow_symlinks=False):
                yield from _assets(Path(e.path), depth + 1, f"{name}/{e.name}" if name else e.name)


def different_files(a: Path, b: Path) -> list[str]:
    """Return the files of two asset folders that differ, or that only one has, by their relative paths."""
    if a.is_file() or b.is_file():
        return [] if _equal(str(find_description(a)), str(find_description(b))) else [find_description(b).name]
    ours, theirs = dict(_files(str(a), "")), dict(_files(str(b), ""))
    lone = ours.keys() ^ theirs.keys()
    return sorted(lone | {name for name in ours.keys() & theirs.keys() if not _alike(ours[name], theirs[name])})


def _files(folder: str, before: str) -> Iterator[tuple[str, os.DirEntry[str]]]:
    with os.scandir(folder) as entries:
        for e in entries:
            if e.name.startswith(".") or (not before and e.name in (*UNCOMPARED, STAGES)):
                continue
            if e.is_dir(follow_symlinks=False):
                yield from _files(e.path, f"{before}{e.name}/")
            elif e.is_file(follow_symlinks=False):
                yield before + e.name, e


def _alike(a: os.DirEntry[str], b: os.DirEntry[str]) -> bool:
    ours, theirs = a.stat(), b.stat()
    if ours.st_size != theirs.st_size:
        return False
    return (ours.st_ino, ours.st_dev) == (theirs.st_ino, theirs.st_dev) or _equal(a.path, b.path)


def _equal(a: str, b: str) -> bool:
    with open(a, "rb", buffering=0) as first, open(b, "rb", buffering=0) as second:  # noqa: PTH123 - a third of the time
        while (block := first.read(BLOCK)) == second.read(BLOCK):
            if not block:
                return True
    return False


def compare(a: Path, b: Path, files: Sequence[str] | None = None) -> dict[str, Any]:
    """Return what differs between two assets. files: that differ, if they were compared already. Raise InputError."""
    names = different_files(a, b) if files is None else list(files)
    parts: list[dict[str, Any]] = []
    if names or a.is_file() or b.is_file():
        ours, theirs = _parts(a), _parts(b)
        pairs = _pairs(ours, theirs)
        parts += [{"name": p.name, "change": "removed"} for k, p in enumerate(ours) if k not in {i for i, _ in pairs}]
        parts += [{"name": p.name, "change": "added"} for k, p in enumerate(theirs) if k not in {j for _, j in pairs}]
        renamed = {ours[i].name: theirs[j].name for i, j in pairs}
        parts += [change for i, j in sorted(pairs) if (change := _change(ours[i], theirs[j], renamed))]
    most = max((p.get("displacement_mm", 0.0) for p in parts), default=0.0)
    result = {"a": str(a), "b": str(b), "same": not (names or parts), "displacement_mm": most, "parts": parts, "files": names}
    loops = [(read_json(path / RECORD) or {}).get("loops", []) for path in (a, b)]  # of a file: none
    return result | ({"loops": loops} if loops[0] != loops[1] else {})


def _parts(path: Path) -> list[PlacedPart]:
    file = find_description(path)
    robot = read_mjcf(file) if kind_of(file) == MJCF else read_urdf(file)
    for fault in check_tree(robot):
        raise InputError(f"{file}: {fault.text}")
    content, joints = read_content(robot), {j.child: j for j in robot.joints}
    for joint in robot.moving:
        if not np.linalg.norm(joint.axis) > 0:
            raise InputError(f"{file}: the axis of {joint.name!r} has no direction")
    return [
        PlacedPart(
            link.name,
            content.at_rest(frozenset({link.name})),
            T := content.places[link.name],
            T if (joint := joints.get(link.name)) is None else content.places[joint.parent],
            joint,
            content,
        )
        for link in robot.links
    ]


def _pairs(ours: Sequence[PlacedPart], theirs: Sequence[PlacedPart]) -> list[tuple[int, int]]:
    """Return which part is which: those in one place, then those of one name, then those of one shape."""
    f, g = (np.array([p.features for p in parts]) for parts in (ours, theirs))
    size = float(np.linalg.norm(f[:, 3:6].max(0) - f[:, :3].min(0))) or 1.0
    named = np.array([[p.name == q.name for q in theirs] for p in ours])
    place = np.abs(f[:, None] - g).max(2) / size
    shapes = [np.c_[np.sort(x[:, 3:6] - x[:, :3], axis=1), x[:, 6]] for x in (f, g)]
    shape = np.abs(shapes[0][:, None] - shapes[1]).max(2) / size
    pairs: list[tuple[int, int]] = []
    for cost, most in ((np.where(named, place - SAME_SHAPE, place), ALIKE), (1.0 - named, 0.5), (shape, SAME_SHAPE)):
        rows, columns = (sorted({*range(n)} - {pair[k] for pair in pairs}) for k, n in enumerate(cost.shape))
        left = cost[np.ix_(rows, columns)]
        chosen = linear_sum_assignment(np.where(left <= most, left, 1e3))
        pairs += [(rows[i], columns[j]) for i, j in zip(*chosen, strict=True) if left[i, j] <= most]
    return pairs


def _change(a: PlacedPart, b: PlacedPart, renamed: Mapping[str, str]) -> dict[str, Any]:
    """Return what differs between two parts that are the same one; empty if nothing does."""
    rest, rigid = _at_rest(a.triangles, b.triangles)
    moved = max(rest, _over_range(a, b, rigid))
    change: dict[str, Any] = {} if moved <= SAME else {"displacement_mm": _mm(moved), "at_rest_mm": _mm(rest)}
    change |= {"shape": "changed"} if moved > SAME and not rigid else {}
    change |= {} if a.name == b.name else {"renamed": [a.name, b.name]}
    change |= _joint_change(a, b, renamed)
    change |= _inertia_change(a, b)
    ours, theirs = (p.content.collisions[p.name] for p in (a, b))
    collided, _ = _at_rest(*(np.concatenate([np.zeros((0, 3, 3)), *(s.triangles for s in some)]) for some in (ours, theirs)))
    if len(ours) != len(theirs) or collided > SAME:
        change["collision"] = {"shapes": [len(ours), len(theirs)], "mm": _mm(collided)}
    looks = [_looks(p.content.visuals[p.name]) for p in (a, b)]
    change |= {} if looks[0] == looks[1] else {"textures": "changed"}
    return {"name": b.name, "change": "changed", **change} if change else {}


def _at_rest(a: np.ndarray, b: np.ndarray) -> tuple[float, bool]:
    """Return how far a surface moved [m], and whether each triangle kept its shape; if not, how far the surfaces are apart."""
    if not len(a) or not len(b):
        return (0.0 if len(a) == len(b) else math.inf), len(a) == len(b)
    if a.shape == b.shape:
        edges = [np.linalg.norm(t - np.roll(t, 1, axis=1), axis=2) for t in (a, b)]
        if np.abs(edges[0] - edges[1]).max() <= SAME:
            return float(np.linalg.norm(a - b, axis=2).max()), True
    return max(_farthest(a, b), _farthest(b, a)), False


def _farthest(a: np.ndarray, b: np.ndarray) -> float:
    """Return how far points of a surface are from another one at most."""
    points = np.concatenate([a.reshape(-1, 3), a.mean(1)])
    points = points[:: 1 + len(points) // MANY]
    return float(distance_to_mesh(points, b.reshape(-1, 3), np.arange(3 * len(b)).reshape(-1, 3))[0].max())


def _over_range(a: PlacedPart, b: PlacedPart, rigid: bool) -> float:
    """Return how far points of a part are apart at most, at equal positions of both joints or at their limits."""
    if not len(a.triangles):
        return 0.0
    rows = _corners(a.triangles.reshape(-1, 3))
    points = a.triangles.reshape(-1, 3)[rows]
    others = b.triangles.reshape(-1, 3)[rows] if rigid else points
    most = 0.0
    for amount, other in _positions(a, b):
        P, Q = a.motion(amount), b.motion(other)
        off = points @ P[:3, :3].T + P[:3, 3] - others @ Q[:3, :3].T - Q[:3, 3]
        most = max(most, float(np.linalg.norm(off, axis=1).max()))
    return most


def _corners(points: np.ndarray) -> np.ndarray:
    """Return indices of the corners of the convex hull, one of which moves farthest, and of some others."""
    some = np.arange(0, len(points), 1 + len(points) // MANY)
    try:
        return np.concatenate([ConvexHull(points).vertices, some]) if len(some) < len(points) else some
    except (QhullError, ValueError):  # it is flat
        return np.arange(len(points))


def _positions(a: PlacedPart, b: PlacedPart) -> Iterator[tuple[float, float]]:
    """Yield positions of both joints: equal ones within the limits of each, or equal shares of ranges of unequal kinds."""
    ranges = [p.joint.range if p.joint is not None and p.joint.moves else (0.0, 0.0) for p in (a, b)]
    (low, high), (low_b, high_b) = ranges
    if {(p.joint.type if p.joint else "") == "prismatic" for p in (a, b)} == {True, False}:
        for share in np.linspace(-1, 1, POSES):
            yield tuple(float(abs(share) * (max(r[1], 0.0) if share > 0 else min(r[0], 0.0))) for r in ranges)  # ty: ignore
        return
    turned = _reversed(a, b)
    for amount in sorted({0.0, *np.linspace(low, high, POSES), *(s * (-1 if turned else 1) for s in (low_b, high_b))}):
        yield min(max(amount, low), high), min(max(-amount if turned else amount, low_b), high_b)


def _reversed(a: PlacedPart, b: PlacedPart) -> bool:
    """Return whether both the axis and the limits of a joint are reversed, so that its motion is the same."""
    if a.joint is None or b.joint is None or a.line[1] @ b.line[1] > -1 + SAME:
        return False
    (low, high), (low_b, high_b) = a.joint.range, b.joint.range
    return abs(low + high_b) <= SAME and abs(high + low_b) <= SAME


def _joint_change(a: PlacedPart, b: PlacedPart, renamed: Mapping[str, str]) -> dict[str, Any]:
    p, q = a.joint, b.joint
    if p is None or q is None:
        return {} if p is q else {"parent": [None if j is None else j.parent for j in (p, q)]}
    change: dict[str, Any] = {} if p.name == q.name else {"joint": [p.name, q.name]}
    change |= {} if renamed.get(p.parent) == q.parent else {"parent": [p.parent, q.parent]}
    change |= {} if p.type == q.type else {"type": [p.type, q.type]}
    limits = [None if j.limits is None or j.type == "continuous" else [float(v) for v in j.limits] for j in (p, q)]
    if not all(_near(*pair) for pair in zip(limits[0] or [None] * 2, limits[1] or [None] * 2, strict=True)):
        change["limits"] = limits
    (at, axis), (at_b, axis_b) = a.line, b.line
    if axis.any() and axis_b.any():
        cosine = float(np.clip(axis @ axis_b, -1, 1))
        degrees = math.degrees(math.atan2(float(np.linalg.norm(np.cross(axis, axis_b))), abs(cosine)))
        arm = at_b - at
        off = 0.0 if "prismatic" in (p.type, q.type) else float(np.linalg.norm(arm - (arm @ axis) * axis))
        if degrees > math.degrees(SAME) or off > SAME or cosine < 0:
            change["axis"] = {"degrees": round(degrees, 4), "mm": _mm(off), "reversed": cosine < 0}
    values = {name: [getattr(p, name), getattr(q, name)] for name in DYNAMICS}
    values["mimic"] = [m and asdict(m) for m in values["mimic"]]
    if unequal := {name: pair for name, pair in values.items() if not _near(*pair)}:
        change["dynamics"] = unequal
    return change


def _near(a: Any, b: Any) -> bool:
    numbers = isinstance(a, float | int) and isinstance(b, float | int)
    return math.isclose(a, b, rel_tol=SAME, abs_tol=1e-12) if numbers else a == b


def _inertia_change(a: PlacedPart, b: PlacedPart) -> dict[str, Any]:
    p, q = (next(link.inertial for link in part.content.robot.links if link.name == part.name) for part in (a, b))
    if p is None or q is None:
        return {} if p is q else {"inertia": {"mass": [None if i is None else i.mass for i in (p, q)]}}
    centers = [part.T[:3, :3] @ i.center + part.T[:3, 3] for part, i in ((a, p), (b, q))]
    off = float(np.linalg.norm(centers[0] - centers[1]))
    tensors = [part.T[:3, :3] @ i.tensor @ part.T[:3, :3].T for part, i in ((a, p), (b, q))]
    share = float(np.abs(tensors[0] - tensors[1]).max() / max(np.abs(tensors[0]).max(), 1e-300))
    if _near(p.mass, q.mass) and off <= SAME and share <= SAME:
        return {}
    return {"inertia": {"mass": [p.mass, q.mass], "center_mm": _mm(off), "tensor": round(share, 6)}}


def _looks(solids: Sequence[Solid]) -> list[str]:
    """Return what surfaces look like: their materials in use with the digests of pictures, and texture coordinates."""
    looks = []
    for mesh in (s.mesh for s in solids if s.mesh is not None):
        for k in np.unique(mesh.face_material):
            material = vars(mesh.materials[k]) if k >= 0 else {}
            pictures = {slot: hashlib.sha256(t.data).hexdigest() for slot, t in material.get("textures", {}).items()}
            uv = b"" if mesh.corner_uv is None else np.ascontiguousarray(mesh.corner_uv).tobytes()
            looks.append(repr(({**material, "textures": sorted(pictures.items())}, hashlib.sha256(uv).hexdigest())))
    return sorted(looks)


def _mm(metres: float) -> float:
    return round(1000 * metres, 4)


def lines(result: Mapping[str, Any]) -> list[str]:
    """Return the result of `differences` in lines of text; the last one sums up."""
    if "changed" not in result:
        loops = " -> ".join("; ".join(map(_shown, some)) or "none" for some in result.get("loops", ()))
        told = [*map(_words, result["parts"]), *([f"loops {loops}"] if loops else [])]
        told += [] if result["same"] else [f"files that differ: {', '.join(result['files'])}"]
        return [*told, "the same" if result["same"] else f"{len(result['parts'])} parts differ{_most(result)}"]
    told = [f"{name}: added" for name in result["added"]] + [f"{name}: removed" for name in result["removed"]]
    for name, change in result["changed"].items():
        what = change.get("error") or f"{len(change['parts'])} parts differ{_most(change)}, {len(change['files'])} files"
        told.append(f"{name}: {what}")
    counts = f"{len(result['changed'])} of {result['assets']} assets differ"
    return [*told, f"{counts}, {len(result['added'])} added, {len(result['removed'])} removed"]


def _most(change: Mapping[str, Any]) -> str:
    return f", by at most {change['displacement_mm']:.4g} mm" if change["displacement_mm"] else ""


def _words(part: Mapping[str, Any]) -> str:
    """Return what differs in a part in words."""
    if part["change"] != "changed":
        return f"{part['name']}: {part['change']}"
    told = []
    if "displacement_mm" in part:
        told.append(f"{part['displacement_mm']:.4g} mm apart over its range, {part['at_rest_mm']:.4g} mm at rest")
    for key in ("renamed", "joint", "parent", "type"):
        told += [f"{key} {part[key][0]} -> {part[key][1]}"] if key in part else []
    told += [f"limits {part['limits'][0]} -> {part['limits'][1]} (rad or m)"] if "limits" in part else []
    if axis := part.get("axis"):
        told.append(f"axis {axis['degrees']:.4g} deg and {axis['mm']:.4g} mm off{', reversed' if axis['reversed'] else ''}")
    told += [f"{name} {_shown(pair[0])} -> {_shown(pair[1])}" for name, pair in part.get("dynamics", {}).items()]
    if inertia := part.get("inertia"):
        told.append(f"mass {inertia['mass'][0]} -> {inertia['mass'][1]} kg, center {inertia.get('center_mm', 0):.4g} mm off")
    if collision := part.get("collision"):
        told.append(f"collision {collision['shapes'][0]} -> {collision['shapes'][1]} shapes, {collision['mm']:.4g} mm off")
    return f"{part['name']}: {'; '.join([*told, *(name for name in ('shape', 'textures') if name in part)])}"


def _shown(value: Any) -> str:
    return ", ".join(f"{k} {v}" for k, v in value.items()) if isinstance(value, dict) else str(value).lower()
