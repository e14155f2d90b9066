"""The same object in GLB, USD, USDZ, FBX, OBJ and DAE gives the same joints."""

import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fbx_text import FbxText, prop

from anymesh.loading import load_mesh
from anymesh.loading.load import place_mesh
from anymesh.pipeline.solving import Solver
from anymesh.types import Joint, Material, Mesh
from anymesh.types.mesh import to_srgb

pytest.importorskip("pxr")
pytest.importorskip("ufbx")
STILL = ("bookcase", "table")  # nothing of them moves
EXAMPLES = Path(__file__).parents[2] / "examples" / "meshes"
FORMATS = ("usda", "usdz", "fbx", "obj", "dae")
CENTIMETRES = 100.0


def parts(mesh: Mesh):
    """Yield the name, vertices, faces and material of each node's faces of one material."""
    for k, node in enumerate(mesh.nodes):
        mine = mesh.subset(mesh.face_node == k)
        for m in np.unique(mine.face_material):
            one = mine.subset(mine.face_material == m)
            yield f"{node.name}_{m}" if len(np.unique(mine.face_material)) > 1 else node.name, one, mesh.materials[m]


def rows(values) -> str:
    return ", ".join(f"({', '.join(f'{v:.9g}' for v in row)})" for row in values)


def usd(mesh: Mesh, folder: Path) -> Path:
    """In centimetres, Z up: another frame than that of the GLB."""
    text = '#usda 1.0\n(\nmetersPerUnit = 0.01\nupAxis = "Z"\ndefaultPrim = "root"\n)\ndef Xform "root"\n{\n'
    text += 'float xformOp:rotateX = 90\nuniform token[] xformOpOrder = ["xformOp:rotateX"]\n'
    for name, one, look in parts(mesh):
        color = rows([look.base_color[:3]])
        text += f'def Xform "{name.replace("-", "_")}"\n{{\ndef Mesh "{name.replace("-", "_")}"\n{{\n'
        text += f"int[] faceVertexCounts = [{', '.join(['3'] * len(one.faces))}]\n"
        text += f"int[] faceVertexIndices = [{', '.join(map(str, one.faces.reshape(-1)))}]\n"
        text += f'point3f[] points = [{rows(one.vertices * CENTIMETRES)}]\nuniform token subdivisionScheme = "none"\n'
        text += f"color3f[] primvars:displayColor = [{color}]\n}}\n}}\n"
    path = folder / "object.usda"
    path.write_text(text + "}\n")
    return path


def usdz(mesh: Mesh, folder: Path) -> Path:
    path = folder / "object.usdz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(usd(mesh, folder), "object.usda")
    return path


def fbx(mesh: Mesh, folder: Path) -> Path:
    made = FbxText(unit=1.0)
    for name, one, look in parts(mesh):
        node = made.node(name)
        made.mesh(node, one.vertices * CENTIMETRES, one.faces.tolist(), name=name)
        made.material(node, look.name, prop("DiffuseColor", *to_srgb(look.base_color[:3])))
    path = folder / "object.fbx"
    path.write_text(made.text())
    return path


def mtl(look: Material) -> str:
    return f"newmtl {look.name}\nKd {' '.join(f'{c:.6g}' for c in to_srgb(look.base_color[:3]))}\n"


def obj(mesh: Mesh, folder: Path) -> Path:
    text, first = "mtllib object.mtl\n", 1
    for name, one, look in parts(mesh):
        text += f"o {name}\nusemtl {look.name}\n" + "".join(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in one.vertices)
        text += "".join(f"f {a} {b} {c}\n" for a, b, c in one.faces + first)
        first += len(one.vertices)
    (folder / "object.mtl").write_text("".join(mtl(look) for look in mesh.materials))
    path = folder / "object.obj"
    path.write_text(text)
    return path


