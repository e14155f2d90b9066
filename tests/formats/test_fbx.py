"""FBX: one small file for each row of the table in docs/formats.md."""

import base64
import io

import numpy as np
import pytest
from PIL import Image
from tables import check_table

pytest.importorskip("ufbx")
from fbx_text import QUAD, FbxText, layer, listed, prop

from anymesh.errors import InputError
from anymesh.formats.reading import read_isolated
from anymesh.loading import load_mesh
from anymesh.loading.files import FileMesh, Folder
from anymesh.types.mesh import CLAMP, to_linear


def read(folder, made: FbxText) -> tuple[FileMesh, list[str]]:
    (folder / "a.fbx").write_text(made.text())
    found = Folder(folder / "a.fbx")
    return read_isolated(b"", found), found.warnings


def simple(*props: str, more: str = "", **options) -> tuple[FbxText, int]:
    made = FbxText(**options)
    node = made.node("door", *props)
    made.mesh(node, *QUAD, more=more)
    return made, node


def png(color) -> bytes:
    buffer = io.BytesIO()
    Image.new("RGB", (2, 2), color).save(buffer, "PNG")
    return buffer.getvalue()


def geometry(folder):
    """A C-shaped face is not covered across its gap; names are kept."""
    made = FbxText()
    points = [(0, 0, 0), (3, 0, 0), (3, 1, 0), (1, 1, 0), (1, 2, 0), (3, 2, 0), (3, 3, 0), (0, 3, 0)]
    made.mesh(made.node("door"), points, [range(8)], name="panel")
    found, warnings = read(folder, made)
    assert (found.mesh.face_areas.sum(), warnings) == (pytest.approx(7), [])
    assert (found.mesh.nodes[0].name, found.mesh.nodes[0].geometry) == ("door", "panel")


def missing_points(folder):
    made = FbxText()
    made.mesh(made.node("door"), QUAD[0], [(0, 1, 2), (0, 2, 9)])
    with pytest.raises(InputError, match="is not a valid FBX file"):
        read(folder, made)


def points_without_place(folder):
    made = FbxText()
    made.mesh(made.node("door"), [*QUAD[0], (np.nan, 0, 0)], [(0, 1, 2), (0, 2, 4)])
    found, warnings = read(folder, made)
    assert len(found.mesh.faces) == 1
    assert "1 faces of 'shape' left out: their points are missing" in warnings


def transforms(folder):
    """A pre-rotation turns about the node's place; a geometric translation moves the mesh, but no children."""
    made = FbxText()
    top = made.node(
        "top", prop("Lcl Translation", 10, 0, 0), prop("PreRotation", 0, 0, 90), prop("RotationActive", 1), kind="Null"
    )
    door = made.node("door", prop("GeometricTranslation", 0, 0, 5), prop("Lcl Scaling", 2, 1, 1), parent=top)
    made.mesh(door, *QUAD)
    made.mesh(made.node("knob", parent=door), *QUAD)
    found, _ = read(folder, made)
    low, high = found.mesh.subset(found.mesh.face_node == 0).bounds
    assert (low, high) == (pytest.approx([9, 0, 5]), pytest.approx([10, 2, 5]))
    assert found.mesh.subset(found.mesh.face_node == 1).bounds[0, 2] == 0
    assert found.mesh.nodes[1].path == ("top", "door", "knob")


def frame(folder):
    assert [(f.up, f.unit) for f in (read(folder, simple(unit=1.0)[0])[0], read(folder, simple(up=2)[0])[0])] == [
        ("y", 0.01),
        ("z", 1),
    ]


def visibility(folder):
    made, _ = simple()
    made.mesh(made.node("ghost", prop("Visibility", 0.0)), *QUAD)
    found, warnings = read(folder, made)
    assert ([n.name for n in found.mesh.nodes], warnings) == (["door"], ["left out: 1 invisible meshes"])


