"""Pivots of nodes as each format states them, in the coordinates of the file."""

import pytest
from mesh_files import DAE_INSTANCE, dae, put

from anymesh.formats.dae.document import read_dae
from anymesh.formats.in_metres import read_in_metres
from anymesh.formats.reading import read_isolated
from anymesh.loading.files import Folder

MOVED = ("Lcl Translation", 10, 0, 0), ("Lcl Rotation", 0, 0, 90)
PIVOT = (1, 2, 0)
OPS = '"xformOp:translate", "xformOp:translate:pivot", "xformOp:rotateZ", "!invert!xformOp:translate:pivot"'


@pytest.mark.parametrize(
    ("more", "found"),
    [
        ((), (10, 0, 0)),
        ((("RotationPivot", *PIVOT),), (11, 2, 0)),
        ((("RotationPivot", *PIVOT), ("ScalingPivot", *PIVOT), ("Lcl Scaling", 2, 2, 2)), (11, 2, 0)),
    ],
)
def test_fbx_turns_a_node_about_its_rotation_pivot(tmp_path, more, found) -> None:
    pytest.importorskip("ufbx")
    from fbx_text import QUAD, FbxText, prop

    made = FbxText()
    made.mesh(made.node("door", *(prop(*p) for p in (*MOVED, *more))), *QUAD)
    (tmp_path / "a.fbx").write_text(made.text())
    assert read_isolated(b"", Folder(tmp_path / "a.fbx")).mesh.nodes[0].pivot == pytest.approx(found)
    assert read_in_metres(tmp_path / "a.fbx", None)[0].nodes[0].pivot is None


@pytest.mark.parametrize("above", [False, True])
def test_usd_turns_a_prim_about_the_pivot_of_its_operations(tmp_path, above: bool) -> None:
    pytest.importorskip("pxr")
    from usda import mesh, read, xform

    moves = "double3 xformOp:translate = (10, 0, 0)\nfloat3 xformOp:translate:pivot = (1, 2, 0)\nfloat xformOp:rotateZ = 90\n"
    moves += f"uniform token[] xformOpOrder = [{OPS}]\n"
    found, _ = read(tmp_path, xform("door", mesh("panel"), moves) if above else mesh(more=moves))
    assert found.mesh.nodes[0].pivot == pytest.approx((11, 2, 0))


def test_dae_turns_a_node_about_its_origin(tmp_path) -> None:
    turned = f'<node id="n"><translate>1 2 3</translate><rotate>0 0 1 90</rotate>{DAE_INSTANCE}</node>'
    path = put(tmp_path, "a.dae", dae(nodes=turned))
    assert read_dae(path.read_bytes(), Folder(path)).nodes[0].pivot == pytest.approx((1, 2, 3))
