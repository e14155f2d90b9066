"""Baking of a mesh's materials into one atlas: new texture coordinates, one material."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Float32, Int, UInt8
from PIL import Image
from scipy.ndimage import distance_transform_edt

from anymesh.errors import OptionError
from anymesh.finishing.protocol import Finished
from anymesh.finishing.texture import Carried, Painted, colors_at
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import edge_pairs, label_connected
from anymesh.types import Brief, Material, Mesh, Texture
from anymesh.types.triangles import face_cross, unshared

WHITE = (1.0, 1.0, 1.0, 1.0)
BASE, ALPHA, METAL, LIGHT = "base_color", "alpha", "metallic_roughness", "emissive"
WIDTH = {BASE: 3, ALPHA: 1, METAL: 2, LIGHT: 3}  # channels of each slot; METAL: roughness, metallic
ACROSS = np.array([[1, 2], [2, 0], [0, 1]])  # axes of the plane normal to each axis
ROUNDS = 8  # iterations of cutting charts that overlap themselves; then each covered face becomes a chart
STEPS = 24  # iterations of the search for the scale
SIZES = (16, 16384)  # [px] minimum and maximum
RAYS = 2  # samples per side of a texel
BAND = 1 << 18  # texels per batch
Sample = Callable[[np.ndarray, np.ndarray], np.ndarray]  # faces and weights of their corners -> channels
Place = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True, eq=False)
class Sampler:
    """Reader of the slots that vary over a mesh.

    Each slot is stored as the colour of a separate mesh, so that all textures are looked up as in `rendering.render`.
    """

    meshes: dict[str, Mesh]

    @property
    def slots(self) -> tuple[str, ...]:
        return tuple(self.meshes)

    def __call__(self, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]) -> UInt8[np.ndarray, "n k"]:
        """Return the channels of all slots, side by side."""
        return np.concatenate([self._read(slot, face, weights) for slot in self.meshes], axis=1)

    def _read(self, slot: str, face: np.ndarray, weights: np.ndarray) -> np.ndarray:
        mesh = self.meshes[slot]
        color = colors_at(mesh, face, weights)
        if slot != METAL:
            return color[:, : WIDTH[slot]]
        factor = np.array([(m.roughness, m.metallic) for m in mesh.materials])[mesh.face_material[face]]
        return np.rint(color[:, 1:] * factor).astype(np.uint8)


def sampler(mesh: Mesh) -> Sampler:
    """Return the sampler of the slots that the mesh needs; base_color is always included."""
    plain = replace(mesh, materials=(*mesh.materials, Material()), corner_color=None)
    if mesh.corner_uv is None:  # textures of one texel also need coordinates
        plain = replace(plain, corner_uv=np.zeros((len(mesh.faces), 3, 2), np.float32))
    plain = replace(plain, face_material=np.where(mesh.face_material < 0, len(mesh.materials), mesh.face_material))
    used = [plain.materials[k] for k in np.unique(plain.face_material)]
    meshes = {BASE: mesh}
    if see_through(mesh).any():
        meshes[ALPHA] = replace(plain, materials=tuple(_opacity(m) for m in plain.materials))
    if any(METAL in m.textures for m in used) or len({(m.roughness, m.metallic) for m in used}) > 1:
        placed = replace(plain, corner_uv=_placed(plain, METAL))
        meshes[METAL] = replace(placed, materials=tuple(_shown(m, WHITE, METAL) for m in plain.materials))
    if any(any(m.emissive) for m in used):
        placed = replace(plain, corner_uv=_placed(plain, LIGHT))
        meshes[LIGHT] = replace(placed, materials=tuple(_shown(m, (*m.emissive, 1.0), LIGHT) for m in plain.materials))
    return Sampler(meshes)


def _placed(mesh: Mesh, slot: str) -> Float32[np.ndarray, "F 3 2"] | None:
    """Return the texture coordinates of the pictures in a slot."""
    uv = mesh.corner_uv
    for k, material in enumerate(mesh.materials):
        number = material.textures[slot].uv_set if slot in material.textures else 0
        if number and uv is not None and mesh.corner_more_uv is not None:
            own = mesh.corner_more_uv[..., 2 * number - 2 : 2 * number]
            uv = np.where((mesh.face_material == k)[:, None, None], own, uv)
    return uv


def see_through(mesh: Mesh) -> Bool[np.ndarray, " F"]:
    """Return the faces whose material is transparent or has holes."""
    clear = np.array([*(m.alpha_mode != "OPAQUE" for m in mesh.materials), False])
    return clear[mesh.face_material]


def _shown(material: Material, color: tuple[float, ...], slot: str) -> Material:
    """Return a material that shows one slot as its colour."""
    textures = {BASE: material.textures[slot]} if slot in material.textures else {}
    return replace(material, base_color=color, textures=textures)


def _opacity(material: Material) -> Material:
    """Return a material that shows opacity as its colour, with the opacity factor stored as a grey texture."""
    share = material.base_color[3] if material.alpha_mode != "OPAQUE" else 1.0
    texture = material.textures.get(BASE)
    with_holes = texture is not None and material.alpha_mode != "OPAQUE"
    picture = texture.pixels()[..., 3] if with_holes else np.full((1, 1), 255, np.uint8)
    grey = np.rint(picture * share).astype(np.uint8)
    shown = Texture(png(grey), "image/png") if texture is None else replace(texture, data=png(grey), mime="image/png")
    return replace(material, base_color=WHITE, textures={BASE: shown})


def png(pixels: UInt8[np.ndarray, ...]) -> bytes:
    """Encode pixels as PNG."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


