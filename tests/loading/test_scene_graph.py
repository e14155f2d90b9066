"""Test which nodes of a scene are one object, how it is named, and what is not part of it."""

# ruff: noqa: E501

import sys
from pathlib import Path

import numpy as np
import pytest
from mesh_files import FACES, POINTS

from anymesh.loading.files import Folder
from anymesh.loading.join import join, simple_mesh
from anymesh.loading.scene_graph import is_generic, scene_of_objects
from anymesh.types import Material, Mesh, Node

sys.path.insert(0, str(Path(__file__).parents[1] / "formats"))
from tables import check_table

ROOT = ("Sketchfab_model", "root", "GLTF_SceneRootNode")
FBX = (*ROOT, "x.fbx", "RootNode")


def scene(*nodes: tuple, folder: Folder) -> Mesh:
    """Return the scene of one solid per node: (chain, material, geometry)."""
    made = []
    for k, (chain, material, *geometry) in enumerate(nodes):
        chain = (chain,) if isinstance(chain, str) else chain
        solid = simple_mesh("x", "x", POINTS + 3 * k, FACES, Material(material) if material else None)
        made.append(join([solid]))
        node = Node(chain[-1], geometry[0] if geometry else chain[-1], path=chain if len(chain) > 1 else ())
        made[-1] = Mesh(solid.vertices, solid.faces, solid.face_node, (node,), solid.face_material, solid.materials)
    return scene_of_objects(join(made), folder)


@pytest.fixture
def folder(tmp_path) -> Folder:
    return Folder(tmp_path / "x.glb")


def counts(mesh: Mesh) -> dict[str, int]:
    return dict(zip((n.name for n in mesh.nodes), np.bincount(mesh.face_node).tolist(), strict=True))


@pytest.mark.parametrize(
    ("nodes", "expected"),
    [
        # Sketchfab, without and with the names of the source
        ([((*ROOT, "Body_0", "Object_4"), "a"), ((*ROOT, "Door_Left_1", "Object_5"), "a"),
          ((*ROOT, "Door_Left_1", "Object_6"), "b")],
         {"Body": 1, "Door_Left": 2}),
        ([((*FBX, "Body", "Body_Oak_0"), "Oak"), ((*FBX, "Cube.001", "Cube.001_Oak_0"), "Oak"),
          ((*FBX, "Door", "Door_Oak_0"), "Oak"), ((*FBX, "Door", "Door_Steel_0"), "Steel")],
         {"Body": 1, "Cube.001": 1, "Door": 2}),
        ([((*ROOT, "Drawer_1_4", "Object_4"), "a"), ((*ROOT, "Drawer_2_5", "Object_5"), "a")], {"Drawer_1": 1, "Drawer_2": 1}),
        ([((*ROOT, "Drawer_1", "Object_4"), "a"), ((*ROOT, "Drawer_2", "Object_5"), "a")], {"Drawer_1": 1, "Drawer_2": 1}),
        # one mesh per material: three.js, Babylon, shapes of Maya, the material's name
        ([(("Body",), "a"), (("Lid", "Lid_1"), "a"), (("Lid", "Lid_2"), "b")], {"Body": 1, "Lid": 2}),
        ([(("Body",), "a"), (("Lid", "Lid_primitive0"), "a"), (("Lid", "Lid_primitive1"), "b")], {"Body": 1, "Lid": 2}),
        ([(("Body",), "a"), (("Lid", "Lid_defaultMaterial_0"), ""), (("Lid", "Lid_lambert1_0"), "x")], {"Body": 1, "Lid": 2}),
        ([(("Body", "BodyShape"), "a"), (("Lid", "LidShape"), "a")], {"Body": 1, "Lid": 1}),
        # objects of their own that are numbered, or several below a plural
        ([(("Body",), "a"), (("Drawers", "Drawers_1"), "b"), (("Drawers", "Drawers_2"), "b")],
         {"Body": 1, "Drawers_1": 1, "Drawers_2": 1}),
        ([(("Body",), "a"), (("Doors", "Object_1"), "b"), (("Doors", "Object_2"), "b")],
         {"Body": 1, "Doors": 1, "Doors_1": 1}),
        # a group of unnamed objects; the name of the whole says nothing of its parts; a mesh above is an object of its own
        ([(("Case", "Cube"), "a"), (("Case", "Cube.001"), "a"), (("Door", "group3", "pCube7"), "a")], {"Case": 2, "Door": 1}),
        ([(("Cabinet", "Object_2"), "a"), (("Cabinet", "Object_3"), "b")], {"Object_2": 1, "Object_3": 1}),
        ([(("Case",), "a"), (("Case", "Cube.001"), "a"), (("Case", "Door"), "a")], {"Case": 1, "Cube.001": 1, "Door": 1}),
        # the geometry's name
        ([("node_1", "a", "Door"), ("node_2", "a", "Body")], {"Door": 1, "Body": 1}),
        ([("mesh_0", "a"), ("mesh_1", "b")], {"mesh_0": 1, "mesh_1": 1}),
        ([((*ROOT, "柜门_3", "Object_4"), "a"), ((*ROOT, "柜体_5", "Object_7"), "a")], {"柜门": 1, "柜体": 1}),
    ],
)  # fmt: skip
def test_one_node_per_named_object(nodes, expected, folder) -> None:
    mesh = scene(*nodes, folder=folder)
    assert counts(mesh) == {name: n * len(FACES) for name, n in expected.items()}
    assert folder.warnings == []


