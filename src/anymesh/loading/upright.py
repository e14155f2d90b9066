"""The direction that points up in a mesh: stated by a user, or inferred from how the object can stand.

The features of a direction do not depend on the mesh's position, rotation or size (of dense meshes, nearly). Lengths are
relative to twice the distance of the farthest corner from the center of the surface.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np
from jaxtyping import Float
from scipy.spatial import ConvexHull, KDTree, QhullError

from anymesh.errors import OptionError
from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.triangle_set import sample_surface, spread_directions
from anymesh.scoring.classifier import MISSING, Classifier
from anymesh.types import Brief, Mesh
from anymesh.types.triangles import face_cross

MAX_FACETS = 14  # largest flat facets of the convex hull on which the object may stand
END_RATIO = 0.02  # of the height: the ends of the object, for samples
STAND_RATIO = 0.01  # of the diagonal: depth of the convex hull's end on which the object would stand
MIN_SIDE = 1e-6  # of an outline
ACROSS_COSINE = 0.1  # maximum cosine of the angle between a mirror plane's normal and up
POINTS = 1500  # samples of the surface
MAX_VERTICES, MAX_SEEDS = 6000, 500  # of dense meshes: vertices, and triangles of the convex hull around which facets are found
OUTER_DIRECTIONS = 1000  # in which the outermost vertices of dense meshes are kept
SAME_COSINE = float(np.cos(np.deg2rad(2)))  # directions closer than this are one
FLAT_COSINE = float(np.cos(np.deg2rad(5)))  # normals closer than this to a direction face it
MAX_FLATS = 4  # directions that most of the surface faces
MIN_FLAT_SHARE = 0.02  # minimum share of the surface that faces such a direction
MIN_ANGLE_SINE = 0.5  # between two directions whose cross product is one more
AXIS = re.compile(r"(?P<sign>[+-]?)(?P<axis>[xyz])")
AUTO, INFER = "auto", "infer"
VALID_UP = "valid are auto, infer, x, y, z, -x, -y, -z, or a direction such as 0,0.7,0.7"
USUAL_SHARE, AXIS_SHARE, TILTED_SHARE = 0.9, 0.09, 0.01  # files in which the format's usual axis, another one or none is up
DIGITS = 9  # of an inferred direction, so that it does not depend on the processor
AXES = "xyz"
TO_Z = {  # rotations: rows are the asset's axes in file coordinates
    "x": np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]]),
    "y": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    "z": np.eye(3),
    "-x": np.array([[0.0, 1, 0], [0, 0, -1], [-1, 0, 0]]),
    "-y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "-z": np.array([[1.0, 0, 0], [0, -1, 0], [0, 0, -1]]),
}


@dataclass(frozen=True, eq=False)
class Up(Brief):
    """direction: (3,) unit, in file coordinates; name: such as -y, or three numbers; probability: None unless inferred."""

    direction: Float[np.ndarray, " 3"]
    name: str
    probability: float | None = None

    @property
    def to_z(self) -> Float[np.ndarray, "3 3"]:
        """Return the rotation to the asset's axes: that of the nearest axis, then the smallest one that makes it vertical."""
        k = int(np.abs(self.direction).argmax())
        base = TO_Z[AXES[k] if self.direction[k] > 0 else f"-{AXES[k]}"]
        x, y, z = base @ self.direction
        if x == y == 0:
            return base
        K = np.array([[0.0, 0, -x], [0, 0, -y], [x, y, 0]])  # of the cross product with the axis of the smallest rotation
        return (np.eye(3) + K + K @ K / (1 + z)) @ base


def read_up(text: str) -> Up | None:
    """Read a stated direction; None for auto and infer. Raise OptionError for any other text."""
    if text in (AUTO, INFER):
        return None
    if axis := AXIS.fullmatch(text):
        return up_of((-1.0 if axis["sign"] == "-" else 1.0) * np.eye(3)[AXES.index(axis["axis"])])
    try:
        direction = np.array([float(number) for number in text.split(",")])
    except ValueError:
        direction = np.zeros(0)
    length = float(np.linalg.norm(direction))
    if len(direction) != 3 or not np.isfinite(length) or length < 1e-9:
        raise OptionError(f"--up: found {text!r}; {VALID_UP}")
    return up_of(direction / length)


