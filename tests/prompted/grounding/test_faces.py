"""Test the assignment of faces to parts from labelled points: whole patches, cuts, unseen patches, names."""

from pathlib import Path

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of

from anymesh.evaluation.ground_truth import GroundTruth, example_truths
from anymesh.evaluation.score import match_parts, part_ious
from anymesh.loading import load_mesh, place_mesh
from anymesh.prompted.grounding.cloud import Cloud, sample_cloud, seen_points
from anymesh.prompted.grounding.em import refine_instances
from anymesh.prompted.grounding.faces import face_parts, mark_parts, point_parts
from anymesh.prompted.grounding.fuse import Instances, Mask, count_points, fuse_masks
from anymesh.prompted.grounding.regions import Marks, face_regions, number_regions
from anymesh.prompted.grounding.views import unseen_patches
from anymesh.rendering.render import View, render
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.naming import named_parts
from anymesh.types.camera import Camera

FEW = 20_000  # points
# A base, a drawer's panel in front of it, the drawer's box behind the panel and inside the base, a loose block in there.
SHELL = [box((0, 0, 0), (1, 1, 0.02)), box((0, 0, 0.98), (1, 1, 1)), box((0, 0, 0.02), (0.02, 1, 0.98)),
         box((0.98, 0, 0.02), (1, 1, 0.98)), box((0.02, 0.98, 0.02), (0.98, 1, 0.98))]  # fmt: skip
FRONT, BIN, BLOCK = (
    box((0.05, -0.1, 0.05), (0.95, -0.05, 0.95)),
    box((0.1, -0.05, 0.1), (0.9, 0.8, 0.4)),
    box((0.4, 0.3, 0.6), (0.6, 0.5, 0.8)),
)


