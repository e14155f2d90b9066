"""Pictures without depth, where CUDA is; else one error that names what is missing."""

import numpy as np
import pytest

from anymesh.applications.scan.frames import Frames, Observation, Pinhole, RgbdFrame
from anymesh.applications.scan.reading import read_frames
from anymesh.applications.scan.splatting_ import gaze, with_depth
from anymesh.errors import MissingExtraError
from anymesh.runtime import silent
from anymesh.types.camera import Camera


def cuda() -> bool:
    try:
        import gsplat  # noqa: F401
        import torch
    except ImportError:
        return False
    return torch.cuda.is_available()


def test_the_point_that_cameras_look_at() -> None:
    target = np.array([0.3, -0.2, 0.5])
    eyes = target + 1.5 * np.array([[1.0, 0, 0], [0, 1, 0], [-0.6, 0, 0.8]])
    c = Pinhole(100.0, 100.0, 40.0, 30.0, 80, 60)
    nothing = Observation(np.zeros((60, 80, 3), np.uint8), np.zeros((1, 1), np.float32))
    poses = [Camera.looking_at(eye, target, 1.0, 80, 60).T_world_camera for eye in eyes]
    frames = Frames(tuple(RgbdFrame(str(k), c, T, lambda: nothing) for k, T in enumerate(poses)), "test", has_depth=False)
    center, distance = gaze(frames)
    np.testing.assert_allclose(center, target, atol=1e-9)
    assert distance == pytest.approx(1.5)


@pytest.mark.skipif(cuda(), reason="CUDA and gsplat are here")
def test_what_is_missing_is_told(recording) -> None:
    with pytest.raises(MissingExtraError, match="scan-gpu"):
        with_depth(read_frames(recording), seed=0, progress=silent)


@pytest.mark.slow
@pytest.mark.skipif(not cuda(), reason="2D Gaussian splatting needs CUDA and the extra scan-gpu")
def test_rendered_depth_is_near_the_sensor_s(recording) -> None:
    frames = read_frames(recording)
    made = with_depth(frames, seed=0, progress=silent)
    for mine, sensor in zip(made.frames[:5], frames.frames[:5], strict=True):
        a, b = mine.observe().depth, sensor.observe().depth
        both = (a > 0) & (b > 0)
        assert both.mean() > 0.3
        assert np.median(np.abs(a - b)[both] / b[both]) < 0.03
