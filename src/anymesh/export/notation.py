"""Rotations, numbers and XML documents in the notation of the formats."""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

DRAKE = "{http://drake.mit.edu}"  # Drake's own tags in a URDF, which other readers pass over
ElementTree.register_namespace("drake", DRAKE[1:-1])


def rpy(rotation: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, " 3"]:
    """Return roll, pitch, yaw [rad] about the fixed x, y, z in this order, as in URDF and SDFormat; no roll at the pole."""
    pitch = float(np.arctan2(-rotation[2, 0], np.hypot(rotation[0, 0], rotation[1, 0])))
    if np.hypot(rotation[0, 0], rotation[1, 0]) < 1e-9:
        return np.array([0.0, pitch, np.arctan2(-rotation[0, 1], rotation[1, 1])])
    return np.array([np.arctan2(rotation[2, 1], rotation[2, 2]), pitch, np.arctan2(rotation[1, 0], rotation[0, 0])])


def quaternion(rotation: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, " 4"]:
    """Return w, x, y, z, unit, with w >= 0."""
    (a, b, c), (d, e, f), (g, h, i) = rotation
    squares = np.maximum(0.0, [1 + a + e + i, 1 + a - e - i, 1 - a + e - i, 1 - a - e + i])  # of 2w, 2x, 2y, 2z
    rows = np.array(
        [
            [squares[0], h - f, c - g, d - b],
            [h - f, squares[1], b + d, c + g],
            [c - g, b + d, squares[2], f + h],
            [d - b, c + g, f + h, squares[3]],
        ]
    )
    quat = rows[int(np.argmax(squares))]
    quat = quat / np.linalg.norm(quat)
    return quat + 0.0 if quat[0] >= 0 else 0.0 - quat


def turning_x_to(axis: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "3 3"]:
    """Return the smallest rotation whose first column is a unit axis."""
    cosine = float(axis[0])
    if cosine < -1 + 1e-12:
        return np.diag([-1.0, -1.0, 1.0])
    x, y, z = np.cross([1.0, 0, 0], axis)
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + K + K @ K / (1 + cosine)


def principal(tensor: Float[np.ndarray, "3 3"]) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, "3 3"]]:
    """Return the moments of an inertia, ascending, and their right-handed axes as columns."""
    moments, axes = np.linalg.eigh(tensor)
    axes = axes * np.sign(axes[np.abs(axes).argmax(0), range(3)])
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return moments, axes


def number(value: float) -> str:
    """Format with ten significant digits; values that are zero up to rounding become 0."""
    return "0" if abs(value) < 1e-12 else f"{float(value):.10g}"


def vector(values: Iterable[float]) -> str:
    """Format numbers separated by spaces."""
    return " ".join(number(v) for v in values)


def moments(tensor: Float[np.ndarray, "3 3"]) -> dict[str, str]:
    """Format the six numbers of an inertia [kg m^2]; off-diagonal ones that are rounding become 0."""
    noise = 1e-12 * float(np.trace(tensor))
    places = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    return {key: f"{tensor[at]:.10g}" if abs(tensor[at]) > noise else "0" for key, at in places.items()}


def document(root: ElementTree.Element) -> str:
    """Return the indented file, with a final newline. It states no encoding, since lxml refuses text that does."""
    ElementTree.indent(root)
    return '<?xml version="1.0"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"
