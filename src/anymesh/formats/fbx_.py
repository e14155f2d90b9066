"""FBX, binary and ASCII, by ufbx: the placed meshes of the scene at rest, and the joints that animations state."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from jaxtyping import Float
from scipy.spatial.transform import Rotation

from anymesh.errors import InputError, MissingExtraError
from anymesh.formats.advice import needs_extra
from anymesh.formats.fbx_materials_ import FbxLook, FbxMaterials, elements
from anymesh.formats.polygons_ import fans, recut
from anymesh.loading.files import MAX_FACES, FileMesh, Folder
from anymesh.loading.join import join, rgba, unique_names, unit
from anymesh.stated.animated import Animations, NodeTrack, SceneNode, animated_joints
from anymesh.types import Brief, Mesh, Node

LEFT_OUT = {
    "nurbs_surfaces": "NURBS surfaces", "nurbs_curves": "curves", "line_curves": "curves",
    "procedural_geometries": "procedural shapes", "cache_deformers": "deformations by a cache (the shape at rest is read)",
}  # fmt: skip
MAX_SAMPLED = 2000  # keys of one node's animation that are looked at


def load_ufbx() -> ModuleType:
    """Import ufbx. Raise MissingExtraError without it."""
    try:
        import ufbx
    except ImportError as error:
        raise MissingExtraError(needs_extra("ufbx")) from error
    return ufbx


def read_fbx(folder: Folder, work: Path) -> FileMesh:
    """Return the scene in the coordinates of the file, with its up axis and unit. work: not used.

    Raise InputError if it is not valid, MissingExtraError without ufbx.
    """
    ufbx = load_ufbx()
    name = folder.path.name
    try:
        scene = ufbx.load_file(
            str(folder.path), evaluate_skinning=True, load_external_files=False, allow_missing_vertex_position=True,
            index_error_handling=ufbx.IndexErrorHandling.NO_INDEX, node_depth_limit=1000, generate_missing_normals=False,
        )  # fmt: skip
    except ufbx.UfbxError as error:
        cause = f"{type(error).__name__}: {error}"[:150]
        raise InputError(f"{name} is not a valid FBX file, it is broken or truncated, or older than FBX 6 ({cause})") from None
    axes, meters = scene.settings.axes, float(scene.settings.unit_meters)
    reader = FbxScene(ufbx, scene, folder)
    mesh = reader.read()
    up = str(axes.up.name)
    if _is_left_handed(axes):
        folder.warn("the file's axes are left-handed: the mesh is mirrored")
        mesh = mesh.transformed(np.diag([-1.0, 1, 1, 1]) if up.endswith("_X") is False else np.diag([1.0, -1, 1, 1]))
    stated = up.startswith("POSITIVE") or up == "UNKNOWN"
    return FileMesh(
        mesh, (up[-1].lower() if up != "UNKNOWN" else "y") if stated else None,
        meters if np.isfinite(meters) and meters > 0 else None,
    )  # fmt: skip


def _is_left_handed(axes: Any) -> bool:
    rows = []
    for axis in (axes.right, axes.up, axes.front):
        if axis.name == "UNKNOWN":
            return False
        rows.append((1 if axis.name.startswith("POSITIVE") else -1) * np.eye(3)["XYZ".index(axis.name[-1])])
    return bool(np.linalg.det(np.array(rows)) < 0)


def matrix(m: Any) -> Float[np.ndarray, "4 4"]:
    """Return a matrix of ufbx, whose columns are vectors."""
    T = np.eye(4)
    T[:3] = np.array([m.c0, m.c1, m.c2, m.c3], np.float64).T
    return T


def numbers(listed: Any, kind: type, width: int) -> np.ndarray:
    """Return a list of ufbx as (n, width), or (n,) for width 0; item by item, since up to 0.0.5 its buffers crash."""
    return np.array(list(listed), kind).reshape((-1, width) if width else (-1,))


@dataclass(frozen=True, eq=False)
class FbxPolygons(Brief):
    """Triangles of a mesh: faces (F, 3) into its vertices, polygon (F,) of the file and corner (F, 3) of all its corners."""

    faces: np.ndarray
    polygon: np.ndarray
    corner: np.ndarray


class FbxScene:
    """Reads the nodes of a scene, in the order of the file."""

    def __init__(self, ufbx: Any, scene: Any, folder: Folder) -> None:
        self._ufbx, self._scene, self._folder = ufbx, scene, folder
        self._materials = FbxMaterials(ufbx, scene, folder)
        self._polygons: dict[int, FbxPolygons | None] = {}
        self._left_out: Counter[str] = Counter()
        self._nodes = elements(scene.nodes)
        labels = [str(n.name) or f"node_{k}" for k, n in enumerate(self._nodes)]
        self._names = dict(zip([n.typed_id for n in self._nodes], unique_names(labels), strict=True))
        self._hidden = self._find_hidden()

    def read(self) -> Mesh:
        """Return what is drawn, with its joints. Raise InputError if there is nothing, or too much."""
        name, placed, home, faces = self._folder.path.name, list[Mesh](), list[int | None](), 0
        for node in self._nodes:
            if node.mesh is None:
                continue
            if node.typed_id in self._hidden:
                self._left_out[self._hidden[node.typed_id]] += 1
                continue
            mesh = self._placed(node)
            if mesh is None:
                self._left_out["meshes without faces"] += 1
                continue
            faces += len(mesh.faces)
            if faces > MAX_FACES:
                raise InputError(f"{name} has more than {MAX_FACES} faces; at most that are handled")
            placed.append(mesh)
            home.append(self._carrier(node))
        for kind, what in LEFT_OUT.items():
            self._left_out[what] += len(getattr(self._scene, kind))
        for what, count in self._left_out.items():
            if count:
                self._folder.warn(f"left out: {count} {what}")
        for warning in elements(self._scene.metadata.warnings):
            self._folder.warn(f"the file has a fault: {str(warning.description)[:100]}")
        if not placed:
            reasons = f" ({'; '.join(self._folder.warnings)})" if self._folder.warnings else ""
            raise InputError(f"{name}: found no triangles in its scene; at least one is needed{reasons}")
        mesh = join(placed)
        return self._with_joints(mesh, home) if self._folder.joints else mesh

    def _find_hidden(self) -> dict[int, str]:
        """Return why nodes are not drawn, parents before their children."""
        hidden: dict[int, str] = {}
        groups = [n for group in elements(self._scene.lod_groups) for n in elements(group.instances)]
        levels = {child.typed_id for n in groups for child in elements(n.children)[1:]}
        for node in self._nodes:
            if node.parent is not None and node.parent.typed_id in hidden:
                hidden[node.typed_id] = hidden[node.parent.typed_id]
            elif not node.visible:
                hidden[node.typed_id] = "invisible meshes"
            elif node.typed_id in levels:
                hidden[node.typed_id] = "meshes of coarser levels of detail"
        return hidden

    def _path(self, node: Any) -> tuple[str, ...]:
        path: list[str] = []
        while node is not None and not node.is_root:
            path.append(self._names[node.typed_id])
            node = node.parent
        return tuple(reversed(path))

    def _carrier(self, node: Any) -> int:
        """Return the node that carries a mesh: the bone, if a single one moves all of it, else itself."""
        skins = elements(node.mesh.skin_deformers)
        bones = [c.bone_node for skin in skins for c in elements(skin.clusters) if c.num_weights and c.bone_node is not None]
        return int(bones[0].typed_id) if len({b.typed_id for b in bones}) == 1 else int(node.typed_id)

    def _placed(self, node: Any) -> Mesh | None:
        """Return the mesh of a node in the frame of the scene, at its rest pose."""
        source = node.mesh
        polygons = self._triangles(source)
        if polygons is None:
            return None
        T, vertices = matrix(node.geometry_to_world), numbers(source.vertices, np.float64, 3)
        if not np.isfinite(T).all():
            raise InputError(f"{self._folder.path.name}: node {node.name!r} has a transform that is not finite")
        deformed = len(source.skin_deformers) or len(source.blend_deformers)
        if deformed and source.skinned_position.exists:
            values = numbers(source.skinned_position.values, np.float64, 3)
            if len(values) == len(vertices) and np.isfinite(values).all():
                vertices, T = values, T if source.skinned_is_local else np.eye(4)
        finite = np.asarray(np.isfinite(vertices).all(1))
        faces = polygons.faces
        vertices = np.where(finite[:, None], vertices, 0.0)
        looks, face_look = self._looks(node, polygons)
        uv = self._coordinates(source, polygons, looks, face_look)
        name, label = str(node.name) or self._names[node.typed_id], str(source.name) or self._names[node.typed_id]
        colors = self._colors(source, polygons, looks, face_look)
        path = self._path(node)
        placed = Mesh(
            vertices, faces, np.zeros(len(faces), np.int64), (Node(name, label, path=path if len(path) > 1 else ()),),
            face_look, tuple(look.material for look in looks), None if uv is None else uv[..., :2], colors,
            self._corner_normals(source, polygons, bool(deformed)),
            corner_more_uv=None if uv is None or uv.shape[2] == 2 else uv[..., 2:],
        ).transformed(T)  # fmt: skip
        pivot = None if deformed else _pivot(node)
        return replace(placed, nodes=(replace(placed.nodes[0], pivot=pivot),))

    def _triangles(self, source: Any) -> FbxPolygons | None:
        key = int(source.typed_id)
        if key not in self._polygons:
            self._polygons[key] = self._cut(source)
        return self._polygons[key]

    def _cut(self, source: Any) -> FbxPolygons | None:
        table = numbers(source.faces, np.int64, 2)  # first corner and count
        index = numbers(source.vertex_indices, np.int64, 0)
        points = numbers(source.vertices, np.float64, 3)
        if not len(table) or not len(points) or not len(index):
            return None
        counts = table[:, 1]
        order = np.repeat(table[:, 0] - (np.cumsum(counts) - counts), counts) + np.arange(counts.sum())
        used = index[order]
        wrong = (used < 0) | (used >= len(points))
        wrong[~wrong] = ~np.isfinite(points[used[~wrong]]).all(1)
        good = np.bincount(np.repeat(np.arange(len(counts)), counts), wrong, len(counts)) == 0
        if not good.all():
            self._folder.warn(f"{int((~good).sum())} faces of {source.name!r} left out: their points are missing")
        holes = numbers(source.face_hole, bool, 0)
        good &= ~holes if len(holes) == len(good) else True
        triangle, polygon = fans(counts)
        triangle = recut(triangle, polygon, counts, np.nan_to_num(points), used)
        triangle, polygon = triangle[good[polygon]], polygon[good[polygon]]
        if int(source.subdivision_display_mode):
            self._left_out["subdivisions (the control cages are read as they are)"] += 1
        return FbxPolygons(used[triangle], polygon, order[triangle]) if len(triangle) else None

    def _looks(self, node: Any, polygons: FbxPolygons) -> tuple[list[FbxLook], np.ndarray]:
        """Return the materials of a node and the one of each triangle, -1 for none."""
        materials = elements(node.materials) or elements(node.mesh.materials)
        looks = [self._materials.read(m) for m in materials]
        of_polygon = numbers(node.mesh.face_material, np.int64, 0)
        if not looks:
            return [], np.full(len(polygons.polygon), -1, np.int64)
        if len(of_polygon) <= int(polygons.polygon.max()):
            return looks, np.zeros(len(polygons.polygon), np.int64)
        face_look = of_polygon[polygons.polygon]
        return looks, np.where(face_look < len(looks), face_look, -1)

    def _spread(self, attribute: Any, polygons: FbxPolygons, width: int) -> np.ndarray | None:
        """Return the values of a vertex attribute at the corners, (F, 3, width)."""
        if not attribute.exists:
            return None
        values = numbers(attribute.values, np.float64, width)
        index = numbers(attribute.indices, np.int64, 0)
        if not len(values) or polygons.corner.max() >= len(index):
            return None
        chosen = index[polygons.corner]
        return values[np.where((chosen >= 0) & (chosen < len(values)), chosen, 0)]

    def _coordinates(
        self, source: Any, polygons: FbxPolygons, looks: Sequence[FbxLook], face_look: np.ndarray
    ) -> np.ndarray | None:
        """Return the texture coordinates of the pictures of each triangle's material, (F, 3, 2n)."""
        sets = {str(s.name): s for s in elements(source.uv_sets)}
        if not sets:
            return None
        width = max([len(look.sets) for look in looks] + [1])
        uv = np.zeros((len(polygons.faces), 3, 2 * width), np.float32)
        spread: dict[str, np.ndarray | None] = {}
        for number in np.unique(face_look):
            chosen = face_look == number
            for k, (name, transform) in enumerate((looks[number].sets if number >= 0 else ()) or (("", None),)):
                real = name if name in sets else next(iter(sets))
                if real not in spread:
                    spread[real] = self._spread(sets[real].vertex_uv, polygons, 2)
                values = spread[real]
                if values is None:
                    continue
                if transform is not None:
                    T = np.array(transform).reshape(2, 3)
                    values = values @ T[:, :2].T + T[:, 2]
                uv[chosen, :, 2 * k : 2 * k + 2] = np.nan_to_num(values[chosen])
        return uv

    def _colors(self, source: Any, polygons: FbxPolygons, looks: Sequence[FbxLook], face_look: np.ndarray) -> np.ndarray | None:
        """Return vertex colours, which count where a face has no picture; white ones say nothing."""
        values = self._spread(source.vertex_color, polygons, 4)
        if values is None:
            return None
        pictured = np.array([bool(look.material.textures) for look in looks] + [False])
        colors = rgba(np.nan_to_num(values).clip(0, 1).reshape(-1, 4)).reshape(-1, 3, 4)
        colors[pictured[face_look]] = 255
        return colors if (colors[..., :3] < 255).any() else None

    def _corner_normals(self, source: Any, polygons: FbxPolygons, deformed: bool) -> np.ndarray | None:
        attribute = source.skinned_normal if deformed and source.skinned_normal.exists else source.vertex_normal
        values = self._spread(attribute, polygons, 3)
        normals = None if values is None or deformed else unit(values.reshape(-1, 3))
        return None if normals is None else normals.reshape(-1, 3, 3)

    def _with_joints(self, mesh: Mesh, home: Sequence[int | None]) -> Mesh:
        """Return the mesh with the joints that animations of nodes state."""
        tracks = [(str(stack.name), self._tracks(stack)) for stack in elements(self._scene.anim_stacks)]
        animations: Animations = [(name, moved) for name, moved in tracks if moved]
        if not animations:
            return mesh
        nodes = {
            int(n.typed_id): SceneNode(
                self._names[n.typed_id], None if n.parent is None else int(n.parent.typed_id),
                np.eye(4) if n.parent is None else matrix(n.parent.node_to_world), matrix(n.node_to_world),
            )
            for n in self._nodes
        }  # fmt: skip
        return animated_joints(mesh, home, nodes, animations, self._folder)

    def _tracks(self, stack: Any) -> dict[int, NodeTrack]:
        """Return how an animation moves nodes, from its keys as ufbx resamples them."""
        baked = self._ufbx.bake_anim(self._scene, stack.anim)
        tracks = {}
        for moved in elements(baked.nodes):
            kinds = (moved.translation_keys, moved.rotation_keys, moved.scale_keys)
            keys = [[(float(k.time), *map(float, k.value)) for k in elements(listed)] for listed in kinds]
            times = np.unique([row[0] for rows in keys for row in rows])
            if all(keys) and len(times) > 1 and all(np.isfinite(rows).all() for rows in keys):
                chosen = np.unique(np.linspace(0, len(times) - 1, min(len(times), MAX_SAMPLED)).astype(int))
                tracks[int(moved.typed_id)] = NodeTrack(times[chosen], _sampler(*(np.array(rows) for rows in keys)))
        return tracks


