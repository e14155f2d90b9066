"""Surfaces that hostile scenes are built from: closed, open, crossing, degenerate; (vertices, faces) of about unit size."""

from __future__ import annotations

from collections.abc import Callable, Sequence
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


def turned(sections: int, rings: int, *, waves: int, lobes: int, depth: float) -> Surface:
    """A closed turned post along z: its radius swells `waves` times along it and `lobes` times round it, by `depth`."""
    vertices, faces = tube(sections, caps=True, rings=rings)
    level = np.rint((vertices[:, 2] + 0.5) * rings) / rings
    radius = 0.15 + 0.1 * np.sin(2 * np.pi * waves * level)
    radius += depth * np.sin(lobes * np.arctan2(vertices[:, 1], vertices[:, 0]))
    return np.c_[vertices[:, :2] * 2 * radius[:, None], vertices[:, 2]], faces


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
