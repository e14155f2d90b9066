"""Surfaces that hostile scenes are built from, (vertices, faces) of about unit size, and how parts of scenes are put together.

Surfaces are closed, open, crossing or degenerate; arrangements are furniture, trees, piles, and the known classes of failure
[m, Y up].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from jaxtyping import Float, Int

Vertices = Float[np.ndarray, "V 3"]
Faces = Int[np.ndarray, "F 3"]
Surface = tuple[Vertices, Faces]
Rng = np.random.Generator

CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))  # -x +x -y +y -z +z
GLYPHS = {  # 5 rows of 3 cells; cells that meet at a corner make edges of four faces
    "A": "010101111101101",
    "K": "101110100110101",
    "8": "111101010101111",
    "X": "101101010101101",
    "L": "100100100100111",
    "T": "111010010010010",
    "o": "000010101010000",
}


def merged(surfaces: Sequence[Surface]) -> Surface:
    """One surface of many; vertices are not shared."""
    offsets = np.cumsum([0, *(len(v) for v, _ in surfaces)])
    faces = [f + o for (_, f), o in zip(surfaces, offsets, strict=False)]
    return np.concatenate([v for v, _ in surfaces]), np.concatenate(faces).astype(np.int64).reshape(-1, 3)


def placed(surface: Surface, size: float | Sequence[float] = 1.0, center: Sequence[float] = (0, 0, 0)) -> Surface:
    """A surface scaled along the axes, then moved."""
    return surface[0] * np.asarray(size, float) + np.asarray(center, float), surface[1]


def box(without: Sequence[int] = ()) -> Surface:
    """A unit cube; `without`: sides that are left out, see SIDES."""
    quads = [q for k, q in enumerate(SIDES) if k not in without]
    return CORNERS.copy(), np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], np.int64)


def sheet(columns: int = 1, rows: int = 1) -> Surface:
    """A flat grid in the xy plane."""
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, columns + 1), np.linspace(-0.5, 0.5, rows + 1), indexing="ij")
    return np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], 1), _grid(columns, rows)


def _grid(columns: int, rows: int) -> Faces:
    at = np.arange((columns + 1) * (rows + 1)).reshape(columns + 1, rows + 1)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def tube(sections: int = 8, *, caps: bool = False, rings: int = 1, top: float = 1.0) -> Surface:
    """A cylinder along z of radius .5; `top`: ratio of its upper radius, 0 for a cone with degenerate faces at the tip."""
    turn = np.linspace(0, 2 * np.pi, sections, endpoint=False)
    circle = 0.5 * np.c_[np.cos(turn), np.sin(turn)]
    levels = np.linspace(0, 1, rings + 1)
    vertices = np.concatenate([np.c_[circle * (1 + (top - 1) * t), np.full(sections, t - 0.5)] for t in levels])
    k, after = np.arange(sections), np.roll(np.arange(sections), -1)
    faces = []
    for ring in range(rings):
        low, up = ring * sections, (ring + 1) * sections
        faces += [np.stack([low + k, low + after, up + after], 1), np.stack([low + k, up + after, up + k], 1)]
    if caps:
        fan = np.stack([np.zeros(sections - 2, int), k[1:-1], k[2:]], 1)
        faces += [fan[:, ::-1], fan + rings * sections]
    return vertices, np.concatenate(faces)


def ball(sections: int = 6, rings: int = 4) -> Surface:
    """A sphere of diameter 1 of `rings` bands; the faces at its poles have no area."""
    vertices, faces = tube(sections, rings=rings)
    angle = np.pi * (vertices[:, 2] + 0.5)
    radius = np.sin(angle)[:, None]
    return np.c_[vertices[:, :2] * radius, -0.5 * np.cos(angle)], faces


def path_tube(path: Float[np.ndarray, "n 3"], radius: float, sections: int = 6) -> Surface:
    """Open tubes along the legs of a path, one for each leg."""
    return merged([_leg(a, b, radius, sections) for a, b in pairwise(path)])


def _leg(a: np.ndarray, b: np.ndarray, radius: float, sections: int, *, caps: bool = False) -> Surface:
    along = b - a
    length = max(float(np.linalg.norm(along)), 1e-12)
    z = along / length
    x = np.cross(z, np.eye(3)[int(np.abs(z).argmin())])
    x /= np.linalg.norm(x)
    vertices, faces = tube(sections, caps=caps)
    local = vertices * (2 * radius, 2 * radius, length)
    return local @ np.stack([x, np.cross(z, x), z]) + (a + b) / 2, faces


def rod(a: Sequence[float], b: Sequence[float], radius: float, sections: int = 8) -> Surface:
    """A closed cylinder between two points."""
    return _leg(np.asarray(a, float), np.asarray(b, float), radius, sections, caps=True)


def glyph(letter: str) -> Surface:
    """A letter of cubes with its inner faces left out and its corners shared: edges of four faces, vertices of two cones."""
    cells = {(k % 3, 4 - k // 3) for k, on in enumerate(GLYPHS[letter]) if on == "1"}
    beside = {0: (-1, 0), 1: (1, 0), 2: (0, -1), 3: (0, 1)}
    found = []
    for x, y in sorted(cells):
        hidden = [side for side, (i, j) in beside.items() if (x + i, y + j) in cells]
        found.append(placed(box(hidden), 1, (x, y, 0)))
    vertices, faces = merged(found)
    used, index = np.unique(vertices, axis=0, return_inverse=True)
    return (used - (1, 2, 0)) / 5, index.reshape(-1)[faces]


def fins(count: int = 3) -> Surface:
    """Sheets that share one edge: `count` faces at it."""
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    rim = np.concatenate([np.c_[0.5 * np.cos(turn), 0.5 * np.sin(turn), np.full(count, z)] for z in (-0.5, 0.5)])
    faces = [t for k in range(count) for t in ((0, 1, 2 + k), (1, 2 + count + k, 2 + k))]
    return np.concatenate([[[0, 0, -0.5], [0, 0, 0.5]], rim]), np.array(faces)


def bow_tie() -> Surface:
    """Two tetrahedra that share a vertex."""
    corners = np.array([[0, 0, 0], [1, 0, 1], [-1, 1, 1], [-1, -1, 1], [1, 0, -1], [-1, 1, -1], [-1, -1, -1]]) / 2
    return corners, np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3], [0, 4, 5], [0, 5, 6], [0, 6, 4], [4, 6, 5]])


def strip(rng: Rng) -> Surface:
    """A Moebius strip: no orientation of its faces agrees."""
    count = int(rng.integers(8, 30))
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    across = 0.15 * np.stack([np.cos(turn / 2) * np.cos(turn), np.cos(turn / 2) * np.sin(turn), np.sin(turn / 2)], 1)
    middle = 0.35 * np.stack([np.cos(turn), np.sin(turn), np.zeros(count)], 1)
    k = np.arange(count - 1)
    faces = [np.stack([k, k + 1, count + k + 1], 1), np.stack([k, count + k + 1, count + k], 1)]
    last = [[count - 1, count, 0], [count - 1, 0, 2 * count - 1]]
    return np.concatenate([middle + across, middle - across]), np.concatenate([*faces, last])


def needles(rng: Rng) -> Surface:
    """Triangles of which one side is far shorter than the others, or one corner nearly on the opposite side."""
    count = int(rng.integers(1, 12))
    a = rng.uniform(-0.5, 0.5, (count, 3))
    b = a + rng.normal(0, 0.5, (count, 3))
    thin = 10.0 ** rng.uniform(-12, -3, (count, 1))
    c = np.where(rng.random((count, 1)) < 0.5, a, (a + b) / 2) + thin * rng.normal(size=(count, 3))
    return np.stack([a, b, c], 1).reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def soup(rng: Rng) -> Surface:
    """Triangles at random, that share vertices at random."""
    count = int(rng.integers(3, 40))
    return rng.uniform(-0.5, 0.5, (count, 3)), rng.integers(0, count, (int(rng.integers(1, 80)), 3))


def one_triangle(rng: Rng) -> Surface:
    return rng.uniform(-0.5, 0.5, (3, 3)), np.array([[0, 1, 2]])


def nothing(rng: Rng) -> Surface:
    """Faces without area, as on a line or in a point; or a single vertex without a face."""
    kind = int(rng.integers(3))
    if kind == 0:
        return rng.uniform(-0.5, 0.5, (1, 3)), np.zeros((0, 3), np.int64)
    along = np.linspace(-0.5, 0.5, 6)[:, None] * (rng.normal(size=(1, 3)) if kind == 1 else np.zeros((1, 3)))
    return along, np.array([[0, 1, 2], [2, 4, 5], [3, 3, 3], [1, 1, 4]])


def hollow(rng: Rng) -> Surface:
    """A box within a box, the inner one turned inside out or not."""
    inner = placed(box(), float(rng.uniform(0.2, 0.999)))
    return merged([box(), (inner[0], inner[1][:, ::-1]) if rng.random() < 0.5 else inner])


def crumpled(rng: Rng) -> Surface:
    """A grid with random heights."""
    vertices, faces = sheet(int(rng.integers(2, 14)), int(rng.integers(2, 14)))
    vertices[:, 2] = rng.normal(0, 10.0 ** rng.uniform(-4, -0.5), len(vertices))
    return vertices, faces


def letters(rng: Rng) -> Surface:
    return glyph(str(rng.choice(list(GLYPHS))))


def bent(rng: Rng) -> Surface:
    """An open tube along a random path."""
    path = rng.uniform(-0.5, 0.5, (int(rng.integers(2, 6)), 3))
    return path_tube(path, 10.0 ** rng.uniform(-3, -1), int(rng.integers(3, 12)))


SHAPES: dict[str, tuple[float, Callable[[Rng], Surface]]] = {  # how often, and how
    "box": (6, lambda rng: box()),
    "open box": (4, lambda rng: box(rng.choice(6, int(rng.integers(1, 4)), replace=False).tolist())),
    "sheet": (2, lambda rng: sheet(int(rng.integers(1, 9)), int(rng.integers(1, 9)))),
    "tube": (2, lambda rng: tube(int(rng.integers(3, 24)), rings=int(rng.integers(1, 5)))),
    "rod": (3, lambda rng: tube(int(rng.integers(3, 24)), caps=True, rings=int(rng.integers(1, 5)))),
    "cone": (1, lambda rng: tube(int(rng.integers(3, 16)), caps=True, top=float(rng.choice([0, 1e-9, 0.3, 2])))),
    "ball": (2, lambda rng: ball(int(rng.integers(3, 14)), int(rng.integers(2, 9)))),
    "glyph": (2, letters),
    "bent tube": (1, bent),
    "fins": (1, lambda rng: fins(int(rng.integers(2, 6)))),
    "bow tie": (1, lambda rng: bow_tie()),
    "strip": (1, strip),
    "needles": (1, needles),
    "soup": (1, soup),
    "one triangle": (1, one_triangle),
    "nothing": (1, nothing),
    "hollow": (1, hollow),
    "crumpled": (1, crumpled),
}


def any_shape(rng: Rng) -> Surface:
    """A shape at random."""
    names = list(SHAPES)
    weights = np.array([SHAPES[n][0] for n in names], float)
    return SHAPES[names[int(rng.choice(len(names), p=weights / weights.sum()))]][1](rng)


@dataclass(frozen=True, eq=False)
class Part:
    """One node of a scene. T: (4, 4), from the part to the scene."""

    name: str
    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]
    T: Float[np.ndarray, "4 4"] = field(default_factory=lambda: np.eye(4))


def part(name: str, surface: Surface, size: float | Sequence[float] = 1.0, center: Sequence[float] = (0, 0, 0)) -> Part:
    return Part(name, *placed(surface, size, center))


def _pose(rng: Rng, scale: float) -> Float[np.ndarray, "4 4"]:
    q = rng.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    T = np.eye(4)
    T[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    T[:3, 3] = rng.normal(0, scale, 3)
    return T


def pile(rng: Rng) -> list[Part]:
    """Shapes at random places, turned at random."""
    count = int(rng.integers(1, 8))
    return [Part(f"part_{k}", *placed(any_shape(rng), rng.uniform(0.05, 1, 3)), _pose(rng, 0.4)) for k in range(count)]


def tree(rng: Rng) -> list[Part]:
    """Boxes and other shapes, each on a side of an earlier one, with a gap, none, or some overlap."""
    boxes = [(np.zeros(3), rng.uniform(0.3, 1, 3))]
    found = [part("base", box(), boxes[0][1])]
    for k in range(int(rng.integers(1, 8))):
        center, size = boxes[int(rng.integers(len(boxes)))]
        own = size * rng.uniform(0.1, 0.9, 3)
        axis, sign = int(rng.integers(3)), float(rng.choice([-1, 1]))
        at = center + (size - own) / 2 * rng.uniform(-1, 1, 3)
        gap = float(rng.choice([0.0, 0.002, 0.02, -0.01, -0.1]))
        at[axis] = center[axis] + sign * ((size[axis] + own[axis]) / 2 + gap)
        boxes.append((at, own))
        found.append(part(f"part_{k}", box() if rng.random() < 0.6 else any_shape(rng), own, at))
    return found


def cabinet(rng: Rng) -> list[Part]:
    """An open box with doors or drawers before it, each with a handle or none."""
    w, h, d = rng.uniform(0.3, 1.2, 3)
    found = [part("body", box((5,)), (w, h, d)), part("inner", box((5,)), (w - 0.04, h - 0.04, d - 0.04), (0, 0, 0.01))]
    rows, columns = int(rng.integers(1, 3)), int(rng.integers(1, 4))
    gap = float(rng.choice([0.0, 0.002, 0.01]))
    for i in range(rows):
        for k in range(columns):
            size = np.array([w / columns - gap, h / rows - gap, 0.02])
            at = np.array([(k + 0.5) * w / columns - w / 2, (i + 0.5) * h / rows - h / 2, d / 2 + 0.011])
            leaf = [placed(box() if rng.random() < 0.7 else sheet(2, 2), size, at)]
            if rng.random() < 0.7:
                leaf.append(placed(any_shape(rng), 0.04, at + size * (*rng.uniform(-0.4, 0.4, 2), 0) + (0, 0, 0.03)))
            if rng.random() < 0.4:
                leaf.append(placed(box((3,)), (size[0] * 0.9, size[1] * 0.8, d * 0.8), at - (0, 0, d * 0.42)))
            found.append(Part(f"{rng.choice(['door', 'drawer', 'front'])}_{i}{k}", *merged(leaf)))
    return found


def wheel(rng: Rng) -> list[Part]:
    """A hub, spokes and a rim on a stand."""
    count = int(rng.integers(3, 12))
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    spokes = [rod((0, 0, 0), (0.4 * np.cos(a), 0.4 * np.sin(a), 0), 0.01, 5) for a in turn]
    rim = np.array([[0.4 * np.cos(a), 0.4 * np.sin(a), 0] for a in np.linspace(0, 2 * np.pi, 3 * count + 1)])
    hub = rod((0, 0, -0.05), (0, 0, 0.05), 0.05, 12)
    whole = merged([hub, *spokes, path_tube(rim, 0.02)])
    return [Part("wheel", *whole), part("stand", box(), (0.1, 0.6, 0.1), (0, -0.3, -0.12))]


def nested(rng: Rng) -> list[Part]:
    """Parts inside parts."""
    scales = np.cumprod(rng.uniform(0.4, 1.0, int(rng.integers(2, 7))))
    return [part(f"shell_{k}", any_shape(rng), s) for k, s in enumerate(scales)]


def copies(rng: Rng) -> list[Part]:
    """The same part in the same place more than once, and beside it."""
    surface = any_shape(rng)
    apart = float(rng.choice([0.0, 1e-9, 1e-4, 0.5, 1.0, 1.001]))
    return [part("copy", surface, 1.0, (k * apart, 0, 0)) for k in range(int(rng.integers(2, 6)))]


def sheets(rng: Rng) -> list[Part]:
    """Sheets that overlap in one plane, or nearly."""
    off = float(rng.choice([0.0, 1e-7, 1e-3]))
    count = int(rng.integers(2, 8))
    grids = [sheet(int(rng.integers(1, 5)), int(rng.integers(1, 5))) for _ in range(count)]
    return [part(f"sheet_{k}", g, rng.uniform(0.3, 1, 3), (*rng.uniform(-0.3, 0.3, 2), k * off)) for k, g in enumerate(grids)]


def sign_board(rng: Rng) -> list[Part]:
    """A board with letters on it."""
    letters = [glyph(str(rng.choice(list("AK8XLTo")))) for _ in range(int(rng.integers(1, 7)))]
    raised = float(rng.choice([0.0, 0.01, 0.06]))
    found = [part(f"letter_{k}", g, (0.1, 0.1, 0.1), (k * 0.15, 0, raised)) for k, g in enumerate(letters)]
    return [part("board", box(), (1.5, 0.4, 0.05), (0.5, 0, -0.02)), *found]


def many(rng: Rng) -> list[Part]:
    """Up to 500 components in one node or in many."""
    count = int(rng.integers(40, 500))
    shape = [box(), tube(5), ball(4, 2), sheet()][int(rng.integers(4))]
    size = 0.6 / np.cbrt(count)
    surfaces = [placed(shape, size * rng.uniform(0.3, 1), at) for at in rng.uniform(-0.5, 0.5, (count, 3))]
    if rng.random() < 0.5:
        return [Part("cloud", *merged(surfaces)), part("base", box(), (1, 0.05, 1), (0, -0.6, 0))]
    return [Part(f"bit_{k}", *s) for k, s in enumerate(surfaces)]


def single(rng: Rng) -> list[Part]:
    """One part alone, of any shape."""
    return [part("thing", any_shape(rng), rng.uniform(0.01, 2, 3))]


def bars_through_board(rng: Rng | None = None) -> list[Part]:
    """Two-sided bars through a board: every face is there twice, once each way round. A thin one has no area."""
    rng = rng or np.random.default_rng(0)
    found = [part("board", box(), (1.0, 0.03, 0.5))]
    for k, x in enumerate(np.linspace(-0.4, 0.4, int(rng.integers(2, 7)))):
        vertices, faces = rod((x, -0.3, 0.05), (x, 0.3, 0.05), 0.012, 6)
        found.append(Part(f"bar_{k}", vertices, np.concatenate([faces, faces[:, ::-1]])))
    ends = [placed(tube(6, caps=True), (0.02, 0.02, 0.02), (x, -0.02, 0.2)) for x in (-0.45, 0.45)]
    ends.append(rod((0, -0.02, 0.2), (0, 0.02, 0.2), 0.0, 6))
    return [*found, part("flap", box(), (0.9, 0.02, 0.3), (0, -0.03, 0.4)), Part("pins", *merged(ends))]


def tube_lamp(rng: Rng | None = None) -> list[Part]:
    """A lamp of thin open tubes: an arm of legs, a stand, and a shade without thickness."""
    rng = rng or np.random.default_rng(0)
    joints = np.cumsum(np.r_[[[0, 0.02, 0]], rng.uniform((-0.1, 0.1, -0.05), (0.2, 0.3, 0.05), (4, 3))], axis=0)
    arms = [path_tube(joints[k : k + 2], 0.004, int(rng.integers(3, 9))) for k in range(4)]
    shade = placed(tube(16, top=0.4), (0.2, 0.2, 0.15), joints[-1])
    wire = path_tube(joints + np.array([0.006, 0, 0]), 0.0008, 3)
    found = [Part(f"arm_{k}", *arm) for k, arm in enumerate(arms)]
    return [part("foot", tube(12, caps=True), (0.2, 0.2, 0.02)), *found, Part("shade", *shade), Part("wire", *wire)]


def lattice(rng: Rng) -> list[Part]:
    """Sheets that share edges, with more than two faces at each."""
    return [part(f"fins_{k}", fins(int(rng.integers(3, 7))), rng.uniform(0.2, 1, 3), rng.normal(0, 0.3, 3)) for k in range(3)]


ARRANGEMENTS: dict[str, tuple[float, Callable[[Rng], list[Part]]]] = {  # how often, and how
    "pile": (7, pile),
    "tree": (5, tree),
    "cabinet": (5, cabinet),
    "wheel": (1, wheel),
    "nested": (2, nested),
    "copies": (2, copies),
    "sheets": (2, sheets),
    "sign": (2, sign_board),
    "many": (1, many),
    "single": (7, single),
    "bars": (1, bars_through_board),
    "lamp": (1, tube_lamp),
    "lattice": (1, lattice),
}