def up_of(direction: Float[np.ndarray, " 3"], probability: float | None = None) -> Up:
    """Return a unit direction with its name."""
    k = int(np.abs(direction).argmax())
    sign = float(np.sign(direction[k]))
    if np.array_equal(direction, sign * np.eye(3)[k]):
        return Up(direction, AXES[k] if sign > 0 else f"-{AXES[k]}", probability)
    return Up(direction, ",".join(f"{x + 0.0:.4g}" for x in direction), probability)


@cache
def up_classifier() -> Classifier:
    """Read the classifier (`training/train_up.py`)."""
    return Classifier.read("anymesh.loading", "up_classifier.npz")


def infer_up(mesh: Mesh, usual: str | None) -> Up:
    """Infer what points up from how the object can stand; the usual axis if the mesh is flat.

    usual: the axis that points up in most files of the format, or None if no axis is likelier than any other direction.
    """
    shape = Stander.of(mesh)
    if shape is None:
        return up_of(np.eye(3)[AXES.index(usual or "z")])
    candidates = up_candidates(shape)
    classifier = up_classifier()
    scores = classifier.score(classifier.table(up_features(shape, candidates)))
    if usual is not None:
        scores = scores + _log_prior(candidates, usual)
    best = int(np.argmax(scores))
    likely = np.exp(scores - scores[best])
    near = candidates @ candidates[best] > FLAT_COSINE
    direction = np.round(candidates[best], DIGITS)
    return up_of(direction / np.linalg.norm(direction), float(likely[near].sum() / likely.sum()))


def _log_prior(candidates: Float[np.ndarray, "k 3"], usual: str) -> Float[np.ndarray, " k"]:
    """Return the logarithm of the share of files in which each candidate points up."""
    is_axis = (np.abs(candidates) == 1).any(1)
    is_usual = candidates[:, AXES.index(usual)] == 1
    share = np.where(is_axis, AXIS_SHARE / 5, TILTED_SHARE / max(int((~is_axis).sum()), 1))
    return np.log(np.where(is_usual, USUAL_SHARE, share))


def up_candidates(shape: Stander) -> Float[np.ndarray, "k 3"]:
    """Return unit directions that may point up: the axes, what the surface faces, opposite to the hull's facets."""
    lines = [*np.eye(3), *shape.flats]
    ways = [sign * line for line in lines for sign in (1.0, -1.0)]
    return distinct([*ways, *-shape.facets[:MAX_FACETS], *shape.main_axes, *-shape.main_axes])


def up_features(shape: Stander, candidates: Float[np.ndarray, "k 3"]) -> list[dict[str, float]]:
    """Return the features of each candidate; the keys are the same for all."""
    return [_features(shape, up) for up in candidates]


def _features(shape: Stander, up: Float[np.ndarray, " 3"]) -> dict[str, float]:
    ground = _ground_axes(up)
    heights, outline = shape.corners @ up, shape.corners @ ground.T
    low, height = float(heights.min()), max(float(np.ptp(heights)), 1e-9)
    share = (shape.points @ up - low) / height
    facing = shape.normals @ up
    area, width, length = _outline(outline)
    spread = np.linalg.norm(shape.points @ ground.T, axis=1) / np.sqrt(area)
    normals, residuals = shape.mirrors
    upright = residuals[np.abs(normals @ up) < ACROSS_COSINE]
    upside_down = shape.asymmetry(up)
    values = {
        "height over length": float(np.log2(height / length)),
        "height over width": float(np.log2(height / width)),
        "height of the center": -low / height,
        "center off the outline's middle": float(np.linalg.norm(_middle(outline)) / np.sqrt(area)),
        "level": float((np.abs(facing) > 0.95).mean()),
        "upright": float((np.abs(facing) < ACROSS_COSINE).mean()),
        "faces up": float((facing > 0.95).mean()),
        "faces down": float((facing < -0.95).mean()),
        "hull below": float(shape.facet_areas[-shape.facets @ up > FLAT_COSINE].sum()),
        "hull above": float(shape.facet_areas[shape.facets @ up > FLAT_COSINE].sum()),
        "mirrored": float(upright.min()) if len(upright) else MISSING,
        "upside down": upside_down,
        "mirrored rather than upside down": upside_down - float(upright.min()) if len(upright) else MISSING,
    }
    for name, at, stands in (
        ("bottom", share < END_RATIO, heights - low < STAND_RATIO),
        ("top", share > 1 - END_RATIO, low + height - heights < STAND_RATIO),
    ):
        values |= {f"{name} area": float(at.mean()), f"{name} level": float((at & (np.abs(facing) > 0.95)).mean())}
        values |= {f"{name} {key}": value for key, value in _stand(outline[stands], area).items()}
    for name, part in (("low", share < 0.25), ("high", share > 0.75)):
        rms = float(np.sqrt((spread[part] ** 2).mean())) if part.any() else MISSING
        values |= {f"{name} quarter": float(part.mean()), f"{name} spread": rms}
    return values


