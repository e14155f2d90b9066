"""Test labels and instances of superpoints from masks."""

import numpy as np
import pytest
from assets import box, mesh_of
from rows import counts_of, row_cloud

from anymesh.config import GroundingConfig
from anymesh.prompted.grounding.cloud import sample_cloud, sight
from anymesh.prompted.grounding.fuse import Instances, Mask, Proposal, count_points, fuse_masks, label_superpoints, marked_masks
from anymesh.prompted.questions.grounding import MarkedPart
from anymesh.rendering.render import render
from anymesh.segmentation.divide import object_shape
from anymesh.types.camera import Camera

FEW = GroundingConfig(points=10_000)
MESH, PIECE = mesh_of([box((0, 0, 0), (1, 1, 1)), box((0, -0.2, 0), (0.48, -0.1, 1)), box((0.52, -0.2, 0), (1, -0.1, 1))])
WHOLE = object_shape(MESH)
CLOUD = sample_cloud(MESH, WHOLE, FEW)
VIEWS = [
    render(MESH, Camera.looking_at(np.array(e), np.array([0.5, 0.4, 0.5]), 1.0, 200, 200))
    for e in ((0.5, -2.0, 0.6), (1.8, -1.4, 0.8), (-0.8, -1.4, 0.8))
]


def masks_of(view, instances=(1, 2)) -> list[Mask]:
    own = np.where(view.face >= 0, PIECE[np.maximum(view.face, 0)], -1)
    return [Mask(own == k, "door", i) for k, i in zip((1, 2), instances, strict=True)]


def test_counts_add_up() -> None:
    c = count_points(CLOUD, VIEWS[0], masks_of(VIEWS[0]), FEW)
    assert (c.top.sum(1) == c.seen).all()
    assert (c.inside == c.top[:, :-1]).all()  # these masks do not overlap
    assert c.seen.sum() == len(sight(CLOUD, VIEWS[0]).points)


def test_a_smaller_mask_owns_the_pixels_of_both() -> None:
    large, small = masks_of(VIEWS[1])
    both = Mask(large.pixels | small.pixels, "front")
    c = count_points(CLOUD, VIEWS[1], [small, both], FEW)
    assert c.labels == ("front", "door")
    assert (c.inside[:, 0] >= c.inside[:, 1]).all()
    assert ((c.top[:, 0] + c.top[:, 1]) == c.inside[:, 0]).all()
    assert c.inside[:, 1].sum() == c.top[:, 1].sum() > 0


def test_masks_of_nearly_all_the_object_and_empty_ones_are_ignored() -> None:
    everything = Mask(VIEWS[0].face >= 0, "cabinet")
    nothing = Mask(np.zeros_like(VIEWS[0].face, dtype=bool), "door")
    c = count_points(CLOUD, VIEWS[0], [everything, nothing], FEW)
    assert c.labels == ()
    assert c.top.shape[1] == 1


def test_two_doors() -> None:
    counts = [count_points(CLOUD, v, masks_of(v), FEW) for v in VIEWS]
    found = fuse_masks(CLOUD, counts, FEW)
    assert found.labels == ("door", "door")
    own = np.zeros(CLOUD.count, int)
    own[CLOUD.superpoint] = PIECE[CLOUD.faces]
    well = sum(c.seen for c in counts) > 30
    assert len({(int(a), int(b)) for a, b in zip(own[well], found.number[well], strict=True)}) == 3
    assert (found.number[well & (own == 0)] == 0).all()
    assert (found.number[sum(c.seen for c in counts) == 0] == -1).all()


def test_instances_need_not_be_numbered_alike_in_all_views() -> None:
    same = fuse_masks(CLOUD, [count_points(CLOUD, v, masks_of(v), FEW) for v in VIEWS], FEW)
    orders = ((1, 2), (2, 1), (7, 3))
    mixed = [count_points(CLOUD, v, masks_of(v, o), FEW) for v, o in zip(VIEWS, orders, strict=True)]
    assert (fuse_masks(CLOUD, mixed, FEW).number == same.number).all()


def test_half_covered_is_enough_over_all_views_that_see_it() -> None:
    one, two = counts_of([[6, 4]], ["lid"]), counts_of([[4, 6]], ["lid"])
    assert label_superpoints([one, two], FEW)[1].tolist() == [0]
    assert label_superpoints([one, two, counts_of([[0, 1]], ["lid"])], FEW)[1].tolist() == [-1]


def test_the_larger_coverage_wins() -> None:
    names, label = label_superpoints([counts_of([[6, 4, 0], [5, 5, 0], [4, 6, 0]], ["lid", "door"])], FEW)
    assert names == ["door", "lid"]
    assert label.tolist() == [1, 0, 0]


def test_neighbours_of_one_label_are_one_part_unless_a_mask_tells_them_apart() -> None:
    near, far = row_cloud([0.0, 0.045]), row_cloud([0.0, 0.2])
    joint, apart = counts_of([[10, 0], [10, 0]], ["door"]), counts_of([[10, 0, 0], [0, 10, 0]], ["door", "door"])
    assert fuse_masks(near, [joint], FEW).number.tolist() == [1, 1]
    assert sorted(fuse_masks(near, [joint, apart], FEW).number) == [1, 2]
    assert sorted(fuse_masks(far, [apart], FEW).number) == [1, 2]


def test_what_hardly_any_view_sees_joins_no_two_parts() -> None:
    row = row_cloud([0.0, 0.045, 0.09])
    told = counts_of([[10, 0, 0], [0, 0, 0], [0, 10, 0]], ["door", "door"])
    middle = counts_of([[0, 0], [10, 0], [0, 0]], ["door"])
    number = fuse_masks(row, [told, middle], FEW).number
    assert number[0] != number[2]


def test_an_instance_without_a_mask_of_its_size_is_dropped() -> None:
    wide = counts_of([[10, 0], [0, 10], [0, 10], [10, 0]], ["door"])
    assert fuse_masks(row_cloud([0, 0.2, 0.4, 0.6]), [wide], FEW).number.tolist() == [0, 0, 0, 0]


def test_instances_out_of_range_are_refused() -> None:
    with pytest.raises(ValueError, match="found 2"):
        Instances(np.array([0, 2]), ("door",))


def test_marks_become_masks_of_their_views() -> None:
    labels = np.array([[1, 2], [3, -1]])
    proposals = [Proposal(k, labels, (1, 2, 3)) for k in (0, 1)]
    first, second = marked_masks(proposals, [MarkedPart("door", 1, 0, (1, 2, -1)), MarkedPart("lid", 2, 1, (3, 9))])
    assert [(m.label, m.instance, m.pixels.tolist()) for m in first] == [("door", 1, [[True, True], [False, False]])]
    assert [(m.label, m.instance, m.pixels.tolist()) for m in second] == [("lid", 2, [[False, False], [True, False]])]
