"""The paper's single-observation setting (appendix A, table 3): joints from one depth image with segmented parts.

As in OPDSynth, pictures are 256 pixels wide, and in some of them one part is partly open. Our choices where the paper is
unspecified:
- The masks are those of the true parts (the paper's come from SAM and a vision-language model).
- Cameras look from the side that shows most of the movable parts, up to 60 degrees aside and 10 to 40 above.
- Every other picture shows the object at rest.
- The unseen surface is filled before joints are estimated (see `geometry.unseen`), without ground truth.
"""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import maximum_filter

from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import EvalSample, of_parts
from anymesh.evaluation.posing import posed
from anymesh.geometry.boxes import OrientedBox, box_in_frame
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.rendering.render import View, render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Mesh, Node
from anymesh.types.camera import Camera

CELLS = 64  # cells along the longest side of the base
UPRIGHT = np.cos(np.deg2rad(10.0))  # minimum cosine between a box axis and the vertical
MAX_CLOSED_PROTRUSION_RATIO = 0.05  # of the base's diagonal: a part that protrudes less is closed
MAX_PANEL_THICKNESS_RATIO = 0.35  # maximum thickness over width of a door, drawer panel or lid
MIN_PANEL_SIZE_RATIO = 0.15  # of the base's diagonal: smaller parts are mounted on visible surface
PANEL_INTERIOR_RATIO = 0.8  # share of a plate's face without its rim
BACKING_OFFSET_RATIO = 0.005  # of the base's diagonal: offset of the support behind a plate
# maximum depth difference of neighbours, in pixel widths at that depth, unless the surface continues at the same slant
STEEP = 6.0
SIZE = 256  # [px] per side
ASIDE = 60.0  # [deg] maximum azimuth of a camera from the front
ELEVATION = (10.0, 40.0)  # [deg] range
MIN_PART_SHARE = 1e-3  # minimum share of the picture for a part to count as visible
OPEN = (0.1, 1.0)  # range of positions of an open joint, as shares of its range
TRIES = 50  # number of cameras tried before the object is rejected
DIRECTIONS = 24  # number of azimuths tried for the front


def hidden_base(
    mesh: Mesh, face_part: Int[np.ndarray, " F"], camera: Camera, depth: Float[np.ndarray, "H W"]
) -> Float[np.ndarray, "G 3 3"]:
    """Return triangles of the base that the visible surface leaves open.

    These are the occluded walls of its box, and backings of closed doors. Nothing is added where the picture shows free space
    (as in space carving, Kutulakos and Seitz 2000).

    mesh: the visible surface, z up; face_part: 0 is the base; depth: per pixel, infinite where nothing is visible.
    """
    shapes = [_shape(mesh, face_part == k) for k in range(int(face_part.max()) + 1)]
    body, shut = _base_box(mesh, [shapes[0].box, *(body_obb(s) for s in shapes[1:])])
    backs = [_backs(shapes[k].corners, core, camera, BACKING_OFFSET_RATIO * body.diagonal) for k, core in shut.items()]
    return np.concatenate([occluded_walls(body, camera, depth), *backs])


def _shape(mesh: Mesh, faces: Bool[np.ndarray, " F"]) -> TriangleSet:
    index = np.flatnonzero(faces)
    return TriangleSet(mesh.triangles[index], mesh.face_normals[index], np.zeros(len(index), bool), index)


def _base_box(mesh: Mesh, boxes: list[OrientedBox]) -> tuple[OrientedBox, dict[int, OrientedBox]]:
    """Return the box of the base, and the boxes of closed parts by number.

    The box covers the visible base down to the ground, and the doors, drawers and lids that are closed.
    """
    base = boxes[0]
    frame = base.axes
    low, high = base.center @ frame.T - base.half, base.center @ frame.T + base.half
    everything = mesh.vertices @ frame.T
    for axis in np.flatnonzero(np.abs(frame[:, 2]) > UPRIGHT):
        if frame[axis, 2] > 0:
            low[axis] = everything[:, axis].min()
        else:
            high[axis] = everything[:, axis].max()
    across = float(np.linalg.norm(high - low))
    tolerance = MAX_CLOSED_PROTRUSION_RATIO * across
    filled, shut = [low[None], high[None]], {}
    for number, core in enumerate(boxes[1:], start=1):
        ends = core.world(_corners(-core.half, core.half)) @ frame.T
        if (ends > low - tolerance).all() and (ends < high + tolerance).all() and _is_plate(core, across):
            filled.append(ends)
            shut[number] = core
    all_ends = np.concatenate(filled)
    return box_in_frame(_corners(all_ends.min(0), all_ends.max(0)) @ frame, frame), shut


