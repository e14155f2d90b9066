"""Robot descriptions: their links, joints and shapes in any format, unchecked, their files, and the reader of URDF.

The reader is tolerant: what can be read is kept, and all faults are recorded for a check.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import InputError
from anymesh.types import Brief, JointType, Mimic, Motion

MOVING = ("revolute", "continuous", "prismatic")
SIZES = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length"), "capsule": ("radius", "length")}
Element = ElementTree.Element
ENDLESS_RAD = 8 * np.pi  # [rad]
XACRO = "xacro}"  # end of the namespace of macros
DEFAULT_MIMIC = (("multiplier", "1"), ("offset", "0"))


@dataclass(frozen=True, eq=False)
class Geometry(Brief):
    """A shape of a link. kind: box (full sides), sphere (radius), cylinder and capsule (radius, length along z), mesh.

    T_link_shape: (4, 4); size: as stated for `kind` [m]; file: of a mesh, as written; scale: of its coordinates;
    triangles: (F, 3, 3) in the link frame [m] if given by the format's reader, None if the file must be read.
    """

    kind: str
    T_link_shape: Float[np.ndarray, "4 4"]
    size: tuple[float, ...] = ()
    file: str | None = None
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    triangles: Float[np.ndarray, "F 3 3"] | None = None


@dataclass(frozen=True, eq=False)
class Inertial(Brief):
    """mass [kg]; center: (3,) of mass in the link frame [m]; tensor: (3, 3) about it, along the link's axes [kg m2]."""

    mass: float
    center: Float[np.ndarray, " 3"]
    tensor: Float[np.ndarray, "3 3"]


@dataclass(frozen=True, eq=False)
class RobotLink:
    """A rigid body; inertial is None if the file gives none."""

    name: str
    visuals: tuple[Geometry, ...] = ()
    collisions: tuple[Geometry, ...] = ()
    inertial: Inertial | None = None


