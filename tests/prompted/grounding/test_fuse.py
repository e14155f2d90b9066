"""Test labels and instances of superpoints from masks."""

import numpy as np
import pytest
from assets import box, mesh_of
from rows import counts_of, row_cloud

from anymesh.prompted.grounding.cloud import sample_cloud, sight
from anymesh.prompted.grounding.fuse import (
    Instances,
    Mask,
    Proposal,
    count_points,
    fuse_masks,
    join_numbered,
    label_superpoints,
    lost_parts,
    marked_masks,
    masks_to_labels,
    propose_masks,
)
from anymesh.prompted.questions.grounding import MarkedPart
from anymesh.rendering.render import render
from anymesh.segmentation.divide import object_shape
from anymesh.types.camera import Camera

MESH, PIECE = mesh_of([box((0, 0, 0), (1, 1, 1)), box((0, -0.2, 0), (0.48, -0.1, 1)), box((0.52, -0.2, 0), (1, -0.1, 1))])
WHOLE = object_shape(MESH)
CLOUD = sample_cloud(MESH, WHOLE, 10_000)
VIEWS = [
    render(MESH, Camera.looking_at(np.array(e), np.array([0.5, 0.4, 0.5]), 1.0, 200, 200))
    for e in ((0.5, -2.0, 0.6), (1.8, -1.4, 0.8), (-0.8, -1.4, 0.8))
]


def masks_of(view, instances=(1, 2)) -> list[Mask]:
    own = np.where(view.face >= 0, PIECE[np.maximum(view.face, 0)], -1)
    return [Mask(own == k, "door", i) for k, i in zip((1, 2), instances, strict=True)]


def test_counts_add_up() -> None:
    c = count_points(CLOUD, VIEWS[0], masks_of(VIEWS[0]))
    assert (c.top.sum(1) == c.seen).all()
    assert (c.inside == c.top[:, :-1]).all()  # these masks do not overlap
    assert c.seen.sum() == len(sight(CLOUD, VIEWS[0]).points)


def test_a_smaller_mask_owns_the_pixels_of_both() -> None:
    large, small = masks_of(VIEWS[1])
    both = Mask(large.pixels | small.pixels, "front")
    c = count_points(CLOUD, VIEWS[1], [small, both])
    assert c.labels == ("front", "door")
    assert (c.inside[:, 0] >= c.inside[:, 1]).all()
    assert ((c.top[:, 0] + c.top[:, 1]) == c.inside[:, 0]).all()
    assert c.inside[:, 1].sum() == c.top[:, 1].sum() > 0


def test_masks_of_nearly_all_the_object_and_empty_ones_are_ignored() -> None:
    everything = Mask(VIEWS[0].face >= 0, "cabinet")
    nothing = Mask(np.zeros_like(VIEWS[0].face, dtype=bool), "door")
    c = count_points(CLOUD, VIEWS[0], [everything, nothing])
    assert c.labels == ()
    assert c.top.shape[1] == 1


def test_two_doors() -> None:
    counts = [count_points(CLOUD, v, masks_of(v)) for v in VIEWS]
    found = fuse_masks(CLOUD, counts)
    assert found.labels == ("door", "door")
    own = np.zeros(CLOUD.count, int)
    own[CLOUD.superpoint] = PIECE[CLOUD.faces]
    well = sum(c.seen for c in counts) > 30
    assert len({(int(a), int(b)) for a, b in zip(own[well], found.number[well], strict=True)}) == 3
    assert (found.number[well & (own == 0)] == 0).all()
    assert (found.number[sum(c.seen for c in counts) == 0] == -1).all()


def test_instances_need_not_be_numbered_alike_in_all_views() -> None:
    same = fuse_masks(CLOUD, [count_points(CLOUD, v, masks_of(v)) for v in VIEWS])
    orders = ((1, 2), (2, 1), (7, 3))
    mixed = [count_points(CLOUD, v, masks_of(v, o)) for v, o in zip(VIEWS, orders, strict=True)]
    assert (fuse_masks(CLOUD, mixed).number == same.number).all()


