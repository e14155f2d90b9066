"""Panels, which close a cavity of the body that carries them, and boards behind them: cavity walls and drawer boxes.

A cavity gets walls where the body's own shell is far away, as beside a microwave's controls.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from jaxtyping import Float

from anymesh.finishing.entering import enters
from anymesh.finishing.protocol import ShapeConfig
from anymesh.finishing.scenes import Growing, Scenes, moves_freely, scene_of, widest
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.kinematics import joint_transform
from anymesh.geometry.raycast_ import Hits, RayScene
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.types import Brief, JointType

FACING = 0.9  # minimum cosine between a face's normal and its panel's
FILLED = 0.6  # minimum share of its bounding rectangle that a panel's face fills
CELLS = 64  # rays along each side of a panel
SMALL = 4.0  # in wall thicknesses: minimum size of a panel and of the cavity behind it
DEEP = 0.5  # share of the maximum depth above which a cell of the panel lies over the cavity
MOVES = 2.0  # in wall thicknesses: minimum distance that a panel moves
_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
_QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_TOP = 5  # index of the quad that faces the last axis
MAX_SIDE_GAP_WALLS = 3.0  # in wall thicknesses: a side of the body nearer than this to the cavity's edge bounds it
TURNED = 0.05  # maximum difference between the axes of adjacent panels
INTO = 0.02  # share of a wall by which boards extend into what they end at; no shell is thinner
INSET = 0.02  # share of a board's side: what extends in no further only touches it
PROBES = 8  # rays along each direction of a side
THERE = 0.6  # minimum share of a strip between two panels that a rail fills
ALONG = 0.5  # minimum overlap of adjacent panels, as a share of the shorter edge
COVERS = 0.3  # minimum share of the body's side covered by panels with separate cavities; less is the flap of a bin
FIRST = 0.4  # share of the cavity's depth within which the body's face lies
STRAIGHT = 0.95  # minimum cosine between the slide and the cavity's direction
UPRIGHT = 0.5  # minimum vertical component of a box's up direction
INNER = np.r_[0.02, (np.arange(1, 11) + 0.5) / 12, 0.98]  # shares of a section at which rays start
THIN = 0.08  # maximum thickness of a box's wall, as a share of its smallest side
HAS_SIDE = 0.6  # minimum share of the rays that hit a side of an existing box
TRIES = (1.0, 2.0, 4.0)  # multiples of the clearance on each side, tried until the box moves freely


@dataclass(frozen=True, eq=False)
class PanelBox(Brief):
    """A part that closes a cavity.

    axes: rows, right-handed: along the panel (2), and into the body; low, high: corners of the cavity along them [m, asset
    frame], from the back of the panel to the first surface behind it.
    """

    part: int
    axes: Float[np.ndarray, "3 3"]
    low: Float[np.ndarray, " 3"]
    high: Float[np.ndarray, " 3"]

    @property
    def inward(self) -> Float[np.ndarray, " 3"]:
        return self.axes[2]


def find_panel(part: int, growing: Growing, config: ShapeConfig) -> PanelBox | None:
    """Find the cavity behind a part that moves away from it; None if there is none, or if it is too small."""
    scenes, joint = growing.scenes, growing.scenes.joint.get(part)
    if joint is None or joint.type in (JointType.FIXED, JointType.CONTINUOUS):
        return None
    face = _face(part, scenes)
    if face is None:
        return None
    axes, low, high = face
    least = SMALL * config.wall * scenes.diagonal
    middle = (low + high) / 2 @ axes
    away = joint_transform(joint, widest(joint))
    goes = float(np.linalg.norm(away[:3, :3] @ middle + away[:3, 3] - middle))
    if (high - low)[:2].min() < least or goes < MOVES * config.wall * scenes.diagonal:
        return None
    return _hollow(part, axes, low, high, growing, least)


def _face(part: int, scenes: Scenes) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Return axes and bounds of a part's visible face: the side of its box that most of its visible surface faces."""
    mesh, faces = scenes.asset.mesh, scenes.asset.segmentation.faces(part)
    shape = TriangleSet(mesh.triangles[faces], mesh.face_normals[faces], np.zeros(len(faces), bool), faces)
    box, s = body_obb(shape), shape.samples
    seen = scenes.seen(s.points, s.normals)
    best, most = None, 0
    for axis in np.concatenate([box.axes, -box.axes]):
        facing = (seen[:, 0] & (s.normals @ axis > FACING)) | (seen[:, 1] & (s.normals @ axis < -FACING))
        if facing.sum() > most:
            best, most, points = axis, int(facing.sum()), s.points[facing]
    if best is None:
        return None
    axes = _upright(box, -best)
    local = points @ axes.T
    low, high = np.percentile(local, 0.5, axis=0), np.percentile(local, 99.5, axis=0)
    filled = most / len(s.points) * shape.area
    return (axes, low, high) if filled > FILLED * (high - low)[0] * (high - low)[1] else None


