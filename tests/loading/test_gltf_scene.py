"""Test that what a glTF file holds of geometry and scene is read, or named in one warning: each row of docs/formats.md."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from mesh_files import FACES, LOW, POINTS, Gltf, assert_refused, draco, meshopt, plain_gltf, put

from anymesh.loading import LoadedMesh, load_mesh
from anymesh.types.triangles import face_cross

sys.path.insert(0, str(Path(__file__).parents[1] / "formats"))
from tables import check_table

BOX = POINTS[FACES]
Check = Callable[[LoadedMesh], object]


def plain(*warnings: str) -> Check:
    """Return the check that the box is read where it is, with these warnings."""

    def check(loaded: LoadedMesh) -> None:
        np.testing.assert_allclose(np.sort(loaded.mesh.triangles, 1), np.sort(BOX, 1), atol=2e-4)
        assert len(loaded.warnings) == len(warnings), loaded.warnings
        assert all(text in warning for text, warning in zip(warnings, loaded.warnings, strict=True)), loaded.warnings

    return check


def moved(*offsets, names: tuple[str, ...] = ()) -> Check:
    """Return the check that there is one box at each offset."""

    def check(loaded: LoadedMesh) -> None:
        mesh = loaded.mesh
        assert loaded.warnings == ()
        found = sorted(tuple(np.round(mesh.triangles[mesh.face_node == k].min((0, 1)), 4)) for k in range(len(mesh.nodes)))
        assert found == sorted(tuple(np.round(LOW + offset, 4)) for offset in offsets)
        assert not names or {n.name for n in mesh.nodes} == set(names)

    return check


def changed(change: Callable[[Gltf, dict], object]) -> bytes:
    g = plain_gltf()
    change(g, g.doc["meshes"][0]["primitives"][0])
    return g.glb()


def with_second(change: Callable[[Gltf, dict], object]) -> bytes:
    g = Gltf()
    bad = g.solid()
    g.node(mesh=g.mesh(g.solid(), bad))
    change(g, bad)
    return g.glb()


def with_node(**fields) -> bytes:
    """Return the box and a second node with the same mesh, 5 to the right."""
    g = plain_gltf()
    g.node(mesh=0, name="other", translation=[5, 0, 0], **fields)
    return g.glb()


def accessors() -> bytes:
    g = plain_gltf()
    packed = np.c_[np.zeros((8, 3)), np.full((8, 2), 7)].astype("<f4").tobytes()
    where, what = g.view(np.arange(8, dtype="<u2").tobytes()), g.view(POINTS.astype("<f4").tobytes())
    sparse = {"count": 8, "indices": {"bufferView": where, "componentType": 5123}, "values": {"bufferView": what}}
    g.doc["accessors"][0] |= {"bufferView": g.view(packed, byteStride=20), "sparse": sparse}
    return g.glb()


def strips() -> bytes:
    g = Gltf()
    corners = g.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    for mode, index in ((4, [0, 1, 2, 1, 3, 2]), (5, [0, 1, 2, 3]), (6, [0, 1, 3, 2])):
        primitive = {"attributes": {"POSITION": corners}, "indices": g.array(index, "B"), "mode": mode}
        g.node(mesh=g.mesh(primitive), name=f"square {mode}")
    return g.glb()


def three_squares(loaded: LoadedMesh) -> None:
    np.testing.assert_allclose(loaded.mesh.face_normals, [[0, 0, 1]] * 6)
    assert loaded.mesh.face_areas.sum() == pytest.approx(3)


def scenes(*lists: list[int], default: int | None = 0) -> bytes:
    g = plain_gltf()
    g.node(root=False, translation=[5, 0, 0], mesh=0)
    g.node(root=False)
    g.doc["scenes"] = [{"nodes": nodes} for nodes in lists]
    g.doc["scene"] = default
    if default is None:
        del g.doc["scene"]
    return g.glb()


def library() -> bytes:
    g = Gltf()
    g.mesh(g.solid())
    del g.doc["scenes"], g.doc["scene"], g.doc["nodes"]
    return g.glb()


def skinned(weights, joints=None, *, bind: float | None = None, more: bool = False, armature: float = 0.5) -> bytes:
    """Return two boxes in one mesh, 2 apart, bound to bones at x = 10 and x = 20, below an armature of scale .5."""
    g = Gltf()
    points = np.r_[POINTS, POINTS + np.array([2, 0, 0])]
    joints = np.c_[np.repeat([0, 1], 8), np.zeros((16, 3), int)] if joints is None else joints
    attributes = {"POSITION": g.array(points), "JOINTS_0": g.array(joints, "B"), "WEIGHTS_0": g.array(weights)}
    if more:
        attributes |= {"JOINTS_1": g.array(np.ones((16, 4)), "B"), "WEIGHTS_1": g.array(np.tile([1.0, 0, 0, 0], (16, 1)))}
    primitive = {"attributes": attributes, "indices": g.array(np.r_[FACES, FACES + 8].ravel(), "H")}
    g.node(mesh=g.mesh(primitive, name="pair"), skin=0, name="pair", translation=[100, 0, 0], scale=[7, 7, 7])
    first = [g.node(root=False, name=f"hinge_{k}", translation=[10 + 10 * k, 0, 0]) for k in range(2)]
    g.node(name="Armature", scale=[armature, 0.5, 0.5], children=first)
    g.doc["skins"] = [{"joints": first}]
    if bind is not None:
        matrix = np.diag([bind, bind, bind, 1.0])
        g.doc["accessors"].append({"count": 2, "type": "MAT4", "componentType": 5126,
                                   "bufferView": g.view(np.tile(matrix.ravel(), 2).astype("<f4").tobytes())})  # fmt: skip
        g.doc["skins"][0]["inverseBindMatrices"] = len(g.doc["accessors"]) - 1
    return g.glb()


ALONE = np.tile([1.0, 0, 0, 0], (16, 1))


def by_two(loaded: LoadedMesh) -> None:
    """Vertices follow the mean of both bones, whose sum of weights is 2."""
    np.testing.assert_allclose(
        loaded.mesh.bounds, [[7.5 + LOW[0] / 2, *LOW[1:] / 2], (POINTS.max(0) + np.array([17, 0, 0])) / 2]
    )
    assert [n.name for n in loaded.mesh.nodes] == ["pair"]
    assert loaded.warnings == ()


def without_bones(loaded: LoadedMesh) -> None:
    assert loaded.mesh.bounds[0] == pytest.approx(7 * LOW + np.array([100, 0, 0]))
    assert "skin" in loaded.warnings[0]


def instances() -> bytes:
    g = plain_gltf()
    attributes = {"TRANSLATION": g.array([[0, 0, 0], [5, 0, 0], [9, 0, 0]]), "ROTATION": g.array([[0, 0, 0, 1]] * 3)}
    g.doc["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    g.doc["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    return g.glb()


def levels() -> bytes:
    g = plain_gltf()
    other = g.node(mesh=0, name="coarse", translation=[5, 0, 0])
    g.doc["nodes"][0]["extensions"] = {"MSFT_lod": {"ids": [other]}}
    return g.glb()


def hidden() -> bytes:
    g = plain_gltf()
    child = g.node(root=False, mesh=0, name="child")
    g.node(children=[child], extensions={"KHR_node_visibility": {"visible": False}})
    return g.glb()


def camera() -> bytes:
    g = plain_gltf()
    child = g.node(root=False, mesh=0, name="frustum")
    g.node(children=[child], camera=0)
    g.node(extensions={"KHR_lights_punctual": {"light": 0}})
    return g.glb()


def quantized() -> bytes:
    g = Gltf()
    solid = g.solid()
    del solid["attributes"]["POSITION"]
    steps = np.pad(np.rint((POINTS - LOW) / 2**-12), ((0, 0), (0, 1)))
    g.doc["accessors"].append({"count": 8, "type": "VEC3", "componentType": 5123,
                               "bufferView": g.view(steps.astype("<u2").tobytes(), byteStride=8)})  # fmt: skip
    solid["attributes"]["POSITION"] = len(g.doc["accessors"]) - 1
    g.node(mesh=g.mesh(solid), translation=LOW.tolist(), scale=[2**-12] * 3)
    g.doc["extensionsRequired"] = ["KHR_mesh_quantization"]
    return g.glb()


def bad_indices(g: Gltf, p: dict) -> None:
    p["indices"] = g.array(np.r_[FACES.ravel(), 3, 99, 5], "H")


HINGES = ("hinge_0", "hinge_1")
ROWS: dict[str, tuple[bytes | list[bytes], Check]] = {
    "`accessors`: `byteStride`, `normalized`, `sparse`": (accessors(), plain()),
    "modes 4 to 6 (triangles, strips, fans)": (strips(), three_squares),
    "modes 0 to 3 (points, lines)": (with_second(lambda _, p: p.update(mode=1)), plain("left out: 1 lines (no triangles)")),
    "`indices`, `POSITION`": (changed(bad_indices), plain("left out: triangles whose positions are missing")),
    "a primitive that cannot be read": (
        with_second(lambda _, p: p["attributes"].clear()),
        plain("primitive 1 of the mesh 'box': it has no"),
    ),
    "an attribute that cannot be read": (
        changed(lambda g, p: p["attributes"].update(NORMAL=g.array(POINTS[:3]), COLOR_0=99)),
        plain("NORMAL of primitive 0 of the mesh 'box': it has 3 elements", "COLOR_0 of primitive 0"),
    ),
    "`TANGENT`, application-specific attributes": (
        changed(lambda g, p: p["attributes"].update(TANGENT=g.array(np.ones((8, 4))), _HEAT=99)),
        plain(),
    ),
    "`targets`, `weights` (morph targets)": (
        changed(lambda g, p: (g.doc["meshes"][0].update(weights=[0.0]), p.update(targets=[{"POSITION": g.array(POINTS)}]))),
        plain("morph targets"),
    ),
    "`nodes`: `matrix`, `translation`, `rotation`, `scale`": (with_node(), moved([0, 0, 0], [5, 0, 0])),
    "`scene`, several `scenes`": ([scenes([0], [2]), scenes([2], [0])], plain()),
    "no `scenes`, no `nodes`": (library(), plain()),
    "`skins`": (skinned(ALONE, bind=2.0), moved([5, 0, 0], [12, 0, 0])),
    "weights of one bone": (skinned(ALONE, bind=2.0), moved([5, 0, 0], [12, 0, 0], names=HINGES)),
    "`JOINTS_1`, `WEIGHTS_1`, weights whose sum is not 1": (skinned(ALONE, 0 * np.ones((16, 4)), more=True), by_two),
    "a skin that cannot be read": (skinned(ALONE).replace(b'"joints": [1', b'"joints": [9'), without_bones),
    "`EXT_mesh_gpu_instancing`": (instances(), moved([0, 0, 0], [5, 0, 0], [9, 0, 0])),
    "`KHR_node_visibility`": (hidden(), plain("1 hidden node is left out (KHR_node_visibility): child")),
    "`MSFT_lod`": (levels(), plain("1 coarser level of detail is left out, the finest is kept (MSFT_lod): coarse")),
    "`cameras`, `KHR_lights_punctual`": (camera(), plain("1 mesh below a camera is left out: frustum")),
    "`KHR_mesh_quantization`": (quantized(), plain()),
    "`KHR_draco_mesh_compression`": (draco(), plain()),
    "`EXT_meshopt_compression`, `KHR_meshopt_compression`": ([meshopt(), meshopt("KHR_meshopt_compression")], plain()),
    "other extensions that the file requires": (
        changed(lambda g, _: g.doc.update(extensionsRequired=["ACME_gravity"])),
        plain("requires the extension ACME_gravity, which is not read"),
    ),
}


@pytest.mark.parametrize("row", ROWS)
def test_each_row_of_the_table_is_true(tmp_path, row) -> None:
    files, check = ROWS[row]
    for data in files if isinstance(files, list) else [files]:
        check(load_mesh(put(tmp_path, "box.glb", data)))


def test_the_table_has_these_rows() -> None:
    check_table("glTF: geometry and scene", ROWS)


def test_which_scene_is_read(tmp_path) -> None:
    plain("1 other scene is left out; scene 1 is read")(load_mesh(put(tmp_path, "a.glb", scenes([1], [0], default=1))))
    plain()(load_mesh(put(tmp_path, "b.glb", scenes([2], [0]))))  # the default scene has no mesh
    plain("1 other scene is left out; scene 0 is read")(load_mesh(put(tmp_path, "c.glb", scenes([0], [1], default=None))))


def test_what_is_hidden_is_all_there_is(tmp_path) -> None:
    g = plain_gltf()
    g.doc["nodes"][0]["extensions"] = {"KHR_node_visibility": {"visible": False}}
    plain()(load_mesh(put(tmp_path, "a.glb", g.glb())))


def test_a_bone_that_mirrors_keeps_faces_outwards(tmp_path) -> None:
    mesh = load_mesh(put(tmp_path, "a.glb", skinned(ALONE, bind=1.0, armature=-0.5))).mesh
    assert np.einsum("fi,fi->", mesh.triangles[:, 0], face_cross(mesh.triangles)) > 0


def test_a_mesh_that_bends_is_one_node(tmp_path) -> None:
    weights = ALONE.copy()
    weights[3] = [0.5, 0.5, 0, 0]
    joints = np.c_[np.repeat([0, 1], 8), np.ones(16, int), np.zeros((16, 2), int)]
    mesh = load_mesh(put(tmp_path, "a.glb", skinned(weights, joints))).mesh
    assert {n.name: n.path for n in mesh.nodes} == {"pair": (), "hinge_1": ("Armature", "hinge_1", "pair")}


@pytest.mark.parametrize("data", [draco(b"DRACO\2\2\1\1\0\0\0\0"), meshopt(broken=True)], ids=["draco", "meshopt"])
def test_broken_compressed_data_is_one_error(tmp_path, data) -> None:
    assert_refused(put(tmp_path, "a.glb", data), "data is", "needed")


def test_morph_targets_at_the_weights_of_the_node(tmp_path) -> None:
    g = plain_gltf()
    g.doc["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": g.array(np.tile([4.0, 0, 0], (8, 1)))}]
    g.doc["meshes"][0]["weights"] = [1]
    g.doc["nodes"][0]["weights"] = [0.25]
    assert load_mesh(put(tmp_path, "a.glb", g.glb())).mesh.bounds[0] == pytest.approx(LOW + np.array([1, 0, 0]))


def test_nodes_too_deep_are_refused(tmp_path) -> None:
    g = plain_gltf()
    for k in range(600):
        g.node(root=False, children=[k])
    g.doc["scenes"][0]["nodes"] = [600]
    assert_refused(put(tmp_path, "a.glb", g.glb()), "over 500 within each other")