def test_half_covered_is_enough_over_all_views_that_see_it() -> None:
    one, two = counts_of([[6, 4]], ["lid"]), counts_of([[4, 6]], ["lid"])
    assert label_superpoints([one, two])[1].tolist() == [0]
    assert label_superpoints([one, two, counts_of([[0, 1]], ["lid"])])[1].tolist() == [-1]


def test_the_larger_coverage_wins() -> None:
    names, label = label_superpoints([counts_of([[6, 4, 0], [5, 5, 0], [4, 6, 0]], ["lid", "door"])])
    assert names == ["door", "lid"]
    assert label.tolist() == [1, 0, 0]


def test_neighbours_of_one_label_are_one_part_unless_a_mask_tells_them_apart() -> None:
    near, far = row_cloud([0.0, 0.045]), row_cloud([0.0, 0.2])
    joint, apart = counts_of([[10, 0], [10, 0]], ["door"]), counts_of([[10, 0, 0], [0, 10, 0]], ["door", "door"])
    assert fuse_masks(near, [joint]).number.tolist() == [1, 1]
    assert sorted(fuse_masks(near, [joint, apart]).number) == [1, 2]
    assert sorted(fuse_masks(far, [apart]).number) == [1, 2]


def test_what_hardly_any_view_sees_joins_no_two_parts() -> None:
    row = row_cloud([0.0, 0.045, 0.09])
    told = counts_of([[10, 0, 0], [0, 0, 0], [0, 10, 0]], ["door", "door"])
    middle = counts_of([[0, 0], [10, 0], [0, 0]], ["door"])
    number = fuse_masks(row, [told, middle]).number
    assert number[0] != number[2]


def test_an_instance_without_a_mask_of_its_size_is_dropped() -> None:
    wide = counts_of([[10, 0], [0, 10], [0, 10], [10, 0]], ["door"])
    assert fuse_masks(row_cloud([0, 0.2, 0.4, 0.6]), [wide]).number.tolist() == [0, 0, 0, 0]


def test_instances_out_of_range_are_refused() -> None:
    with pytest.raises(ValueError, match="found 2"):
        Instances(np.array([0, 2]), ("door",))


def test_marks_become_masks_of_their_views() -> None:
    labels = np.array([[1, 2], [3, -1]])
    proposals = [Proposal(k, labels, (1, 2, 3)) for k in (0, 1)]
    first, second = marked_masks(proposals, [MarkedPart("door", 1, 0, (1, 2, -1)), MarkedPart("lid", 2, 1, (3, 9))])
    assert [(m.label, m.instance, m.pixels.tolist()) for m in first] == [("door", 1, [[True, True], [False, False]])]
    assert [(m.label, m.instance, m.pixels.tolist()) for m in second] == [("lid", 2, [[False, False], [True, False]])]


OUTSIDE = counts_of([[9, 0], [0, 0], [0, 9]], ["door"])  # of three superpoints, one view sees the first and the last
INSIDE = counts_of([[0, 0], [9, 0], [0, 9]], ["door"])
APART = Instances(np.array([1, 2, 0]), ("door", "door"))


def test_pieces_with_one_number_that_no_view_shows_together_are_one_part() -> None:
    found = join_numbered([OUTSIDE, INSIDE], APART)
    assert found.number.tolist() == [1, 1, 0]
    assert found.labels == ("door",)


def test_pieces_with_different_numbers_or_labels_stay_apart() -> None:
    second = counts_of([[0, 0], [9, 0], [0, 9]], ["door"], [2])
    assert join_numbered([OUTSIDE, second], APART).number.tolist() == [1, 2, 0]
    other = Instances(np.array([1, 2, 0]), ("door", "lid"))
    lid = counts_of([[0, 0], [9, 0], [0, 9]], ["lid"])
    assert join_numbered([OUTSIDE, lid], other).labels == ("door", "lid")