@dataclass(frozen=True, eq=False)
class Layout(Brief):
    """Position of every face corner in a square picture. corners: (F, 3, 2) [px], right and down; scale: [px/m]."""

    size: int
    corners: Float[np.ndarray, "F 3 2"]
    scale: float
    charts: int


def lay_out(mesh: Mesh, size: int, padding: int) -> Layout:
    """Lay out the faces without overlap; charts are `padding` px from each other and from the border.

    A chart is a connected set of faces with the same dominant axis, projected along that axis, so no length shrinks by more
    than a factor of 1.8. Raise OptionError if the charts do not fit.
    """
    cross = face_cross(mesh.triangles)
    direction = 2 * np.abs(cross).argmax(1)
    direction += np.take_along_axis(cross, direction[:, None] // 2, 1)[:, 0] < 0
    flat, depth = _flattened(mesh, direction)
    pairs = edge_pairs(mesh.vertices, mesh.faces).faces
    pairs = pairs[direction[pairs[:, 0]] == direction[pairs[:, 1]]]
    layer = np.zeros(len(flat), np.int64)
    for turn in range(ROUNDS + 1):
        chart = label_connected(len(flat), pairs[layer[pairs[:, 0]] == layer[pairs[:, 1]]])
        layout = _packed(flat, chart, size, padding)
        covered = _covered(layout, depth, chart)
        if not covered.any():
            break
        layer[covered] = turn + 1 if turn < ROUNDS - 1 else len(flat) + np.flatnonzero(covered)
    return layout


def _flattened(mesh: Mesh, direction: np.ndarray) -> tuple[Float[np.ndarray, "F 3 2"], Float[np.ndarray, "F 3"]]:
    """Project corners [m] along each face's direction, without mirroring; also return their height towards the viewer."""
    axis, back = direction // 2, direction % 2 == 1
    rows = np.arange(len(direction))[:, None]
    right, up = (mesh.triangles[rows, np.arange(3), ACROSS[axis, k][:, None]] for k in (0, 1))
    height = mesh.triangles[rows, np.arange(3), axis[:, None]]
    flip = np.where(back, -1.0, 1.0)[:, None]
    return np.stack([flip * right, -up], 2), flip * height


def _packed(flat: np.ndarray, chart: np.ndarray, size: int, padding: int) -> Layout:
    """Find the largest scale at which the charts fit, by bisection."""
    count = int(chart.max()) + 1
    low, high = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(low, chart, flat.min(1))
    np.maximum.at(high, chart, flat.max(1))
    extent = high - low
    least, most = 0.0, size / max(float(np.sqrt((extent[:, 0] * extent[:, 1]).sum())), float(extent.max()) / 2, 1e-300)
    at = _shelves(_pixels(extent, least, padding), size)
    if at is None:
        raise OptionError(f"an atlas of {size} px has no room for {count} charts; a larger one has")
    for _ in range(STEPS):
        middle = (least + most) / 2
        tried = _shelves(_pixels(extent, middle, padding), size)
        least, most, at = (middle, most, tried) if tried is not None else (least, middle, at)
    corners = (flat - low[chart][:, None]) * least + at[chart][:, None] + padding + 0.5
    return Layout(size, corners, least, count)


def _pixels(extent: np.ndarray, scale: float, padding: int) -> Int[np.ndarray, "c 2"]:
    return np.ceil(extent * scale).astype(np.int64) + 1 + 2 * padding


def _shelves(boxes: Int[np.ndarray, "c 2"], size: int) -> Int[np.ndarray, "c 2"] | None:
    """Place boxes side by side on shelves, tallest first, and return their corners; None if they do not fit."""
    if (boxes > size).any() or boxes.prod(1).sum() > size * size:
        return None
    at = np.zeros_like(boxes)
    x = y = shelf = 0
    for k in np.lexsort((-boxes[:, 0], -boxes[:, 1])).tolist():
        width, height = boxes[k].tolist()
        if x + width > size:
            x, y, shelf = 0, y + shelf, 0
        if y + height > size:
            return None
        at[k] = x, y
        x, shelf = x + width, max(shelf, height)
    return at


def _covered(layout: Layout, depth: np.ndarray, chart: np.ndarray) -> np.ndarray:
    """Return which faces have their centroid below another face of their chart."""
    corners = np.concatenate([layout.corners, (depth * layout.scale)[:, :, None]], axis=2)
    scene = RayScene(*unshared(corners))
    middle = corners.mean(1)
    middle[:, 2] = corners[:, :, 2].max() + 1
    hit = scene.first_hit(middle, np.repeat([[0.0, 0.0, -1.0]], len(middle), 0)).face
    own = np.arange(len(hit))
    above = depth[hit].mean(1) - depth.mean(1) > 1e-9 * max(1.0, float(np.abs(depth).max()))
    return (hit >= 0) & (hit != own) & (chart[hit] == chart) & above


@dataclass(frozen=True)
class Baked:
    """Retexturer that bakes the built-in textures into an atlas of size x size px; charts have `padding` px on each side."""

    size: int = 1024
    padding: int = 2
    name: str = "bake"

    def retexture(self, finished: Finished) -> Painted:
        painted = Carried().retexture(finished)
        mesh, notes = bake(painted.asset.mesh, size=self.size, padding=self.padding)
        return Painted(replace(painted.asset, mesh=mesh), (*painted.notes, *notes))


def bake(mesh: Mesh, *, size: int = 1024, padding: int = 2) -> tuple[Mesh, tuple[str, ...]]:
    """Bake the materials of a mesh into one picture of size x size px; also return notes on what it cannot hold.

    The result has one material, and a second one with the same picture for transparent faces. Metallic, roughness and emission
    are baked to pictures of the same layout if they vary.
    Raise OptionError for an invalid size, or one too small for the charts.
    """
    layout = check_layout(mesh, size, padding)
    seen = see_through(mesh)
    materials = atlas_materials(layout, mesh, "atlas", clear=bool(seen.any()))
    notes = [f"appearance baked to {size} x {size} px: {layout.charts} charts, {layout.scale:.3g} px per metre"]
    lost = sorted({slot for m in mesh.materials for slot in m.textures} & {"normal", "occlusion"})
    if lost:
        notes.append(f"not baked: {', '.join(lost)} maps")
    baked = replace(
        mesh,
        materials=materials,
        face_material=seen.astype(np.int64),
        corner_uv=atlas_uv(layout),
        corner_color=None,
        corner_more_uv=None,
    )
    return baked, tuple(notes)


def check_layout(mesh: Mesh, size: int, padding: int) -> Layout:
    """Compute the layout for a size and a padding given by the user. Raise OptionError if they are not valid."""
    if not SIZES[0] <= size <= SIZES[1] or not 1 <= padding <= size // 4:
        given = f"found {size} px and a padding of {padding} px"
        raise OptionError(f"an atlas has {SIZES[0]} to {SIZES[1]} px and a padding of 1 px to a quarter of that; {given}")
    return lay_out(mesh, size, padding)


def atlas_uv(layout: Layout) -> Float32[np.ndarray, "F 3 2"]:
    """Return the texture coordinates of every corner, with v upwards."""
    uv = layout.corners / layout.size
    return np.stack([uv[..., 0], 1 - uv[..., 1]], 2).astype(np.float32)


def paint(layout: Layout, sample: Sample, channels: int) -> UInt8[np.ndarray, "S S k"]:
    """Paint the atlas from the values of `sample` at points (face, weights of its corners).

    A texel is the mean of RAYS squared points. A face without any of these points gets one texel at its centroid. Texels
    without a face copy the nearest texel with one.
    """
    size, corners = layout.size, layout.corners
    scene = RayScene(*unshared(np.concatenate([corners, np.zeros((len(corners), 3, 1))], 2)))
    total, count = np.zeros((size * size, channels)), np.zeros(size * size)
    met = np.zeros(len(corners), bool)
    for first in range(0, size * size, BAND):
        texel = np.arange(first, min(first + BAND, size * size))
        for k in range(RAYS * RAYS):
            at = np.stack([texel % size, texel // size], 1) + (np.array(divmod(k, RAYS)) + 0.5) / RAYS
            start = np.concatenate([at, np.ones((len(at), 1))], 1)
            hits = scene.first_hit(start, np.repeat([[0.0, 0.0, -1.0]], len(at), 0))
            on = np.flatnonzero(hits.face >= 0)
            weights = np.stack([1 - hits.u - hits.v, hits.u, hits.v], 1)[on]
            if len(on):
                total[texel[on]] += sample(hits.face[on], weights)
            count[texel[on]] += 1
            met[hits.face[on]] = True
    missed = np.flatnonzero(~met)
    if len(missed):
        x, y = np.clip(corners[missed].mean(1).astype(np.int64), 0, size - 1).T
        free = count[y * size + x] == 0
        missed, at = missed[free], (y * size + x)[free]
        total[at] = sample(missed, np.full((len(missed), 3), 1 / 3)) if len(missed) else 0
        count[at] = 1
    mean = np.rint(total / np.maximum(count, 1)[:, None]).astype(np.uint8).reshape(size, size, channels)
    row, column = distance_transform_edt(count.reshape(size, size) == 0, return_distances=False, return_indices=True)
    return mean[row, column]


def atlas_materials(
    layout: Layout, mesh: Mesh, name: str, *, clear: bool = False, place: Place | None = None
) -> tuple[Material, ...]:
    """Return the atlas material of a mesh, and with `clear` also the one of its transparent faces.

    place: maps points on the unwrapped mesh to points on the mesh with the materials; None if both are the same.
    """
    read = sampler(mesh)
    at = place or (lambda face, weights: (face, weights))
    picture = paint(layout, lambda face, weights: read(*at(face, weights)), sum(WIDTH[slot] for slot in read.slots))
    ends = np.cumsum([WIDTH[slot] for slot in read.slots])[:-1]
    slots = dict(zip(read.slots, np.split(picture, ends, axis=2), strict=True))
    used = [(*mesh.materials, Material())[k] for k in np.unique(mesh.face_material)]
    color = np.concatenate([slots[BASE], slots[ALPHA]], 2) if ALPHA in slots else slots[BASE]
    textures = {BASE: Texture(png(color), "image/png", name)}
    if METAL in slots:
        pixels = np.concatenate([np.zeros_like(slots[METAL][..., :1]), slots[METAL]], 2)
        textures[METAL] = Texture(png(pixels), "image/png", f"{name}_metallic_roughness")
    if LIGHT in slots:
        textures[LIGHT] = Texture(png(slots[LIGHT]), "image/png", f"{name}_emissive")
    atlas = Material(
        name,
        WHITE,
        metallic=1.0 if METAL in slots else used[0].metallic,
        roughness=1.0 if METAL in slots else used[0].roughness,
        emissive=(1.0, 1.0, 1.0) if LIGHT in slots else (0.0, 0.0, 0.0),
        double_sided=any(m.double_sided for m in used),
        textures=textures,
    )
    if not clear:
        return (atlas,)
    mode = "BLEND" if any(m.alpha_mode == "BLEND" for m in used) else "MASK"
    return (atlas, replace(atlas, name=f"{name}_clear", alpha_mode=mode))
