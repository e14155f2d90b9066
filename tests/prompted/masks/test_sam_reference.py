"""Our automatic masks against segment-anything's own, on the same logits and on the same small random model.

    pip install torch==2.13.0 segment-anything onnx onnxruntime opencv-python-headless && pytest -m slow tests/models_sam

segment-anything takes box suppression from torchvision. Where that does not load (its wheels want the CUDA build of
torch) ONNX Runtime's NonMaxSuppression stands in: not ours either.
"""

import importlib

import numpy as np
import pytest
from sam_reference import SIDE, SIZES, logits, picture, small_sam

from anymesh.prompted.masks.sam_frame import Frame
from anymesh.prompted.masks.sam_masks import crop_boxes, mask_box, point_grid, stability, without_small_regions

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("smooth", [False, True])
def test_stability_boxes_and_regions(reference, smooth):
    import torch

    amg = reference.utils.amg
    for seed in range(20):
        found = logits(seed, smooth)
        expected = amg.calculate_stability_score(torch.from_numpy(found), 0.0, 1.0).numpy()
        np.testing.assert_allclose([stability(one, 1.0) for one in found], expected, rtol=1e-6)
        boxes = amg.batched_mask_to_box(torch.from_numpy(found > 2)).numpy()
        assert [mask_box(one > 2) for one in found] == [tuple(box) for box in boxes.tolist()]
        if importlib.util.find_spec("cv2"):
            for one in found > 0:
                holes, changed = amg.remove_small_regions(one, 12, mode="holes")
                whole, again = amg.remove_small_regions(holes, 12, mode="islands")
                cleaned, told = without_small_regions(one, 12)
                np.testing.assert_array_equal(cleaned, whole)
                assert told == (changed or again)


@pytest.mark.parametrize(("height", "width"), SIZES)
def test_grids_crops_and_the_frame(reference, height, width):
    amg = reference.utils.amg
    transform = reference.utils.transforms.ResizeLongestSide(SIDE)
    np.testing.assert_allclose(point_grid(7), amg.build_point_grid(7), atol=1e-12)
    for layers in range(3):
        boxes, numbers = amg.generate_crop_boxes((height, width), layers, 512 / 1500)
        assert crop_boxes(height, width, layers, 512 / 1500) == list(zip(numbers, map(tuple, boxes), strict=True))
    frame, points = Frame(SIDE, padded=True), np.random.default_rng(0).uniform(0, 70, (9, 2))
    np.testing.assert_allclose(frame.points(points, height, width), transform.apply_coords(points, (height, width)), atol=1e-9)
    np.testing.assert_array_equal(frame.resize(picture(height, width)), transform.apply_image(picture(height, width)))


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize(("height", "width"), SIZES)
def test_upscaling_and_padding_removal(reference, height, width, smooth, record_property):
    import torch
    from torch.nn import functional

    sam, frame = small_sam(reference), Frame(SIDE, padded=True)
    low = logits(1, smooth)
    expected = sam.postprocess_masks(torch.from_numpy(low)[None], frame.inner(height, width), (height, width))[0].numpy()
    found = np.stack([frame.upscaler(low.shape[-2:], height, width)(one) for one in low])
    record_property("largest difference", float(np.abs(found - expected).max()))
    np.testing.assert_allclose(found, expected, atol=2e-5)
    # SAM 2 stretches: one resize, from the low resolution to the picture
    expected = functional.interpolate(torch.from_numpy(low)[None], (height, width), mode="bilinear")[0].numpy()
    stretched = Frame(SIDE, padded=False).upscaler(low.shape[-2:], height, width)
    np.testing.assert_allclose(np.stack([stretched(one) for one in low]), expected, atol=2e-5)
