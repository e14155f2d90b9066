"""What the built-in shape completer gives back of objects made into surface meshes on purpose; parts and joints are given.

python -m benchmarks.completion                              all sets, as tables
python -m benchmarks.completion --markdown FILE              also written to a file
python -m benchmarks.completion --only NAME --changes fused  some objects, one way of making surfaces
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from scipy import ndimage

from anymesh.checking.engines.rest_ import at_rest
from anymesh.evaluation.changes import changed
from anymesh.evaluation.datasets.urdf_ import CLASSES, synthesize
from anymesh.evaluation.evaluate_sample import drive
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.export import write_asset
from anymesh.finishing.complete import complete_shapes
from anymesh.finishing.scenes import GRAZE, escapes
from anymesh.geometry.distance_ import distance_to_mesh, winding_number
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import components, weld
from anymesh.geometry.triangle_set import sample_surface, spread_directions
from anymesh.types import Asset, JointType, Mesh
from benchmarks import EXAMPLES, made_with, parser_of, table_head, table_row

CHANGES = ("unseen-gone", "fused")
LEAST = 0.01  # share of the grid that a cavity takes at least; less is a gap
STEPS = 60  # places along a joint's range in the simulator
PACKAGES = ("articulate-anymesh", "numpy", "mujoco", "manifold3d", "scene_synthesizer")
HEAD = """# Shape completion (paper, 3.4)

`python -m benchmarks.completion --markdown benchmarks/reports/completion.md`, {made_with}.

The interior of objects whose interior is known is removed: `unseen-gone` removes the faces that no view shows at rest,
`fused` wraps the visible surface in one closed surface, as scans and generators produce it, and cuts it into parts by the
true labels. Parts and joints are the true ones, so that only completion is measured. Objects that ship fused are left out:
their interior is not known.

- Cavity IoU: cells (40 along the longest side) of empty space that is enclosed at rest and that the moving parts open, of the
  completed mesh against the true one; "-" if the true cavity fills less than 1 % of the grid.
- Moved: distance between the visible surfaces at rest, in both directions, as a share of the diagonal (99th percentile over the
  visible points).
- Watertight: parts all of whose surfaces are closed and consistently wound, before and after.
- Faults: joints that a motor cannot drive through their range in MuJoCo, before and after.
- Rest, with `--rest`: joints that contacts move by over 0.5 degrees or 1 mm in 2 s in MuJoCo, without excludes, before and
  after, of the examples, fused ones too; with the furthest of each kind after.
