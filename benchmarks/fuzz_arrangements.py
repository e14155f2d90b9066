"""How parts of hostile scenes are put together: furniture, trees, piles, and the known classes of failure [m, Y up]."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from benchmarks.fuzz_shapes import (
    Rng,
    Surface,
    any_shape,
    ball,
    box,
    fins,
    glyph,
    merged,
    path_tube,
    placed,
    rod,
    sheet,
    tube,
    turned,
)


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


def chandelier(beads: int = 2000, sections: int = 6, rings: int = 5) -> list[Part]:
    """Curved open tubes with strings of beads: 2,000 components and 120,000 faces by default."""
    arms, strings = [], []
    turn = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    for a in turn:
        out = np.linspace(0, 0.4, 7)
        arms.append(path_tube(np.stack([out * np.cos(a), 0.1 * np.sin(8 * out), out * np.sin(a)], 1), 0.006))
    for k in range(beads):
        a, t = turn[k % 8], (k // 8) / max(beads // 8, 1)
        at = (0.4 * t * np.cos(a), -0.05 - 0.3 * t * (1 - t), 0.4 * t * np.sin(a))
        strings.append(placed(ball(sections, rings), 0.8 / max(beads // 8, 1) / 2, at))
    rod_ = rod((0, 0, 0), (0, 0.5, 0), 0.01)
    return [Part("stem", *rod_), Part("arms", *merged(arms)), Part("beads", *merged(strings))]


def crossing_sticks(count: int = 700) -> list[Part]:
    """Long sticks in random directions through one place, most of which cross most others."""
    rng = np.random.default_rng(0)
    ends = rng.normal(size=(count, 3))
    ends /= 2 * np.linalg.norm(ends, axis=1, keepdims=True)
    middles = rng.uniform(-0.2, 0.2, (count, 3))
    return [Part("sticks", *merged([rod(m - e, m + e, 0.004, 4) for m, e in zip(middles, ends, strict=True)]))]


def _seat_on(legs: Surface) -> list[Part]:
    """A stool: a seat on two legs [m, Y up]."""
    seat = placed(ball(16, 8), (0.5, 0.06, 0.5), (0, 0.63, 0))
    upright = [(legs[0][:, [0, 2, 1]] * (1, 1, -1) + (x, 0.3, 0), legs[1]) for x in (-0.15, 0.15)]
    return [Part("stool", *merged([seat, *upright]))]


def turned_legs() -> list[Part]:
    """Build a stool of closed parts whose fluted legs cross themselves at the waist (CoACD 1.0.14 crashes on them)."""
    return _seat_on(placed(turned(19, 53, waves=4, lobes=4, depth=0.06), (0.5, 0.4, 0.6)))


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
FIXTURES: dict[str, Callable[[], list[Part]]] = {
    "bars through a board": bars_through_board,
    "chandelier": chandelier,
    "crossing sticks": crossing_sticks,
    "turned legs": turned_legs,
    "lamp of thin tubes": tube_lamp,
}
