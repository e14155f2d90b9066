"""Every layout gives the frames that were written: poses, intrinsics and depth."""

import json
import shutil
import zipfile
from pathlib import Path

import numpy as np
import pytest
from recordings import as_colmap, as_nerfstudio, as_polycam, as_record3d

from anymesh.applications.scan.frames import Frames
from anymesh.applications.scan.reading import read_frames
from anymesh.errors import InputError, OptionError


@pytest.fixture(scope="module")
def few(recording: Path) -> Frames:
    """The first four frames."""
    found = read_frames(recording)
    return found.of(list(found.frames[:4]))


def assert_same_frames(found: Frames, true: Frames, *, half: bool = False, metres: float = 1e-6) -> None:
    assert len(found) == len(true)
    for a, b in zip(found.frames, true.frames, strict=True):
        np.testing.assert_allclose(a.T_world_camera, b.T_world_camera, atol=1e-6)
        for key in ("fx", "fy", "cx", "cy"):
            assert getattr(a.camera, key) == pytest.approx(getattr(b.camera, key), rel=1e-6)
        mine, theirs = a.observe(), b.observe()
        expected = theirs.depth[::2, ::2].copy() if half else theirs.depth
        if half:
            expected[:10] = 0  # what the confidence map refuses
        np.testing.assert_allclose(mine.depth, expected, atol=metres)
        assert mine.color.shape == theirs.color.shape


def test_nerfstudio(few: Frames, tmp_path: Path) -> None:
    found = read_frames(as_nerfstudio(few, tmp_path / "n"))
    assert found.has_depth
    assert found.up == (0, 0, 1)
    assert_same_frames(found, few)


def test_nerfstudio_takes_focal_lengths_from_the_angle_of_view(few: Frames, tmp_path: Path) -> None:
    folder = as_nerfstudio(few, tmp_path / "n")
    told = json.loads((folder / "transforms.json").read_text())
    angle = 2 * np.arctan(told["w"] / (2 * told["fl_x"]))
    for key in ("fl_x", "fl_y", "cx", "cy", "w", "h"):
        del told[key]
    (folder / "transforms.json").write_text(json.dumps(told | {"camera_angle_x": angle}))
    assert_same_frames(read_frames(folder), few)


@pytest.mark.parametrize("binary", [True, False])
def test_colmap_with_its_depth_maps(few: Frames, tmp_path: Path, binary: bool) -> None:
    folder = as_colmap(few, tmp_path / "c", binary=binary, unit=0.25)
    assert_same_frames(read_frames(folder, scale=0.25), few, metres=1e-5)


def test_colmap_with_blank_lines(few: Frames, tmp_path: Path) -> None:
    """As in COLMAP's reader, blank lines count only directly after an image: there they are an empty list of points."""
    folder = as_colmap(few, tmp_path / "c", binary=False, unit=1.0)
    model = folder / "sparse" / "0"
    cameras, images = model / "cameras.txt", model / "images.txt"
    cameras.write_text("\n  # indented\n" + cameras.read_text().replace("\n", "\n \n") + "\n")
    head, *lines = images.read_text().split("\n")
    lines = [line for line in lines if line]
    blocks = [f"{line}\n{'1.5 2.5 -1' if k % 2 else ''}\n" for k, line in enumerate(lines)]
    images.write_text(f"{head}\n\n" + " \n\n".join(blocks) + "\n\n\n")
    assert_same_frames(read_frames(folder, scale=1.0), few, metres=1e-5)


def test_colmap_needs_a_scale(few: Frames, tmp_path: Path) -> None:
    with pytest.raises(OptionError, match="--scale METRES_PER_UNIT"):
        read_frames(as_colmap(few, tmp_path / "c", binary=True, unit=1.0))


def test_colmap_that_is_cut_short(few: Frames, tmp_path: Path) -> None:
    folder = as_colmap(few, tmp_path / "c", binary=True, unit=1.0)
    path = folder / "sparse" / "0" / "images.bin"
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(InputError, match=r"images\.bin is cut short"):
        read_frames(folder, scale=1.0)


def test_colmap_with_a_lens_that_bends(few: Frames, tmp_path: Path) -> None:
    folder = as_colmap(few, tmp_path / "c", binary=False, unit=1.0)
    c = few.frames[0].camera
    text = f"1 SIMPLE_RADIAL {c.width} {c.height} {c.fx} {c.cx} {c.cy} 0.2\n"
    (folder / "sparse" / "0" / "cameras.txt").write_text(text)
    with pytest.raises(InputError, match="undistort first"):
        read_frames(folder, scale=1.0)


def test_polycam_with_confidence_and_smaller_depth(few: Frames, tmp_path: Path) -> None:
    found = read_frames(as_polycam(few, tmp_path / "p"))
    assert "drift" in found.warnings[0]  # no optimized cameras
    assert found.up == (0, 1, 0)
    assert_same_frames(found, few, half=True)


def test_record3d_as_folder_and_archive(few: Frames, tmp_path: Path) -> None:
    folder = as_record3d(few, tmp_path / "r")
    assert_same_frames(read_frames(folder), few)
    with zipfile.ZipFile(tmp_path / "r.r3d", "w") as archive:
        for path in folder.rglob("*"):
            archive.write(path, path.relative_to(folder).as_posix())
    assert_same_frames(read_frames(tmp_path / "r.r3d"), few)


def test_record3d_that_lacks_its_size(few: Frames, tmp_path: Path) -> None:
    """Older recordings do not tell the size of the depth map; it has the picture's proportions."""
    folder = as_record3d(few, tmp_path / "r")
    told = json.loads((folder / "metadata").read_text())
    del told["dw"], told["dh"]
    (folder / "metadata").write_text(json.dumps(told))
    assert_same_frames(read_frames(folder), few)


@pytest.mark.parametrize(("poses", "count"), [(7, 0), ([], 0), ([[0, 0, 0, 1, 0, 0, 0]], 1)])
def test_record3d_without_a_pose_per_picture(few: Frames, tmp_path: Path, poses: object, count: int) -> None:
    folder = as_record3d(few, tmp_path / "r")
    metadata = json.loads((folder / "metadata").read_text())
    (folder / "metadata").write_text(json.dumps({**metadata, "poses": poses}))
    with pytest.raises(InputError, match=f"metadata has {count} poses"):
        read_frames(folder)


def test_record3d_with_damaged_depth(few: Frames, tmp_path: Path) -> None:
    folder = as_record3d(few, tmp_path / "r")
    (folder / "rgbd" / "0.depth").write_bytes(b"none of this is compressed")
    with pytest.raises(InputError, match="not LZFSE data"):
        read_frames(folder).frames[0].observe()


def test_what_is_no_recording(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"frames\.json, transforms\.json"):
        read_frames(tmp_path)
    with pytest.raises(InputError, match="does not exist"):
        read_frames(tmp_path / "none")


def test_files_outside_the_folder_are_not_read(few: Frames, tmp_path: Path) -> None:
    folder = as_nerfstudio(few, tmp_path / "n")
    shutil.copy(folder / "0.png", tmp_path / "secret.png")
    told = json.loads((folder / "transforms.json").read_text())
    told["frames"][0]["file_path"] = "../secret.png"
    (folder / "transforms.json").write_text(json.dumps(told))
    with pytest.raises(InputError, match="outside the recording"):
        read_frames(folder)
