"""How strongly each joint resists, from its kind and from what it moves: friction, damping, limits and the pull at the handle.

Sources of the values: docs/resistance.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from anymesh.geometry.kinematics import joint_motion
from anymesh.mechanisms.handles import find_protrusion
from anymesh.physics.inertia import Inertia
from anymesh.physics.resistance import GRAVITY, FoundHandle, Pull, Resistance, ResistanceLevel, crossing
from anymesh.types import Asset, Joint, JointType
from anymesh.types.triangles import bounds_of, crosses, lengths
from anymesh.vocabulary import recognize, words_of

UPRIGHT = 0.999  # minimum cosine to the vertical of an upright joint, which tilts nothing that it carries
MIN_ARM, MIN_REACH = 1e-3, 0.3  # minimum lever arm of a handle [m], and over that of the farthest point from the axis
TILT = float(np.sin(np.deg2rad(1.0)))  # of the weight: what a joint that stays closed resists, since no floor is level
STILL = {True: 1e-3, False: float(np.deg2rad(0.5))}  # [m, rad] of a slide, of a turn: a joint with less room cannot move
HOLD = np.array([1.25, 1.5, 2.5])  # friction over the load from gravity that it holds at rest
PULLS = np.array([8.0, 15.0, 45.0])  # [N] maximum friction at a handle
EDGE = 3.0  # [m/s] maximum speed of the edge of what turns about a hinge
MAX_RATE = 15.0  # [1/s] maximum damping over inertia: a quarter at steps of 1/60 s
SETTLING = 4.0, 1.4  # [1/s] minimum damping over inertia of a pendulum, and in natural frequencies [rad/s]
SWING = 0.05  # [rad] beyond the limits: a lowest position about which a joint swings
AXLE = 0.1  # of a wheel's radius: radius of its axle
MIN_INERTIA, JERK = 1e-7, 2e4  # [kg m^2, rad/s^2] parts that turn with less, or with more friction over it, get armature
EFFORT, BRISK = 2.0, 0.6  # of motors: times friction and gravity; times the speed limit over the time constant of a drive
GROUND = 0.02  # of the asset's height: a wheel this low stands on the ground
HOLDERS = frozenset(("handle", "knob", "lever"))  # parts by which others are pulled


@dataclass(frozen=True)
class ResistingKind:
    """Friction of a kind of joint: light, typical, stiff, in a form of `FORMS`.

    speed: limit [rad/s, m/s], of the rim [m/s] for bearings; rate: damping over inertia [1/s]; size: of parts [m] below which
    friction is less; torque: turned about its axis rather than pulled at a handle.
    """

    form: str
    values: tuple[float, float, float]
    speed: float = 6.0
    rate: float = 1.0
    size: float = 0.0
    torque: bool = False


FORMS = {
    "weight": "friction at the handle over the weight",
    "hinge": "friction over the largest load from gravity",
    "touch": "friction at the handle [N], less for small parts",
    "bearing": "friction coefficient on the axle",
}
KINDS = {
    "door": ResistingKind("weight", (0.03, 0.06, 0.15)),
    "drawer": ResistingKind("weight", (0.03, 0.05, 0.2), 2.0),
    "lid": ResistingKind("weight", (0.02, 0.04, 0.1)),
    "flap": ResistingKind("weight", (0.03, 0.08, 0.2)),
    "window": ResistingKind("weight", (0.04, 0.08, 0.25), 2.0),
    "seat": ResistingKind("weight", (0.02, 0.05, 0.15)),
    "slider": ResistingKind("weight", (0.1, 0.25, 0.5), 2.0, 3.0),
    "bail": ResistingKind("weight", (0.01, 0.03, 0.1)),
    "turntable": ResistingKind("weight", (0.01, 0.03, 0.1), torque=True),
    "screen": ResistingKind("hinge", (1.2, 1.5, 2.5), rate=4.0),
    "knob": ResistingKind("touch", (0.5, 1.5, 4.0), 20.0, 10.0, 0.025, torque=True),
    "tap": ResistingKind("touch", (2.0, 6.0, 15.0), 10.0, 10.0, 0.05, torque=True),
    "crank": ResistingKind("touch", (1.0, 3.0, 8.0), 20.0, 2.0, 0.1, torque=True),
    "button": ResistingKind("touch", (0.3, 0.8, 2.0), 2.0, 10.0, 0.015),
    "key": ResistingKind("touch", (0.1, 0.25, 0.6), 2.0, 10.0, 0.015),
    "lever": ResistingKind("touch", (0.7, 2.0, 6.0), 10.0, 5.0, 0.1),
    "wheel": ResistingKind("bearing", (0.01, 0.05, 0.2), 10.0, 0.02, torque=True),
    "rotor": ResistingKind("bearing", (0.0015, 0.02, 0.1), 30.0, 0.05, torque=True),
    "hinge": ResistingKind("weight", (0.03, 0.06, 0.15)),
    "slide": ResistingKind("weight", (0.03, 0.08, 0.3), 2.0),
    "spin": ResistingKind("bearing", (0.01, 0.05, 0.2), 10.0, 0.5, torque=True),
}
WORDS = {
    "screen": "screen display monitor", "tap": "tap valve faucet chuck cap", "crank": "crank steering", "key": "key keycap",
    "rotor": "rotor propeller fan blade turbine", "turntable": "turntable carousel", "lever": "handle",
}  # fmt: skip
BY_WORD = {word: name for name, words in WORDS.items() for word in words.split()}
ENDLESS = (JointType.CONTINUOUS, JointType.SCREW)
BY_TYPE = {JointType.PRISMATIC: "slide", JointType.REVOLUTE: "hinge"}  # others: "spin"
SLIDING = {"knob": "button", "tap": "button", "crank": "slide", "wheel": "slide", "rotor": "slide", "turntable": "slide"}
WHEELED = frozenset(("tire", "tyre", "caster", "castor"))
FOLDING = frozenset(("laptop", "notebook", "netbook"))  # objects whose lids have friction hinges


def resistances(
    asset: Asset, inertias: Mapping[str, Inertia], level: ResistanceLevel = ResistanceLevel.TYPICAL
) -> dict[str, Resistance]:
    """Return the resistance of each moving joint, by name. inertias: of all links, about their joints' origins."""
    tree = _Tree(asset, inertias)
    return {j.name: _resistance(tree, _Moved(tree, j), list(ResistanceLevel).index(level)) for j in tree.joints}


