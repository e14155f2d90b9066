"""Transforms of COLLADA nodes, and the joints that animations of them give."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.formats.dae.geometry import floats
from anymesh.loading.files import Folder
from anymesh.stated.animated import NodeTrack, SceneNode, animated_joints
from anymesh.types import Brief, Mesh

SIZES = {"matrix": 16, "translate": 3, "scale": 3, "rotate": 4, "lookat": 9, "skew": 7}
MEMBERS = {"X": 0, "Y": 1, "Z": 2, "W": 3, "ANGLE": 3}
TARGET = re.compile(r"([^/]+)/([^/.(]+)(?:\.(\w+)|\((\d+)\)(?:\((\d+)\))?)?")
Find = Callable[[str, str | None], ET.Element | None]
Values = Mapping[int, Float[np.ndarray, "k n"]]  # the numbers of some of a node's transforms at some times, by position
Curve = tuple[np.ndarray, np.ndarray, slice, bool]  # times, (n, w) values, the numbers that they replace, whether they step


@dataclass(frozen=True, eq=False)
class DaeNode(Brief):
    """A visible node of the scene; one that is instanced several times is several. parent: its number, -1 for none.

    T: (4, 4) to the scene [units of the file].
    """

    element: ET.Element
    parent: int
    T: Float[np.ndarray, "4 4"]


def local_transform(node: ET.Element) -> Float[np.ndarray, "4 4"]:
    """Return the product of a node's transforms, in their order."""
    return _transforms(_steps(node), {}, 1)[0]


def _steps(node: ET.Element) -> list[tuple[ET.Element, np.ndarray]]:
    steps = [(element, floats(element.text or "")) for element in node if element.tag in SIZES]
    return [(element, numbers) for element, numbers in steps if len(numbers) == SIZES[element.tag]]


def _transforms(steps: list[tuple[ET.Element, np.ndarray]], changed: Values, count: int) -> Float[np.ndarray, "k 4 4"]:
    T = np.tile(np.eye(4), (count, 1, 1))
    for k, (element, numbers) in enumerate(steps):
        T = T @ _matrices(element.tag, changed.get(k, numbers[None]))
    return T


def _matrices(tag: str, v: Float[np.ndarray, "k n"]) -> Float[np.ndarray, "k 4 4"]:
    T = np.tile(np.eye(4), (len(v), 1, 1))
    match tag:
        case "matrix":
            return v.reshape(-1, 4, 4)
        case "translate":
            T[:, :3, 3] = v
        case "scale":
            T[:, :3, :3] *= v[:, None]
        case "rotate":
            (x, y, z), angle, none = _units(v[:, :3]).T, np.radians(v[:, 3])[:, None, None], np.zeros(len(v))
            K = np.stack([none, -z, y, z, none, -x, -y, x, none], 1).reshape(-1, 3, 3)
            T[:, :3, :3] += np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)
        case "lookat":
            eye, target, up = v[:, :3], v[:, 3:6], v[:, 6:]
            right = np.cross(up, eye - target)
            T[:, :3, :3] = np.stack([_units(right), _units(np.cross(eye - target, right)), _units(eye - target)], 2)
            T[:, :3, 3] = eye
        case "skew":
            slope = np.tan(np.radians(v[:, 0]))[:, None, None]
            T[:, :3, :3] += slope * (_units(v[:, 4:])[:, :, None] * _units(v[:, 1:4])[:, None])
    return T


def _units(v: Float[np.ndarray, "k 3"]) -> Float[np.ndarray, "k 3"]:
    return v / np.maximum(np.linalg.norm(v, axis=1, keepdims=True), 1e-300)


def dae_joints(mesh: Mesh, home: Sequence[int], nodes: Sequence[DaeNode], root: ET.Element, find: Find, folder: Folder) -> Mesh:
    """Return the mesh of a scene with the joints that its animations give; a warning counts channels that are not read.

    home: the number of the node that places each node of the mesh.
    """
    curves, names = _channels(root, find, folder)
    clips = [(clip, _clip_range(clip)) for clip in root.iter("animation_clip")]
    tracks = {k: _track(node.element, curves[id(node.element)]) for k, node in enumerate(nodes) if id(node.element) in curves}
    scene = {}
    for k, node in enumerate(nodes):
        label = node.element.get("name") or node.element.get("id") or f"node_{k}"
        T_parent = node.T @ np.linalg.pinv(local_transform(node.element))
        scene[k] = SceneNode(label, None if node.parent < 0 else node.parent, T_parent, node.T)
    carried = set(home)
    while above := {nodes[k].parent for k in carried if k >= 0} - carried:
        carried |= above
    if bent := [track.name for k, track in tracks.items() if k not in carried and nodes[k].element.get("type") == "JOINT"]:
        folder.warn(f'the animation "{bent[0]}" bends a mesh by bones; it is read at rest')
    whole = [(names[0] if len(names) == 1 else "", tracks)]
    animations = [(clip.get("name") or clip.get("id") or "", _cut(tracks, *between)) for clip, between in clips] or whole
    return animated_joints(mesh, home, scene, animations, folder)