def dae(mesh: Mesh, folder: Path) -> Path:
    shapes, nodes, effects, materials = "", "", "", ""
    for k, look in enumerate(mesh.materials):
        color = " ".join(f"{c:.6g}" for c in (*to_srgb(look.base_color[:3]), 1))
        effects += f'<effect id="e{k}"><profile_COMMON><technique sid="t"><lambert><diffuse><color>{color}</color></diffuse>'
        effects += "</lambert></technique></profile_COMMON></effect>"
        materials += f'<material id="m{k}" name="{look.name}"><instance_effect url="#e{k}"/></material>'
    for k, (name, one, look) in enumerate(parts(mesh)):
        m, numbers = mesh.materials.index(look), " ".join(f"{v:.9g}" for v in one.vertices.reshape(-1))
        access = f'<accessor source="#a{k}" count="{len(one.vertices)}" stride="3">' + "".join(
            f'<param name="{c}" type="float"/>' for c in "XYZ"
        )
        shapes += f'<geometry id="g{k}"><mesh><source id="s{k}">'
        shapes += f'<float_array id="a{k}" count="{one.vertices.size}">{numbers}</float_array>'
        shapes += f'<technique_common>{access}</accessor></technique_common></source><vertices id="v{k}">'
        shapes += f'<input semantic="POSITION" source="#s{k}"/></vertices><triangles material="x" count="{len(one.faces)}">'
        shapes += f'<input semantic="VERTEX" source="#v{k}" offset="0"/>'
        shapes += f"<p>{' '.join(map(str, one.faces.reshape(-1)))}</p></triangles></mesh></geometry>"
        nodes += f'<node id="n{k}" name="{name}"><instance_geometry url="#g{k}"><bind_material><technique_common>'
        nodes += f'<instance_material symbol="x" target="#m{m}"/></technique_common></bind_material></instance_geometry></node>'
    path = folder / "object.dae"
    path.write_text(
        '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
        f'<unit meter="1"/><up_axis>Y_UP</up_axis></asset><library_effects>{effects}</library_effects>'
        f"<library_materials>{materials}</library_materials><library_geometries>{shapes}</library_geometries>"
        f'<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )
    return path


WRITERS = {"usda": usd, "usdz": usdz, "fbx": fbx, "obj": obj, "dae": dae}


def solved(path: Path, up: str = "auto", scale: str = "auto") -> tuple[Mesh, list[Joint]]:
    placed = place_mesh(load_mesh(path), up=up, scale=scale)
    solver = Solver(placed.mesh)
    parts = solver.parts().segmentation
    return placed.mesh, list(solver.joints(parts).joints)


def check(name: str, folder: Path) -> None:
    source = load_mesh(EXAMPLES / f"{name}.glb").mesh
    if (source.face_material < 0).any():
        source = replace(source, materials=(Material("material_0"),), face_material=np.zeros(len(source.faces), np.int64))
    mesh, joints = solved(EXAMPLES / f"{name}.glb", scale="1")
    assert bool(joints) == (name not in STILL)
    for kind in FORMATS:
        guess = {"up": "y", "scale": "1"} if kind == "obj" else {}
        other, found = solved(WRITERS[kind](source, folder), **guess)
        assert other.extents == pytest.approx(mesh.extents, rel=1e-5), kind
        assert len(found) == len(joints), kind
        for joint in joints:
            same = min(found, key=lambda j: float(np.linalg.norm(j.origin - joint.origin)))
            assert same.type is joint.type, (kind, joint.name)
            cosine = float(same.axis @ joint.axis)
            assert cosine >= np.cos(np.radians(0.5)), (kind, joint.name)
            away = same.origin - joint.origin
            away = away if joint.type == "prismatic" else away - (away @ joint.axis) * joint.axis
            assert np.linalg.norm(away) <= 0.01 * mesh.diagonal, (kind, joint.name)
            assert same.limits == pytest.approx(joint.limits, abs=np.radians(2)) if joint.limits else same.limits is None


@pytest.mark.parametrize("name", ["sliding_window", "named_cabinet", "laptop"])
def test_the_same_object_is_the_same_mesh(name, tmp_path):
    """So its joints are the same: the suite of all examples, which computes them, takes minutes."""
    source = load_mesh(EXAMPLES / f"{name}.glb").mesh
    mesh = place_mesh(load_mesh(EXAMPLES / f"{name}.glb"), scale="1").mesh
    for kind in FORMATS:
        loaded = load_mesh(WRITERS[kind](source, tmp_path))
        other = place_mesh(loaded, up="y" if kind == "obj" else "auto", scale="1" if kind == "obj" else "auto").mesh
        assert len(other.faces) == len(mesh.faces), kind
        for a, b in zip(summary(mesh), summary(other), strict=True):
            assert b == pytest.approx(a, abs=1e-4), kind


def summary(mesh: Mesh) -> list[tuple[float, ...]]:
    """Return the area, the centre and the colour of the faces of each node and material, in an order that any reader has."""
    colors = np.array([m.base_color for m in mesh.materials])[mesh.face_material]
    keys = np.c_[np.round(colors, 3), mesh.face_node]
    found = []
    for key in np.unique(keys, axis=0):
        chosen = (keys == key).all(1)
        areas = mesh.face_areas[chosen]
        center = (mesh.triangles[chosen].mean(1) * areas[:, None]).sum(0) / areas.sum()
        found.append((*key[:4], float(areas.sum()), *center))
    return sorted(found, key=lambda row: tuple(np.round(row, 3)))


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(p.stem for p in EXAMPLES.glob("*.glb")))
def test_each_example_gives_the_same_joints(name, tmp_path):
    check(name, tmp_path)
