"""COLLADA 1.4 and 1.5: the placed geometries of the scene, without the file's up axis and unit.

Skins are read at their rest: vertices as the joints place them where the scene has them. What cannot be read is left out with
a warning, and does not keep the rest from being read.
"""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET
from collections import Counter
from dataclasses import replace

import numpy as np

from anymesh.errors import InputError
from anymesh.formats.credits import credits_in
from anymesh.formats.dae.geometry import DaeSurface, DaeTriangles, floats, skin_transforms, whole
from anymesh.formats.dae.materials import DaeMaterial, DaeMaterials
from anymesh.formats.dae.transforms import DaeNode, dae_joints, local_transform
from anymesh.loading.files import MAX_FACES, Folder
from anymesh.loading.join import join, rgba, simple_mesh, unique_names, unit
from anymesh.types import Material, Mesh, Node

INTEGER, WITH_COMMA = rb"[+-]?\d+", rb"[+-]?\d+,\d+(?:[eE][+-]?\d+)?"
NUMBERS_WITH_COMMAS = re.compile(
    rb"(?:>|\bmeter\s*=\s*[\"'])\s*(?:%(int)b\s+)*%(comma)b(?:\s+(?:%(comma)b|%(int)b))*\s*[<\"']"
    % {b"int": INTEGER, b"comma": WITH_COMMA}
)
ENCODINGS = ("utf-8", "us-ascii", "ascii", "iso-8859-1", "iso-8859-15", "windows-1252")  # supersets of ASCII
MAX_NODES = 50_000  # placed nodes; CAD assemblies have some thousand
MAX_DEPTH = 500  # nodes within each other
FRAMES = {  # right, up and towards the viewer, as columns
    "X_UP": ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "Y_UP": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "Z_UP": ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
}
NOT_READ = {  # elements without a counterpart, by what they hold
    "library_kinematics_models": "kinematics",
    "library_articulated_systems": "kinematics",
    "library_physics_models": "physics",
    "library_force_fields": "physics",
}
Binding = dict[str, tuple[str, dict[str, int]]]  # symbol -> URL of its material, and set of coordinates by its name


def read_dae(data: bytes, folder: Folder) -> Mesh:
    """Return the scene in file coordinates. Raise InputError if it is not valid."""
    document = DaeDocument(data, folder)
    told = document.root.find("asset/contributor")
    folder.credits = credits_in("contributor", {} if told is None else {e.tag: e.text for e in told})
    placed = {number: made for number in range(len(document.nodes)) if (made := document.mesh(number)) is not None}
    document.warn_of_rest()
    if not placed:
        because = f" ({'; '.join(folder.warnings)})" if folder.warnings else ""
        raise InputError(f"{folder.path.name}: found no triangles in its scene; at least one is needed{because}")
    mesh = join(list(placed.values()))
    if folder.joints and document.root.find("library_animations") is not None:
        return dae_joints(mesh, list(placed), document.nodes, document.root, document.find, folder)
    return mesh


def parse_dae(name: str, data: bytes) -> ET.Element:
    """Return the document, with tags without namespaces. Raise InputError if it cannot be read."""
    declared = re.match(rb"""(?:\xef\xbb\xbf)?\s*<\?xml[^>]*?encoding\s*=\s*["']([^"']*)""", data)
    encoding = declared[1].decode("ascii", "replace").lower() if declared else "utf-8"
    if b"\0" in data or encoding not in ENCODINGS:  # other encodings could hide a document type in other bytes
        content = f"a zero byte at {data.index(0)}" if b"\0" in data else f"the encoding {encoding[:40]}"
        raise InputError(f"{name}: found {content}; valid is text in {', '.join(ENCODINGS)}")
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise InputError(f"{name} declares a document type; a COLLADA file needs none, and it is not read")
    try:
        root = ET.fromstring(with_decimal_points(data))
    except (ET.ParseError, ValueError, LookupError) as error:
        raise InputError(f"{name}: its XML is broken or truncated ({error})") from None
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    return root


def with_decimal_points(data: bytes) -> bytes:
    """Return a document with points for the decimal commas that exporters write in some countries' settings.

    Only the unit, and texts that are nothing but such numbers and integers, separated by spaces, are changed.
    """
    return NUMBERS_WITH_COMMAS.sub(lambda match: match[0].replace(b",", b"."), data)