@dataclass(frozen=True, eq=False)
class RobotJoint(Brief):
    """A joint as written. T_parent_joint: (4, 4) at position 0; axis: in the joint frame, any length.

    limits [rad or m], effort [N m or N], velocity [rad/s or m/s]: None if not given; friction [N m or N], damping [N m s/rad or
    N s/m], armature [kg m2 or kg] (MJCF): 0 if not given.
    """

    name: str
    type: str
    parent: str
    child: str
    T_parent_joint: Float[np.ndarray, "4 4"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None = None
    effort: float | None = None
    velocity: float | None = None
    friction: float = 0.0
    damping: float = 0.0
    mimic: Mimic | None = None
    armature: float = 0.0

    @property
    def moves(self) -> bool:
        return self.type in MOVING

    @property
    def range(self) -> tuple[float, float]:
        """The limits; half a turn each way if there are none, or if they are so wide that they mean none."""
        endless = self.type == "revolute" and self.limits is not None and np.ptp(self.limits) > ENDLESS_RAD
        return (-np.pi, np.pi) if self.type == "continuous" or self.limits is None or endless else self.limits

    def transform(self, position: float) -> Float[np.ndarray, "4 4"]:
        """Return the transform from the child's frame to the parent's, at a position [rad or m]."""
        if not self.moves or position == 0:
            return self.T_parent_joint
        kind = JointType.PRISMATIC if self.type == "prismatic" else JointType.REVOLUTE
        motion = Motion(kind, self.axis / np.linalg.norm(self.axis), np.zeros(3), self.name)
        return self.T_parent_joint @ motion.transform(position)


@dataclass(frozen=True, eq=False)
class Robot:
    """Content of a robot description file.

    excluded: pairs of links that do not collide according to the file; problems: (subject, fault); pictures: texture files
    named by the description itself.
    """

    path: Path
    name: str
    links: tuple[RobotLink, ...]
    joints: tuple[RobotJoint, ...]
    excluded: frozenset[frozenset[str]] = frozenset()
    problems: tuple[tuple[str, str], ...] = ()
    pictures: tuple[str, ...] = ()
    format: str = "URDF"

    @property
    def moving(self) -> tuple[RobotJoint, ...]:
        return tuple(j for j in self.joints if j.moves)

    @property
    def followers(self) -> dict[str, Mimic]:
        """Return the moving joints that follow a moving one, and how."""
        names = {j.name for j in self.moving}
        return {j.name: j.mimic for j in self.moving if j.mimic is not None and j.mimic.joint in names - {j.name}}

    def coupled(self, positions: Mapping[str, float]) -> dict[str, float]:
        """Return positions of joints with those of the joints that follow them, within their limits, added if not given."""
        result, joints = dict(positions), {j.name: j for j in self.moving}
        waiting = {name: m for name, m in self.followers.items() if name not in result}
        for _ in range(len(waiting)):
            for name, m in [(n, m) for n, m in waiting.items() if m.joint not in waiting]:
                low, high = joints[name].range
                result[name] = min(max(m.offset + m.ratio * result.get(m.joint, 0.0), low), high)
                del waiting[name]
        return result

    @property
    def roots(self) -> tuple[str, ...]:
        children = {j.child for j in self.joints}
        return tuple(link.name for link in self.links if link.name not in children)

    def carried(self, link: str) -> frozenset[str]:
        """Return a link and all its descendants."""
        links, fresh = {link}, {link}
        while fresh:
            fresh = {j.child for j in self.joints if j.parent in fresh} - links
            links |= fresh
        return frozenset(links)

    def placements(self, positions: Mapping[str, float]) -> dict[str, Float[np.ndarray, "4 4"]]:
        """Return transforms from each link's frame to the root's; joints without a position are at 0, or follow others.

        The file must hold a tree.
        """
        positions = self.coupled(positions)
        placements = {name: np.eye(4) for name in self.roots}
        waiting = list(self.joints)
        while waiting:
            ready = [j for j in waiting if j.parent in placements]
            if not ready:
                raise ValueError(f"joints {[j.name for j in waiting]} are not connected to a root; a tree is needed")
            for j in ready:
                placements[j.child] = placements[j.parent] @ j.transform(positions.get(j.name, 0.0))
            waiting = [j for j in waiting if j.child not in placements]
        return placements


def shape_triangles(shape: Geometry) -> Float[np.ndarray, "F 3 3"]:
    """Return the surface of a box, sphere, cylinder or capsule in the link frame [m]; round ones as polyhedra."""
    if shape.kind == "box":
        vertices, faces = _lathe([(1.0, -0.5), (1.0, 0.5)], 4, reach=0.5, turned=np.pi / 4)
        vertices = vertices * [*(np.asarray(shape.size[:2]) / np.sqrt(2)), shape.size[2]]
    else:
        radius = shape.size[0]
        half = shape.size[1] / 2 if shape.kind != "sphere" else 0.0
        profile = [(radius, -half), (radius, half)]
        if shape.kind != "cylinder":
            angles = np.linspace(-np.pi / 2, np.pi / 2, 10)[1:-1]
            profile = [(radius * np.cos(a), radius * np.sin(a) + np.sign(a) * half) for a in angles]
        vertices, faces = _lathe(profile, 24, reach=half if shape.kind == "cylinder" else half + radius)
    T = shape.T_link_shape
    return (vertices @ T[:3, :3].T + T[:3, 3])[faces]


def _lathe(
    profile: list[tuple[float, float]], count: int, *, reach: float, turned: float = 0.0
) -> tuple[Float[np.ndarray, "n 3"], Int[np.ndarray, "m 3"]]:
    """Return a closed surface of revolution about z through (radius, height) in `count` segments, ends at z = -reach, reach."""
    angle = np.arange(count) * 2 * np.pi / count + turned
    ring = np.stack([np.cos(angle), np.sin(angle)], 1)
    rings = [np.column_stack([ring * radius, np.full(count, height)]) for radius, height in profile]
    low, high = np.array([[0, 0, -reach]]), np.array([[0, 0, reach]])
    vertices = np.concatenate([*rings, low, high])
    k = np.arange(count)
    after = (k + 1) % count
    bottom, top, last = len(vertices) - 2, len(vertices) - 1, (len(profile) - 1) * count
    faces = [np.stack([np.full(count, bottom), after, k], 1), np.stack([np.full(count, top), last + k, last + after], 1)]
    for row in range(len(profile) - 1):
        a, b = row * count, (row + 1) * count
        faces += [np.stack([a + k, a + after, b + after], 1), np.stack([a + k, b + after, b + k], 1)]
    return vertices, np.concatenate(faces)


def read_urdf(path: Path) -> Robot:
    """Read the links and joints of a URDF. Raise InputError if it is not XML with a <robot>."""
    path = Path(path)
    try:
        root = ElementTree.fromstring(path.read_bytes())
    except (OSError, ElementTree.ParseError, LookupError, ValueError) as error:
        raise InputError(f"{path.name} cannot be read: {' '.join(str(error).split())}; valid is an XML file") from None
    if root.tag != "robot":
        raise InputError(f"{path.name} holds a <{root.tag}>; a URDF holds a <robot>")
    if root.find("link") is None and any(XACRO in element.tag for element in root.iter()):
        raise InputError(f"{path.name} holds macros of xacro; expand them with `xacro {path.name} -o robot.urdf`")
    reader = _Reader()
    links = tuple(reader.link(element) for element in root.findall("link"))
    joints = tuple(reader.joint(element) for element in root.findall("joint"))
    pictures = tuple(dict.fromkeys(e.get("filename") or "" for e in root.iter("texture")))
    return Robot(path, root.get("name") or "", links, joints, problems=tuple(reader.problems), pictures=pictures)


class _Reader:
    """Reader of elements; invalid values are recorded and replaced by the default."""

    def __init__(self) -> None:
        self.problems: list[tuple[str, str]] = []
        self.subject = ""

    def link(self, element: Element) -> RobotLink:
        self.subject = element.get("name") or ""
        inertial = element.find("inertial")
        return RobotLink(
            self.subject,
            tuple(g for e in element.findall("visual") if (g := self.geometry(e)) is not None),
            tuple(g for e in element.findall("collision") if (g := self.geometry(e)) is not None),
            None if inertial is None else self.inertial(inertial),
        )

    def geometry(self, element: Element) -> Geometry | None:
        T = self.origin(element)
        holder = element.find("geometry")
        shape = next(iter(holder), None) if holder is not None else None
        if shape is None or shape.tag not in (*SIZES, "mesh"):
            content = "nothing" if shape is None else f"<{shape.tag}>"
            return self.note(f"a <{element.tag}> holds {content}; valid are box, sphere, cylinder, capsule and mesh")
        if shape.tag == "mesh":
            file = shape.get("filename")
            if not file:
                return self.note(f"a <{element.tag}> has a mesh without a filename")
            scale = self.numbers(shape.get("scale"), (1.0, 1.0, 1.0), "scale")
            return Geometry("mesh", T, file=file, scale=(scale[0], scale[1], scale[2]))
        size: tuple[float, ...] = ()
        for key in SIZES[shape.tag]:
            size += self.numbers(shape.get(key), (0.0,) * (3 if shape.tag == "box" else 1), f"{shape.tag} {key}")
        if min(size) <= 0:
            return self.note(f"a <{element.tag}> has a {shape.tag} of size {size}; it must be above 0")
        return Geometry(shape.tag, T, size)

    def inertial(self, element: Element) -> Inertial:
        T = self.origin(element)
        mass, inertia = element.find("mass"), element.find("inertia")
        keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        xx, xy, xz, yy, yz, zz = (self.numbers(None if inertia is None else inertia.get(key), (0.0,), key)[0] for key in keys)
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        value = self.numbers(None if mass is None else mass.get("value"), (0.0,), "mass")[0]
        return Inertial(value, T[:3, 3], T[:3, :3] @ tensor @ T[:3, :3].T)

    def joint(self, element: Element) -> RobotJoint:
        self.subject = element.get("name") or ""
        parent, child = element.find("parent"), element.find("child")
        axis, limit, dynamics = element.find("axis"), element.find("limit"), element.find("dynamics")
        direction = (1.0, 0.0, 0.0) if axis is None else self.numbers(axis.get("xyz"), (1.0, 0.0, 0.0), "axis")
        limits = None
        if limit is not None and {"lower", "upper"} & set(limit.keys()):
            ends = [self.numbers(limit.get(key, "0"), (0.0,), key)[0] for key in ("lower", "upper")]
            limits = (ends[0], ends[1])
        friction, damping = (
            self.numbers("0" if dynamics is None else dynamics.get(key, "0"), (0.0,), key)[0] for key in ("friction", "damping")
        )
        return RobotJoint(
            self.subject,
            element.get("type") or "",
            (parent.get("link") if parent is not None else None) or "",
            (child.get("link") if child is not None else None) or "",
            self.origin(element),
            np.array(direction),
            limits,
            self.optional(limit, "effort"),
            self.optional(limit, "velocity"),
            friction,
            damping,
            self.mimic(element),
        )

    def mimic(self, element: Element) -> Mimic | None:
        mimic = element.find("mimic")
        if mimic is None:
            return None
        values = [self.numbers(mimic.get(key, text), (0.0,), f"mimic {key}")[0] for key, text in DEFAULT_MIMIC]
        return Mimic(mimic.get("joint") or "", *values)

    def optional(self, element: Element | None, key: str) -> float | None:
        text = None if element is None else element.get(key)
        return None if text is None else self.numbers(text, (0.0,), key)[0]

    def origin(self, element: Element) -> Float[np.ndarray, "4 4"]:
        origin = element.find("origin")
        T = np.eye(4)
        if origin is not None:
            T[:3, 3] = self.numbers(origin.get("xyz", "0 0 0"), (0.0, 0.0, 0.0), "origin xyz")
            T[:3, :3] = _rotation(*self.numbers(origin.get("rpy", "0 0 0"), (0.0, 0.0, 0.0), "origin rpy"))
        return T

    def numbers(self, text: str | None, default: tuple[float, ...], what: str) -> tuple[float, ...]:
        """Parse finite numbers, as many as the default has; a missing scale gets the default."""
        if text is None and what == "scale":
            return default
        try:
            values = tuple(float(word) for word in (text or "").split())
        except ValueError:
            values = ()
        if len(values) != len(default) or not np.isfinite(values).all():
            self.note(f"{what} is {text!r}; valid are {len(default)} finite numbers")
            return default
        return values

    def note(self, text: str) -> None:
        self.problems.append((self.subject, text))


def _rotation(roll: float, pitch: float, yaw: float) -> Float[np.ndarray, "3 3"]:
    """Return the rotation about the fixed axes x, y, z in turn (URDF's rpy) [rad]."""
    (cr, sr), (cp, sp), (cy, sy) = ((np.cos(a), np.sin(a)) for a in (roll, pitch, yaw))
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    return np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]) @ about_y @ about_x