"""
CELLS = 40  # along the longest side of the object
WAYS = 40  # directions in which a cell looks for the outside
SHUT = 0.05  # share of them that may be free in a cell that is shut in at rest
LAID_OPEN = 0.1  # share of the cells of a space that must see out without the moving parts
DENSITY = 40  # points a cell of surface: cells that hold one are walls, and few of these may be missed
PROBES = 20_000


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


@dataclass(frozen=True)
class Row:
    """One object. cavity: IoU, not a number without one; moved: share of the diagonal; faults: joints; seconds: to complete."""

    name: str
    cavity: float
    moved: float
    parts: int
    tight: tuple[int, int]
    joints: int
    faults: tuple[int, int]
    new: int
    seconds: float


def measure(truth: GroundTruth, change: str) -> Row:
    whole = prepared(truth)
    true, surface = whole.asset(), changed(change, whole).asset()
    begin = time.perf_counter()
    finished = complete_shapes(surface)
    seconds = time.perf_counter() - begin
    done = finished.asset
    grid = grid_of(true.mesh)
    known, found = cavity(true, grid), cavity(done, grid)
    faults = [len({f.split(":")[0] for f in drive(a.mesh, a.segmentation, a.joints, STEPS)}) for a in (surface, done)]
    count = len(surface.segmentation.parts)
    return Row(
        truth.name,
        iou(known, found) if known.mean() > LEAST else float("nan"),
        moved(surface.mesh, done.mesh),
        count,
        (count - len(open_parts(surface)), count - len(open_parts(done))),
        sum(j.type is not JointType.FIXED for j in done.joints),
        (faults[0], faults[1]),
        len(done.mesh.faces) - len(surface.mesh.faces),
        seconds,
    )


def resting(asset: Asset) -> dict[str, float]:
    """How far contacts move each joint at rest [degrees or mm]."""
    with tempfile.TemporaryDirectory() as folder:
        write_asset(asset, Path(folder))
        moved = at_rest(Path(folder) / f"{asset.name}.urdf").moved
    slides = {j.name for j in asset.joints if j.type is JointType.PRISMATIC}
    return {name: 1000 * by if name in slides else float(np.degrees(by)) for name, by in moved.items()}


def rest_table(truths: Sequence[GroundTruth]) -> str:
    """Joints that contacts move at rest, before and after completion; fused examples as they are, the others unseen-gone."""
    lines = ["## Rest", "", *table_head(("object", "joints", "moved", "furthest, degrees", "furthest, mm"))]
    for truth in truths:
        whole = prepared(truth)
        before = (whole if truth.name.endswith("_fused") else changed("unseen-gone", whole)).asset()
        first, then = resting(before), resting(complete_shapes(before).asset)
        slides = {j.name for j in before.joints if j.type is JointType.PRISMATIC}
        moved = " -> ".join(str(sum(v > (1.0 if k in slides else 0.5) for k, v in r.items())) for r in (first, then))
        most = (f"{max((v for k, v in then.items() if (k in slides) == s), default=0):.2g}" for s in (False, True))
        lines.append(table_row((truth.name, len(then), moved, *most)))
        print(lines[-1], flush=True)
    return "\n".join([*lines, ""])


def table(title: str, rows: Sequence[Row]) -> str:
    head = ("object", "cavity IoU", "moved", "parts watertight", "joints with faults", "new faces", "seconds")
    lines = [f"## {title}", "", *table_head(head)]
    known = [r.cavity for r in rows if np.isfinite(r.cavity)]
    for r in rows:
        cell = f"{r.cavity:.3f}" if np.isfinite(r.cavity) else "-"
        tight, faults = f"{r.tight[0]} -> {r.tight[1]} of {r.parts}", f"{r.faults[0]} -> {r.faults[1]} of {r.joints}"
        lines.append(table_row((r.name, cell, f"{r.moved:.3%}", tight, faults, r.new, f"{r.seconds:.1f}")))
    parts, joints = sum(r.parts for r in rows), sum(r.joints for r in rows)
    tight = " -> ".join(f"{sum(r.tight[k] for r in rows) / parts:.1%}" for k in (0, 1))
    faults = " -> ".join(str(sum(r.faults[k] for r in rows)) for k in (0, 1))
    mean = f"mean {np.mean(known):.3f}, least {min(known):.3f}" if known else "-"
    most, new, seconds = max(r.moved for r in rows), sum(r.new for r in rows), sum(r.seconds for r in rows)
    lines.append(f"| **all** | {mean} | most {most:.3%} | {tight} | {faults} of {joints} | {new} | {seconds:.1f} |")
    return "\n".join([*lines, ""])


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("--markdown", type=Path, help="file to write the tables to")
    parser.add_argument("--only", nargs="*", help="names of objects")
    parser.add_argument("--changes", nargs="*", default=CHANGES, help="how they are made into surfaces")
    parser.add_argument("--rest", action="store_true", help="only what contacts move at rest, of the examples")
    options = parser.parse_args()
    if options.rest:
        some = [t for t in example_truths(EXAMPLES) if t.joints and (not options.only or t.name in options.only)]
        text = rest_table(some)
        if options.markdown:
            options.markdown.write_text(text, encoding="utf-8")
        return
    done = [HEAD.format(made_with=made_with(*PACKAGES))]
    with tempfile.TemporaryDirectory() as folder:
        examples = [t for t in example_truths(EXAMPLES) if not t.name.endswith("_fused")]
        sets = {"examples": examples, "scene-synthesizer": [synthesize(c, Path(folder)) for c in CLASSES]}
        for change in options.changes:
            for title, truths in sets.items():
                rows = []
                for truth in truths:
                    if truth.joints and (not options.only or truth.name in options.only):
                        rows.append(measure(truth, change))
                        print(rows[-1], flush=True)
                if rows:
                    done.append(table(f"{title}, {change}", rows))
                    print(done[-1], flush=True)
    if options.markdown:
        options.markdown.write_text("\n".join(done), encoding="utf-8")


if __name__ == "__main__":
    main()