def kind_of(asset: Asset, joint: Joint) -> str:
    """Return the kind of a joint (a key of `KINDS`) by the words of its part's label and name, else by its type."""
    part = next(p for p in asset.segmentation.parts if p.name == joint.child)
    words, whole = [*words_of(part.name), *words_of(part.label)], words_of(f"{asset.name} {asset.category}")
    word = recognize(part.label) or recognize(part.name)
    kind = next((BY_WORD[w] for w in reversed(words) if w in BY_WORD), word.label if word else "")
    if kind == "lid":
        kind = "screen" if FOLDING & {*words, *whole} else "tap" if joint.type in ENDLESS else kind
    if kind == "wheel" and not WHEELED & {*words, *whole}:  # a valve's, a fan's
        kind = next((BY_WORD[w] for w in whole if w in BY_WORD), kind)
    if joint.type is JointType.PRISMATIC:
        kind = SLIDING.get(kind, kind)
    return kind if kind in KINDS else BY_TYPE.get(joint.type, "spin")


class _Tree:
    """The moving joints of an asset with the masses that they carry; spatial inertia is about the asset's origin."""

    def __init__(self, asset: Asset, inertias: Mapping[str, Inertia]) -> None:
        mesh, self.labels = asset.mesh, {p.name: p.label for p in asset.segmentation.parts}
        order = np.argsort(asset.segmentation.face_part, kind="stable")
        cuts = np.searchsorted(asset.segmentation.face_part[order], np.arange(1, len(self.labels)))
        self.triangles = dict(zip(self.labels, (mesh.triangles[own] for own in np.split(order, cuts)), strict=True))
        self.carriers = {j.child: _single(j) for j in asset.joints}
        self.joints = [j for j in self.carriers.values() if j.type not in (JointType.FIXED, JointType.FREE)]
        origins = {j.child: j.origin for j in asset.joints}
        own = {name: _spatial(body, origins.get(name, np.zeros(3))) for name, body in inertias.items()}
        self.carried = {name: inertia.copy() for name, inertia in own.items()}
        for name in own:
            for above in self.above(name):
                self.carried[above.parent] += own[name]
        self.kinds = {j.name: kind_of(asset, j) for j in self.joints}
        self.effective = dict(zip((j.name for j in self.joints), self._effective(), strict=True))
        low = mesh.vertices[:, 2].min() + GROUND * np.ptp(mesh.vertices[:, 2])
        wheels = [j for j in self.joints if self.kinds[j.name] == "wheel"]
        self.standing = [j.name for j in wheels if self.triangles[j.child][:, :, 2].min() <= low]

    def above(self, name: str) -> list[Joint]:
        """Return the joints from a link to the root."""
        joints = []
        while name in self.carriers:
            joints.append(self.carriers[name])
            name = joints[-1].parent
        return joints

    def _effective(self) -> Float[np.ndarray, " n"]:
        """Return the inertia of each joint with the others free, on which its damping acts in an explicit step."""
        index = {j.name: k for k, j in enumerate(self.joints)}
        M = np.zeros((len(index),) * 2)
        for j in self.joints:
            for above in (j for j in self.above(j.child) if j.name in index):
                at = index[above.name], index[j.name]
                M[at] = M[at[::-1]] = _motion(above) @ self.carried[j.child] @ _motion(j)
        scale = 1 / np.sqrt(M.diagonal())
        return 1 / (np.linalg.inv(M * np.outer(scale, scale) + 1e-9 * np.eye(len(M))).diagonal() * scale**2)


