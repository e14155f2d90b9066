"""A triangle mesh with the scene graph, materials and per-corner attributes that must survive to the output; convex shapes.

Colours for display are sRGB and those for light linear, both 0..1 (IEC 61966-2-1).
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Float32, Int, UInt8
from PIL import Image

from anymesh.types.brief import Brief
from anymesh.types.motion import StatedJoint
from anymesh.types.triangles import bounds_of, corners_of, normals_and_areas

REPEAT, MIRROR, CLAMP = "repeat", "mirror", "clamp"
TEXTURE_SLOTS = ("base_color", "metallic_roughness", "normal", "occlusion", "emissive")


@dataclass(frozen=True)
class Texture(Brief):
    """An encoded image, as the bytes of its file, and how a material lays it on."""

    data: bytes
    mime: str  # "image/png" or "image/jpeg"
    name: str = ""
    wrap: tuple[str, str] = (REPEAT, REPEAT)  # beyond 0..1 along u and v: REPEAT, MIRROR or CLAMP
    uv_set: int = 0  # 0: Mesh.corner_uv, k: columns 2k - 2 and 2k - 1 of Mesh.corner_more_uv
    strength: float = 1.0  # scale of a normal picture, strength of an occlusion picture
    nearest: bool = False  # whether magnified texels keep hard edges

    def pixels(self, most: int | None = None) -> UInt8[np.ndarray, "H W 4"]:
        """Decode the image as RGBA, shrunk to at most `most` pixels wide and high."""
        with Image.open(io.BytesIO(self.data)) as image:
            if most is not None:
                image.thumbnail((most, most), Image.Resampling.BOX)
            return np.asarray(image.convert("RGBA"))

    @property
    def transparent(self) -> bool:
        """Return whether some pixel is not opaque."""
        if self.mime == "image/jpeg":
            return False
        with Image.open(io.BytesIO(self.data)) as image:
            return image.has_transparency_data and bool(np.asarray(image.convert("RGBA").getchannel("A")).min() < 255)

    def painted(self, pixels: np.ndarray) -> Texture:
        """Return the texture with other pixels (H, W, 3 or 4), 0..255."""
        buffer = io.BytesIO()
        Image.fromarray(np.rint(pixels).astype(np.uint8)).save(buffer, "PNG")
        return replace(self, data=buffer.getvalue(), mime="image/png")


@dataclass(frozen=True)
class Material(Brief):
    """A metallic-roughness material (glTF 2.0 meaning; factors multiply textures)."""

    name: str = "material"
    base_color: tuple[float, float, float, float] = (0.7, 0.7, 0.7, 1.0)  # linear factor, RGBA in 0..1
    metallic: float = 0.0
    roughness: float = 0.8
    emissive: tuple[float, float, float] = (0.0, 0.0, 0.0)  # linear; above 1 for what is brighter than white
    double_sided: bool = False
    alpha_mode: str = "OPAQUE"  # OPAQUE (alpha of factor, picture and vertex colours does not count), MASK or BLEND
    alpha_cutoff: float = 0.5
    textures: Mapping[str, Texture] = field(default_factory=dict)  # slot of TEXTURE_SLOTS -> image
    unlit: bool = False  # the base colour is shown as it is, without light

    def __post_init__(self) -> None:
        unknown = set(self.textures) - set(TEXTURE_SLOTS)
        if unknown:
            raise ValueError(f"material {self.name!r}: texture slots {sorted(unknown)}, valid are {TEXTURE_SLOTS}")

    @property
    def opacity(self) -> float:
        """Return the opacity of the factor, 0..1, as far as alpha_mode lets it count; every writer obeys this."""
        alpha = self.base_color[3]
        return {"BLEND": alpha, "MASK": float(alpha >= self.alpha_cutoff)}.get(self.alpha_mode, 1.0)


@dataclass(frozen=True)
class Node:
    """One placed geometry of the source's scene graph; each instance counts once per placement."""

    name: str  # the name of the object in the file; unique within a mesh
    geometry: str = ""  # the geometry's name in the file, shared by instances
    joint: int = -1  # index into the mesh's joints of the one that moves this node, -1 = none
    path: tuple[str, ...] = ()  # names in the file from the scene's root to this node, each node's unique; () for (name,)
    pivot: tuple[float, float, float] | None = None  # its origin in the mesh's frame, where this tells about what it turns