def _pivot(node: Any) -> tuple[float, float, float] | None:
    """Return the point about which a node turns, in the frame of the scene: its rotation pivot, by default its origin."""
    stated = {str(p.name): np.array(list(p.value_vec4)[:3], np.float64) for p in elements(node.props.props)}
    offset, scaling, turning = (stated.get(key, np.zeros(3)) for key in ("ScalingOffset", "ScalingPivot", "RotationPivot"))
    scale = np.array(list(node.local_transform.scale), np.float64)
    with np.errstate(all="ignore"):
        local = scaling + (turning - offset - scaling) / scale  # what the scale moves to the rotation pivot
        point = matrix(node.node_to_world) @ [*local, 1]
    return tuple(point[:3].tolist()) if np.isfinite(point).all() else None


def _sampler(
    places: np.ndarray, turns: np.ndarray, scales: np.ndarray
) -> Callable[[Float[np.ndarray, " k"]], Float[np.ndarray, "k 4 4"]]:
    """Return the local transforms over time of keys, each a row of its time and its values."""
    for k in range(1, len(turns)):  # the short way round
        turns[k, 1:] *= 1.0 if turns[k, 1:] @ turns[k - 1, 1:] >= 0 else -1.0

    def at(rows: np.ndarray, when: np.ndarray) -> np.ndarray:
        return np.stack([np.interp(when, rows[:, 0], column) for column in rows[:, 1:].T], 1)

    def sample(when: Float[np.ndarray, " k"]) -> Float[np.ndarray, "k 4 4"]:
        T = np.tile(np.eye(4), (len(when), 1, 1))
        T[:, :3, :3] = Rotation.from_quat(at(turns, when)).as_matrix() * at(scales, when)[:, None]
        T[:, :3, 3] = at(places, when)
        return T

    return sample