def levels_of_detail(folder):
    made, _ = simple()
    group = made.node("car", kind="LodGroup")
    made.add("NodeAttribute", "lod", "LodGroup", 'TypeFlags: "LodGroup"\n', group)
    for name in ("fine", "coarse"):
        made.mesh(made.node(name, parent=group), *QUAD)
    found, warnings = read(folder, made)
    assert [n.name for n in found.mesh.nodes] == ["door", "fine"]
    assert warnings == ["left out: 1 meshes of coarser levels of detail"]


def attributes(folder):
    """Normals and colours of corners; a colour counts where there is no picture."""
    normals = layer("LayerElementNormal", f"Normals: {listed([(0, 1, 0)] * 4)}\n", "ByPolygonVertex")
    colors = layer("LayerElementColor", f"Colors: {listed([(1, 0, 0, 1)] * 4)}\n", "ByPolygonVertex")
    found, _ = read(folder, simple(more=normals + colors)[0])
    assert found.mesh.corner_normal[0, 0].tolist() == [0, 1, 0]
    assert found.mesh.corner_color[0, 0].tolist() == [255, 0, 0, 255]


def materials(folder):
    """Each face has its material; colours of Lambert and Phong are those of the screen."""
    made = FbxText()
    node = made.node("door")
    parts = layer("LayerElementMaterial", f"Materials: {listed([0, 1])}\n", "ByPolygon", "IndexToDirect")
    made.mesh(node, QUAD[0], [(0, 1, 2), (0, 2, 3)], more=parts)
    made.material(node, "red", prop("DiffuseColor", 0.5, 0, 0))
    made.material(
        node, "glass", prop("DiffuseColor", 1, 1, 1), prop("TransparencyFactor", 0.75), prop("TransparentColor", 1, 1, 1)
    )
    found, _ = read(folder, made)
    red, glass = found.mesh.materials
    assert found.mesh.face_material.tolist() == [0, 1]
    assert (red.name, red.base_color) == ("red", pytest.approx((to_linear([0.5])[0], 0, 0, 1)))
    assert (glass.alpha_mode, glass.base_color[3]) == ("BLEND", pytest.approx(0.25))
    made.material(node, "gone", prop("TransparencyFactor", 1.0), prop("TransparentColor", 1, 1, 1))
    found, warnings = read(folder, made)
    assert found.mesh.materials[2].alpha_mode == "OPAQUE"
    assert "taken for opaque" in warnings[0]


UV = layer("LayerElementUV", f'Name: "map"\nUV: {listed([(0, 0), (1, 0), (1, 1), (0, 1)])}\n', "ByPolygonVertex")


def pictures(folder):
    """Beside the mesh, whatever computer the path is of; clamped as stated."""
    made, node = simple(more=UV)
    red = made.material(node, "red", prop("DiffuseColor", 0.2, 0.2, 0.2))
    made.texture(
        red, "DiffuseColor", "C:\\work\\red.png", f"Properties70: {{\n{prop('WrapModeU', 1)}{prop('WrapModeV', 1)}}}\n"
    )
    (folder / "red.png").write_bytes(png((255, 0, 0)))
    found, warnings = read(folder, made)
    look = found.mesh.materials[0]
    assert (look.textures["base_color"].wrap, look.base_color, warnings) == ((CLAMP, CLAMP), (1, 1, 1, 1), [])
    assert found.mesh.corner_uv.max() == 1
    (folder / "red.png").unlink()
    assert "texture 'C:\\\\work\\\\red.png' left out" in read(folder, made)[1][0]


def embedded_pictures(folder):
    made, node = simple(more=UV)
    red = made.material(node, "red")
    texture = made.texture(red, "DiffuseColor", "red.png")
    content = base64.b64encode(png((255, 0, 0))).decode()
    made.add("Video", "clip", "Clip", f'Type: "Clip"\nFileName: "red.png"\nContent: ,\n"{content}"\n', texture)
    found, warnings = read(folder, made)
    assert ("base_color" in found.mesh.materials[0].textures, warnings) == (True, [])


