"""Scenes of several objects: which are found, what is written of them, and what a single object is not taken for."""

import json
from collections.abc import Sequence
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import trimesh
from assets import box

import anymesh
from anymesh.applications.scenes.objects import find_objects
from anymesh.cli import run
from anymesh.errors import OptionError, OutputError
from anymesh.loading.join import join, simple_mesh
from anymesh.loading.load import load_mesh
from anymesh.types import JointType, Mesh, StatedJoint

Pieces = dict[str, list[tuple[np.ndarray, np.ndarray]]]
# A cabinet that is open in front (-y), with a door before it and its handle [m, Z up].
WALLS = [([-0.25, -0.2, 0], [0.25, 0.2, 0.02]), ([-0.25, -0.2, 0.68], [0.25, 0.2, 0.7]), ([-0.25, -0.2, 0], [-0.23, 0.2, 0.7]),
         ([0.23, -0.2, 0], [0.25, 0.2, 0.7]), ([-0.25, 0.18, 0], [0.25, 0.2, 0.7])]  # fmt: skip
CABINET: Pieces = {
    "carcass": [box(*wall) for wall in WALLS],
    "door": [box([-0.25, -0.223, 0], [0.25, -0.203, 0.7])],
    "handle": [box([0.19, -0.25, 0.3], [0.21, -0.223, 0.4])],
}
ROOM: Pieces = {
    "shell": [
        box([-0.5, -1, -0.05], [4.5, 3, 0]),
        box([-0.5, 3, -0.05], [4.5, 3.05, 2.6]),
        box([4.5, -1, -0.05], [4.55, 3, 2.6]),
    ]
}


def placed(pieces: Pieces, name: str, x: float = 0.0, y: float = 0.0, turn: float = 0.0) -> list[Mesh]:
    """Return the nodes of an object at a place, each below the node `name`."""
    T = trimesh.transformations.rotation_matrix(np.radians(turn), [0, 0, 1])
    T[:2, 3] = x, y
    nodes = []
    for part, boxes in pieces.items():
        vertices = np.concatenate([v for v, _ in boxes])
        faces = np.concatenate([f + 8 * k for k, (_, f) in enumerate(boxes)])
        node = simple_mesh("scene", part, vertices, faces).transformed(T)
        path = (name, f"{name}/{part}") if name else ()
        nodes.append(replace(node, nodes=(replace(node.nodes[0], name=f"{name}_{part}", path=path),)))
    return nodes


def fused(mesh: Mesh) -> Mesh:
    """Return the same surface as one node."""
    return replace(mesh, face_node=np.zeros(len(mesh.faces), np.int64), nodes=mesh.nodes[:1])


def row(places: Sequence[float], *, named: bool = True) -> Mesh:
    return join([node for k, x in enumerate(places) for node in placed(CABINET, f"cabinet_{k}" if named else "", x)])


def sizes(mesh: Mesh) -> list[int]:
    return sorted(len(o.faces) for o in find_objects(mesh))


@pytest.mark.parametrize("gap", [0.0, 0.02, 0.3])
def test_the_nodes_of_a_row_of_cabinets_are_its_objects(gap) -> None:
    found = find_objects(row([0, 0.5 + gap, 1 + 2 * gap]))
    assert [(o.name, len(o.faces), o.fixed) for o in found] == [(f"cabinet_{k}", 84, False) for k in range(3)]


def test_objects_of_one_node_are_told_apart_by_their_distance() -> None:
    assert sizes(fused(row([0, 0.55, 1.1]))) == [84, 84, 84]


def test_a_worktop_and_a_room_are_no_cabinets() -> None:
    top = placed({"slab": [box([-0.3, -0.25, 0.7], [0.8, 0.25, 0.74])]}, "worktop")
    found = find_objects(join([row([0, 0.5]), *top, *placed(ROOM, "")]))
    assert sorted((len(o.faces), o.fixed) for o in found) == [(12, False), (36, True), (84, False), (84, False)]