def _spatial(body: Inertia, origin: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "6 6"]:
    """Return the spatial inertia of a link (rotation, translation) about the asset's origin."""
    x, y, z = body.center + origin
    C = body.mass * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.block([[body.tensor + C @ C.T / body.mass, C], [C.T, body.mass * np.eye(3)]])


def _whole(tree: _Tree, part: str, way: Float[np.ndarray, " 3"]) -> FoundHandle:
    """Return a part that is a handle as a whole, which a hand reaches against a direction of any length."""
    return FoundHandle(part, np.arange(len(tree.triangles[part])), way / max(float(np.linalg.norm(way)), 1e-12))


def _single(joint: Joint) -> Joint:
    """Return a joint of one axis: of a ball, across its arm, and level where that is not upright."""
    if joint.type is not JointType.BALL:
        return joint
    level = np.cross(joint.axis, (0.0, 0.0, 1.0))
    length = float(np.linalg.norm(level))
    axis = level / length if length > UPRIGHT else joint_motion(joint).axis
    return replace(joint, type=JointType.REVOLUTE, axis=axis, limits=joint.span)


def _motion(joint: Joint) -> Float[np.ndarray, " 6"]:
    """Return the spatial velocity of a link per unit of its joint's speed."""
    slides = joint.type is JointType.PRISMATIC
    along = joint.pitch / (2 * np.pi) * joint.axis
    return np.r_[np.zeros(3), joint.axis] if slides else np.r_[joint.axis, np.cross(joint.origin, joint.axis) + along]