def _check_range(name: str, numbers: np.ndarray, low: int, end: int) -> None:
    least, most = int(numbers.min()), int(numbers.max())
    if least < low or most >= end:
        raise ValueError(f"{name} must lie in {low}..{end - 1}, found {least if least < low else most}")


def _cofactors(linear: np.ndarray) -> np.ndarray:
    """Return the matrix that transforms normals, up to a factor; it also exists for a transform that flattens the mesh."""
    x, y, z = linear.T
    return np.stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)], 1)


@dataclass(frozen=True, eq=False)
class Mesh(Brief):
    """Triangles of the whole object in one frame, with the node and material of every face.

    vertices: (V, 3) [units of its frame]; faces: (F, 3) into vertices; face_node: (F,) into nodes;
    face_material: (F,) into materials, -1 = none. Corner attributes are per face corner, or None when the source has none:
    corner_uv (F, 3, 2), v up as in OBJ; corner_color (F, 3, 4) sRGB and alpha 0..255; corner_normal (F, 3, 3) unit;
    corner_more_uv (F, 3, 2n) n further sets of texture coordinates, side by side.
    """

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]
    face_node: Int[np.ndarray, " F"]
    nodes: tuple[Node, ...]
    face_material: Int[np.ndarray, " F"]
    materials: tuple[Material, ...] = ()
    corner_uv: Float32[np.ndarray, "F 3 2"] | None = None
    corner_color: UInt8[np.ndarray, "F 3 4"] | None = None
    corner_normal: Float32[np.ndarray, "F 3 3"] | None = None
    joints: tuple[StatedJoint, ...] = ()  # that the file states, parents before the joints that they carry
    corner_more_uv: Float32[np.ndarray, "F 3 n"] | None = None

    def __post_init__(self) -> None:
        count = len(self.faces)
        if count == 0:
            raise ValueError("a mesh needs at least one face, found none")
        if not np.isfinite(self.vertices).all():
            raise ValueError("vertices must be finite")
        for name in ("face_node", "face_material", "corner_uv", "corner_color", "corner_normal", "corner_more_uv"):
            value = getattr(self, name)
            if value is not None and len(value) != count:
                raise ValueError(f"{name} must have one row per face ({count}), found {len(value)}")
        _check_range("face indices", self.faces, 0, len(self.vertices))
        _check_range("face_node", self.face_node, 0, len(self.nodes))
        _check_range("face_material", self.face_material, -1, len(self.materials))
        _check_range("joints of nodes", np.array([node.joint for node in self.nodes]), -1, len(self.joints))

    @cached_property
    def triangles(self) -> Float[np.ndarray, "F 3 3"]:
        """Return the corner positions of each face [m]."""
        return corners_of(self.vertices, self.faces)

    @cached_property
    def face_pivot(self) -> Float[np.ndarray, "F 3"] | None:
        """Return the pivot of each face's node, NaN where it has none; None if no node has one."""
        pivots = [(np.nan,) * 3 if node.pivot is None else node.pivot for node in self.nodes]
        return None if np.isnan(pivots).all() else np.array(pivots)[self.face_node]

    @cached_property
    def face_areas(self) -> Float[np.ndarray, " F"]:
        """Return the area of each face [m^2]."""
        return normals_and_areas(self.triangles)[1]

    @cached_property
    def face_normals(self) -> Float[np.ndarray, "F 3"]:
        """Return the unit normal of each face, zero where it has no area."""
        return normals_and_areas(self.triangles)[0]

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Return the axis-aligned bounds of all used vertices [m]."""
        used = np.zeros(len(self.vertices), bool)
        used[self.faces] = True
        return bounds_of(self.vertices[used])

    @property
    def extents(self) -> Float[np.ndarray, " 3"]:
        """Return the side lengths of the axis-aligned box [m]."""
        return self.bounds[1] - self.bounds[0]

    @property
    def diagonal(self) -> float:
        """Return the diagonal of the axis-aligned box [m]."""
        return float(np.linalg.norm(self.extents))

    def transformed(self, T: Float[np.ndarray, "4 4"]) -> Mesh:
        """Return the mesh under a 4x4 affine transform; a mirroring one also flips the faces."""
        linear = T[:3, :3]
        mirrored = np.linalg.det(linear) < 0
        order = [0, 2, 1] if mirrored else [0, 1, 2]

        def corners(a):
            return None if a is None else np.ascontiguousarray(a[:, order])

        normal = corners(self.corner_normal)
        if normal is not None:
            normal = normal.astype(np.float64) @ _cofactors(linear).T * (-1.0 if mirrored else 1.0)
            length = np.linalg.norm(normal, axis=2, keepdims=True)
            normal = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0).astype(np.float32)

        def moved(node: Node) -> Node:
            return node if node.pivot is None else replace(node, pivot=tuple((linear @ node.pivot + T[:3, 3]).tolist()))

        return replace(
            self,
            nodes=tuple(map(moved, self.nodes)),
            vertices=self.vertices @ linear.T + T[:3, 3],
            faces=np.ascontiguousarray(self.faces[:, order]),
            corner_uv=corners(self.corner_uv),
            corner_color=corners(self.corner_color),
            corner_normal=normal,
            joints=tuple(joint.transformed(T) for joint in self.joints),
            corner_more_uv=corners(self.corner_more_uv),
        )

    def without_joints(self) -> Mesh:
        """Return the mesh without the joints and pivots that its file states."""
        return replace(self, nodes=tuple(replace(node, joint=-1, pivot=None) for node in self.nodes), joints=())

    def subset(self, faces: Int[np.ndarray, " n"] | Bool[np.ndarray, " F"]) -> Mesh:
        """Return the mesh of some faces (indices or mask), without unused vertices; nodes, materials and joints are kept."""
        chosen = self.faces[faces]
        used, inverse = np.unique(chosen, return_inverse=True)

        def rows(a):
            return None if a is None else a[faces]

        return replace(
            self,
            vertices=self.vertices[used],
            faces=inverse.reshape(-1, 3),
            face_node=self.face_node[faces],
            face_material=self.face_material[faces],
            corner_uv=rows(self.corner_uv),
            corner_color=rows(self.corner_color),
            corner_normal=rows(self.corner_normal),
            corner_more_uv=rows(self.corner_more_uv),
        )


def to_linear(srgb: np.ndarray | Sequence[float]) -> Float[np.ndarray, ...]:
    """Convert sRGB channels to linear ones; values outside 0..1 are clipped."""
    c = np.clip(np.asarray(srgb, np.float64), 0, 1)
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def to_srgb(linear: np.ndarray | Sequence[float]) -> Float[np.ndarray, ...]:
    """Convert linear channels to sRGB ones; values outside 0..1 are clipped."""
    c = np.clip(np.asarray(linear, np.float64), 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * np.maximum(c, 1e-9) ** (1 / 2.4) - 0.055)


@dataclass(frozen=True, eq=False)
class Box(Brief):
    """A box. center [m]; rotation: columns are the box's axes in the link frame, right-handed; size: full side lengths [m]."""

    center: Float[np.ndarray, " 3"]
    rotation: Float[np.ndarray, "3 3"]
    size: Float[np.ndarray, " 3"]


@dataclass(frozen=True, eq=False)
class Cylinder(Brief):
    """A cylinder.

    center [m]; rotation: columns are its axes in the link frame, the last one along the cylinder; radius, length [m].
    """

    center: Float[np.ndarray, " 3"]
    rotation: Float[np.ndarray, "3 3"]
    radius: float
    length: float


@dataclass(frozen=True, eq=False)
class Hull(Brief):
    """A convex polyhedron. vertices [m]; faces: outward triangles into them."""

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]


Shape = Box | Cylinder | Hull