WHEEL = [(x, y) for x in (-0.9, 0.9) for y in (-1.3, 1.3)]
SINGLE: dict[str, Pieces] = {
    "a cabinet": CABINET,
    "a door that floats 2 cm before its case": {**CABINET, "door": [box([-0.25, -0.24, 0], [0.25, -0.22, 0.7])]},
    "a car with wheels beside it": {
        "body": [box([-0.7, -2, 0.3], [0.7, 2, 1.4])],
        **{f"wheel_{k}": [box([x - 0.15, y - 0.3, 0], [x + 0.15, y + 0.3, 0.6])] for k, (x, y) in enumerate(WHEEL)},
    },
    "a table with legs that do not touch": {
        "top": [box([-0.6, -0.4, 0.72], [0.6, 0.4, 0.75])],
        **{
            f"leg_{k}": [box([x * 0.6 - 0.03, y * 0.25 - 0.03, 0], [x * 0.6 + 0.03, y * 0.25 + 0.03, 0.7])]
            for k, (x, y) in enumerate(WHEEL)
        },
    },
    "a chest of drawers": {
        "case": [box(*wall) for wall in WALLS],
        **{f"drawer_{k}": [box([-0.22, -0.22, 0.03 + 0.3 * k], [0.22, 0.17, 0.3 + 0.3 * k])] for k in range(2)},
    },
    "a pot and its lid": {"pot": [box([-0.1, -0.1, 0], [0.1, 0.1, 0.15])], "lid": [box([-0.1, -0.1, 0.16], [0.1, 0.1, 0.17])]},
}


@pytest.mark.parametrize("pieces", SINGLE.values(), ids=SINGLE)
def test_a_single_object_is_no_scene(pieces) -> None:
    whole = join(placed(pieces, "thing"))
    for mesh in (whole, fused(whole), join(placed(pieces, ""))):
        assert len(find_objects(mesh)) == 1


def test_what_a_stated_joint_moves_is_no_object_of_its_own() -> None:
    joint = StatedJoint(JointType.REVOLUTE, np.zeros(3), np.array([1.0, 0, 0]), (0.0, 1.0))
    pieces = {"a": [box([-0.4, -0.2, 0], [0.4, 0.2, 0.3])], "b": [box([-0.4, -0.2, 0.301], [0.4, 0.2, 0.34])]}
    chest = join(placed(pieces, ""))
    nodes = tuple(replace(n, name="Chest", path=("rig", n.name, "Chest")) for n in chest.nodes)  # bones of one skin
    assert len(find_objects(replace(chest, nodes=nodes))) == 2
    moved = replace(chest, nodes=(nodes[0], replace(nodes[1], joint=0)), joints=(joint,))
    assert len(find_objects(moved)) == 1


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory):
    """A GLB of three equal cabinets, one of them turned, and a lower one, in a room."""
    low = {name: [(v * [1, 1, 0.5], f) for v, f in boxes] for name, boxes in CABINET.items()}
    scene = trimesh.Scene()
    scene.graph.update("top", matrix=trimesh.transformations.rotation_matrix(-np.pi / 2, [1, 0, 0]))
    places = {
        "base_a": (CABINET, 0, 0, 0),
        "base_b": (CABINET, 0.55, 0, 0),
        "base_c": (CABINET, 3, 1, 90),
        "low": (low, 1.6, 0, 0),
        "room": (ROOM, 0, 0, 0),
    }
    for name, (pieces, x, y, turn) in places.items():
        T = trimesh.transformations.rotation_matrix(np.radians(turn), [0, 0, 1])
        T[:2, 3] = x, y
        scene.graph.update(name, "top", matrix=T)
        for part, boxes in pieces.items():
            solid = trimesh.util.concatenate([trimesh.Trimesh(v, f, process=False) for v, f in boxes])
            scene.add_geometry(
                solid,
                node_name=f"{name}_{part}",
                geom_name=f"{'low' if pieces is low else 'base'}_{part}",
                parent_node_name=name,
            )
    path = tmp_path_factory.mktemp("scene") / "kitchen.glb"
    path.write_bytes(scene.export(file_type="glb"))
    return path


@pytest.fixture(scope="module")
def split(kitchen, tmp_path_factory):
    out = tmp_path_factory.mktemp("split") / "kitchen"
    return anymesh.articulate_scene(kitchen, out, formats="mjcf,usd"), out


def test_without_the_option_a_warning_says_how_many_objects_there_are(kitchen, tmp_path) -> None:
    asset = anymesh.articulate(kitchen, tmp_path / "out", parts="none", formats="glb")
    assert "a scene of 4 objects is taken as one; --scene split articulates each" in asset.warnings