class _Moved:
    """What a joint moves, at rest, and where it is pulled.

    weight [N]; rest: gravity along the joint, load: its maximum [N or N m]; radius: largest distance from the axis [m]; center,
    handle: of mass and of the pull, from the axis [m]; reach, arm: their distances, 1 for slides; size: of what is touched [m].
    """

    def __init__(self, tree: _Tree, joint: Joint) -> None:
        carried, motion, self.joint = tree.carried[joint.child], _motion(joint), joint
        self.slides, self.kind = joint.type is JointType.PRISMATIC, KINDS[tree.kinds[joint.name]]
        self.torque = self.kind.torque and not self.slides
        self.lower, self.upper = (-np.inf, np.inf) if joint.limits is None else joint.limits
        self.opens = -1.0 if self.lower + self.upper < 0 else 1.0
        self.inertia, self.weight = float(motion @ carried @ motion), GRAVITY * float(carried[3, 3])
        self.corners = tree.triangles[joint.child].reshape(-1, 3)
        self.distances = self.distance(self.corners)
        self.radius = float(self.distances.max())
        self.at, self.found = self._handle(tree)
        mean = np.array([carried[2, 4], carried[0, 5], carried[1, 3]]) / carried[3, 3]
        off = np.array([mean, self.at]) - joint.origin
        self.center, self.handle = off - np.outer(off @ joint.axis, joint.axis)
        self.reach = 1.0 if self.slides else float(np.linalg.norm(self.center))
        self.arm = 1.0 if self.slides or self.torque else max(float(np.linalg.norm(self.handle)), MIN_ARM)
        across = np.ptp(self.corners, axis=0) if self.slides else 2 * self.radius if self.torque else self.arm
        self.size = float(np.linalg.norm(across))
        turning = (j for j in tree.above(joint.parent) if j.type in (JointType.REVOLUTE, JointType.CONTINUOUS))
        level = abs(joint.axis[2]) if self.slides else float(np.linalg.norm(joint.axis[:2]))
        self.rest = -GRAVITY * float((carried @ motion)[5])
        self.load = self.weight * self.reach * (1.0 if any(abs(j.axis[2]) < UPRIGHT for j in turning) else level)
        shared = GRAVITY * tree.carried[next(iter(tree.labels))][3, 3] / max(len(tree.standing), 1)
        self.bearing = shared if joint.name in tree.standing else self.weight

    def distance(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
        """Return the distance of points from the axis [m]."""
        offset = points - self.joint.origin
        return lengths(crosses(np.broadcast_to(self.joint.axis, offset.shape), offset))

    def _handle(self, tree: _Tree) -> tuple[Float[np.ndarray, " 3"], FoundHandle | None]:
        """Return where the joint is opened [m, asset frame], and its handle.

        That is its handle: a part that hangs on it, or a protrusion; else the farthest points from the axis of a turn, and the
        middle of the face of a slide, from which a button is pushed. What is turned by a torque is turned in its middle.
        """
        joint, along = self.joint, self.opens * self.joint.axis
        middle = bounds_of(self.corners).sum(0) / 2
        heights, touched = (self.corners - middle) @ along, self.kind.form == "touch"
        rim = self.corners[self.distances >= 0.98 * self.radius]
        arms = np.cross(joint.axis, rim - joint.origin)
        far = rim[arms @ arms[0] >= 0.5 * arms[0] @ arms[0]].mean(0)  # of one side, else the middle of a rotor is its handle
        usual = middle + (heights.min() if touched else heights.max()) * along if self.slides else far
        words = {n: recognize(tree.labels[n]) for n, j in tree.carriers.items() if j.parent == joint.child}
        hanging = [n for n, word in words.items() if word is not None and word.label in HOLDERS]
        own, held = recognize(tree.labels[joint.child]), None
        if own is not None and own.label in HOLDERS and not self.slides:
            held = _whole(tree, joint.child, self._side(tree, middle, far))
        if touched or self.torque:
            return middle if self.torque else usual, held
        outwards = along if self.slides else np.cross(along, far - joint.origin)
        protruding = find_protrusion(tree.triangles[joint.child], tree.triangles[joint.parent], outwards)
        mine = [] if protruding is None else [(protruding[1], FoundHandle(joint.child, protruding[0].faces, protruding[0].way))]
        corners = {n: tree.triangles[n].reshape(-1, 3) for n in hanging}
        hung = [(np.stack([c.min(0), c.max(0)]).mean(0), _whole(tree, n, outwards)) for n, c in corners.items()]
        points = [p for p, _ in hung or mine if self._far(p)]
        held = next((handle for p, handle in (*mine, *hung) if self._far(p)), held)
        return (points[0] if points else usual), held

    def _far(self, point: Float[np.ndarray, " 3"]) -> bool:
        """Return whether a point is far enough from the axis to pull there."""
        return self.slides or bool(self.distance(point[None])[0] > MIN_REACH * self.radius)

    def _side(self, tree: _Tree, middle: Float[np.ndarray, " 3"], far: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"]:
        """Return the side from which a part that is a handle is held: along its axis, or a bail's far one."""
        joint, above = self.joint, tree.triangles[self.joint.parent].reshape(-1, 3)
        if not self.torque and np.ptp(self.corners @ joint.axis) > self.radius:
            return far - joint.origin - ((far - joint.origin) @ joint.axis) * joint.axis
        return joint.axis if (middle - (above.min(0) + above.max(0)) / 2) @ joint.axis > 0 else -joint.axis

    def friction(self) -> Float[np.ndarray, " 3"]:
        """Return the light, typical and stiff friction of the joint's kind."""
        values, turned = np.array(self.kind.values), self.radius if self.torque else self.arm
        match self.kind.form:
            case "weight":
                return np.minimum(values * self.weight, PULLS) * turned
            case "hinge":
                return values * self.load + TILT * self.weight * self.arm
            case "touch":
                return values * min(1.0, self.size / self.kind.size) * turned
            case _:
                return values * self.bearing * AXLE * self.radius

    def holding(self) -> Float[np.ndarray, " 3"]:
        """Return the friction that keeps the joint from moving by itself at rest, and on a floor a degree out of level."""
        rooms, shaken = ((1, self.upper), (-1, -self.lower)), self.weight * self.reach * TILT
        return HOLD * max([0.0, *(sign * self.rest + shaken for sign, room in rooms if room > STILL[self.slides])])

    def rate(self) -> float:
        """Return damping over inertia [1/s], more if it swings about a lowest position within its range."""
        axis = self.joint.axis
        down = np.array([0.0, 0.0, -1.0]) + axis[2] * axis
        lowest = float(np.arctan2(axis @ np.cross(self.center, down), self.center @ down))
        turns = (lowest - 2 * np.pi, lowest, lowest + 2 * np.pi)
        if self.slides or self.load < 1e-12 or not any(self.lower - SWING < at < self.upper + SWING for at in turns):
            return self.kind.rate
        return min(MAX_RATE, max(self.kind.rate, SETTLING[0], SETTLING[1] * float(np.sqrt(self.load / self.inertia))))


def _resistance(tree: _Tree, moved: _Moved, level: int) -> Resistance:
    joint, kind, name = moved.joint, moved.kind, tree.kinds[moved.joint.name]
    usual, holding = moved.friction(), moved.holding()
    friction = np.maximum(usual, holding)
    fixed = moved.slides or kind.form == "bearing"
    armature = 0.0 if fixed else max(0.0, MIN_INERTIA - moved.inertia, float(friction[2]) / JERK - moved.inertia)
    free = tree.effective[joint.name]  # URDF and SDF have no armature, so it may not raise the damping beyond what is stable
    damping = min(moved.rate() * (free + armature), MAX_RATE * free)
    turning = max(moved.radius, MIN_ARM)
    velocity = max(100.0, kind.speed / turning) if kind.form == "bearing" else min(kind.speed, EDGE / turning)
    velocity = min(kind.speed, 2.0) if moved.slides else velocity
    brisk = (moved.inertia + armature) * velocity / crossing(joint, velocity)
    effort = EFFORT * (float(friction[2]) + moved.load) + damping * min(velocity, 6.0) + BRISK * brisk
    direction = moved.opens * joint.axis
    if not (moved.slides or moved.torque):
        direction = np.cross(direction, moved.handle) / max(float(np.linalg.norm(moved.handle)), 1e-12)
    pulls = (friction - moved.opens * moved.rest) / moved.arm
    pull = Pull("N m" if moved.torque else "N", *(float(pulls[k]) for k in (level, 0, 2)), moved.at, direction, moved.found)
    words = f"{name}: {FORMS[kind.form]}: {kind.values[1]:g} ({kind.values[0]:g} to {kind.values[2]:g})"
    more = "; more, to hold its weight at rest" if holding[1] > usual[1] else ""
    numbers = (float(v) for v in (damping, effort, velocity, armature, moved.inertia, moved.load))
    bounds = (float(friction[0]), float(friction[2]))
    return Resistance(float(friction[level]), bounds, *numbers, pull, name, words + more)