def test_a_path_leads_to_the_node_that_was_joined(folder) -> None:
    mesh = scene((("Body",), "a"), (("Lid", "Lid_1"), "a"), (("Lid", "Lid_2"), "b"), folder=folder)
    assert [n.path for n in mesh.nodes] == [(), ("Lid",)]


@pytest.mark.parametrize(
    ("names", "kept", "warning"),
    [
        (["Body_LOD0", "Body_LOD1", "Body_LOD2"], ["Body"],
         "2 coarser levels of detail are left out, the finest is kept: Body_LOD1, Body_LOD2"),
        (["Lid", "Lid_LOD1", "$LOD2_Lid"], ["Lid"], "2 coarser levels"),
        (["Lid_LOD0", "Lid_LOD1", "UCX_Lid_LOD0"], ["Lid"], "1 coarser level"),
        (["LOD1_Lid", "LOD0_Lid", "Body"], ["Lid", "Body"], "1 coarser level of detail is left out"),
        ([("LOD0", "Lid"), ("LOD0", "Body"), ("LOD1", "All")], ["Lid", "Body"], "1 coarser level"),
        ([("Lid", "Lid.lod.1"), ("Lid", "Lid.lod.2"), "Body"], ["Lid", "Body"], "1 coarser level"),
        (["Body", "UCX_Body_00", "UBX_Body"], ["Body"],
         "2 collision shapes are left out, the visual meshes are kept: UCX_Body_00, UBX_Body"),
        (["Body", "Body-col"], ["Body"], "1 collision shape is"),
        (["Body", "Body-convcolonly", "floor-colonly"], ["Body"], "2 collision shapes"),
        (["Body", "COL_Body", "body_collision_mesh"], ["Body"], "2 collision shapes"),
        (["Body", "body_collider", "Collision_hull"], ["Body"], "2 collision shapes"),
        ([("Body",), ("collision", "Cube")], ["Body"], "1 collision shape"),
        (["Lid", "Camera001.Target", "SpotLightHelper"], ["Lid"],
         "2 helpers of cameras and lights are left out: Camera001.Target, Spot"),
    ],
)  # fmt: skip
def test_what_is_not_part_of_the_object_is_left_out(names, kept, warning, folder) -> None:
    mesh = scene(*((name, "a") for name in names), folder=folder)
    assert list(counts(mesh)) == kept
    assert folder.warnings[0].startswith(warning)


@pytest.mark.parametrize(
    "names",
    [["Body-col", "Lid"], ["UCX_a", "UCX_b"], ["Lodge1", "Colander", "Protocol", "col_a", "a-col-b"], ["Camera", "Lamp"]],
)
def test_what_may_be_seen_is_kept(names, folder) -> None:
    assert list(counts(scene(*((name, "a") for name in names), folder=folder))) == names
    assert folder.warnings == []