def _corners(low: np.ndarray, high: np.ndarray) -> Float[np.ndarray, "8 3"]:
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])


def _is_plate(core: OrientedBox, base_diagonal: float) -> bool:
    return bool(
        core.half[2] < MAX_PANEL_THICKNESS_RATIO * core.half[1] and core.diagonal > MIN_PANEL_SIZE_RATIO * base_diagonal
    )


def _backs(points: np.ndarray, core: OrientedBox, camera: Camera, behind: float) -> Float[np.ndarray, "n 3 3"]:
    """Return the backing of a plate: its face moved away from the camera, behind all of its visible surface.

    The inner part of the face is added separately, since a rim may be deeper than the plate is thick.
    """
    away = core.axes[2] * np.sign((core.center - camera.T_world_camera[:3, 3]) @ core.axes[2])
    deep, across = (points - core.center) @ away, np.abs(core.local(points)[:, :2] / core.half[:2]).max(1)
    rectangles = []
    for share in (1.0, PANEL_INTERIOR_RATIO):
        inside = deep[across <= share + 1e-6]
        if len(inside):
            rectangles.append(_rectangle(core, core.center + (inside.max() + behind) * away, share, away))
    return np.concatenate(rectangles) if rectangles else np.zeros((0, 3, 3))


def _rectangle(core: OrientedBox, middle: np.ndarray, share: float, away: np.ndarray) -> Float[np.ndarray, "2 3 3"]:
    """Return a share of a box's largest side, wound to face against `away`."""
    u, v = share * core.half[0] * core.axes[0], share * core.half[1] * core.axes[1]
    u = u if np.cross(u, v) @ away < 0 else -u
    a, b, c, d = middle - u - v, middle + u - v, middle + u + v, middle - u + v
    return np.array([[a, b, c], [a, c, d]])


def occluded_walls(box: OrientedBox, camera: Camera, depth: Float[np.ndarray, "H W"]) -> Float[np.ndarray, "F 3 3"]:
    """Return triangles of the box's far sides, wound outwards, where the picture shows neither free space nor the sides."""
    step = 2 * float(box.half.max()) / CELLS
    triangles = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        at_u, at_v = (np.linspace(-h, h, max(1, round(2 * h / step)) + 1) for h in (box.half[u], box.half[v]))
        for sign in (1.0, -1.0):
            local = np.empty((len(at_u), len(at_v), 3))
            local[..., axis], local[..., u], local[..., v] = sign * box.half[axis], at_u[:, None], at_v[None]
            points = box.world(local.reshape(-1, 3))
            beyond = (points - camera.T_world_camera[:3, 3]) @ (sign * box.axes[axis]) > 0
            out = (beyond & is_occluded(points, camera, depth)).reshape(local.shape[:2])
            corners = points.reshape(local.shape)
            a, b, c, d = (corners[i, j] for i in (slice(None, -1), slice(1, None)) for j in (slice(None, -1), slice(1, None)))
            whole = out[:-1, :-1] & out[1:, :-1] & out[:-1, 1:] & out[1:, 1:]
            for triangle in ((a, c, d), (a, d, b)) if sign > 0 else ((a, d, c), (a, b, d)):
                triangles.append(np.stack([corner[whole] for corner in triangle], 1))
    return np.concatenate(triangles)


def is_occluded(points: Float[np.ndarray, "n 3"], camera: Camera, depth: Float[np.ndarray, "H W"]) -> Bool[np.ndarray, " n"]:
    """Return which points are occluded by more than the width of a pixel; pixels without depth show free space."""
    size = np.array([camera.width, camera.height])
    at, far = camera.project(points)
    pixel = np.floor(at).astype(np.int64)
    inside = ((pixel >= 0) & (pixel < size)).all(1) & (far > 0)
    x, y = np.clip(pixel, 0, size - 1).T
    # of the neighbours, since surfaces are slanted and edges are ragged
    shown = maximum_filter(np.where(np.isfinite(depth), depth, 0.0), 3)
    before = shown[y, x]
    return inside & (before > 0) & (far > before + far / camera.focal)


