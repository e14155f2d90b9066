"""A recording becomes the thing that was recorded: its place, size, colour, and nothing else."""

import json
from pathlib import Path

import numpy as np
import pytest
from recordings import EXTENTS, VOXEL, thing

from anymesh.applications.scan import scan
from anymesh.applications.scan.frames import Frames, Observation, Pinhole, RgbdFrame
from anymesh.applications.scan.reading import read_frames
from anymesh.applications.scan.scanning import TO_GLTF
from anymesh.applications.scan.splatting_ import gaze, with_depth
from anymesh.errors import MissingExtraError
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.topology import components
from anymesh.loading import load_mesh
from anymesh.runtime import silent
from anymesh.types.camera import Camera


def in_truth(path: Path, report, recording: Path) -> np.ndarray:
    """Vertices of a scan in the true mesh's frame."""
    T = np.array(report.T_scan_world) @ np.array(json.loads((recording / "truth.json").read_text())["T_world_mesh"])
    return (load_mesh(path).mesh.vertices @ TO_GLTF - T[:3, 3]) @ T[:3, :3]


def test_it_lies_on_the_true_surface(scanned, recording: Path) -> None:
    out, report = scanned
    truth = thing()
    far = distance_to_mesh(in_truth(out, report, recording), truth.vertices, truth.faces)[0] / truth.diagonal
    assert far.mean() < 0.003
    assert np.quantile(far, 0.95) < 0.01


def test_the_true_surface_is_all_there(scanned, recording: Path) -> None:
    out, report = scanned
    corners = thing().vertices
    far = distance_to_mesh(corners, in_truth(out, report, recording), load_mesh(out).mesh.faces)[0]
    assert far.max() < 0.02  # [m] corners are the most that noise takes off


def test_up_floor_and_size(scanned) -> None:
    out, report = scanned
    assert report.floor == "removed"
    low, high = load_mesh(out).mesh.bounds  # y is up
    assert low[1] == pytest.approx(0, abs=0.002)
    assert high[1] == pytest.approx(EXTENTS[2], abs=0.01)
    assert sorted(report.extents) == pytest.approx(sorted([0.4, 0.35, 0.5]), abs=0.02)


def test_it_is_one_closed_outward_surface(scanned) -> None:
    out, report = scanned
    mesh = load_mesh(out).mesh
    found = components(mesh.vertices, mesh.faces)
    assert found.count == 1
    assert found.solid[0]
    assert not found.flip.any()
    assert len(mesh.faces) == report.faces
    assert [h.on_floor for h in report.holes if h.area > 0.05] == [True]  # it stands on it


def test_colors_are_those_of_the_parts(scanned, recording: Path) -> None:
    out, report = scanned
    mesh, at = load_mesh(out).mesh, in_truth(out, report, recording)
    color = np.zeros((len(mesh.vertices), 3))
    color[mesh.faces.reshape(-1)] = mesh.corner_color.reshape(-1, 4)[:, :3]
    knob = (at[:, 1] < -0.17) & (at[:, 2] > 0.31) & (at[:, 2] < 0.39)
    body = (at[:, 1] > -0.1) & (at[:, 2] > 0.1)
    assert np.median(color[knob, 2]) > np.median(color[knob, 0])
    assert np.median(color[body, 0]) > 2 * np.median(color[body, 2])


def test_the_same_recording_gives_the_same_bytes(scanned, recording: Path, tmp_path: Path) -> None:
    out, report = scanned
    again = scan(recording, tmp_path / "thing.glb", voxel=VOXEL)
    assert again == report
    assert (tmp_path / "thing.glb").read_bytes() == out.read_bytes()
    assert (tmp_path / "thing.scan.json").read_bytes() == out.with_name("thing.scan.json").read_bytes()


def test_report_is_written_beside(scanned) -> None:
    out, report = scanned
    told = json.loads(out.with_name("thing.scan.json").read_text())
    assert told["frames"] == 24
    assert told["voxel"] == report.voxel
    assert not list(out.parent.glob(".*"))


def test_voxel_faces_and_a_floor_to_keep_are_obeyed(recording: Path, tmp_path: Path) -> None:
    report = scan(recording, tmp_path / "floor.glb", voxel=0.02, faces=2000, keep_floor=True)
    assert report.voxel == 0.02
    assert report.faces < 2200
    assert report.floor == "kept"
    assert max(report.extents) > 0.8


def test_a_crop_keeps_what_is_inside(recording: Path, tmp_path: Path) -> None:
    T = np.array(json.loads((recording / "truth.json").read_text())["T_world_mesh"])
    x, y, z = T[:3, 3]
    crop = tuple(float(v) for v in (x - 1, y - 1, z + 0.25, x + 1, y + 1, z + 1))
    report = scan(recording, tmp_path / "top.glb", voxel=0.015, crop=crop, keep_floor=True)
    assert report.extents[2] == pytest.approx(0.25, abs=0.03)


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
