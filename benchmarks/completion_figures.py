"""What completing a surface mesh gave back: the cavity that its moving parts open onto, and what became of what is seen."""

from __future__ import annotations

import io
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from PIL import Image
from scipy import ndimage

from anymesh.finishing.protocol import Finished
from anymesh.finishing.scenes import GRAZE, escapes, widest
from anymesh.geometry.distance_ import distance_to_mesh, winding_number
from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import components, weld
from anymesh.geometry.triangle_set import sample_surface, spread_directions
from anymesh.rendering.render import render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Asset, Mesh

CELLS = 40  # along the longest side of the object
WAYS = 40  # directions in which a cell looks for the outside
SHUT = 0.05  # share of them that may be free in a cell that is shut in at rest
LAID_OPEN = 0.1  # share of the cells of a space that must see out without the moving parts
DENSITY = 40  # points a cell of surface: cells that hold one are walls, and few of these may be missed
PROBES = 20_000
OPEN = 0.8  # share of their range that joints are opened in pictures
TILE = 330  # [px]
ORANGE = np.array([255.0, 80, 0])
COLORS = np.array(
    [[200, 180, 150], [120, 160, 210], [150, 200, 140], [220, 150, 150], [200, 170, 220], [230, 210, 120], [140, 210, 210]]
)


@dataclass(frozen=True, eq=False)
class Grid:
    """Cells round an object. low: its first corner [m]; cell: side [m]; shape: cells along x, y, z."""

    low: Float[np.ndarray, " 3"]
    cell: float
    shape: tuple[int, int, int]

    @property
    def middles(self) -> Float[np.ndarray, "n 3"]:
        at = np.stack(np.meshgrid(*(np.arange(n) for n in self.shape), indexing="ij"), -1).reshape(-1, 3)
        return self.low + (at + 0.5) * self.cell


def grid_of(mesh: Mesh) -> Grid:
    """The grid of a mesh, with a margin of two cells."""
    cell = float(mesh.extents.max()) / CELLS
    count = np.ceil(mesh.extents / cell).astype(int) + 4
    return Grid(mesh.bounds[0] - 2 * cell, cell, (int(count[0]), int(count[1]), int(count[2])))


def cavity(asset: Asset, grid: Grid) -> Bool[np.ndarray, "x y z"]:
    """The empty space that the moving parts open onto: in no material, shut in at rest (hardly any ray gets out), joined to
    the outside once the moving parts are taken away, and then seen from there where it is largest."""
    mesh, number = asset.mesh, {p.name: k for k, p in enumerate(asset.segmentation.parts)}
    moving = {number[j.child] for j in asset.joints if j.type != "fixed"}
    for _ in asset.joints:
        moving |= {number[j.child] for j in asset.joints if number[j.parent] in moving}
    stands = ~np.isin(asset.segmentation.face_part, list(moving))
    points = grid.middles
    inside = np.flatnonzero(((points > mesh.bounds[0]) & (points < mesh.bounds[1])).all(1))
    ways = np.ones(len(points))
    ways[inside] = _free_ways(mesh, points[inside])
    shut = ways <= SHUT
    empty = np.ones(len(points), bool)
    here = np.flatnonzero(shut)
    empty[here] = np.abs(winding_number(points[here], mesh.vertices, _outward(mesh))) < 0.5
    walls = _walls(mesh.subset(stands), grid) if stands.any() else np.zeros(grid.shape, bool)
    shut3, empty3 = shut.reshape(grid.shape), empty.reshape(grid.shape)
    regions = ndimage.label(~walls & (empty3 | _in_movers(mesh, stands, here, points, grid)))[0]
    reached = regions == regions[0, 0, 0]
    reached |= walls & ndimage.binary_dilation(reached)
    return _laid_open(shut3 & empty3 & reached, mesh.subset(stands), points, ways)


def _laid_open(cells: np.ndarray, body: Mesh, points: np.ndarray, ways: np.ndarray) -> np.ndarray:
    """Of the spaces that cells make up, those that are seen into far more once the moving parts are taken away."""
    region, count = ndimage.label(cells)
    here = np.flatnonzero(cells)
    open_now = _free_ways(body, points[here]) - ways[here] > SHUT
    number = region.reshape(-1)[here]
    share = np.bincount(number, open_now, count + 1) / np.maximum(np.bincount(number, minlength=count + 1), 1)
    return cells & (share > LAID_OPEN)[region]