def visible_surface(view: View, part: Int[np.ndarray, "H W"]) -> tuple[Mesh, Int[np.ndarray, " F"]]:
    """Return the surface visible in a picture, with its colours, and the part of each face.

    part: per pixel, -1 where nothing is visible. Faces connect pixels of one part only, face the camera, and do not span jumps
    in depth. Raise ValueError if no three pixels can be connected.
    """
    origins, directions = view.camera.rays()
    depth = view.depth.reshape(-1)
    seen = np.isfinite(depth)
    points = origins + np.where(seen, depth, 0.0)[:, None] * directions
    corners = _triangles(view, part)
    if not len(corners):
        raise ValueError("a surface needs three neighbouring pixels of one part, found none")
    used, faces = np.unique(corners, return_inverse=True)
    color = np.concatenate([view.color.reshape(-1, 3), np.full((view.color.size // 3, 1), 255, np.uint8)], 1)
    mesh = Mesh(
        vertices=points[used],
        faces=faces.reshape(-1, 3),
        face_node=np.zeros(len(corners), np.int64),
        nodes=(Node("view"),),
        face_material=np.full(len(corners), -1),
        corner_color=color[corners],
    )
    return mesh, part.reshape(-1)[corners[:, 0]].astype(np.int64)


def _triangles(view: View, part: np.ndarray) -> Int[np.ndarray, "F 3"]:
    """Return the pixel indices of every face.

    Each square of four neighbours is cut along the diagonal that keeps more of it.
    """
    z, focal = view.depth, view.camera.focal
    across, down = joined(z, part, focal), joined(z.T, part.T, focal).T
    number = np.arange(z.size).reshape(z.shape)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]
    top, bottom, left, right = across[:-1], across[1:], down[:, :-1], down[:, 1:]
    falling = [(left & bottom, (a, c, d)), (top & right, (a, d, b))]
    rising = [(top & left, (a, c, b)), (bottom & right, (b, c, d))]
    kept = [sum(whole.astype(int) for whole, _ in cut) for cut in (falling, rising)]
    with np.errstate(invalid="ignore"):
        flat = np.abs(z[:-1, :-1] - z[1:, 1:]) <= np.abs(z[:-1, 1:] - z[1:, :-1])
    first = (kept[0] > kept[1]) | ((kept[0] == kept[1]) & flat)
    cuts = [(whole & first, t) for whole, t in falling] + [(whole & ~first, t) for whole, t in rising]
    return np.concatenate([np.stack([corner[whole] for corner in t], 1) for whole, t in cuts])


def joined(z: Float[np.ndarray, "H W"], part: Int[np.ndarray, "H W"], focal: float) -> Bool[np.ndarray, "H w"]:
    """Return whether each pixel and its right neighbour show the same surface: the same part, without a jump in depth.

    The inverse depth of a plane is linear in the picture, so that a plane at any slant continues.
    """
    with np.errstate(invalid="ignore"):
        step = np.abs(np.diff(z, axis=1))
        width = np.minimum(z[:, :-1], z[:, 1:]) / focal
        near = step <= STEEP * width
        bend = np.abs(np.diff(1 / z, 2, axis=1)) * z[:, 1:-1] ** 2 <= z[:, 1:-1] / focal
    bend &= np.isfinite(z[:, :-2]) & np.isfinite(z[:, 1:-1]) & np.isfinite(z[:, 2:])
    same = part[:, 1:] == part[:, :-1]
    of_one = bend & same[:, 1:] & same[:, :-1]
    goes_on = np.zeros_like(near)
    goes_on[:, 1:] |= of_one  # with the previous one
    goes_on[:, :-1] |= of_one  # with the next one
    return (part[:, 1:] >= 0) & same & (near | goes_on)


def observations(sample: EvalSample, count: int, seed: int) -> list[EvalSample]:
    """Return the first `count` observations of a sample."""
    return [observation(sample, number, seed) for number in range(count)]


def observation(sample: EvalSample, number: int, seed: int) -> EvalSample:
    """Return the surface visible in one picture: even numbers at rest, odd ones with one joint partly open.

    Raise InputError if no camera sees a movable part and the base.
    """
    rng = np.random.default_rng([seed, number, zlib.crc32(sample.truth.name.encode())])
    around, seen = front(sample)
    scene = opened(sample, seen, rng) if number % 2 else sample
    rays = RayScene(scene.mesh.vertices, scene.mesh.faces)
    for _ in range(TRIES):
        azimuth = around + np.deg2rad(rng.uniform(-ASIDE, ASIDE))
        camera = orbit_camera(scene.mesh.bounds, azimuth, np.deg2rad(rng.uniform(*ELEVATION)), SIZE)
        visible_sample = observed(scene, camera, rays)
        if visible_sample is not None:
            return visible_sample
    raise InputError(f"{sample.truth.name}: no picture shows a movable part and the base; found none in {TRIES} views")


def observed(sample: EvalSample, camera: Camera, rays: RayScene | None = None) -> EvalSample | None:
    """Return the part of the sample visible to a camera, with the ground truth of the visible parts.

    None if no movable part or no base is visible. Lengths of scores stay relative to the whole object's diagonal.
    """
    view = render(sample.mesh, camera, scene=rays)
    part = np.where(view.face >= 0, sample.labels[view.face], -1)
    bordering = (part == 0) & (maximum_filter(part, 3) > 0)  # one pixel of clearance, since edges are not known more precisely
    try:
        mesh, labels = visible_surface(view, np.where(bordering, -1, part))
    except ValueError:
        return None
    covered = np.bincount(part[part >= 0], minlength=len(sample.truth.parts)) >= MIN_PART_SHARE * part.size
    covered &= np.isin(np.arange(len(covered)), labels)
    if not covered[0] or not covered[1:].any():
        return None
    kept = np.flatnonzero(covered[labels])
    truth, number = of_parts(sample.truth, np.flatnonzero(covered))
    mesh, labels = _closed(mesh.subset(kept), number[labels[kept]], view)
    return replace(sample, truth=truth, mesh=mesh, labels=labels, diagonal=2 * sample.unit)


def _closed(mesh: Mesh, labels: Int[np.ndarray, " F"], view: View) -> tuple[Mesh, Int[np.ndarray, " G"]]:
    """Add the unseen walls of the object's box behind the surface, as base."""
    walls = hidden_base(mesh, labels, view.camera, view.depth)
    count, first = len(walls), len(mesh.vertices)
    if not count:
        return mesh, labels
    more = np.arange(first, first + 3 * count).reshape(-1, 3)
    color = np.broadcast_to(np.array([128, 128, 128, 255], np.uint8), (count, 3, 4))
    closed = replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, walls.reshape(-1, 3)]),
        faces=np.concatenate([mesh.faces, more]),
        face_node=np.zeros(len(mesh.faces) + count, np.int64),
        face_material=np.full(len(mesh.faces) + count, -1),
        corner_color=np.concatenate([mesh.corner_color, color]),
    )
    return closed, np.concatenate([labels, np.zeros(count, np.int64)])


