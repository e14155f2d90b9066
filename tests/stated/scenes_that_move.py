"""glTF scenes of boxes whose nodes are animated or joined, for tests of the joints that files state."""

from __future__ import annotations

import numpy as np
from assets import CUBE
from mesh_files import FACES, Gltf
from scipy.spatial.transform import Rotation

from anymesh.loading import load_mesh
from anymesh.types import Mesh


class Moving(Gltf):
    """Builder of a scene of boxes with animations."""

    def box(self, low, high, name: str = "", **fields) -> int:
        """Add a node with a box between two corners of its own frame."""
        low, high = np.array(low, float), np.array(high, float)
        primitive = {"attributes": {"POSITION": self.array(low + CUBE * (high - low))}}
        mesh = self.mesh(primitive | {"indices": self.array(np.reshape(FACES, -1), "H")}, name=name or "box")
        return self.node(mesh=mesh, **({"name": name} if name else {}), **fields)

    def animate(self, node: int, path: str, times, values, *, name: str = "Open", mode: str = "LINEAR") -> None:
        """Add a channel to the animation of that name."""
        animations = self.doc.setdefault("animations", [])
        found = next((a for a in animations if a.get("name", "") == name), None)
        if found is None:
            found = {"channels": [], "samplers": []} | ({"name": name} if name else {})
            animations.append(found)
        sampler = {"input": self.array(np.array(times, float)), "output": self.array(np.array(values, float))}
        found["samplers"].append(sampler | {"interpolation": mode})
        found["channels"].append({"sampler": len(found["samplers"]) - 1, "target": {"node": node, "path": path}})

    def turn(self, node: int, degrees, axis=(0, 1, 0), **more) -> None:
        """Animate a rotation with a key per second."""
        self.animate(node, "rotation", np.arange(len(degrees)), turns(degrees, axis), **more)

    def slide(self, node: int, amounts, axis=(0, 0, 1), rest=(0, 0, 0), **more) -> None:
        """Animate a translation from `rest` with a key per second."""
        moved = np.array(rest, float) + np.outer(amounts, axis)
        self.animate(node, "translation", np.arange(len(amounts)), moved, **more)


def turns(degrees, axis=(0, 1, 0)) -> np.ndarray:
    """Return quaternions xyzw of turns about an axis."""
    return Rotation.from_rotvec(np.outer(np.deg2rad(degrees), np.array(axis) / np.linalg.norm(axis))).as_quat()


def cabinet() -> tuple[Moving, int]:
    """Return a case with a door, and the node of the door, whose origin is its hinge at (0.25, 0, 0.2), along y."""
    g = Moving()
    g.box((-0.25, 0, -0.2), (0.25, 0.7, 0.2), "Case")
    return g, g.box((-0.5, 0, 0), (0, 0.7, 0.02), "Door", translation=[0.25, 0, 0.2])


def read(g: Gltf, folder) -> tuple[Mesh, tuple[str, ...]]:
    """Return the mesh of a scene, in its own frame, and the warnings."""
    path = folder / "scene.glb"
    path.write_bytes(g.glb())
    loaded = load_mesh(path)
    return loaded.mesh, loaded.warnings