def _upright(box: OrientedBox, inward: np.ndarray) -> Float[np.ndarray, "3 3"]:
    """Return a box's axes with the last one inward, and the second as vertical as possible, pointing up."""
    others = [a for a in box.axes if abs(a @ inward) < 0.5]
    up = max(others, key=lambda a: (round(abs(float(a[2])), 9), round(abs(float(a[1])), 9), round(abs(float(a[0])), 9)))
    up = up if tuple(np.round(up, 9)[::-1]) > (0.0, 0.0, 0.0) else -up
    return np.stack([np.cross(up, inward), up, inward])


def _hollow(
    part: int, axes: np.ndarray, low: np.ndarray, high: np.ndarray, growing: Growing, min_depth: float
) -> PanelBox | None:
    """Return the panel with the bounds of the cavity behind its face."""
    body, own = scene_of(growing.triangles(*growing.scenes.carriers(part))), scene_of(growing.triangles(part))
    if body is None or own is None:
        return None
    far = 2 * growing.scenes.diagonal
    share = (np.arange(CELLS) + 0.5) / CELLS
    u, v = (low[k] + share * (high - low)[k] for k in (0, 1))
    at = np.stack(np.meshgrid(u, v, indexing="ij"), -1).reshape(-1, 2)
    start = np.column_stack([at, np.full(len(at), low[2])]) @ axes
    ways = np.repeat(axes[2][None], len(start), 0)
    depth = body.first_hit(start, ways, far).distance.reshape(CELLS, CELLS)
    deepest = np.median(np.where(np.isfinite(depth), depth, 0.0))
    if not np.isfinite(depth).mean() > FILLED or deepest < min_depth:
        return None
    deep = depth > DEEP * deepest
    rows, columns = (np.flatnonzero(deep.mean(k) > 0.5) for k in (1, 0))
    if len(rows) == 0 or len(columns) == 0:
        return None
    inner_low, inner_high = low.copy(), high.copy()
    for k, cells in ((0, rows), (1, columns)):
        step = (high - low)[k] / CELLS
        inner_low[k], inner_high[k] = low[k] + cells[0] * step, low[k] + (cells[-1] + 1) * step
    inner_high[2] = low[2] + np.percentile(depth[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1], 10)
    inner_low[2] = _back(own, axes, inner_low, inner_high)
    if (inner_high - inner_low).min() < min_depth:
        return None
    return PanelBox(part, axes, inner_low, inner_high)


def _back(own, axes: np.ndarray, low: np.ndarray, high: np.ndarray) -> float:
    """Return how far a part extends inward at its centre, measured from within the cavity."""
    middle = (low + high) / 2
    start = np.array([[middle[0], middle[1], high[2]]]) @ axes
    hit = own.first_hit(start, -axes[2][None], float(high[2] - low[2]))
    return float(high[2] - hit.distance[0]) if np.isfinite(hit.distance[0]) else float(low[2])


def board(
    low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], axes: Float[np.ndarray, "3 3"]
) -> Float[np.ndarray, "12 3 3"]:
    """Return a box between two corners in the frame of `axes` (rows, unit, right-handed) [m], wound outwards."""
    return _quads(_box(low, high, axes), _QUADS)


