"""Test the conversion of parts to links: merged corners, no loss."""

from dataclasses import replace

import numpy as np
from assets import cabinet

from anymesh.export.links import split_links, unique_rows
from anymesh.export.model import ExportConfig

CONFIG = ExportConfig()


def test_links_hold_the_source_faces_in_order():
    asset = cabinet()
    for index, link in enumerate(split_links(asset)):
        np.testing.assert_array_equal(link.faces, asset.segmentation.faces(index))
        np.testing.assert_allclose(link.triangles + link.origin, asset.mesh.triangles[link.faces], atol=1e-12)


def test_equal_corners_are_merged_and_others_are_not():
    knob = split_links(cabinet())[3].primitives[0]
    assert len(knob.positions) == 24  # a box with flat normals and unwrapped sides
    bare = replace(cabinet().mesh, corner_uv=None, corner_normal=None, corner_color=None)
    assert len(split_links(replace(cabinet(), mesh=bare))[3].primitives[0].positions) == 8


def test_two_materials_in_a_part_are_two_primitives():
    asset = cabinet()
    material = asset.mesh.face_material.copy()
    material[asset.segmentation.faces(1)[:4]] = -1
    primitives = split_links(replace(asset, mesh=replace(asset.mesh, face_material=material)))[1].primitives
    assert [p.material for p in primitives] == [-1, 1]
    assert [len(p.triangles) for p in primitives] == [4, 8]


def test_zero_and_wrong_normals_become_the_face_normal():
    asset = cabinet()
    normals = asset.mesh.corner_normal.copy()
    normals[:6], normals[6:12] = 0, np.nan
    fixed = split_links(replace(asset, mesh=replace(asset.mesh, corner_normal=normals)))[0].primitives[0]
    np.testing.assert_allclose(np.linalg.norm(fixed.normals, axis=1), 1, atol=1e-6)


def test_unique_rows_against_numpy():
    rng = np.random.default_rng(0)
    rows = rng.integers(0, 3, (500, 4)).astype(np.uint64)
    first, inverse = unique_rows(list(rows.T))
    np.testing.assert_array_equal(rows[first][inverse], rows)
    assert len(first) == len(np.unique(rows, axis=0))
    assert (np.diff(first) > 0).all()
