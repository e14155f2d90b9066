"""Tolerant reading of URDF files: readable content is kept, and all faults are recorded for a check."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.robot import Geometry, Inertial, Robot, RobotJoint, RobotLink
from anymesh.errors import InputError

SIZES = {"box": ("size",), "sphere": ("radius",), "cylinder": ("radius", "length"), "capsule": ("radius", "length")}
Element = ElementTree.Element


def read_urdf(path: Path) -> Robot:
    """Read the links and joints of a URDF. Raise InputError if it is not XML with a <robot>."""
    path = Path(path)
    try:
        root = ElementTree.fromstring(path.read_bytes())
    except (OSError, ElementTree.ParseError, LookupError, ValueError) as error:
        raise InputError(f"{path.name} cannot be read: {' '.join(str(error).split())}; valid is an XML file") from None
    if root.tag != "robot":
        raise InputError(f"{path.name} holds a <{root.tag}>; a URDF holds a <robot>")
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
        )

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