def opened(sample: EvalSample, among: Int[np.ndarray, " k"], rng: np.random.Generator) -> EvalSample:
    """Partly open the joint of one random part among these; return the sample unchanged if none has limits."""
    names = {sample.truth.parts[k].name for k in among}
    able = [j for j in sample.truth.joints if j.limits is not None and j.range_known and j.child in names]
    if not able:
        return sample
    joint = able[int(rng.integers(len(able)))]
    lower, upper = joint.limits or (0.0, 0.0)
    return posed(sample, {joint.child: lower + float(rng.uniform(*OPEN)) * (upper - lower)})


def front(sample: EvalSample) -> tuple[float, Int[np.ndarray, " k"]]:
    """Return the azimuth [rad] with most pixels of movable parts at rest, and the indices of the parts visible there."""
    rays = RayScene(sample.mesh.vertices, sample.mesh.faces)
    high = np.deg2rad(sum(ELEVATION) / 2)
    best, most = 0.0, np.zeros(len(sample.truth.parts), np.int64)
    for azimuth in 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS:
        view = render(sample.mesh, orbit_camera(sample.mesh.bounds, azimuth, high, SIZE // 4), scene=rays)
        pixels = np.bincount(sample.labels[view.face[view.face >= 0]], minlength=len(most))
        if pixels[1:].sum() > most[1:].sum():
            best, most = float(azimuth), pixels
    return best, 1 + np.flatnonzero(most[1:])