def dae_frame(data: bytes) -> tuple[str, float | None]:
    """Return the up axis ("x", "y" or "z") and the unit [m] of a file that was read; None if it states none."""
    for _, element in ET.iterparse(io.BytesIO(with_decimal_points(data[: 1 << 20]) + data[1 << 20 :])):
        element.tag = element.tag.rpartition("}")[2]
        if element.tag == "asset":
            up, metres = _asset(element)
            return {"X_UP": "x", "Z_UP": "z"}.get(up or "", "y"), metres
    return "y", None


def _asset(asset: ET.Element) -> tuple[str | None, float | None]:
    up, scale = (asset.findtext("up_axis") or "").strip(), asset.find("unit")
    metres = floats("" if scale is None else scale.get("meter", ""))
    known = len(metres) == 1 and np.isfinite(metres[0]) and metres[0] > 0
    return up if up in FRAMES else None, float(metres[0]) if known else None


class DaeDocument:
    """A parsed file. root: its elements, tags without namespaces; nodes: of the scene, parents first, in the file's order.

    Raise InputError if it is not XML, or holds a circle or too many nodes.
    """

    def __init__(self, data: bytes, folder: Folder) -> None:
        self.folder, self.name = folder, folder.path.name
        self.root = parse_dae(self.name, data)
        if NUMBERS_WITH_COMMAS.search(data):
            folder.warn("found decimal commas, which are taken for points")
        self._by_id: dict[tuple[str, str], ET.Element] = {}
        for element in self.root.iter():
            self._by_id.setdefault((element.tag, element.get("id", "")), element)
        self._asset = _asset(next(self.root.iter("asset"), ET.Element("asset")))
        self.counts: Counter[str] = Counter()  # what is left out
        self._surfaces: dict[int, DaeSurface] = {}
        self._meshes: dict[tuple[int, str], Mesh | None] = {}
        self._materials = DaeMaterials(self.find, self.root, folder)
        self._faces = 0
        self.nodes = self._placed()
        self._poses = {id(node.element): node.T for node in reversed(self.nodes)}
        self._names = unique_names(_label(node.element) or "node" for node in self.nodes)

    def find(self, tag: str, url: str | None) -> ET.Element | None:
        """Return the element with a tag that "#id" refers to; None if it is not in this file."""
        return self._by_id.get((tag, (url or "").strip().removeprefix("#"))) if url else None

    def _scene(self) -> ET.Element:
        scenes = list(self.root.iter("visual_scene"))
        instance = self.root.find("scene/instance_visual_scene")
        shown = None if instance is None else self.find("visual_scene", instance.get("url"))
        if shown is None and scenes:
            shown = scenes[0]
            self.folder.warn("the file does not say which scene is shown; the first one is read")
        if len(scenes) > 1:
            self.folder.warn(f"the file has {len(scenes)} scenes; only the one that is shown is read")
        if shown is None:  # all geometries as they are
            shown = ET.Element("visual_scene")
            for geometry in self.root.iter("geometry"):
                node = ET.SubElement(shown, "node", dict(geometry.attrib))
                ET.SubElement(node, "instance_geometry", url=f"#{geometry.get('id')}")
            self.folder.warn("the file has no scene; its geometries are read where they are")
        return shown

    def _placed(self) -> list[DaeNode]:
        scene, placed, count = self._scene(), [], 0
        waiting: list[tuple[ET.Element, tuple[int, ...], np.ndarray]] = [(scene, (), np.eye(4))]
        while waiting:
            element, chain, T = waiting.pop()
            count += 1
            if count > MAX_NODES or len(chain) > MAX_DEPTH:
                raise InputError(f"{self.name}: found over {MAX_NODES} placed nodes, or {MAX_DEPTH} within each other")
            if any(placed[k].element is element for k in chain):
                raise InputError(f"{self.name}: node {_label(element)!r} contains itself; valid is a tree of nodes")
            if (element.findtext("extra/technique/visibility") or "1").strip() in ("0", "0.0", "false"):
                self.counts["hidden nodes"] += 1
                continue
            T = T @ self._conversion(element) @ local_transform(element)
            if not np.isfinite(T).all():
                self.counts["nodes with a transform that is not finite"] += 1
                continue
            if element is not scene:
                placed.append(DaeNode(element, chain[-1] if chain else -1, T))
                chain = (*chain, len(placed) - 1)
            inner = []
            for child in element:
                target = self.find("node", child.get("url")) if child.tag == "instance_node" else child
                if target is None:
                    self.counts["instances of nodes that are not in the file"] += 1
                elif target.tag == "node":
                    inner.append((target, chain, T))
            waiting += reversed(inner)
        return placed

    def _conversion(self, element: ET.Element) -> np.ndarray:
        """Return the transform from an element's own unit and up axis, if it has some, to those of the file."""
        T, asset = np.eye(4), element.find("asset")
        if asset is None:
            return T
        (up, metres), (file_up, file_metres) = _asset(asset), self._asset
        scale = metres / (file_metres or 1.0) if metres else 1.0
        T[:3, :3] = scale * np.array(FRAMES[file_up or "Y_UP"]) @ np.array(FRAMES[up or file_up or "Y_UP"]).T
        if not np.allclose(T, np.eye(4)):
            self.folder.warn("some elements have a unit or an up axis of their own, which is applied to them")
        return T

    def mesh(self, number: int) -> Mesh | None:
        """Return what one of the nodes places, as one node of the mesh; None if it has no triangles."""
        node, meshes = self.nodes[number], []
        for instance in node.element:
            if instance.tag == "instance_geometry":
                geometry = self._geometry(instance, "geometry", instance.get("url"))
                meshes += [] if geometry is None else [geometry.transformed(node.T)]
            elif instance.tag == "instance_controller":
                meshes += [m for m in [self._controlled(instance, node.T)] if m is not None]
        if not meshes:
            return None
        self._faces += sum(len(m.faces) for m in meshes)
        if self._faces > MAX_FACES:
            raise InputError(f"{self.name} has over {MAX_FACES} faces; at most {MAX_FACES} are handled")
        mesh = meshes[0] if len(meshes) == 1 else join(meshes)
        geometry = mesh.nodes[0].geometry
        path, above = [self._names[number]], node.parent
        while above >= 0:
            path.append(self._names[above])
            above = self.nodes[above].parent
        pivot = tuple(node.T[:3, 3].tolist())
        made = Node(_label(node.element) or geometry, geometry, path=tuple(path[::-1]) if len(path) > 1 else (), pivot=pivot)
        return replace(mesh, face_node=np.zeros(len(mesh.faces), np.int64), nodes=(made,))

    def _geometry(self, instance: ET.Element, tag: str, url: str | None) -> Mesh | None:
        """Return a geometry with the materials of its instance, in the unit of the file."""
        geometry = self.find(tag, url)
        if geometry is None:
            self.counts["instances of geometries that are not in the file"] += 1
            return None
        binding = _binding(instance)
        key = (id(geometry), repr(binding))
        if key not in self._meshes:
            if id(geometry) not in self._surfaces:
                self._surfaces[id(geometry)] = DaeSurface(geometry, self.find, self.counts)
            mesh = self._painted(geometry, self._surfaces[id(geometry)], binding)
            C = self._conversion(geometry)
            self._meshes[key] = mesh if mesh is None or (np.eye(4) == C).all() else mesh.transformed(C)
        return self._meshes[key]

    def _painted(self, geometry: ET.Element, surface: DaeSurface, binding: Binding) -> Mesh | None:
        label, where = _label(geometry), f"{self.name}, geometry {_label(geometry)!r}"
        double_sided = (geometry.findtext("extra/technique/double_sided") or "").strip() in ("1", "true")
        meshes = []
        for p in surface.primitives:
            url, sets = binding.get(p.symbol, (f"#{p.symbol}", {}))
            material = self.find("material", url)
            if material is None and p.symbol in binding:
                self.counts["instances of materials that are not in the file"] += 1
            made = DaeMaterial(None) if material is None else self._materials.of(material)
            used, faces = np.unique(p.faces, return_inverse=True)
            paint, uv, more_uv = _coordinates(p, made, sets)
            if paint is not None and double_sided and not paint.double_sided:
                paint = replace(paint, double_sided=True)
            meshes.append(
                simple_mesh(
                    where, label, surface.vertices[used], faces, paint, corner_uv=uv, corner_more_uv=more_uv,
                    corner_color=None if p.color is None else rgba(p.color[..., :3].reshape(-1, 3)).reshape(-1, 3, 4),
                    corner_normal=None if p.normal is None else unit(p.normal),
                )
            )  # fmt: skip
        if not meshes:
            return None
        vertices = np.where(np.isfinite(surface.vertices), surface.vertices, 0.0)  # those of no face
        mesh = replace(join(meshes), vertices=vertices, faces=np.concatenate([p.faces for p in surface.primitives]))
        return replace(mesh, face_node=np.zeros(len(mesh.faces), np.int64), nodes=(Node(label, label),))

    def _controlled(self, instance: ET.Element, T: np.ndarray) -> Mesh | None:
        """Return the geometry of a skin at rest, or of a morph without its targets, placed in the scene."""
        url, skins = instance.get("url"), []
        for _ in range(8):  # a skin of a morph of a geometry, or the reverse
            controller = self.find("controller", url)
            if controller is None:
                break
            kind = next((c for c in controller if c.tag in ("skin", "morph")), ET.Element("none"))
            url = kind.get("source")
            if kind.tag == "skin":
                skins.append(kind)
            else:
                self.folder.warn("morph targets are left out; the base shape is read")
        mesh = self._geometry(instance, "geometry", url)
        if mesh is None or not skins:
            return None if mesh is None else mesh.transformed(T)
        return self._skinned(mesh, skins[0], instance, T)

    def _skinned(self, mesh: Mesh, skin: ET.Element, instance: ET.Element, T: np.ndarray) -> Mesh:
        bind = floats(skin.findtext("bind_shape_matrix") or "")
        mesh = mesh.transformed(bind.reshape(4, 4) if len(bind) == 16 and np.isfinite(bind).all() else np.eye(4))
        roots = [r for s in instance.findall("skeleton") if (r := self.find("node", s.text)) is not None] or [self.root]
        placed = skin_transforms(skin, roots, self._poses, self.find, len(mesh.vertices))
        if placed is None:
            self.folder.warn("a skin has no usable joints; it is read as it was bound, at its node")
            return mesh.transformed(T)
        moved = np.einsum("vij,vj->vi", placed[:, :3, :3], mesh.vertices) + placed[:, :3, 3]
        normal = mesh.corner_normal
        if normal is not None:
            normal = unit(np.einsum("fcij,fcj->fci", placed[mesh.faces][:, :, :3, :3], normal))
        return replace(mesh, vertices=moved, corner_normal=normal)

    def warn_of_rest(self) -> None:
        """Warn of what was left out, once per kind, after the meshes were read."""
        for what, count in sorted(self.counts.items()):
            self.folder.warn(f"{count} {what} left out")
        for what in sorted({what for tag, what in NOT_READ.items() if self.root.find(tag) is not None}):
            self.folder.warn(f"the {what} of the file are not read")
        placed = len(self._surfaces)
        drawn = sum(1 for g in self.root.iter("geometry") if g.find("mesh") is not None)
        if drawn > placed:
            self.folder.warn(f"{drawn - placed} geometries are not placed in the scene, and are left out")