def parts_of(pieces, told: dict[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return the part of each face when the points of some pieces are known, and the piece of each face."""
    mesh, piece = mesh_of(pieces)
    whole = object_shape(mesh)
    cloud = sample_cloud(mesh, whole, FEW)
    point = np.array([told.get(int(p), -1) for p in piece[cloud.faces]])
    return face_parts(mesh, whole, cloud, point), piece


def test_a_box_that_no_view_sees_joins_the_front_that_it_hangs_on() -> None:
    found, piece = parts_of([*SHELL, FRONT, BIN, BLOCK], {0: 0, 1: 0, 2: 0, 3: 0, 4: 0, 5: 1})
    assert (found[(piece == 5) | (piece == 6)] == 1).all()
    assert (found[piece < 5] == 0).all()
    assert (found[piece == 7] == 0).all()  # nothing supports it


def test_a_box_that_also_touches_the_body_stays_with_what_it_touches_more() -> None:
    rail = box((0.02, 0.1, 0.2), (0.1, 0.7, 0.22))  # between the drawer's box and the side of the base
    found, piece = parts_of([*SHELL, FRONT, BIN, rail], {0: 0, 1: 0, 2: 0, 3: 0, 4: 0, 5: 1})
    assert (found[piece == 6] == 1).all()
    assert (found[piece < 5] == 0).all()


def test_a_small_component_goes_to_the_part_of_most_of_its_points() -> None:
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), box((1, 0.4, 0.4), (1.1, 0.6, 0.6))])
    whole = object_shape(mesh)
    cloud = sample_cloud(mesh, whole, FEW)
    point = np.where(piece[cloud.faces] == 1, (cloud.points[:, 0] > 1.04).astype(int), 0)
    found = face_parts(mesh, whole, cloud, point)
    assert (found == piece).all()


def test_a_piece_of_two_parts_is_cut_along_its_superpoints_without_speckles() -> None:
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(vertices, faces, 0.1))
    mesh, _ = mesh_of([(np.asarray(fine.vertices), np.asarray(fine.faces))])
    whole = object_shape(mesh)
    cloud = sample_cloud(mesh, whole, FEW)
    top = cloud.normals[:, 2] > 0.9
    rng = np.random.default_rng(0)
    point = np.where(rng.random(len(cloud)) < 0.25, ~top, top).astype(int)
    point[rng.random(len(cloud)) < 0.3] = -1
    point[cloud.normals[:, 0] > 0.9] = -1  # a side that no view shows
    found = face_parts(mesh, whole, cloud, point)
    known = mesh.face_normals[:, 0] < 0.9
    assert (found[known] == (mesh.face_normals[known, 2] > 0.9)).all()
    assert set(found[~known]) <= {0, 1}


def test_what_shows_through_a_gap_tells_nothing() -> None:
    mesh, piece = mesh_of([*SHELL, FRONT, BIN])
    whole = object_shape(mesh)
    cloud = sample_cloud(mesh, whole, FEW)
    own = piece[cloud.faces]
    point = np.where(own == 5, 1, np.where(own < 5, 0, -1))
    point[np.flatnonzero(own == 6)[::200]] = 0
    assert (face_parts(mesh, whole, cloud, point)[piece == 6] == 1).all()


def test_nothing_told_is_all_base() -> None:
    assert (parts_of([*SHELL, FRONT], {})[0] == 0).all()
    assert (parts_of([*SHELL, FRONT], dict.fromkeys(range(6), 0))[0] == 0).all()


def test_names_are_unique_legal_and_the_largest_comes_first() -> None:
    found = named_parts(
        np.array([0, 2, 1, 3, 0]), ["door", "door", "top lid"], np.array([9.0, 3, 1, 2, 9]), [0.2, 0.3, 0.4], ["a", "b", "c"]
    )
    assert [p.name for p in found.parts] == ["base", "door_1", "top_lid", "door_2"]
    assert [p.label for p in found.parts] == ["base", "door", "top lid", "door"]
    assert [p.confidence for p in found.parts] == [1.0, 0.3, 0.4, 0.2]
    assert [p.reason for p in found.parts[1:]] == ["b", "c", "a"]
    assert found.face_part.tolist() == [0, 1, 3, 2, 0]


def test_parts_without_faces_are_left_out_and_a_base_is_found() -> None:
    found = named_parts(np.array([1, 3, 3]), ["door", "knob", "body"], np.ones(3), [1.0] * 3, [""] * 3)
    assert [p.name for p in found.parts] == ["base", "door"]
    assert found.face_part.tolist() == [1, 0, 0]


TRUTHS = {t.name: t for t in example_truths(Path(__file__).parents[3] / "examples")}


def grounded(truth: GroundTruth, exact: bool) -> tuple[float, float]:
    """Return the mean IoU of the movable parts and the IoU of the base for perfect labels of the regions."""
    mesh = place_mesh(load_mesh(truth.mesh)).mesh
    whole = object_shape(mesh)
    cloud = sample_cloud(mesh, whole, 30_000)
    middle, turns = mesh.bounds.mean(0), np.deg2rad(np.arange(0, 360, 45))
    eyes = [middle + mesh.diagonal * np.array([0.97 * np.cos(a), 0.97 * np.sin(a), 0.26]) for a in turns]
    views = [render(mesh, Camera.looking_at(e, middle, np.deg2rad(60.0), 320, 320)) for e in eyes]
    marks = number_regions(face_regions(whole, cloud), views, whole.diagonal)
    shown = seen_points(cloud, views)
    if exact:
        part = [np.bincount(truth.labels[marks.face_mark == n]).argmax() for n in range(1, int(marks.face_mark.max()) + 1)]
        named = [[n for n, p in enumerate(part, 1) if p == k] for k in range(1, len(truth.parts))]
        found = mark_parts(mesh, whole, marks.face_mark, named, unseen_patches(whole, cloud, shown))
    else:
        found = face_parts(mesh, whole, cloud, point_parts(cloud, by_masks(truth, marks, cloud, views), shown))
    ious = part_ious(found, truth.labels, mesh.face_areas)
    return sum(iou for _, _, iou in match_parts(ious)) / (len(truth.parts) - 1), float(ious[0, 0])


def by_masks(truth: GroundTruth, marks: Marks, cloud: Cloud, views: list[View]) -> Instances:
    """Return the result of PartSlip++ for views that number the parts independently."""
    rng = np.random.default_rng(0)
    counts = []
    for view in views:
        label, own = marks.in_view(view), np.where(view.face >= 0, truth.labels[np.maximum(view.face, 0)], 0)
        part = {int(n): int(np.bincount(own[label == n]).argmax()) for n in np.unique(label[label > 0])}
        masks = [
            Mask(np.isin(label, [n for n, p in part.items() if p == k]), truth.parts[k].label, int(rng.integers(1, 9)))
            for k in sorted(set(part.values()) - {0})
        ]
        counts.append(count_points(cloud, view, masks))
    return refine_instances(cloud, counts, fuse_masks(cloud, counts), rng)


ONLY_SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in ("cabinet", "stove_fused", "toy_car")]


@pytest.mark.parametrize("exact", [pytest.param(True, marks=pytest.mark.slow), False], ids=["exact", "em"])
@pytest.mark.parametrize("name", ["cabinet_fused", "laptop", *ONLY_SLOW])
def test_true_labels_on_proposals_give_the_true_parts(name: str, exact: bool) -> None:
    parts, base = grounded(TRUTHS[name], exact)
    assert parts >= 0.93
    assert base >= 0.93