def _in_movers(mesh: Mesh, stands: np.ndarray, here: np.ndarray, points: np.ndarray, grid: Grid) -> np.ndarray:
    """Cells in the material of moving parts, which are taken away."""
    found = np.zeros(len(points), bool)
    if not stands.all() and len(here):
        movers = mesh.subset(~stands)
        found[here] = np.abs(winding_number(points[here], movers.vertices, _outward(movers))) >= 0.5
    return found.reshape(grid.shape)


def _outward(mesh: Mesh) -> np.ndarray:
    """Faces, those of closed components that are inside out turned round."""
    found = components(mesh.vertices, mesh.faces)
    return np.where(found.flip[:, None], mesh.faces[:, ::-1], mesh.faces)


def _free_ways(mesh: Mesh, points: np.ndarray) -> np.ndarray:
    """Share of the directions in which nothing stands between a point and far away."""
    scene, free = RayScene(mesh.vertices, mesh.faces), np.zeros(len(points))
    for way in spread_directions(WAYS):
        free += scene.first_hit(points, np.repeat(way[None] * 2 * mesh.diagonal, len(points), 0), 1.0).face < 0
    return free / WAYS


def _walls(mesh: Mesh, grid: Grid) -> Bool[np.ndarray, "x y z"]:
    count = int(DENSITY * mesh.face_areas.sum() / grid.cell**2) + 1
    at = ((sample_surface(mesh.triangles, count, 0, at_least=1).points - grid.low) / grid.cell).astype(int)
    found = np.zeros(grid.shape, bool)
    found[tuple(np.clip(at, 0, np.array(grid.shape) - 1).T)] = True
    return found


def iou(a: np.ndarray, b: np.ndarray) -> float:
    """Of two sets of cells; not a number where both are empty."""
    both = (a | b).sum()
    return float((a & b).sum() / both) if both else float("nan")


def moved(before: Mesh, after: Mesh) -> float:
    """The furthest that what is seen at rest lies off, either way, as a share of the diagonal: what was seen from the completed
    surface, and what is seen of that from the old one or from where nothing was."""
    off = [_furthest(before, after), _furthest(after, before)]
    return max(off) / before.diagonal


def _furthest(mesh: Mesh, other: Mesh) -> float:
    """How far the points in sight of one mesh lie from another, at most [m] but for one in a hundred."""
    s = sample_surface(mesh.triangles, PROBES, 0)
    seen = (escapes(RayScene(mesh.vertices, mesh.faces), s.points, s.normals, mesh.diagonal) >= GRAZE).any(1)
    return float(np.percentile(distance_to_mesh(s.points[seen], other.vertices, other.faces)[0], 99))


def open_parts(asset: Asset) -> list[str]:
    """The parts with a surface that is not closed and evenly wound; faces with two corners in one place bound nothing."""
    found = []
    for number, part in enumerate(asset.segmentation.parts):
        mesh = asset.mesh.subset(asset.segmentation.faces(number))
        corner = weld(mesh.vertices)[mesh.faces]
        mesh = mesh.subset((corner != np.roll(corner, 1, axis=1)).all(1))
        if not components(mesh.vertices, mesh.faces).solid.all():
            found.append(part.name)
    return found


def picture(true: Asset, before: Asset, finished: Finished) -> bytes:
    """PNG: before at rest, then with all joints open the truth, before, after, and after from behind; new faces are orange."""
    views = [(before, False, None, 25.0)]
    new = finished.source_face < 0
    views += [
        (true, True, None, 25.0),
        (before, True, None, 25.0),
        (finished.asset, True, new, 25.0),
        (finished.asset, True, new, 175.0),
    ]
    tiles = []
    for asset, opened, fresh, azimuth in views:
        wide = {j.name: OPEN * widest(j) for j in asset.joints if j.limits and opened}
        mesh = posed(asset, wide)
        color = COLORS[asset.segmentation.face_part % len(COLORS)].astype(np.float64)
        if fresh is not None:
            color[fresh] = (color[fresh] + ORANGE) / 2
        camera = orbit_camera(mesh.bounds, np.deg2rad(azimuth), np.deg2rad(25.0), TILE)
        tiles.append(render(mesh, camera, face_color=color.astype(np.uint8)).color)
    file = io.BytesIO()
    Image.fromarray(np.concatenate(tiles, 1)).save(file, "PNG")
    return file.getvalue()