def _coordinates(
    p: DaeTriangles, made: DaeMaterial, sets: dict[str, int]
) -> tuple[Material | None, np.ndarray | None, np.ndarray | None]:
    """Return the material, with the texture coordinates of each picture numbered, and these: the first set, and the others."""
    first = next(iter(p.uv.values()), None)
    if first is None or made.material is None:
        return made.material, None if first is None else _pairs(first).astype(np.float32), None
    placed: list[np.ndarray] = []
    known: dict[str, int] = {}
    textures = dict(made.material.textures)
    for slot, (name, repeat, offset) in made.places.items():
        number = sets.get(name, -1)
        key = f"{number if number in p.uv else -1} {repeat} {offset}"
        if key not in known:
            known[key] = len(placed)
            placed.append((_pairs(p.uv.get(number, first)) * repeat + offset).astype(np.float32))
        textures[slot] = replace(textures[slot], uv_set=known[key])
    placed = placed or [_pairs(first).astype(np.float32)]
    return replace(made.material, textures=textures), placed[0], np.concatenate(placed[1:], 2) if len(placed) > 1 else None


def _pairs(uv: np.ndarray) -> np.ndarray:
    return np.nan_to_num(uv[..., :2] if uv.shape[-1] > 1 else np.repeat(uv, 2, -1))


def _label(element: ET.Element) -> str:
    return element.get("name") or element.get("id") or element.get("sid") or ""


def _binding(instance: ET.Element) -> Binding:
    binding: Binding = {}
    for m in instance.iter("instance_material"):
        inputs = m.findall("bind_vertex_input")
        sets = {b.get("semantic", ""): whole(b, "input_set") for b in inputs}
        binding[m.get("symbol", "")] = (m.get("target", ""), sets)
    return binding