def test_names_that_programs_give() -> None:
    generic = "Object_4 mesh_0_3 defaultMaterial Cube.001 polySurface12 ID7 Group#3 cabinet.fbx Box01 12 RootNode pCubeShape1 =>[0:1:1:2] NAUO7 Body2".split()
    generic.append("Open CASCADE STEP translator 7.9 4.1")
    assert [name for name in generic if not is_generic(name)] == []
    assert [name for name in "Door base body body_2 Boxer panel_2 Grouper 门 Handle.001".split() if is_generic(name)] == []


NAMES: dict[str, tuple[list[tuple], dict[str, int], int]] = {  # nodes, faces in boxes by name, number of warnings
    "`Object_4`, `mesh_0_3`, `defaultMaterial`, `Cube.001`, `polySurface12`, `Body2`": (
        [(("Case", "mesh_0_3"), "a"), (("Lid", "defaultMaterial"), "b"), (("Leg", "Body1"), "b")], {"Case": 1, "Lid": 1, "Leg": 1}, 0),
    "`Door_Oak_0`, `Door_1`, `DoorShape` below `Door`": (
        [(("Case", "CaseShape"), "a"), (("Door", "Door_Oak_0"), "Oak"), (("Door", "Door_1"), "b")], {"Case": 1, "Door": 2}, 0),
    "such nodes below a plural (`Doors`, `Door set`)": (
        [("Case", "a"), (("Door set", "Cube"), "b"), (("Door set", "Cube.001"), "b")], {"Case": 1, "Door set": 1, "Door set_1": 1}, 0),
    "a name above all that is there": ([(("All", "Cube"), "a"), (("All", "Box02"), "b")], {"Cube": 1, "Box02": 1}, 0),
    "nodes without names of their own": ([("Cube", "a", "Lid"), ("Cube.001", "b", "Case")], {"Lid": 1, "Case": 1}, 0),
    "`door_oak`, `door_steel` beside each other": ([("door_oak", "oak"), ("door_steel", "steel")], {"door_oak": 1, "door_steel": 1}, 0),
    "the number that Sketchfab adds to each name": ([((*ROOT, "Lid_7", "Object_9"), "a"), ((*ROOT, "Case_8", "Object_10"), "b")],
                                                     {"Lid": 1, "Case": 1}, 0),
    "`_LOD0` to `_LOD3`, `LOD1_`, groups of that name": ([("Lid_LOD0", "a"), ("Lid_LOD3", "a"), ("Case", "a")], {"Lid": 1, "Case": 1}, 1),
    "`UCX_`, `UBX_`, `USP_`, `UCP_`, `MCDCX_`, `-colonly`, `-convcolonly`": (
        [("Lid", "a"), *((f"{p}Lid_00", "a") for p in ("UCX_", "UBX_", "USP_", "UCP_", "MCDCX_")), ("a-colonly", "a")], {"Lid": 1}, 1),
    "`collider` or `collision` as first or last word": ([("Lid", "a"), ("Lid Collider", "a"), ("collision_1", "a")], {"Lid": 1}, 1),
    "`-col`, `-convcol`": ([("Lid", "a"), ("Lid-convcol", "a"), ("Case-col", "a")], {"Lid": 1, "Case-col": 1}, 1),
    "`Camera.Target`, `SpotLightHelper`, `GridHelper`": ([("Lid", "a"), ("Camera.Target", "a"), ("GridHelper", "a")], {"Lid": 1}, 1),
    "nothing else in the file": ([("Lid_collision", "a")], {"Lid_collision": 1}, 0),
    "names in other scripts": ([(("دولاب", "Object_3"), "a"), (("门", "Object_4"), "a")], {"دولاب": 1, "门": 1}, 0),
}  # fmt: skip


@pytest.mark.parametrize("row", NAMES)
def test_each_row_of_the_table_on_names_is_true(row, folder) -> None:
    nodes, expected, warnings = NAMES[row]
    mesh = scene(*nodes, folder=folder)
    assert counts(mesh) == {name: n * len(FACES) for name, n in expected.items()}
    assert len(folder.warnings) == warnings


def test_the_table_on_names_has_these_rows() -> None:
    check_table("Names, levels of detail and helpers", NAMES)


def test_long_names_take_no_time(folder) -> None:
    names = [c * 20_000 for c in ("_-", "0", "a.", "LOD1_")]
    assert len(scene(*(((name, f"{name}x"), "a") for name in names), folder=folder).nodes) == 4