def bumps(folder):
    """A normal map is often where heights belong."""
    for color, slots in (((128, 128, 255), ["normal"]), ((90, 90, 90), [])):
        (folder / "bump.png").write_bytes(png(color))
        made, node = simple(more=UV)
        made.texture(made.material(node, "red"), "Bump", "bump.png")
        found, warnings = read(folder, made)
        assert list(found.mesh.materials[0].textures) == slots
        assert bool(slots) == (warnings == [])


def skins(folder):
    """A mesh is read where its bones are, not where it was bound; a mesh of one bone moves with it."""
    made, _ = simple()
    bone = made.node("bone", prop("Lcl Translation", 3, 0, 0), kind="LimbNode")
    made.add("NodeAttribute", "bone", "LimbNode", 'TypeFlags: "Skeleton"\n', bone)
    skin = made.add("Deformer", "skin", "Skin", "Version: 101\n", made.count - 2)
    weights = f"Indexes: {listed(range(4))}\nWeights: {listed([1] * 4)}\n"
    identity = listed(np.eye(4))
    cluster = made.add(
        "Deformer", "bone", "Cluster", f"Version: 100\n{weights}Transform: {identity}\nTransformLink: {identity}\n", skin
    )
    made.connect(bone, cluster)
    found, _ = read(folder, made)
    assert found.mesh.bounds[0] == pytest.approx([3, 0, 0])


def animations(folder):
    made, _ = simple()
    lid = made.node("lid", prop("Lcl Translation", 0, 1, 0))
    made.mesh(lid, *QUAD)
    made.animation(lid, "R", "Lcl Rotation", [(0, 0), (1, 45), (2, 90)])
    found, _ = read(folder, made)
    (joint,) = found.mesh.joints
    assert (joint.type, joint.name, joint.limits) == ("revolute", "lid", pytest.approx((0, np.pi / 2), abs=1e-3))
    assert (joint.axis, joint.origin[1]) == (pytest.approx([0, 0, 1], abs=1e-6), pytest.approx(1, abs=1e-6))


def curves(folder):
    made, _ = simple()
    made.add(
        "Geometry",
        "path",
        "Line",
        f"Points: {listed(QUAD[0])}\nPointsIndex: {listed([0, 1, 2, -4])}\n",
        made.node("path", kind="Line"),
    )
    assert read(folder, made)[1] == ["left out: 1 curves"]


ROWS = {
    "meshes: faces of any number of corners, also concave": geometry,
    "faces that refer to points beyond the last": missing_points,
    "faces whose points are not finite": points_without_place,
    "transforms of nodes: pivots, pre- and post-rotation, geometric transform": transforms,
    "axes and unit": frame,
    "`Visibility`": visibility,
    "LOD groups": levels_of_detail,
    "normals, vertex colours": attributes,
    "materials: Lambert, Phong, and those of Maya, 3ds Max, Blender and Arnold": materials,
    "pictures beside the mesh": pictures,
    "embedded pictures": embedded_pictures,
    "bump pictures": bumps,
    "skins": skins,
    "animations": animations,
    "curves, NURBS surfaces, procedural shapes": curves,
}


@pytest.mark.parametrize("row", ROWS)
def test_what_is_said_of_fbx(row, tmp_path):
    ROWS[row](tmp_path)


def test_every_row_on_fbx_is_tested():
    check_table("FBX", ROWS)


def test_a_broken_fbx_ends_in_one_error(tmp_path):
    (tmp_path / "a.fbx").write_bytes(b"Kaydara FBX Binary  \0\x1a\0" + b"\xff" * 50)
    with pytest.raises(InputError, match=r"a\.fbx is not a valid FBX file"):
        load_mesh(tmp_path / "a.fbx")
    with pytest.raises(InputError, match="found no triangles"):
        read(tmp_path, FbxText())