def test_equal_objects_are_one_asset_with_its_placements(split) -> None:
    scene, out = split
    assert {name: len(places) for name, places in scene.placements.items()} == {"base_a": 3, "low": 1, "room": 1}
    joints = {name: json.loads((out / "assets" / name / "asset.json").read_text())["joints"] for name in scene.placements}
    assert {name: [j["child"] for j in made] for name, made in joints.items()} == {
        "base_a": ["door"],
        "low": ["door"],
        "room": [],
    }


def drawn_corners(model, data, geom: int) -> np.ndarray:
    mesh = model.geom_dataid[geom]
    start, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    return model.mesh_vert[start : start + count] @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]


def test_the_whole_in_mujoco_has_every_object_where_it_was(split, kitchen) -> None:
    model = mujoco.MjModel.from_xml_path(str(split[1] / "scene.xml"))
    assert [model.joint(k).name for k in range(model.njnt)] == [
        f"{name}/door_joint" for name in ("base_a", "base_b", "base_c", "low")
    ]
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    drawn = [k for k in range(model.ngeom) if model.geom_type[k] == mujoco.mjtGeom.mjGEOM_MESH and model.geom_contype[k] == 0]
    corners = np.concatenate([drawn_corners(model, data, k) for k in drawn])
    truth = load_mesh(kitchen).mesh.triangles.reshape(-1, 3) @ np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]).T
    truth = truth - [*(truth.min(0) + truth.max(0))[:2] / 2, truth[:, 2].min()]
    for a, b in ((corners, truth), (truth, corners)):
        assert np.abs(a[:, None] - np.unique(b.round(6), axis=0)[None]).max(2).min(1).max() < 1e-4


def test_the_whole_in_usd_refers_to_each_asset(split) -> None:
    usd = pytest.importorskip("pxr.Usd")
    from pxr import UsdGeom, UsdPhysics

    stage = usd.Stage.Open(str(split[1] / "scene.usda"))
    assert [str(p.GetPath()) for p in stage.Traverse() if p.IsA(UsdPhysics.RevoluteJoint)] == [
        f"/scene/{name}/joints/door_joint" for name in ("base_a", "base_b", "base_c", "low")
    ]
    box_ = UsdGeom.BBoxCache(usd.TimeCode.Default(), ["default", "render"]).ComputeWorldBound(stage.GetDefaultPrim())
    assert np.array(box_.ComputeAlignedRange().GetSize()) == pytest.approx([5.05, 4.05, 2.65], abs=1e-4)


def test_a_finished_scene_is_kept_and_an_unfinished_one_is_continued(split, kitchen) -> None:
    _, out = split
    with pytest.raises(OutputError, match="not empty"):
        anymesh.articulate_scene(kitchen, out, formats="mjcf,usd")
    record = json.loads((out / "scene.json").read_text())
    (out / "scene.json").write_text(json.dumps({**record, "finished": False}))
    before = (out / "assets" / "low" / "asset.json").stat().st_mtime_ns
    anymesh.articulate_scene(kitchen, out, formats="mjcf,usd")
    assert (out / "assets" / "low" / "asset.json").stat().st_mtime_ns == before
    assert json.loads((out / "scene.json").read_text()) == record
    with pytest.raises(OptionError, match="auto and nodes"):
        anymesh.articulate_scene(kitchen, out, parts="labels.npy")
    with pytest.raises(OptionError, match="--mass is that of one object"):
        anymesh.articulate_scene(kitchen, out, mass=20.0)


def test_the_command_lists_the_assets(kitchen, tmp_path, capsys) -> None:
    assert run(["articulate", str(kitchen), "-o", str(tmp_path / "k"), "--scene", "split", "--formats", "glb", "--json"]) == 0
    made = json.loads(capsys.readouterr().out)["assets"]
    assert [(a["asset"], a["placed"], a["joints"]) for a in made] == [
        ("base_a", 3, "door_joint"),
        ("low", 1, "door_joint"),
        ("room", 1, ""),
    ]
    assert run(["articulate", str(kitchen), "-o", str(tmp_path / "n"), "--scene", "pieces"]) == OptionError.exit_code