def tray(
    low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], axes: Float[np.ndarray, "3 3"], wall: float
) -> Float[np.ndarray, "28 3 3"]:
    """Return a box as `board` does, hollow and open along the last axis, with walls and a bottom of thickness `wall` [m]."""
    inner_low, inner_high = low + wall, high - np.array([wall, wall, 0.0])
    outer, inner = _box(low, high, axes), _box(inner_low, inner_high, axes)
    shut = [q for k, q in enumerate(_QUADS) if k != _TOP]
    points = np.concatenate([outer, inner])
    rim = _QUADS[_TOP]
    around = [(rim[k], rim[(k + 1) % 4], rim[(k + 1) % 4] + 8, rim[k] + 8) for k in range(4)]
    return np.concatenate(
        [_quads(points, shut), _quads(points, [tuple(8 + c for c in q[::-1]) for q in shut]), _quads(points, around)]
    )


def _box(low: np.ndarray, high: np.ndarray, axes: np.ndarray) -> Float[np.ndarray, "8 3"]:
    return (low + _CORNERS * (high - low)) @ axes


def _quads(points: np.ndarray, quads: Sequence[tuple[int, ...]]) -> Float[np.ndarray, "n 3 3"]:
    return points[np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])]


def add_walls(panel: PanelBox, panels: Sequence[PanelBox], growing: Growing, config: ShapeConfig) -> None:
    """Add boards to the part that carries a panel, where the cavity behind it has no side."""
    parent, standing = growing.scenes.carriers(panel.part)[0], growing.triangles(*growing.scenes.carriers(panel.part))
    body, movers = scene_of(standing), scene_of(growing.others(parent))
    wall = config.wall * growing.scenes.diagonal
    if body is None or movers is None or _covered(panel, panels, standing) < COVERS:
        return
    for axis, sign in product((0, 1), (-1.0, 1.0)):
        corners = None if np.isfinite(_side(panel, axis, sign, body, wall)) else _rail(panel, panels, axis, sign, body, wall)
        if corners is None:
            continue
        (low, high), gap = corners, config.clearance * growing.scenes.diagonal
        starts = (low[2], panel.low[2] + gap)  # beside the panel, or behind it
        for first, thinner in product(starts, (0.0, gap)):
            low[2], less = first, thinner * np.eye(3)[axis]
            if (low + less >= high - less).any():
                continue
            new = board(low + less, high - less, panel.axes)
            free = not crosses(movers, low + less, high - less, panel.axes) and not enters(parent, growing, new)
            if free and moves_freely(panel.part, growing, growing, beside=new):
                growing.add(parent, new, ["wall added beside the cavity of a moving part"])
                break


def _covered(panel: PanelBox, panels: Sequence[PanelBox], standing: Float[np.ndarray, "n 3 3"]) -> float:
    """Compute the share of the body's side that a panel and those parallel to it cover."""
    side = np.ptp(standing.reshape(-1, 3) @ panel.axes[:2].T, axis=0)
    alike = [f for f in panels if _alike(panel, f)]
    return float(sum(np.prod((f.high - f.low)[:2]) for f in alike) / max(float(side.prod()), 1e-300))


def _alike(panel: PanelBox, other: PanelBox) -> bool:
    return float(np.abs(other.axes - panel.axes).max()) < TURNED


def _side(panel: PanelBox, axis: int, sign: float, base: RayScene, wall: float) -> float:
    """Compute the distance from an edge of the cavity to the body's side beyond it [m]; infinite if there is none nearby."""
    share = (np.arange(PROBES) + 0.5) / PROBES
    level = float((panel.high if sign > 0 else panel.low)[axis] - sign * wall)
    local = _section(axis, level, panel.low, panel.high, (share, 0.2 + 0.6 * share))
    return float(np.median(_cast(base, local, panel.axes, axis, sign, (MAX_SIDE_GAP_WALLS + 1) * wall).distance) - wall)


