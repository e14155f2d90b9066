"""Test that data types validate their values, and that meshes keep their attributes."""

from dataclasses import replace

import numpy as np
import pytest
from assets import CUBE, CUBE_FACES, box, cabinet, joint, mesh_of
from scipy.spatial.transform import Rotation

from anymesh.types import Material, Part, Segmentation, Texture

ASSET = cabinet()
MESH, HINGE = ASSET.mesh, ASSET.joints[0]
PARTS = ASSET.segmentation.parts


def with_joints(*parents_and_children):
    joints = [joint(c, "fixed", p, c, (0, 0, 0), (0, 0, 1), None) for p, c in parents_and_children]
    return replace(ASSET, joints=tuple(joints))


WRONG = {
    "no faces": (lambda: MESH.subset(np.zeros(0, int)), "at least one face"),
    "infinite vertex": (lambda: replace(MESH, vertices=MESH.vertices + np.inf), "finite"),
    "face beyond": (lambda: replace(MESH, faces=MESH.faces + len(MESH.vertices)), "face indices"),
    "face below": (lambda: replace(MESH, faces=MESH.faces - 1), "face indices .* found -1"),
    "node beyond": (lambda: replace(MESH, face_node=MESH.face_node + 99), r"face_node must lie in 0\.\."),
    "node below": (lambda: replace(MESH, face_node=MESH.face_node * 0 - 1), "face_node .* found -1"),
    "no nodes": (lambda: replace(MESH, nodes=()), r"face_node must lie in 0\.\.-1"),
    "material beyond": (lambda: replace(MESH, materials=()), r"face_material must lie in -1\.\.-1"),
    "material below": (lambda: replace(MESH, face_material=MESH.face_material * 0 - 2), "face_material .* found -2"),
    "texture slot": (lambda: Material("m", textures={"glow": Texture(b"", "image/png")}), "'glow'"),
    "long axis": (lambda: replace(HINGE, axis=HINGE.axis * 1.1), "unit vector"),
    "axis not a number": (lambda: replace(HINGE, axis=np.full(3, np.nan)), "unit vector, found .*nan"),
    "axis without length": (lambda: replace(HINGE, axis=np.zeros(3)), "unit vector"),
    "origin not a number": (lambda: replace(HINGE, origin=np.array([0, np.nan, 0])), "origin must be finite, found .*nan"),
    "infinite origin": (lambda: replace(HINGE, origin=np.array([0, np.inf, 0])), "origin must be finite, found .*inf"),
    "confidence": (lambda: replace(HINGE, confidence=1.2), "1.2"),
    "no confidence": (lambda: replace(HINGE, confidence=float("nan")), "nan"),
    "no reason": (lambda: replace(HINGE, reason=""), "reason"),
    "limits missing": (lambda: replace(HINGE, limits=None), "None .* revolute"),
    "limits of a fixed joint": (lambda: joint("j", "fixed", "a", "b", (0, 0, 0), (0, 0, 1), (0.0, 1.0)), "fixed"),
    "limits off rest": (lambda: replace(HINGE, limits=(0.1, 1.0)), "rest pose"),
    "limits turned round": (lambda: replace(HINGE, limits=(1.0, -1.0)), "rest pose"),
    "limits without range": (lambda: replace(HINGE, limits=(0.0, 0.0)), "range"),
    "upper limit infinite": (lambda: replace(HINGE, limits=(0.0, np.inf)), "limits must be finite"),
    "lower limit infinite": (lambda: replace(HINGE, limits=(-np.inf, 0.0)), "limits must be finite"),
    "limit not a number": (lambda: replace(HINGE, limits=(0.0, np.nan)), "limits must be finite"),
    "part without name": (lambda: Part("", "door"), "name"),
    "part confidence": (lambda: Part("a", "door", -0.1), "-0.1"),
    "no parts": (lambda: Segmentation(np.zeros(3, int), ()), "root"),
    "same names": (lambda: Segmentation(np.arange(2), (Part("a", "x"), Part("a", "y"))), r"unique, found \['a', 'a'\]"),
    "part beyond": (lambda: Segmentation(np.arange(3), (Part("a", "x"), Part("b", "y"))), r"0\.\.1, found 2"),
    "part below": (lambda: Segmentation(np.arange(-1, 1), (Part("a", "x"),)), r"face_part must lie in 0\.\.0, found -1"),
    "part without faces": (lambda: Segmentation(np.zeros(3, int), (Part("a", "x"), Part("b", "y"))), r"\['b'\]"),
    "part without joint": (lambda: with_joints(("base", "door"), ("base", "drawer")), "needs one joint"),
    "same joint names": (
        lambda: replace(ASSET, joints=tuple(replace(j, name="j") for j in ASSET.joints)),
        r"joint names must be unique, found \['j', 'j'",
    ),
    "joint of the root": (lambda: with_joints(*[("door", n) for n in ("base", "drawer", "knob")]), "needs one joint"),
    "circle": (lambda: with_joints(("base", "door"), ("knob", "drawer"), ("drawer", "knob")), "tree"),
    "stranger": (lambda: with_joints(("base", "door"), ("base", "drawer"), ("stranger", "knob")), "tree"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_noun_that_is_wrong_is_not_made(name):
    make, message = WRONG[name]
    with pytest.raises(ValueError, match=message):
        make()


@pytest.mark.parametrize("name", ["face_node", "face_material", "corner_uv", "corner_color", "corner_normal"])
def test_attributes_have_one_row_a_face(name):
    with pytest.raises((ValueError, TypeError), match=name):  # type checks of annotations, if enabled, raise first
        replace(MESH, **{name: getattr(MESH, name)[:3]})


def test_the_smallest_right_nouns_are_made():
    assert with_joints(("base", "door"), ("door", "drawer"), ("drawer", "knob")).joints[2].parent == "drawer"
    assert replace(HINGE, limits=(-1.0, 0.0)).limits == (-1.0, 0.0)
    assert replace(HINGE, confidence=0.0).confidence == 0


def test_the_parts_share_out_the_faces():
    found = [ASSET.segmentation.faces(k) for k in range(4)]
    assert sorted(np.concatenate(found)) == list(range(len(MESH.faces)))
    assert all((ASSET.segmentation.face_part[f] == k).all() for k, f in enumerate(found))


def affine(seed: int, mirrored: bool) -> np.ndarray:
    """Return a random affine transform: rotated, sheared, scaled, moved."""
    rng = np.random.default_rng(seed)
    T = np.eye(4)
    shear = np.triu(rng.uniform(-0.5, 0.5, (3, 3)), 1) + np.diag(rng.uniform(0.5, 2, 3) * [-1 if mirrored else 1, 1, 1])
    T[:3, :3], T[:3, 3] = Rotation.random(random_state=seed).as_matrix() @ shear, rng.uniform(-5, 5, 3)
    return T


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_a_moved_mesh_keeps_its_normals_outward_and_its_corners_together(seed, mirrored):
    T = affine(seed, mirrored)
    moved = MESH.transformed(T)
    np.testing.assert_allclose(moved.corner_normal, np.repeat(moved.face_normals[:, None], 3, 1), atol=1e-5)
    cube, _ = mesh_of([(CUBE, CUBE_FACES)])
    out = cube.transformed(T)
    assert (np.einsum("ij,ij->i", out.face_normals, out.triangles.mean(1) - out.vertices.mean(0)) > 0).all()
    where = {(tuple(np.round(p, 6)), tuple(uv)) for p, uv in zip(flat(MESH.triangles, T), flat(MESH.corner_uv), strict=True)}
    assert where == {
        (tuple(np.round(p, 6)), tuple(uv)) for p, uv in zip(flat(moved.triangles), flat(moved.corner_uv), strict=True)
    }
    back = moved.transformed(np.linalg.inv(T))
    np.testing.assert_allclose(back.triangles, MESH.triangles, atol=1e-9)
    np.testing.assert_array_equal(back.corner_color, MESH.corner_color)


def flat(rows: np.ndarray, T: np.ndarray | None = None) -> np.ndarray:
    rows = rows.reshape(-1, rows.shape[-1])
    return rows if T is None else rows @ T[:3, :3].T + T[:3, 3]


def test_a_subset_has_the_same_faces_and_no_other_vertices():
    mask = ASSET.segmentation.face_part == 2
    for chosen in (mask, np.flatnonzero(mask)[::-1]):
        part = MESH.subset(chosen)
        np.testing.assert_array_equal(part.triangles, MESH.triangles[chosen])
        np.testing.assert_array_equal(part.corner_uv, MESH.corner_uv[chosen])
        np.testing.assert_array_equal(part.face_material, MESH.face_material[chosen])
        assert sorted(np.unique(part.faces)) == list(range(len(part.vertices)))


def test_areas_normals_and_bounds_of_a_box_are_as_built():
    vertices, faces = box((1, 2, 3), (2, 4, 6))
    unused, degenerate = np.full((1, 3), 99.0), np.array([[0, 0, 1]])
    mesh, _ = mesh_of([(np.concatenate([vertices, unused]), np.concatenate([faces, degenerate]))])
    assert mesh.face_areas.sum() == pytest.approx(2 * (2 + 3 + 6))
    np.testing.assert_array_equal(mesh.bounds, [[1, 2, 3], [2, 4, 6]])
    assert mesh.diagonal == pytest.approx(14**0.5)
    np.testing.assert_array_equal(np.linalg.norm(mesh.face_normals, axis=1), [1] * 12 + [0])
    np.testing.assert_allclose((mesh.face_normals * mesh.face_areas[:, None]).sum(0), 0, atol=1e-12)
