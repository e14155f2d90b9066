"""Joints from the animations of a scene: nodes that turn about one axis or slide along one line, relative to their parents.

The transforms of a node over time, each relative to its pose in the scene, are fitted by one motion. Nodes without triangles
of their own, such as pivots, are composed with the nodes that they carry.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial.transform import Rotation

from anymesh.loading.files import Folder
from anymesh.names import listed
from anymesh.types import Brief, JointType, Mesh, StatedJoint

MAX_KEYS = 4000  # keys of an animation that are looked at, evenly chosen
MAX_SAMPLES = 2000  # samples of few keys, up to MAX_STEPS between two
MAX_STEPS = 12
MIN_TURN_RAD = 0.01  # [rad] less is no turn
MIN_TRAVEL_RATIO = 0.005  # of the part's diagonal: less is no travel
MAX_OFF_RATIO = 0.01  # of the part's diagonal: what a hinge may be off, and a hinge may slide
MAX_CURVE_RATIO = 0.02  # of its travel: how far a slide may be off its line
MAX_SWING = float(np.sin(np.deg2rad(1)))  # sine of half the turn about other axes than that of a hinge
MAX_STRETCH = 0.02  # of a rigid motion
MAX_AXIS_DISTANCE = 100.0  # of the part's diagonal: a farther axis is none
MAX_SHARE = 0.6  # of the larger part's diagonal: a part that moves with it and touches it belongs to it
MAX_GAP_RATIO = 0.005  # of the object's diagonal: between the boxes of parts that touch
FULL_TURN_RAD = 1.9 * np.pi  # [rad] a longer turn has no limits
SAME_AXIS_COSINE = float(np.cos(np.deg2rad(2)))
NOISE = 1e-3  # of the larger excursion: a smaller one is that of rounded keys
SAME_EXCURSION = 0.99  # ratio from which two excursions are equal, and the first one counts as opening


@dataclass(frozen=True, eq=False)
class NodeTrack(Brief):
    """How an animation moves a node. times: keys [s], ascending; sample: its local transforms at some times; name: its own."""

    times: Float[np.ndarray, " n"]
    sample: Callable[[Float[np.ndarray, " k"]], Float[np.ndarray, "k 4 4"]]
    name: str = ""  # used where the animation has none


@dataclass(frozen=True, eq=False)
class SceneNode(Brief):
    """A node at rest. parent: its key, None for a root; T_parent: (4, 4) of the parent to the scene; T: of the node itself."""

    name: str
    parent: int | None
    T_parent: Float[np.ndarray, "4 4"]
    T: Float[np.ndarray, "4 4"]
    opens: Float[np.ndarray, " 3"] | None = None  # an axis in the scene about or along which positive motion opens, if stated


Animations = Sequence[tuple[str, Mapping[int, NodeTrack]]]  # the name of each animation, and what it does to nodes, by key


class _Fit(NamedTuple):
    """A motion of one degree of freedom: axis and a point on it, and its range, which contains 0."""

    type: JointType
    axis: np.ndarray
    origin: np.ndarray
    low: float
    high: float

    def reversed(self) -> _Fit:
        return self._replace(axis=-self.axis, low=0.0 - self.high, high=0.0 - self.low)


def animated_joints(
    mesh: Mesh, home: Sequence[int | None], nodes: Mapping[int, SceneNode], animations: Animations, folder: Folder
) -> Mesh:
    """Return the mesh with the joints that animations state; a warning names what moves otherwise.

    home: key of the scene's node that carries each node of the mesh, None for one that nothing moves; nodes: of the scene.
    """
    return _Animated(mesh, home, nodes, animations).joined(folder)


class _Animated:
    """The nodes of a scene that move, and the nodes of the mesh that each of them carries."""

    def __init__(self, mesh: Mesh, home: Sequence[int | None], nodes: Mapping[int, SceneNode], animations: Animations) -> None:
        self.mesh, self.nodes = mesh, nodes
        above = {k for start in set(home) if start is not None for k in self._upwards(start)}
        self.animations = [(name, {k: t for k, t in tracks.items() if k in above}) for name, tracks in animations]
        moving = {k for _, tracks in self.animations for k, track in tracks.items() if self._moves(k, track)}
        self.carrier = [None if h is None else next((k for k in self._upwards(h) if k in moving), None) for h in home]
        self.box = {c: self._box(c) for c in dict.fromkeys(self.carrier) if c is not None}
        self.parent = {c: next((k for k in [*self._upwards(c)][1:] if k in self.box), None) for c in self.box}
        self.base, self.whole = None, False
        if self.box and None not in self.carrier:  # everything moves: the largest part is what the others move on
            tops = [c for c in self.box if self.parent[c] is None]
            self.whole = len(tops) == 1
            self.base = max(tops, key=lambda c: float(np.linalg.norm(np.ptp(self.box[c], axis=0))))
            self.parent = {c: None if p == self.base else p for c, p in self.parent.items()}

    def joined(self, folder: Folder) -> Mesh:
        """Return the mesh with its joints, parents first."""
        joints, number, free = list[StatedJoint](), dict[int, int](), list[str]()
        if self.whole and self.base is not None and self._fits(self.base):
            folder.warn("an animation moves the whole object, which is no joint")
        for c in sorted((c for c in self.box if c != self.base), key=self._order):
            fits = self._fits(c)
            joint, others = _joint(fits, self.nodes[c], self.box[c])
            name = self.nodes[c].name
            larger = self._beside(c, list(number)) if joint is not None else []
            whole = next((k for k in larger if self._together(c, k)), None)
            if whole is not None:
                number[c] = number[whole]
                continue
            free += [f"{name} ({why})" for why in others]
            if joint is not None:
                carried = (number[k] for k in self._carriers(c) if k in number)
                number[c] = len(joints)
                joints.append(replace(joint, name=name, parent=next(carried, None)))
        if free:
            folder.warn(f"animations that are no joint of one axis are left out: {listed(free, 8)}")
        owner = [next((number[k] for k in [c, *self._carriers(c)] if k in number), -1) for c in self.carrier]
        nodes = tuple(replace(node, joint=o) for node, o in zip(self.mesh.nodes, owner, strict=True))
        return replace(self.mesh, nodes=nodes, joints=tuple(joints))

    def _order(self, c: int) -> tuple[int, float, int]:
        """Return a key that sorts parents before what they carry, and large parts before what they may hold."""
        return len(self._carriers(c)), -float(np.linalg.norm(self.box[c][1] - self.box[c][0])), c

    def _upwards(self, key: int | None) -> list[int]:
        above = list[int]()
        while key is not None and key in self.nodes:
            above.append(key)
            key = self.nodes[key].parent
        return above

    def _carriers(self, c: int | None) -> list[int]:
        """Return the carriers above one, nearest first."""
        above = list[int]()
        while c is not None and (c := self.parent[c]) is not None:
            above.append(c)
        return above

    def _box(self, carrier: int) -> Float[np.ndarray, "2 3"]:
        mine = np.isin(self.mesh.face_node, [n for n, c in enumerate(self.carrier) if c == carrier])
        corners = self.mesh.triangles[mine].reshape(-1, 3)
        return np.array([corners.min(0), corners.max(0)]) if len(corners) else np.zeros((2, 3))

    def _motion(self, key: int, track: NodeTrack, times: np.ndarray) -> Float[np.ndarray, "k 4 4"]:
        """Return how a track moves what its node carries from rest, in the scene, while all above rests."""
        node = self.nodes[key]
        return node.T_parent @ track.sample(times) @ np.linalg.pinv(node.T)

    def _moves(self, key: int, track: NodeTrack) -> bool:
        change = np.abs(self._motion(key, track, _samples(track.times)[0]) - np.eye(4)).reshape(-1, 16).max(0).reshape(4, 4)
        return bool(change[:3, :3].max() > MIN_TURN_RAD / 2 or change[:3, 3].max() > 1e-4 * self.mesh.diagonal)

    def _chain(self, carrier: int) -> list[int]:
        """Return the nodes that move a carrier relative to the one above, outermost first."""
        above = self._upwards(carrier)
        stop = next((n for n, k in enumerate(above) if n and k in self.box), len(above))
        return above[:stop][::-1]

    def _fits(self, carrier: int) -> list[tuple[str, _Fit | str]]:
        """Return how each animation moves a carrier: a motion, or why it is none; without those that leave it at rest."""
        chain, fits = self._chain(carrier), []
        on_base = self._chain(self.base) if self.base not in (None, carrier) and self.parent[carrier] is None else []
        if self.base in self._upwards(carrier):
            on_base = []
        for name, tracks in self.animations:
            keys = [tracks[k].times for k in (*chain, *on_base) if k in tracks]
            if not keys:
                continue
            times, keyed = _samples(np.unique(np.concatenate(keys)))
            motion = self._along(chain, tracks, times)
            if on_base:
                motion = np.linalg.pinv(self._along(on_base, tracks, times)) @ motion
            fit = _fit(motion, keyed, self.box[carrier], self.nodes[carrier].T[:3, 3])
            if isinstance(fit, str):  # the pose at rest may be none of the animation; then the axis moves with the part
                again = _fit(np.linalg.pinv(motion[0]) @ motion, keyed, self.box[carrier], self.nodes[carrier].T[:3, 3])
                fit = fit if again is None else again
            if fit is not None:
                own = (tracks[k].name for k in reversed(chain) if k in tracks)
                fits.append((name or next(own, ""), fit))
        return fits

    def _beside(self, carrier: int, others: Sequence[int]) -> list[int]:
        """Return much larger parts on the same parent that a carrier touches by its box."""
        others = [k for k in others if self.parent[k] == self.parent[carrier]]
        if not others:
            return []
        (low, high), boxes = self.box[carrier], np.array([self.box[k] for k in others])
        large = np.linalg.norm(boxes[:, 1] - boxes[:, 0], axis=1) * MAX_SHARE >= np.linalg.norm(high - low)
        gap = np.maximum(boxes[:, 0] - high, low - boxes[:, 1]).max(1)
        return [others[n] for n in np.flatnonzero(large & (gap <= MAX_GAP_RATIO * self.mesh.diagonal))]

    def _together(self, carrier: int, other: int) -> bool:
        """Return whether two carriers move alike in all animations, as a handle and its door."""
        chains = self._chain(carrier), self._chain(other)
        for _, tracks in self.animations:
            keys = [tracks[k].times for k in (*chains[0], *chains[1]) if k in tracks]
            if keys:
                times = np.unique(np.concatenate(keys))[:MAX_KEYS]
                motions = [self._along(chain, tracks, times) for chain in chains]
                if np.abs(motions[0] - motions[1]).max() > MAX_OFF_RATIO * min(1.0, self.mesh.diagonal):
                    return False
        return True

    def _along(self, chain: list[int], tracks: Mapping[int, NodeTrack], times: np.ndarray) -> np.ndarray:
        motion = np.tile(np.eye(4), (len(times), 1, 1))
        for k in chain:
            if k in tracks:
                motion = motion @ self._motion(k, tracks[k], times)
        return motion


def _samples(times: Float[np.ndarray, " n"]) -> tuple[Float[np.ndarray, " k"], Bool[np.ndarray, " k"]]:
    """Return times at and between keys, and which are keys."""
    if len(times) > MAX_KEYS:
        times = times[np.linspace(0, len(times) - 1, MAX_KEYS).astype(int)]
    steps = int(np.clip(MAX_SAMPLES // len(times), 1, MAX_STEPS))
    between = times[:-1, None] + np.diff(times)[:, None] * np.arange(steps) / steps
    samples = np.append(between.reshape(-1), times[-1])
    return samples, np.arange(len(samples)) % steps == 0


def _fit(motion: np.ndarray, keyed: np.ndarray, box: np.ndarray, pivot: np.ndarray) -> _Fit | str | None:
    """Return the motion of one axis that fits rigid transforms, the reason why there is none, or None if nothing moves.

    motion: (k, 4, 4) from rest; keyed: (k,) which the animator set, and must fit; box: (2, 3) bounds of the part at rest;
    pivot: the node's own origin, used where it lies on the axis.
    """
    R, center, size = motion[:, :3, :3], box.mean(0), float(np.linalg.norm(box[1] - box[0]))
    if not np.isfinite(motion).all() or np.abs(R @ R.transpose(0, 2, 1) - np.eye(3)).max() > MAX_STRETCH:
        return "changes its size"
    quaternion = Rotation.from_matrix(R).as_quat()
    sine = quaternion[:, :3]
    moved = R @ center + motion[:, :3, 3] - center
    size_of_sine = np.linalg.norm(sine, axis=1)
    if 2 * np.arcsin(min(float(size_of_sine.max()), 1.0)) < MIN_TURN_RAD:
        return _slide(moved, keyed, center, size)
    if size_of_sine[keyed].max() < size_of_sine.max() / 2:  # whole turns between the keys
        keyed = np.ones(len(keyed), bool)
    axis = np.linalg.svd(sine[keyed], full_matrices=False)[2][0]
    if np.linalg.norm(sine - np.outer(sine @ axis, axis), axis=1)[keyed].max() > MAX_SWING:
        return "turns about several axes"
    along = moved @ axis
    across, levers = moved - np.outer(along, axis), np.eye(3) - R
    arm = np.linalg.lstsq(levers[keyed].reshape(-1, 3), across[keyed].reshape(-1), rcond=1e-9)[0]
    if np.linalg.norm(levers[keyed] @ arm - across[keyed], axis=1).max() > MAX_OFF_RATIO * size:
        return "turns about an axis that moves"
    if np.abs(along[keyed]).max() > MAX_OFF_RATIO * size:
        return "turns and slides at once"
    if np.linalg.norm(arm) > MAX_AXIS_DISTANCE * size:
        return "turns about an axis far away"
    origin = center + arm
    off = pivot - origin
    if np.linalg.norm(off - (off @ axis) * axis) < MAX_OFF_RATIO / 5 * size:
        origin = pivot
    angle = np.unwrap((2 * np.arctan2(sine @ axis, quaternion[:, 3]) + np.pi) % (2 * np.pi) - np.pi)
    return _signed(JointType.REVOLUTE, axis, origin, angle)


def _slide(moved: np.ndarray, keyed: np.ndarray, center: np.ndarray, size: float) -> _Fit | str | None:
    if np.linalg.norm(moved, axis=1).max() < MIN_TRAVEL_RATIO * size:
        return None
    axis = np.linalg.svd(moved[keyed], full_matrices=False)[2][0]
    along = moved @ axis
    if np.linalg.norm(moved - np.outer(along, axis), axis=1)[keyed].max() > MAX_CURVE_RATIO * np.abs(along).max():
        return "slides along no straight line"
    return _signed(JointType.PRISMATIC, axis, center, along)


def _signed(kind: JointType, axis: np.ndarray, origin: np.ndarray, amounts: np.ndarray) -> _Fit:
    """Return a motion whose positive direction has the larger excursion from rest, and comes first if both are equal."""
    low, high = min(float(amounts.min()), 0.0), max(float(amounts.max()), 0.0)
    low, high = (low if -low > NOISE * high else 0.0), (high if high > -NOISE * low else 0.0)
    turns = kind is JointType.REVOLUTE and high - low > FULL_TURN_RAD
    fit = _Fit(JointType.CONTINUOUS if turns else kind, axis, origin, low, high)
    less, more = sorted((-low, high))
    first = float(amounts[np.argmax(np.abs(amounts) > 0.9 * less)])
    backwards = first < 0 if less > SAME_EXCURSION * more else -low > high
    return fit.reversed() if backwards else fit


def _joint(fits: list[tuple[str, _Fit | str]], node: SceneNode, box: np.ndarray) -> tuple[StatedJoint | None, list[str]]:
    """Return the joint of a node from all animations, by the first that states one, and what else moves it."""
    size, joint, names, others = float(np.linalg.norm(box[1] - box[0])), None, list[str](), list[str]()
    for name, fit in fits:
        if isinstance(fit, str):
            others.append(fit)
        elif joint is None:
            joint, names = fit, [name]
        elif (union := _union(joint, fit, size)) is not None:
            joint = union
            names.append(name)
        else:
            others.append(f'moves otherwise in "{name}"')
    if joint is None:
        return None, list(dict.fromkeys(others))
    if node.opens is not None and joint.axis @ node.opens < 0:
        joint = joint.reversed()
    origin = _near(joint, box)
    limits = None if joint.type is JointType.CONTINUOUS else (joint.low, joint.high)
    reason = f'from the animation "{names[0]}"' if names[0] else "from an animation of the file"
    return StatedJoint(joint.type, origin, joint.axis, limits, reason=reason), list(dict.fromkeys(others))


def _union(a: _Fit, b: _Fit, size: float) -> _Fit | None:
    """Return the motion that covers two about or along one axis, None if their axes differ."""
    slides = JointType.PRISMATIC in (a.type, b.type)
    if (slides and a.type is not b.type) or abs(float(a.axis @ b.axis)) < SAME_AXIS_COSINE:
        return None
    off = b.origin - a.origin
    if not slides and np.linalg.norm(off - (off @ a.axis) * a.axis) > 2 * MAX_OFF_RATIO * size:
        return None
    same = b if a.axis @ b.axis > 0 else b.reversed()
    low, high = min(a.low, same.low), max(a.high, same.high)
    turns = JointType.CONTINUOUS in (a.type, b.type) or (not slides and high - low > FULL_TURN_RAD)
    fit = a._replace(type=JointType.CONTINUOUS if turns else a.type, low=low, high=high)
    return fit.reversed() if -low > high and not turns else fit


def _near(fit: _Fit, box: np.ndarray) -> np.ndarray:
    """Return the point of an axis that is nearest to its origin among those beside the part; for a slide, one in the part."""
    if fit.type is JointType.PRISMATIC:
        return np.clip(fit.origin, *box)
    corners = np.stack(np.meshgrid(*box.T, indexing="ij"), -1).reshape(-1, 3) - fit.origin
    along = corners @ fit.axis
    return fit.origin + np.clip(0.0, along.min(), along.max()) * fit.axis