def _rail(
    panel: PanelBox, panels: Sequence[PanelBox], axis: int, sign: float, base: RayScene, wall: float
) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]] | None:
    """Return the corners of the board at an edge of the cavity; None where the next cavity begins without a rail between."""
    edge = float((panel.high if sign > 0 else panel.low)[axis])
    beside = [
        (gap, f) for f in panels if (gap := _gap(panel, f, axis, sign)) is not None and -wall < gap < MAX_SIDE_GAP_WALLS * wall
    ]
    thick = wall
    if beside:
        thick, neighbour = min(beside, key=lambda pair: abs(pair[0]))
        if neighbour.part < panel.part or thick < wall / 4:
            return None
    low, high = panel.low.copy(), panel.high.copy()
    for side, end in ((-1.0, low), (1.0, high)):  # into the body's sides if they are near, else into the next board
        far = _side(panel, 1 - axis, side, base, wall)
        end[1 - axis] += side * (far + INTO * wall if np.isfinite(far) else wall / 2)
    low[axis], high[axis] = (edge, edge + thick) if sign > 0 else (edge - thick, edge)
    face = _face_level(panel, low, high, axis, base)
    if beside and face is None:
        return None
    low[2] = panel.low[2] if face is None else face + min(wall, float(panel.high[2] - face)) / 2
    high[2] = _back_level(panel, low, high, axis, base) + INTO * wall
    return (low, high) if high[2] > low[2] else None


def _back_level(panel: PanelBox, low: np.ndarray, high: np.ndarray, axis: int, base: RayScene) -> float:
    """Return where the body ends behind a board, along the inward direction."""
    local = _along(panel, low, high, axis)
    local[:, 2] = (low[2] + panel.high[2]) / 2
    far = float(panel.high[2] - low[2])
    distance = _cast(base, local, panel.axes, 2, 1.0, far).distance
    return float(local[0, 2] + np.median(np.minimum(distance, far)))


def _along(panel: PanelBox, low: np.ndarray, high: np.ndarray, axis: int) -> Float[np.ndarray, "n 3"]:
    """Return points along the centre line of a board without its ends, at depth 0."""
    share = np.linspace(0.1, 0.9, PROBES**2)
    local = np.zeros((PROBES**2, 3))
    local[:, axis] = (low + high)[axis] / 2
    local[:, 1 - axis] = (panel.low + share[:, None] * (panel.high - panel.low))[:, 1 - axis]
    return local


def _gap(panel: PanelBox, other: PanelBox, axis: int, sign: float) -> float | None:
    """Compute the distance of another parallel panel from an edge of a panel [m]; None if it is not beside it."""
    if other.part == panel.part or not _alike(panel, other):
        return None
    k = 1 - axis
    along = min(panel.high[k], other.high[k]) - max(panel.low[k], other.low[k])
    if along < ALONG * min(panel.high[k] - panel.low[k], other.high[k] - other.low[k]):
        return None
    gap = other.low[axis] - panel.high[axis] if sign > 0 else panel.low[axis] - other.high[axis]
    return float(gap)


def _face_level(panel: PanelBox, low: np.ndarray, high: np.ndarray, axis: int, base: RayScene) -> float | None:
    """Return where the body's own face is before a board, along the inward direction; None if it has none there."""
    local = _along(panel, low, high, axis)
    depth = float(panel.high[2] - panel.low[2])
    local[:, 2] = panel.low[2] - depth
    level = _cast(base, local, panel.axes, 2, 1.0, (1 + FIRST) * depth).distance
    hit = np.isfinite(level)
    return float(np.median(level[hit]) + local[0, 2]) if hit.mean() > THERE else None


def crosses(
    scene: RayScene, low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], axes: Float[np.ndarray, "3 3"]
) -> bool:
    """Return whether a box between two corners in the frame of `axes` (rows) contains any surface of a scene."""
    share = (np.arange(PROBES) + 0.5) / PROBES
    low, high = low + INSET * (high - low), high - INSET * (high - low)
    for k in range(3):
        local = _section(k, float(low[k]), low, high, (share, share))
        if (_cast(scene, local, axes, k, 1.0, float(high[k] - low[k])).face >= 0).any():
            return True
    return False


def _section(
    axis: int, level: float, low: np.ndarray, high: np.ndarray, shares: tuple[np.ndarray, np.ndarray]
) -> Float[np.ndarray, "n 3"]:
    """Return points over a section of a box at a level along one axis, at shares of its sides along the other two."""
    at = np.stack(np.meshgrid(*shares, indexing="ij"), -1).reshape(-1, 2)
    local = np.full((len(at), 3), level)
    for column, k in enumerate(k for k in range(3) if k != axis):
        local[:, k] = low[k] + at[:, column] * (high[k] - low[k])
    return local


