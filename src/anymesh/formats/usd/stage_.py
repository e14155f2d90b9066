"""USD, USDA, USDC and USDZ by OpenUSD: all that is drawn of the composed stage at rest, and the joints of UsdPhysics."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.errors import InputError
from anymesh.formats.credits import credits_in
from anymesh.formats.usd.geometry_ import PRIMITIVES, UsdTriangles, array, kind_of, polygon_mesh, primitive, value
from anymesh.formats.usd.joints_ import add_animated_joints, add_joints
from anymesh.formats.usd.layers_ import Layers, load_pxr
from anymesh.formats.usd.materials_ import UV_NAMES, StageMaterials, UsdLook
from anymesh.loading.files import MAX_FACES, FileMesh, Folder
from anymesh.loading.join import join, rgba, unit
from anymesh.types import Brief, Material, Mesh, Node
from anymesh.types.mesh import to_srgb

LEFT_OUT = {
    "BasisCurves": "curves", "NurbsCurves": "curves", "HermiteCurves": "curves", "NurbsPatch": "NURBS surfaces",
    "Points": "points", "TetMesh": "tetrahedral meshes", "Volume": "volumes",
}  # fmt: skip
HIDDEN_PURPOSES = ("proxy", "guide")
MAX_PLACED = 200_000  # placements of prims
CENTIMETRES = 0.01  # [m] the unit of a stage that states none
PLAUSIBLE = (0.02, 12.0)  # [m] diagonals for which that is believed


def read_usd(folder: Folder, work: Path) -> FileMesh:
    """Return the stage in its own coordinates, with its up axis and unit. work: an empty folder for unpacked archives.

    Raise InputError if it is not valid, MissingExtraError without OpenUSD.
    """
    pxr = load_pxr()
    layers = Layers(folder, work)
    stage = pxr.Usd.Stage.Open(layers.root)
    reader = StageReader(pxr, stage, layers, folder)
    folder.credits = credits_in("customLayerData", stage.GetRootLayer().customLayerData.get("credits", {}))
    placed = reader.read()
    mesh = join([p.mesh for p in placed])
    if folder.joints:
        paths = [p.path for p in placed]
        mesh = add_joints(pxr, stage, mesh, paths, reader.to_stage, folder.warn)
        mesh = mesh if mesh.joints else add_animated_joints(pxr, stage, mesh, paths, reader.to_stage, folder)
    stated = stage.GetMetadata("metersPerUnit") if stage.HasAuthoredMetadata("metersPerUnit") else None  # of any number's type
    unit_in_metres = float(stated) if isinstance(stated, int | float) else None
    if unit_in_metres is None:
        believed = PLAUSIBLE[0] <= mesh.diagonal * CENTIMETRES <= PLAUSIBLE[1]
        unit_in_metres = CENTIMETRES if believed else None
        what = "the format's centimetres are taken" if believed else "in the format's centimetres it is no plausible size"
        folder.warn(f"the file states no metersPerUnit: {what}; if that is wrong, set it with --scale")
    elif not (np.isfinite(unit_in_metres) and unit_in_metres > 0):
        unit_in_metres = None
    up = str(stage.GetMetadata("upAxis") if stage.HasAuthoredMetadata("upAxis") else "Y").lower()
    return FileMesh(mesh, up if up in ("x", "y", "z") else "y", unit_in_metres)


@dataclass(frozen=True, eq=False)
class PlacedPrim:
    """The mesh of one prim in the frame of the stage. path: of the prim; in a point instancer, of that."""

    mesh: Mesh
    path: str


@dataclass(frozen=True, eq=False)
class _Visit(Brief):
    """A prim to be read: parent's transform, purpose inherited so far, and the point instancer that places it."""

    prim: Any
    T: Float[np.ndarray, "4 4"]
    purpose: str = "default"
    instancer: str = ""
    placed: bool = False  # whether T includes the prim's own transform