def _ground_axes(up: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "2 3"]:
    x = np.cross(up, np.eye(3)[np.abs(up).argmin()])
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(up, x)])


def _hull(points: Float[np.ndarray, "n 2"]) -> ConvexHull | None:
    try:
        return ConvexHull(points) if len(points) > 2 else None
    except QhullError:
        return None


def _boxes(hull: ConvexHull) -> tuple[Float[np.ndarray, "e 2 2"], Float[np.ndarray, "e 2"], Float[np.ndarray, "e 2"]]:
    """Return axes, lower and upper ends of the rectangles around a hull along each of its edges, the smallest first."""
    normals = hull.equations[:, :2]
    axes = np.stack([normals, np.stack([-normals[:, 1], normals[:, 0]], 1)], 1)
    along = axes @ hull.points[hull.vertices].T
    low, high = along.min(2), along.max(2)
    order = np.argsort((high - low).prod(1), kind="stable")
    return axes[order], low[order], high[order]


def _outline(points: Float[np.ndarray, "n 2"]) -> tuple[float, float, float]:
    """Return the area of the convex hull of points in a plane, and the sides of the smallest rectangle around it."""
    hull = _hull(points)
    if hull is None:
        return MIN_SIDE**2, MIN_SIDE, max(float(np.linalg.norm(np.ptp(points, axis=0))), MIN_SIDE)
    _, low, high = _boxes(hull)
    width, length = sorted(high[0] - low[0])
    return float(hull.volume), float(width), float(length)


def _middle(points: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, " 2"]:
    """Return the center of the smallest rectangle around points."""
    hull = _hull(points)
    if hull is None:
        return points.mean(0)
    axes, low, high = _boxes(hull)
    return (low[0] + high[0]) / 2 @ axes[0]


def _stand(stand: Float[np.ndarray, "n 2"], area: float) -> dict[str, float]:
    """Return features of the corners on which the object would stand with its center above 0. area: of its outline."""
    hull = _hull(stand)
    if hull is None:
        return {"share": 0.0, "margin": -1.0, "off": 1.0}
    return {
        "share": float(hull.volume) / area,
        "margin": max(float(-hull.equations[:, 2].max() / np.sqrt(area)), -1.0),  # of the center inside it, if positive
        "off": float(np.linalg.norm(_middle(stand)) / np.sqrt(area)),
    }