@pytest.mark.parametrize("order", [(1, 2), (2, 1)])
def test_numbers_that_are_mixed_up_join_nothing_that_one_view_tells_apart(order: tuple[int, int]) -> None:
    together = counts_of([[9, 0, 0], [0, 9, 0], [0, 0, 9]], ["door", "door"], order)
    found = join_numbered([OUTSIDE, INSIDE, INSIDE, together], APART)
    assert found.number.tolist() == [1, 2, 0]


def test_what_no_view_shows_and_what_has_no_number_stay_as_they_are() -> None:
    unseen = Instances(np.array([1, 2, -1]), ("door", "door"))
    nothing = counts_of([[9], [9], [0]], [])
    assert join_numbered([nothing], unseen).number.tolist() == [1, 2, -1]
    assert join_numbered([nothing], unseen).labels == ("door", "door")


def test_marked_parts_that_became_no_part_of_their_own_are_told() -> None:
    face = np.array([[0, 0, 1, 1, 2, 2, -1]])
    masks = [Mask(face == k, "knob", k + 1) for k in range(3)]
    assert lost_parts([masks], [face], np.array([1, 2, 3]), ["knob"] * 3) == ()
    merged = lost_parts([masks], [face], np.array([1, 1, 2]), ["knob"] * 2)
    assert merged == ("marked, but not found as parts of their own: 1 of label 'knob'",)
    assert "2 of label 'knob'" in lost_parts([masks], [face], np.array([0, 1, 2]), ["knob", "lid"])[0]
    again = [*masks[:2], Mask(face == 2, "knob", 2)]  # numbered otherwise in another view: nothing is lost
    assert lost_parts([masks, again], [face, face], np.array([1, 2, 3]), ["knob"] * 3) == ()


SAMPLED = 20_000  # points
BODY, FRONT = box((0, 0, 0), (1, 1, 1)), box((0, -0.1, 0), (1, -0.01, 1))


def views_of(mesh, size: int = 300):
    middle = mesh.bounds.mean(0)
    eyes = [middle + mesh.diagonal * np.array(e) for e in ((0, -1.0, 0.2), (0.7, -0.7, 0.2), (-0.7, -0.7, 0.2))]
    return [render(mesh, Camera.looking_at(eye, middle, np.deg2rad(60.0), size, size)) for eye in eyes]


def test_small_masks_are_dropped_and_small_lie_over_large() -> None:
    masks = np.zeros((3, 60, 60), bool)
    masks[0, 5:15, 5:15] = True
    masks[1, 2:50, 2:50] = True
    masks[2, 55:58, 55:58] = True  # 9 px
    labels = masks_to_labels(masks, 50.0)
    assert labels.max() == 2
    assert labels[10, 10] != labels[30, 30]
    assert labels[56, 56] == -1
    assert (labels == labels[10, 10]).sum() == 88  # the majority filter removes three pixels at each corner


def test_speckles_go_and_pieces_apart_get_numbers_of_their_own() -> None:
    masks = np.zeros((1, 60, 60), bool)
    masks[0, 5:25, 5:55] = masks[0, 35:55, 5:55] = True
    masks[0, 15, 30] = False
    labels = masks_to_labels(masks, 50.0)
    assert labels[15, 30] == labels[10, 10]
    assert sorted(np.unique(labels)) == [-1, 1, 2]
    assert labels[10, 10] != labels[40, 40]


def test_masks_of_a_view_stay_on_the_object() -> None:
    mesh, _ = mesh_of([BODY, FRONT])
    views = views_of(mesh)
    masks = [np.ones((1, 300, 300), bool) for _ in views]
    found = propose_masks(masks, views)
    for p, v in zip(found, views, strict=True):
        assert ((p.labels > 0) == (v.face >= 0)).all()
        assert p.numbers == (1,)
    assert propose_masks([np.zeros((0, 300, 300), bool)] * 3, views)[0].numbers == ()