class StageReader:
    """Reads the prims of a stage: parents first, in their order."""

    def __init__(self, pxr: Any, stage: Any, layers: Layers, folder: Folder) -> None:
        self._pxr, self._stage, self._folder = pxr, stage, folder
        self._materials = StageMaterials(pxr, layers, folder)
        self._skins = pxr.UsdSkel.Cache()
        self._meshes: dict[tuple[Any, ...], Mesh | None] = {}
        self._left_out: Counter[str] = Counter()
        self._constants: dict[tuple[float, ...], int] = {}  # display colours that are materials
        self._placed: list[PlacedPrim] = []
        self._faces = 0

    def read(self) -> list[PlacedPrim]:
        """Return what is drawn. Raise InputError if there is nothing, or too much."""
        name = self._folder.path.name
        self._walk(HIDDEN_PURPOSES)
        if not self._placed and any("purpose" in what for what in self._left_out):
            self._left_out.clear()
            self._walk(("guide",))
        for what, count in self._left_out.items():
            self._folder.warn(f"left out: {count} {what}")
        if not self._placed:
            reasons = f" ({'; '.join(self._folder.warnings)})" if self._folder.warnings else ""
            raise InputError(f"{name}: found no triangles on its stage; at least one is needed{reasons}")
        return self._placed

    def _walk(self, hidden: tuple[str, ...]) -> None:
        usd = self._pxr.Usd
        drawn = usd.TraverseInstanceProxies(usd.PrimDefaultPredicate)
        prototypes = usd.TraverseInstanceProxies(usd.PrimIsActive & usd.PrimIsLoaded)  # may be classes, which are not drawn
        waiting = [_Visit(prim, np.eye(4)) for prim in reversed(self._stage.GetPseudoRoot().GetFilteredChildren(drawn))]
        while waiting:
            visit = waiting.pop()
            if len(self._placed) + len(waiting) > MAX_PLACED:
                raise InputError(f"{self._folder.path.name} places more than {MAX_PLACED} objects; at most that are read")
            prim, kind = visit.prim, kind_of(visit.prim)
            imageable = self._pxr.UsdGeom.Imageable(prim)
            purpose = visit.purpose
            if imageable:
                if value(imageable.GetVisibilityAttr()) == "invisible":
                    self._count_hidden(prim, drawn)
                    continue
                authored = imageable.GetPurposeAttr()
                purpose = str(value(authored)) if authored.HasAuthoredValue() else purpose
            T = visit.T if visit.placed else self._transform(prim, visit.T)
            if kind == "PointInstancer":
                waiting += reversed(self._instances(prim, T, purpose))
                continue
            self._add(prim, kind, T, purpose in hidden and purpose, visit.instancer)
            children = prim.GetFilteredChildren(prototypes if visit.instancer else drawn)
            waiting += [_Visit(child, T, purpose, visit.instancer) for child in reversed(children)]

    def _count_hidden(self, prim: Any, drawn: Any) -> None:
        inside = sum(kind_of(p) == "Mesh" or kind_of(p) in PRIMITIVES for p in self._pxr.Usd.PrimRange(prim, drawn))
        if inside:
            self._left_out["invisible shapes"] += inside

    def _transform(self, prim: Any, T_parent: np.ndarray) -> np.ndarray:
        """Return the transform of a prim at rest, from its coordinates to those of the stage."""
        xform = self._pxr.UsdGeom.Xformable(prim)
        if not xform:
            return T_parent
        ops = xform.GetOrderedXformOps()
        moves = [op.GetAttr() for op in ops if op.GetAttr().GetNumTimeSamples()]
        time = self._pxr.Usd.TimeCode.Default()
        if any(a.Get() is None for a in moves):
            time = self._pxr.Usd.TimeCode(min(a.GetTimeSamples()[0] for a in moves))
        local = np.array(xform.GetLocalTransformation(time)).T
        if not np.isfinite(local).all():
            raise InputError(f"{self._folder.path.name}: {str(prim.GetPath())!r} has a transform that is not finite")
        return local if xform.GetResetXformStack() else T_parent @ local

    def _instances(self, prim: Any, T: np.ndarray, purpose: str) -> list[_Visit]:
        """Return the prototypes of a point instancer at their places."""
        geom, usd = self._pxr.UsdGeom, self._pxr.Usd
        kind = geom.PointInstancer
        instancer = kind(prim)
        times = instancer.GetPositionsAttr().GetTimeSamples()
        time = usd.TimeCode(times[0]) if times and instancer.GetPositionsAttr().Get() is None else usd.TimeCode.Default()
        numbers = array(value(instancer.GetProtoIndicesAttr()), 0, np.int64)
        targets = [self._stage.GetPrimAtPath(p) for p in instancer.GetPrototypesRel().GetForwardedTargets()]
        matrices = instancer.ComputeInstanceTransformsAtTime(time, time, kind.IncludeProtoXform, kind.IgnoreMask)
        mask = instancer.ComputeMaskAtTime(time) or [True] * len(numbers)
        visits = []
        if len(matrices) != len(numbers):
            self._left_out[f"instances of {prim.GetName()!r}, whose numbers of places and of prototypes differ"] += len(numbers)
            return visits
        for number, matrix, shown in zip(numbers, matrices, mask, strict=False):
            if shown and 0 <= number < len(targets) and targets[number]:
                visit = _Visit(targets[number], T @ np.array(matrix).T, purpose, str(prim.GetPath()), placed=True)
                visits.append(visit)
        return visits

    def _add(self, prim: Any, kind: str, T: np.ndarray, hidden: Any, instancer: str) -> None:
        if kind in LEFT_OUT and not hidden:
            self._left_out[LEFT_OUT[kind]] += 1
        if kind != "Mesh" and kind not in PRIMITIVES:
            return
        if hidden:
            self._left_out[f"shapes with the purpose {hidden}"] += 1
            return
        if kind == "Mesh" and prim.HasAPI(self._pxr.UsdSkel.BindingAPI):
            mesh, T = self._skinned(prim, T)
        else:
            mesh = self._mesh(prim)
        if mesh is None:
            self._left_out["meshes without faces"] += 1
            return
        self._faces += len(mesh.faces)
        if self._faces > MAX_FACES:
            raise InputError(f"{self._folder.path.name} has more than {MAX_FACES} faces; at most that are handled")
        chain = tuple(str(prim.GetPath()).split("/")[1:])
        if instancer:
            chain = (*instancer.split("/")[1:], f"{prim.GetName()}_{len(self._placed)}")
        pivot = None if instancer else tuple((T @ [*self._pivot(prim), 1])[:3].tolist())
        node = Node(str(prim.GetName()), mesh.nodes[0].geometry, path=chain, pivot=pivot)
        self._placed.append(PlacedPrim(replace(mesh.transformed(T), nodes=(node,)), instancer or str(prim.GetPath())))

    def _pivot(self, prim: Any) -> tuple[float, ...]:
        """Return the point of a prim's coordinates about which the nearest operations turn it, by default their origin."""
        ops: list[Any] = []
        while not ops and prim and not prim.IsPseudoRoot():
            xform, prim = self._pxr.UsdGeom.Xformable(prim), prim.GetParent()
            ops = list(xform.GetOrderedXformOps()) if xform else []
        points = [value(op.GetAttr()) for op in ops if op.GetOpName() == "xformOp:translate:pivot"]
        return next((tuple(map(float, p)) for p in points if p is not None), (0.0, 0.0, 0.0))

    def _skinned(self, prim: Any, T: np.ndarray) -> tuple[Mesh | None, np.ndarray]:
        """Return a mesh at the rest pose of its skeleton, and its transform to the stage."""
        skel, mesh = self._pxr.UsdSkel, self._mesh(prim)
        skeleton = skel.BindingAPI(prim).GetInheritedSkeleton()
        root = skel.Root.Find(prim)
        if mesh is None or not skeleton or not root:
            return mesh, T
        self._skins.Populate(root, self._pxr.Usd.TraverseInstanceProxies(self._pxr.Usd.PrimDefaultPredicate))
        skin, bones = self._skins.GetSkinningQuery(prim), self._skins.GetSkelQuery(skeleton)
        if not skin or not bones:
            return mesh, T
        if skin.HasBlendShapes():
            self._left_out["blend shapes' offsets (the shape at rest is read)"] += 1
        points = self._pxr.UsdGeom.Mesh(prim).GetPointsAttr()
        rest = bones.ComputeJointSkelTransforms(self._pxr.Usd.TimeCode.Default(), True) if bones.HasBindPose() else None
        if not skin.HasJointInfluences() or rest is None:
            return mesh, T
        bind = bones.GetJointWorldBindTransforms()
        if len(rest) != len(bind):
            self._folder.warn("a skeleton without a rest pose: its meshes are read as they are")
            return mesh, T
        pose = type(rest)([b.GetInverse() * r for b, r in zip(bind, rest, strict=True)])
        deformed = type(value(points))(value(points))
        if not skin.ComputeSkinnedPoints(pose, deformed, self._pxr.Usd.TimeCode.Default()):
            self._folder.warn(f"the skin of {prim.GetName()!r} is broken; the mesh is read as it is")
            return mesh, T
        T_skeleton = self.to_stage(skeleton.GetPrim())
        new = array(deformed, 3)
        return replace(mesh, vertices=new, corner_normal=None) if len(new) == len(mesh.vertices) else mesh, T_skeleton

    def to_stage(self, prim: Any) -> Float[np.ndarray, "4 4"]:
        """Return the transform from the coordinates of a prim to those of the stage."""
        above = []
        while prim and not prim.IsPseudoRoot():
            above.append(prim)
            prim = prim.GetParent()
        T = np.eye(4)
        for p in reversed(above):
            T = self._transform(p, T)
        return T

    def _mesh(self, prim: Any) -> Mesh | None:
        """Return the geometry of a prim in its own coordinates; instances share it."""
        look = self._materials.bound(prim, bool(value(self._pxr.UsdGeom.Gprim(prim).GetDoubleSidedAttr())))
        source = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
        colors = self._pxr.UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayColor")
        key = (source.GetPath(), id(look), colors.GetAttr().GetPath() if colors else None)
        if key not in self._meshes:
            made = self._read_mesh(prim, look)
            name = str(source.GetName())
            self._meshes[key] = None if made is None else replace(made, nodes=(Node(name, name),))
        return self._meshes[key]

    def _read_mesh(self, prim: Any, look: UsdLook | None) -> Mesh | None:
        geom = self._pxr.UsdGeom
        if kind_of(prim) == "Mesh":
            t = polygon_mesh(self._pxr, prim, self._folder.warn)
            scheme = geom.Mesh(prim).GetSubdivisionSchemeAttr()
            smooth = str(value(scheme)) != "none" and (scheme.HasAuthoredValue() or not self._primvar(prim, "normals"))
            if t is not None and smooth:
                self._left_out["subdivisions (the control cages are read as they are)"] += 1
        else:
            t, smooth = primitive(self._pxr, prim), False
        if t is None:
            return None
        looks, face_look = self._faces_looks(prim, t, look)
        uv = np.zeros((len(t.faces), 3, 2 * max(1, *(len(one.sets) for one in looks if one), 1)), np.float32)
        colors = np.full((len(t.faces), 3, 4), 255, np.uint8)
        with_uv = with_color = False
        face_material = np.full(len(t.faces), -1, np.int64)
        materials: list[Material] = []
        for number, one in enumerate(looks):
            chosen = face_look == number
            if not chosen.any():
                continue
            for k, placed in enumerate(self._uv(prim, t, one)):
                if placed is not None:
                    uv[chosen, :, 2 * k : 2 * k + 2], with_uv = placed[chosen], True
            shown = self._colors(prim, t, one)
            material = None if one is None else one.material
            if isinstance(shown, Material):
                material = shown
            elif shown is not None:
                colors[chosen], with_color = shown[chosen], True
            if material is not None:
                face_material[chosen] = len(materials)
                materials.append(material)
        normals = None if smooth else self._normals(prim, t)
        return Mesh(
            t.vertices, t.faces, np.zeros(len(t.faces), np.int64), (Node(""),), face_material, tuple(materials),
            uv[..., :2] if with_uv else None, colors if with_color else None, normals,
            corner_more_uv=uv[..., 2:] if with_uv and uv.shape[2] > 2 else None,
        )  # fmt: skip

    def _faces_looks(self, prim: Any, t: UsdTriangles, look: UsdLook | None) -> tuple[list[UsdLook | None], np.ndarray]:
        """Return the materials of a prim and, per triangle, which one it has."""
        looks, of_polygon = [look], np.zeros(t.polygons, np.int64)
        two_sided = bool(value(self._pxr.UsdGeom.Gprim(prim).GetDoubleSidedAttr()))
        if kind_of(prim) == "Mesh":
            for subset in self._pxr.UsdGeom.Subset.GetAllGeomSubsets(self._pxr.UsdGeom.Imageable(prim)):
                if value(subset.GetElementTypeAttr()) != "face" or not subset.GetPrim().HasRelationship("material:binding"):
                    continue
                indices = array(value(subset.GetIndicesAttr()), 0, np.int64)
                of_polygon[indices[(indices >= 0) & (indices < t.polygons)]] = len(looks)
                looks.append(self._materials.bound(subset.GetPrim(), two_sided))
        return looks, of_polygon[t.polygon]

    def _primvar(self, prim: Any, name: str) -> tuple[np.ndarray, str] | None:
        """Return the values of a primvar, of the prim or constant above it, without indices, and their interpolation."""
        primvar = self._pxr.UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
        if name == "normals" and not primvar and kind_of(prim) == "Mesh":
            mesh = self._pxr.UsdGeom.Mesh(prim)
            given, interpolation = value(mesh.GetNormalsAttr()), str(mesh.GetNormalsInterpolation())
        elif primvar:
            times = primvar.GetTimeSamples()
            given = primvar.ComputeFlattened()
            given = primvar.ComputeFlattened(times[0]) if given is None and times else given
            interpolation = str(primvar.GetInterpolation())
        else:
            return None
        try:
            values = np.asarray(given if given is not None else (), np.float64)
        except (TypeError, ValueError):  # such as text
            return None
        values = values.reshape(-1, 1) if values.ndim < 2 else values
        return (values, interpolation) if values.size else None

    def _spread(self, prim: Any, t: UsdTriangles, name: str) -> np.ndarray | None:
        stated = self._primvar(prim, name)
        if stated is None:
            return None
        spread = t.spread(*stated)
        if spread is None:
            self._folder.warn(
                f"{name} of {prim.GetName()!r} left out: its number of values does not fit {stated[1]} interpolation"
            )
        return spread

    def _uv(self, prim: Any, t: UsdTriangles, look: UsdLook | None) -> list[np.ndarray | None]:
        """Return the texture coordinates that a material's pictures use, (F, 3, 2) each."""
        sets = []
        api = self._pxr.UsdGeom.PrimvarsAPI(prim)
        kinds = {str(p.GetPrimvarName()): str(p.GetTypeName()) for p in api.GetPrimvarsWithValues()}
        pairs = sorted(name for name, kind in kinds.items() if kind.startswith(("texCoord2", "float2")))
        for primvar, transform in (look.sets if look else ()) or ((None, None),):
            name = next((n for n in (primvar, *UV_NAMES) if n in pairs), pairs[0] if pairs else None)
            values = None if name is None else self._spread(prim, t, name)
            if values is not None and transform is not None:
                T = np.array(transform).reshape(2, 3)
                values = values @ T[:, :2].T + T[:, 2]
            sets.append(None if values is None else np.nan_to_num(values).astype(np.float32))
        return sets

    def _colors(self, prim: Any, t: UsdTriangles, look: UsdLook | None) -> np.ndarray | Material | None:
        """Return display colours at the corners, or a material if they are all the same; None if a material counts."""
        name = "displayColor" if look is None else look.color
        linear = None if name is None else self._spread(prim, t, name)
        if linear is None or linear.shape[2] not in (3, 4):
            return None
        opacity = self._spread(prim, t, "displayOpacity") if look is None else None
        alpha = linear[:, :, 3:] if linear.shape[2] == 4 else np.ones((*linear.shape[:2], 1)) if opacity is None else opacity
        colors = np.nan_to_num(np.concatenate([linear[:, :, :3], alpha], 2))
        first = np.clip(colors[0, 0], 0, 1)
        if look is None and (colors == colors[:1, :1]).all():
            mode = "BLEND" if first[3] < 1 else "OPAQUE"
            red, green, blue, opaque = (float(c) for c in first)
            color = (red, green, blue, opaque)
            number = self._constants.setdefault(color, len(self._constants))  # a name that says nothing of the part
            return Material(f"material_{number}", color, alpha_mode=mode)
        flat = colors.reshape(-1, 4)
        return rgba(np.c_[to_srgb(flat[:, :3]), flat[:, 3]]).reshape(-1, 3, 4)

    def _normals(self, prim: Any, t: UsdTriangles) -> np.ndarray | None:
        values = self._spread(prim, t, "normals")
        normals = None if values is None or values.shape[2] != 3 else unit(values.reshape(-1, 3))
        return None if normals is None else normals.reshape(-1, 3, 3)