@dataclass(frozen=True, eq=False)
class Stander(Brief):
    """A mesh as something that stands, with the center of its surface at 0 and its farthest corner at 0.5. Build it by `of`.

    points, normals: samples of the surface; corners: of its convex hull; facets: unit normals of the hull's flat facets, the
    largest first; facet_areas: as shares of the hull's area.
    """

    points: Float[np.ndarray, "n 3"]
    normals: Float[np.ndarray, "n 3"]
    corners: Float[np.ndarray, "c 3"]
    facets: Float[np.ndarray, "f 3"]
    facet_areas: Float[np.ndarray, " f"]

    @classmethod
    def of(cls, mesh: Mesh) -> Stander | None:
        """Sample a mesh; return None if it is flat or has no extent."""
        used = np.zeros(len(mesh.vertices), bool)
        used[mesh.faces] = True
        low, high = mesh.bounds
        with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
            scaled = (mesh.vertices - (low + high) / 2) / float(np.linalg.norm(high - low))
        if not np.isfinite(scaled[used]).all():
            return None
        outer = mesh_surface(replace(mesh, vertices=np.where(used[:, None], scaled, 0.0))).shape
        samples = sample_surface(outer.triangles, POINTS, 0)
        try:
            hull = ConvexHull(_outermost(scaled[used]))
        except QhullError:
            return None
        facets, areas = _facets(hull)
        corners, center = hull.points[hull.vertices], samples.points.mean(0)
        size = 2 * float(np.linalg.norm(corners - center, axis=1).max())  # the diagonal of bounds depends on the rotation
        points = (samples.points - center) / size
        return cls(points, samples.normals, (corners - center) / size, facets, areas / areas.sum())

    @cached_property
    def flats(self) -> Float[np.ndarray, "k 3"]:
        """Return the directions that most of the surface faces, either way, and the cross products of these."""
        normals = self.normals[::3]
        left, directions, facing = np.ones(len(normals)), [], np.abs(normals @ normals.T) > FLAT_COSINE
        for _ in range(MAX_FLATS):
            best = int((facing @ left * left).argmax())
            if (facing[best] @ left) < MIN_FLAT_SHARE * len(left):
                break
            sign = np.sign(normals @ normals[best])
            direction = (normals * (sign * left * facing[best])[:, None]).sum(0)
            directions.append(direction / np.linalg.norm(direction))
            left = left * (np.abs(normals @ directions[-1]) <= FLAT_COSINE)
        across = [np.cross(a, b) for k, a in enumerate(directions) for b in directions[:k]]
        across = [c / np.linalg.norm(c) for c in across if np.linalg.norm(c) > MIN_ANGLE_SINE]
        return np.array([*directions, *across]).reshape(-1, 3)

    @cached_property
    def main_axes(self) -> Float[np.ndarray, "3 3"]:
        """Return the principal axes of the surface."""
        return np.linalg.svd(self.points, full_matrices=False)[2]

    @cached_property
    def mirrors(self) -> tuple[Float[np.ndarray, "m 3"], Float[np.ndarray, " m"]]:
        """Return the normals of possible mirror planes, and the mean distance of the mirrored surface from the surface."""
        normals = distinct([*self.flats, *self.main_axes], either_way=True)
        return normals, np.array([self.asymmetry(n) for n in normals])

    def asymmetry(self, normal: Float[np.ndarray, " 3"]) -> float:
        """Return the mean distance from the surface of its mirror image, in the middle of the extent along `normal`."""
        along = self.corners @ normal
        height = self.points[::3] @ normal - (along.min() + along.max()) / 2
        return float(self._tree.query(self.points[::3] - 2 * height[:, None] * normal)[0].mean())

    @cached_property
    def _tree(self) -> KDTree:
        return KDTree(self.points)


def _outermost(points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "m 3"]:
    """Return all points, or of more than MAX_VERTICES the outermost ones in OUTER_DIRECTIONS directions.

    The time of a convex hull grows with the square of the number of corners of a ring.
    """
    if len(points) <= MAX_VERTICES:
        return points
    directions = spread_directions(OUTER_DIRECTIONS)
    blocks = np.array_split(np.arange(len(points)), -(-len(points) // MAX_VERTICES))
    outer = np.unique(np.concatenate([block[(directions @ points[block].T).argmax(1)] for block in blocks]))
    return points[np.unique(outer[(directions @ points[outer].T).argmax(1)])]


def _facets(hull: ConvexHull) -> tuple[Float[np.ndarray, "f 3"], Float[np.ndarray, " f"]]:
    """Return the unit normals and areas of the flat facets of a hull, the largest first.

    Facets without any of the hull's MAX_SEEDS largest triangles are left out.
    """
    normals, corners = hull.equations[:, :3], hull.points[hull.simplices]
    areas = 0.5 * np.linalg.norm(face_cross(corners), axis=1)
    left, facets, sizes = areas > 0, [], []
    for k in np.argsort(-areas, kind="stable")[:MAX_SEEDS]:
        if left[k]:
            same = left & (normals @ normals[k] > SAME_COSINE)
            left &= ~same
            normal = (normals[same] * areas[same, None]).sum(0)
            facets.append(normal / np.linalg.norm(normal))
            sizes.append(areas[same].sum())
    order = np.argsort(-np.array(sizes), kind="stable")
    return np.array(facets)[order], np.array(sizes)[order]


def distinct(directions: Iterable[Float[np.ndarray, " 3"]], *, either_way: bool = False) -> Float[np.ndarray, "k 3"]:
    """Return the directions without those that are close to an earlier one, or to its opposite if `either_way`."""
    chosen: list[np.ndarray] = []
    for d in directions:
        cosines = [float(d @ c) for c in chosen]
        if max((abs(c) if either_way else c for c in cosines), default=-1.0) < SAME_COSINE:
            chosen.append(d)
    return np.array(chosen).reshape(-1, 3)
