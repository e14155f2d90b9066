"""A chest as URDF text, drawn from boxes without the exporters: a case, a drawer, a door below it."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from assets import box, checker

DENSITY = 600.0  # [kg/m3]
CHEST = {  # boxes (low, high) in the root's frame [m]; open at the front, -y
    "case": [
        ((0, 0, 0), (0.6, 0.4, 0.02)),
        ((0, 0, 0.78), (0.6, 0.4, 0.8)),
        ((0, 0, 0.02), (0.02, 0.4, 0.78)),
        ((0.58, 0, 0.02), (0.6, 0.4, 0.78)),
        ((0.02, 0.38, 0.02), (0.58, 0.4, 0.78)),
        ((0.02, 0.01, 0.5), (0.58, 0.38, 0.52)),
    ],
    "drawer": [
        ((0.03, 0.005, 0.53), (0.57, 0.37, 0.54)),
        ((0.03, -0.02, 0.53), (0.57, 0.004, 0.77)),
        ((0.03, 0.36, 0.54), (0.57, 0.37, 0.65)),
        ((0.03, 0.005, 0.54), (0.04, 0.36, 0.65)),
        ((0.56, 0.005, 0.54), (0.57, 0.36, 0.65)),
    ],
    "door": [((0.03, -0.03, 0.03), (0.59, -0.005, 0.49))],
}
ORIGINS = {"case": (0, 0, 0), "drawer": (0.3, 0, 0.6), "door": (0.59, -0.005, 0.26)}
JOINTS = """
<joint name="slide" type="prismatic"><origin xyz="0.3 0 0.6"/><parent link="case"/><child link="drawer"/>
  <axis xyz="0 -1 0"/><limit lower="0" upper="0.3" effort="50" velocity="1"/><dynamics damping="1" friction="0.5"/></joint>
<joint name="hinge" type="revolute"><origin xyz="0.59 -0.005 0.26"/><parent link="case"/><child link="door"/>
  <axis xyz="0 0 1"/><limit lower="0" upper="1.6" effort="20" velocity="2"/><dynamics damping="0.1" friction="0.05"/></joint>
"""


def chest(folder: Path, *changes: tuple[str, str]) -> Path:
    """Writes chest.urdf, its meshes and a texture; each change replaces a text that must be there."""
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    (folder / "meshes" / "checker.png").write_bytes(checker())
    (folder / "meshes" / "all.mtl").write_text("newmtl wood\nKd 1 1 1\nmap_Kd checker.png\n")
    text = '<robot name="chest">' + "".join(_link(folder, name, boxes) for name, boxes in CHEST.items()) + JOINTS + "</robot>"
    root = ElementTree.fromstring(text)
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    path = folder / "chest.urdf"
    path.write_text(text, encoding="utf-8")
    return path


def _link(folder: Path, name: str, boxes: list) -> str:
    origin = np.array(ORIGINS[name], float)
    lines = ["mtllib all.mtl\n"]
    mass, first, second, collisions = 0.0, np.zeros(3), np.zeros((3, 3)), ""
    for count, (low, high) in enumerate(boxes):
        size, center = np.subtract(high, low), np.add(low, high) / 2 - origin
        m = DENSITY * float(np.prod(size))
        own = m / 12 * np.diag(size @ size - size**2)
        mass, first = mass + m, first + m * center
        second += own + m * (center @ center * np.eye(3) - np.outer(center, center))
        vertices, faces = box(np.asarray(low) - origin, np.asarray(high) - origin)
        lines += [f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in vertices] + ["vt 0 0\nvt 1 0\nvt 1 1\nusemtl wood\n"]
        corners = faces + 1 + 8 * count
        lines += [f"f {a}/{3 * count + 1} {b}/{3 * count + 2} {c}/{3 * count + 3}\n" for a, b, c in corners]
        collisions += f'<collision><origin xyz="{_text(center)}"/><geometry><box size="{_text(size)}"/></geometry></collision>'
    (folder / "meshes" / f"{name}.obj").write_text("".join(lines))
    center = first / mass
    tensor = second - mass * (center @ center * np.eye(3) - np.outer(center, center))
    keys = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    inertia = " ".join(f'{key}="{tensor[at]:.9g}"' for key, at in keys.items())
    return (
        f'<link name="{name}"><inertial><origin xyz="{_text(center)}"/><mass value="{mass:.9g}"/><inertia {inertia}/>'
        f'</inertial><visual><geometry><mesh filename="meshes/{name}.obj"/></geometry></visual>{collisions}</link>'
    )


def _text(values: np.ndarray) -> str:
    return " ".join(f"{v:.9g}" for v in values)
