"""Meshes of COLLADA as triangles: polygons with holes, strips and fans, with the attributes of each corner."""

from __future__ import annotations

import warnings
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.formats.polygons_ import fans, recut, triangulate
from anymesh.types import Brief

LEFT_OUT = {
    "lines": "sets of lines",
    "linestrips": "sets of lines",
    "spline": "splines",
    "brep": "solids of exact surfaces (brep), which need to be exported as meshes,",
}
MAX_OFFSET = 64  # of inputs
PRIMITIVES = ("triangles", "polylist", "polygons", "trifans", "tristrips")
Find = Callable[[str, str | None], ET.Element | None]


def floats(text: str, default: float | None = None) -> Float[np.ndarray, " n"]:
    """Return the numbers of a text, NaN for words that are none; the default for a text without one."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            values = np.fromstring(text, np.float64, sep=" ")
        except (DeprecationWarning, ValueError):  # words as "-1.#IND", which some exporters write
            values = np.array([_number(word) for word in text.split()])
    if default is None:
        return values
    return values if len(values) and np.isfinite(values).all() else np.array([default])


def whole(element: ET.Element | None, key: str, default: int = 0) -> int:
    """Return an attribute that is an integer, or the default."""
    return int(floats("" if element is None else element.get(key, ""), float(default))[0])


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return np.nan


def _whole(text: str) -> Int[np.ndarray, " n"]:
    """Return the integers of a text, -1 for what is none."""
    values = floats(text)
    return np.where(np.abs(values) < 2**52, values, -1).astype(np.int64)


@dataclass(frozen=True, eq=False)
class DaeTriangles(Brief):
    """Triangles with one material. symbol: its name in the geometry; faces: (F, 3) into the surface's vertices.

    uv: set number -> (F, 3, 1 or more), color: (F, 3, 3 or 4) and normal: (F, 3, 3), or None.
    """

    symbol: str
    faces: Int[np.ndarray, "F 3"]
    uv: dict[int, Float[np.ndarray, "F 3 _"]]
    color: Float[np.ndarray, "F 3 _"] | None
    normal: Float[np.ndarray, "F 3 3"] | None


class DaeSurface:
    """The triangles of a <geometry>. find: an element by tag and URL; counts: what is left out, by kind."""

    def __init__(self, geometry: ET.Element, find: Find, counts: Counter[str]) -> None:
        self._find, self._counts = find, counts
        self._starts: dict[int, tuple[int, int]] = {}  # first vertex and number of vertices of each source
        self._sources: dict[int, np.ndarray] = {}
        self._vertices: list[np.ndarray] = []
        self.primitives: list[DaeTriangles] = []
        for element in self._meshes(geometry, 0):
            if element.tag in PRIMITIVES:
                made = self._primitive(element)
                self.primitives += [] if made is None else [made]
            elif element.tag in LEFT_OUT:
                counts[LEFT_OUT[element.tag]] += 1
        self.vertices = np.concatenate([np.zeros((0, 3)), *self._vertices])

    def _meshes(self, geometry: ET.Element, depth: int) -> Iterator[ET.Element]:
        for shape in geometry:
            hull_of = self._find("geometry", shape.get("convex_hull_of")) if shape.tag == "convex_mesh" else None
            if hull_of is not None and depth < 2:
                yield from self._meshes(hull_of, depth + 1)
            elif shape.tag in ("mesh", "convex_mesh"):
                yield from shape
            elif shape.tag in LEFT_OUT:
                yield shape

    def _values(self, source: ET.Element | None) -> Float[np.ndarray, "n _"]:
        """Return the rows of a source as its accessor says; values of parameters without a name are not data."""
        if source is None:
            return np.zeros((0, 3))
        if id(source) not in self._sources:
            accessor = source.find("technique_common/accessor")
            url = None if accessor is None else accessor.get("source")
            array = next((a for tag in ("float_array", "int_array") if (a := self._find(tag, url)) is not None), None)
            if array is None:
                array = next((a for a in source if a.tag in ("float_array", "int_array")), ET.Element("none"))
            names = [p.get("name") for p in (() if accessor is None else accessor)]
            stride, first = whole(accessor, "stride", max(len(names), 1)), whole(accessor, "offset")
            count = whole(accessor, "count", 2**40)
            data = floats(array.text or "")[max(first, 0) :]
            stride = 3 if accessor is None else min(max(stride, 1), MAX_OFFSET)
            used = [k for k, name in enumerate(names) if name] or list(range(stride))
            rows = data[: len(data) // stride * stride].reshape(-1, stride)[: max(count, 0)]
            self._sources[id(source)] = rows[:, [k for k in used if k < stride]]
        return self._sources[id(source)]

    def _inputs(self, element: ET.Element) -> dict[str, list[tuple[int, int, ET.Element | None]]]:
        """Return set, offset and source of the inputs by semantic; those of <vertices> have the offset of VERTEX."""
        inputs: dict[str, list[tuple[int, int, ET.Element | None]]] = {}
        for e in element.findall("input"):
            number, offset = whole(e, "set"), whole(e, "offset")
            vertices = self._find("vertices", e.get("source")) if e.get("semantic") == "VERTEX" else None
            for inner in [e] if vertices is None else vertices.findall("input"):
                key, source = inner.get("semantic", ""), self._find("source", inner.get("source"))
                inputs.setdefault(key, []).append((number if inner is e else 0, max(offset, 0), source))
        return inputs

    def _primitive(self, element: ET.Element) -> DaeTriangles | None:
        inputs = self._inputs(element)
        _, offset, source = (inputs.get("POSITION") or [(0, 0, None)])[0]
        points = self._values(source)
        if source is None or points.shape[1] < 3 or not len(points):
            self._counts["sets of faces without positions"] += 1
            return None
        if id(source) not in self._starts:
            self._starts[id(source)] = sum(len(v) for v in self._vertices), len(points)
            self._vertices.append(points[:, :3])
        stride = 1 + max(whole(e, "offset") for e in element.findall("input"))
        if stride > MAX_OFFSET:
            self._counts["sets of faces with unusable offsets"] += 1
            return None
        index, faces = self._triangles(element, stride, points[:, :3], offset)
        vertex = index[:, offset][faces] if len(faces) else faces
        if element.tag == "tristrips":  # repeated vertices only lead to the next strip
            faces = faces[(vertex != np.roll(vertex, 1, axis=1)).all(1)]
            vertex = index[:, offset][faces]
        good = ((vertex >= 0) & (vertex < len(points))).all(1)
        if not good.all():
            self._counts["triangles with a vertex that is not in the file"] += int((~good).sum())
        faces, vertex = faces[good], vertex[good]
        if not len(faces):
            return None

        def corners(key: str) -> list[tuple[int, np.ndarray]]:
            return [(number, self._gathered(self._values(s), index[:, o][faces])) for number, o, s in inputs.get(key, [])]

        normal, color = (next((v for _, v in corners(key) if v.shape[-1] >= 3), None) for key in ("NORMAL", "COLOR"))
        uv = {number: values for number, values in reversed(corners("TEXCOORD") or corners("UV")) if values.shape[-1]}
        uv = {number: uv[number] for number in sorted(uv)}
        normal = None if normal is None else normal[..., :3]
        return DaeTriangles(element.get("material", ""), vertex + self._starts[id(source)][0], uv, color, normal)

    def _gathered(self, values: np.ndarray, index: np.ndarray) -> np.ndarray:
        good = (index >= 0) & (index < len(values))
        if not good.all():
            self._counts["corners' texture coordinates, normals or colours that are not in the file"] += int((~good).sum())
            values = np.concatenate([values, np.zeros((1, values.shape[1]))])
            index = np.where(good, index, len(values) - 1)
        return values[index]

    def _triangles(
        self, element: ET.Element, stride: int, points: np.ndarray, offset: int
    ) -> tuple[Int[np.ndarray, "c _"], Int[np.ndarray, "F 3"]]:
        """Return the indices of each corner, one per input, and triangles as three of these rows."""
        lists = [_whole(p.text or "") for p in element.findall("p")]
        rows = [p[: len(p) // stride * stride].reshape(-1, stride) for p in lists]
        if element.tag in ("trifans", "tristrips"):
            index, counts = np.concatenate([np.zeros((0, stride), np.int64), *rows]), [len(r) for r in rows]
            return index, np.concatenate([np.zeros((0, 3), np.int64), *_strips(counts, element.tag == "trifans")])
        if element.tag == "polygons":
            return self._polygons(element, rows, stride, points, offset)
        index = np.concatenate([np.zeros((0, stride), np.int64), *rows])
        if element.tag == "triangles":
            return index, np.arange(len(index) // 3 * 3).reshape(-1, 3)
        counts = _whole(element.findtext("vcount") or "")
        ends = np.cumsum(np.maximum(counts, 0))
        return index, _cut(counts[(counts > 0) & (ends <= len(index))], points, index[:, offset])

    def _polygons(
        self, element: ET.Element, rows: list[np.ndarray], stride: int, points: np.ndarray, offset: int
    ) -> tuple[np.ndarray, np.ndarray]:
        counts = np.array([len(r) for r in rows], np.int64)
        corners = np.concatenate([np.zeros((0, stride), np.int64), *rows])
        faces = [_cut(counts, points, corners[:, offset])]
        parts, start = [corners], len(corners)
        for holed in element.findall("ph"):
            outlines = [_whole(e.text or "") for tag in ("p", "h") for e in holed.findall(tag)]
            rings = [o[: len(o) // stride * stride].reshape(-1, stride) for o in outlines]
            inner = np.concatenate([np.zeros((0, stride), np.int64), *rings])
            if not len(inner) or inner[:, offset].min() < 0 or inner[:, offset].max() >= len(points):
                self._counts["polygons with a vertex that is not in the file"] += 1
                continue
            faces.append(start + _holed([points[r[:, offset]] for r in rings if len(r) > 2]))
            parts += [r for r in rings if len(r) > 2]
            start = sum(len(p) for p in parts)
        return np.concatenate(parts), np.concatenate(faces)


def _cut(counts: np.ndarray, points: np.ndarray, vertex: np.ndarray) -> Int[np.ndarray, "F 3"]:
    """Return triangles of polygons that lie one after another, as rows of their corners."""
    triangles, polygon = fans(counts)
    return recut(triangles, polygon, counts, points, vertex[: int(counts.sum())])


def _strips(counts: list[int], fan: bool) -> Iterator[np.ndarray]:
    start = 0
    for count in counts:
        k = np.arange(max(count - 2, 0))
        if fan:
            yield start + np.stack([np.zeros_like(k), k + 1, k + 2], 1)
        else:
            yield start + np.stack([k, k + 1 + k % 2, k + 2 - k % 2], 1)
        start += count


def _holed(rings: list[Float[np.ndarray, "_ 3"]]) -> Int[np.ndarray, "F 3"]:
    """Return triangles over the points of an outline and its holes, wound as the outline."""
    if not rings:
        return np.zeros((0, 3), np.int64)
    outer = rings[0] - rings[0][0]
    normal = np.cross(outer, np.roll(outer, -1, 0)).sum(0)
    k = int(np.abs(normal).argmax())
    axes = [(k + 1) % 3, (k + 2) % 3] if normal[k] > 0 else [(k + 2) % 3, (k + 1) % 3]
    flat = [ring[:, axes] for ring in rings]
    back, turned = [], []
    for number, ring in enumerate(flat):
        x, y = (ring - ring[0]).T
        area = float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
        order = np.arange(len(ring)) if (area >= 0) == (number == 0) else np.arange(len(ring))[::-1]
        back.append(order + sum(len(r) for r in flat[:number]))
        turned.append(ring[order])
    return np.concatenate(back)[triangulate(turned)]


def skin_transforms(
    skin: ET.Element, roots: list[ET.Element], poses: Mapping[int, np.ndarray], find: Find, count: int
) -> Float[np.ndarray, "n 4 4"] | None:
    """Return the transform of each vertex from the bound shape to the scene; None if no joint is known.

    roots: elements with the joints; poses: of nodes in the scene, by the id() of their elements; count: of vertices.
    """
    inputs = {e.get("semantic"): find("source", e.get("source")) for e in skin.findall("joints/input")}
    joint_source, inverse = inputs.get("JOINT"), inputs.get("INV_BIND_MATRIX")
    arrays = [] if joint_source is None else [a for a in joint_source if a.tag in ("Name_array", "IDREF_array")]
    names = [word for a in arrays for word in (a.text or "").split()]
    matrices = floats("" if inverse is None else inverse.findtext("float_array") or "")
    joints: dict[str, ET.Element] = {}
    for key in ("sid", "id", "name"):
        for node in (n for root in roots for n in root.iter("node") if n.get(key)):
            joints.setdefault(node.attrib[key], node)
    at = [poses.get(id(joints.get(name))) for name in names]
    weights = skin.find("vertex_weights")
    if weights is None or len(matrices) != 16 * len(names) or all(pose is None for pose in at):
        return None
    moved = [np.eye(4) if pose is None else pose @ b for pose, b in zip(at, matrices.reshape(-1, 4, 4), strict=True)]
    transforms = np.array([*moved, np.eye(4)])  # the last one, index -1, is the bound shape itself
    offset = {e.get("semantic"): (whole(e, "offset"), find("source", e.get("source"))) for e in weights.findall("input")}
    if not {"JOINT", "WEIGHT"} <= set(offset) or not 0 <= min(o for o, _ in offset.values()) <= MAX_OFFSET:
        return None
    each, values = _whole(weights.findtext("vcount") or ""), _whole(weights.findtext("v") or "")
    stride = 1 + max(o for o, _ in offset.values())
    rows = values[: len(values) // stride * stride].reshape(-1, stride)
    each = np.clip(each, 0, len(rows))
    vertex = np.repeat(np.arange(len(each)), np.diff(np.minimum(np.cumsum([0, *each]), len(rows))))
    joint, number = (rows[: len(vertex), offset[key][0]] for key in ("JOINT", "WEIGHT"))
    source = offset["WEIGHT"][1]
    table = floats("" if source is None else source.findtext("float_array") or "")
    good = (vertex < count) & (joint >= -1) & (joint < len(names)) & (number >= 0) & (number < len(table))
    vertex, joint, weight = vertex[good], joint[good], np.nan_to_num(table[number[good]])
    total = np.bincount(vertex, weight, count)
    placed = np.zeros((count, 4, 4))
    np.add.at(placed, vertex, weight[:, None, None] * transforms[joint])
    bound = total <= 0  # vertices that no joint moves
    return np.where(bound[:, None, None], np.eye(4), placed / np.where(bound, 1.0, total)[:, None, None])