def _cast(scene: RayScene, local: np.ndarray, axes: np.ndarray, axis: int, sign: float, far: float) -> Hits:
    """Cast rays from points in the frame of `axes` (rows) along one of these axes."""
    return scene.first_hit(local @ axes, np.repeat(sign * axes[axis][None], len(local), 0), far)


def add_box(panel: PanelBox, growing: Growing, config: ShapeConfig) -> None:
    """Add a box to a panel that slides straight out and has none, unless it would collide on its way."""
    joint = growing.scenes.joint[panel.part]
    if joint.type is not JointType.PRISMATIC or joint.limits is None or panel.axes[1][2] < UPRIGHT:
        return
    travel = -panel.inward @ joint.axis * (joint.limits[1] if panel.inward @ joint.axis < 0 else joint.limits[0])
    if abs(panel.inward @ joint.axis) < STRAIGHT or travel <= 0:
        return
    own, others = scene_of(growing.triangles(panel.part)), scene_of(growing.others(panel.part))
    if own is None or others is None or _has_box(panel, own):
        return
    for more in TRIES:
        clear = more * config.clearance * growing.scenes.diagonal
        low, high = _inside(panel, others, own, clear)
        high[2] = min(high[2], low[2] + max(travel / (1 - config.drawer_keep), 0.0))
        high[1] = low[1] + config.drawer_height * (high[1] - low[1])
        wall = min(config.wall * growing.scenes.diagonal, THIN * float((high - low).min()))
        if wall <= config.sheet * growing.scenes.diagonal:
            continue
        order = [2, 0, 1]  # open along the second of the panel's axes
        box = tray(low[order], high[order], panel.axes[order], wall)
        if moves_freely(panel.part, growing, growing, added=box) and not enters(panel.part, growing, box):
            reach = high[2] - low[2]
            growing.add(
                panel.part, box, [f"drawer box added behind its front, {reach:.2g} m deep for a travel of {travel:.2g} m"]
            )
            return
    growing.add(panel.part, np.zeros((0, 3, 3)), ["no drawer box added: none moves without collision"])


def _inside(panel: PanelBox, others: RayScene, own: RayScene, clear: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners of the space behind a panel that is free at rest, less the clearance on all sides but the panel's."""
    low, high = panel.low.copy(), panel.high.copy()
    low[:2] += clear
    high -= clear
    scenes = (others, own)
    middle = (low + high) / 2
    core = (middle + (low - middle) / 2, middle + (high - middle) / 2)
    high[2] = min(high[2], low[2] + _way(panel.axes, 2, 1.0, low[2], *core, scenes) - clear)
    for axis in (0, 1):
        down = _way(panel.axes, axis, -1.0, middle[axis], low, high, scenes)
        up = _way(panel.axes, axis, 1.0, middle[axis], low, high, scenes)
        low[axis], high[axis] = max(low[axis], middle[axis] - down + clear), min(high[axis], middle[axis] + up - clear)
    high[2] = min(high[2], low[2] + _way(panel.axes, 2, 1.0, low[2], low, high, scenes) - clear)
    return low, high


def _way(
    axes: np.ndarray, axis: int, sign: float, level: float, low: np.ndarray, high: np.ndarray, scenes: tuple[RayScene, ...]
) -> float:
    """Compute the distance from a section of a box to the first surface along one of its axes [m]."""
    skip = 1e-3 * float((high - low)[axis])
    local = _section(axis, level + sign * skip, low, high, (INNER, INNER))
    far = 2 * float(np.abs(high - low).max())
    return min(float(np.minimum(_cast(s, local, axes, axis, sign, far).distance, far).min()) for s in scenes) + skip


def _has_box(panel: PanelBox, own: RayScene) -> bool:
    """Return whether the part has its own bottom, two sides and back in the cavity, by rays from its centre."""
    middle, size = (panel.low + panel.high) / 2, panel.high - panel.low
    for axis, sign in ((0, -1.0), (0, 1.0), (1, -1.0), (2, 1.0)):
        low, high = middle - size / 4, middle + size / 4
        low[1] = high[1] = panel.low[1] + 0.3 * size[1]
        local = _section(axis, float(low[1] if axis == 1 else middle[axis]), low, high, (INNER, INNER))
        if (_cast(own, local, panel.axes, axis, sign, float(size[axis])).face >= 0).mean() < HAS_SIDE:
            return False
    return True