def _clip_range(clip: ET.Element) -> tuple[float, float]:
    start, end = floats(clip.get("start", "")), floats(clip.get("end", ""))
    return float(start[0]) if len(start) else -np.inf, float(end[0]) if len(end) else np.inf


def _cut(tracks: Mapping[int, NodeTrack], start: float, end: float) -> dict[int, NodeTrack]:
    inside = {k: t.times[(t.times >= start - 1e-6) & (t.times <= end + 1e-6)] for k, t in tracks.items()}
    return {k: NodeTrack(times, tracks[k].sample, tracks[k].name) for k, times in inside.items() if len(times)}


def _channels(root: ET.Element, find: Find, folder: Folder) -> tuple[dict[int, list[tuple[str, str, Curve]]], list[str]]:
    """Return name, target's sid and curve of each node's channels, by its element, and the animations' names."""
    channels: dict[int, list[tuple[str, str, Curve]]] = {}
    names, left_out = list[str](), 0
    for animation in root.findall("library_animations/animation"):
        names.append(animation.get("name") or animation.get("id") or "")
        for channel in animation.iter("channel"):
            match = TARGET.fullmatch(channel.get("target", "").strip())
            node = find("node", match[1]) if match else None
            curve = None if match is None or node is None else _curve(find("sampler", channel.get("source")), match, node, find)
            if match is None or node is None or curve is None:
                left_out += 1
            else:
                channels.setdefault(id(node), []).append((names[-1], match[2], curve))
    if left_out:
        folder.warn(f"{left_out} channels of animations that move no node, or are broken, are left out")
    return channels, names


def _curve(sampler: ET.Element | None, match: re.Match[str], node: ET.Element, find: Find) -> Curve | None:
    target = next((element for element, _ in _steps(node) if element.get("sid") == match[2]), None)
    if sampler is None or target is None:
        return None
    source = {i.get("semantic"): find("source", i.get("source")) for i in sampler.findall("input")}
    data = {key: floats(s.findtext("float_array") or "") for key, s in source.items() if s is not None}
    times, size = data.get("INPUT", np.zeros(0)), SIZES[target.tag]
    if match[3]:
        first = MEMBERS.get(match[3], size)
    elif match[5]:
        first = 4 * int(match[5]) + int(match[4]) if target.tag == "matrix" else size  # (column)(row)
    else:
        first = int(match[4] or 0)
    part = slice(first, first + 1) if match[3] or match[4] else slice(0, size)
    values, width = data.get("OUTPUT", np.zeros(0)), part.stop - part.start
    if not len(times) or len(values) != len(times) * width or part.stop > size:
        return None
    if not (np.isfinite(times).all() and np.isfinite(values).all() and (np.diff(times) >= 0).all()):
        return None
    kinds = source.get("INTERPOLATION")
    steps = kinds is not None and set((kinds.findtext("Name_array") or "").split()) == {"STEP"}
    return times, values.reshape(len(times), width), part, steps or target.tag == "matrix"


def _track(node: ET.Element, channels: list[tuple[str, str, Curve]]) -> NodeTrack:
    """Return how channels move a node. Between keys, numbers change evenly; matrices stay, since their mean is none."""
    steps = _steps(node)
    number = {element.get("sid"): k for k, (element, _) in reversed(list(enumerate(steps)))}

    def sample(when: Float[np.ndarray, " k"]) -> Float[np.ndarray, "k 4 4"]:
        changed = dict[int, np.ndarray]()
        for _, sid, (times, values, part, stays) in channels:
            k = number[sid]
            now = changed.setdefault(k, np.tile(steps[k][1], (len(when), 1)))
            if stays:
                now[:, part] = values[np.clip(np.searchsorted(times, when, "right") - 1, 0, len(times) - 1)]
            else:
                now[:, part] = np.stack([np.interp(when, times, column) for column in values.T], 1)
        return _transforms(steps, changed, len(when))

    return NodeTrack(np.unique(np.concatenate([times for _, _, (times, *_) in channels])), sample, channels[0][0])
