"""Test that errors in calibration, poses or depth are reported with their likely cause."""

import json
import shutil
import zipfile
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from recordings import as_colmap, as_nerfstudio, as_polycam, as_record3d, edited

from anymesh.applications.scan import scan
from anymesh.applications.scan.agreement import agreement, glimpse
from anymesh.applications.scan.frames import FLIPPED, Frames
from anymesh.applications.scan.reading import read_frames
from anymesh.errors import AnymeshError, InputError, MissingExtraError, OptionError, OutputError


def with_poses(folder: Path, change) -> None:
    """Every pose after `change(number, T)`."""
    told = json.loads((folder / "frames.json").read_text())
    for number, entry in enumerate(told["frames"]):
        entry["T_world_camera"] = np.asarray(change(number, np.array(entry["T_world_camera"]))).tolist()
    (folder / "frames.json").write_text(json.dumps(told))


def told_by(folder: Path, error: type[AnymeshError] = InputError, **options) -> str:
    with pytest.raises(error) as found:
        scan(folder, folder.parent / "out.glb", **options)
    assert not (folder.parent / "out.glb").exists()
    return str(found.value)


def test_missing_intrinsics(mine: Path) -> None:
    edited(mine, camera={"fx": 100.0, "cx": 80, "cy": 60, "width": 160, "height": 120})
    assert "intrinsics are missing: fy" in told_by(mine)


def test_a_picture_of_other_proportions(mine: Path) -> None:
    edited(mine, camera={"fx": 150.0, "fy": 150.0, "cx": 80, "cy": 80, "width": 160, "height": 160})
    assert "160 x 120 pixels, its intrinsics are for 160 x 160" in told_by(mine)


def test_intrinsics_of_another_resolution_are_scaled(mine: Path, recording: Path) -> None:
    told = json.loads((mine / "frames.json").read_text())["camera"]
    edited(mine, camera={key: 4 * value for key, value in told.items()})
    for a, b in zip(read_frames(mine).frames, read_frames(recording).frames, strict=True):
        assert a.camera == b.camera


def test_a_depth_map_of_other_proportions(mine: Path) -> None:
    Image.fromarray(np.full((100, 100), 900, np.uint16)).save(mine / "depth" / "0002.png")
    assert "frame 2: the depth map has 100 x 100 pixels" in told_by(mine)


@pytest.mark.parametrize(("unit", "hint"), [(1.0, "millimetres read as metres"), (1e-6, "metres read as millimetres")])
def test_a_wrong_unit_of_depth(mine: Path, unit: float, hint: str) -> None:
    edited(mine, depth_scale=unit)
    told = told_by(mine)
    assert hint in told
    assert "--depth-scale" in told


def test_poses_that_are_not_rigid(mine: Path) -> None:
    with_poses(mine, lambda k, T: T @ np.diag([2.0, 2, 2, 1]))
    assert "must be orthonormal" in told_by(mine)
    assert "scaled by 2" in told_by(mine)


def test_poses_that_mirror(mine: Path) -> None:
    with_poses(mine, lambda k, T: T @ np.diag([1.0, 1, -1, 1]))
    assert "mirrors" in told_by(mine)


def test_poses_by_columns(mine: Path) -> None:
    with_poses(mine, lambda k, T: T.T)
    assert "transposed" in told_by(mine)


def test_poses_with_other_camera_axes(mine: Path) -> None:
    with_poses(mine, lambda k, T: T @ FLIPPED)
    assert "axes are those of OpenGL" in told_by(mine)


def test_poses_from_world_to_camera(mine: Path) -> None:
    with_poses(mine, lambda k, T: np.linalg.inv(T))
    assert "world-to-camera where camera-to-world was expected" in told_by(mine)


def test_poses_from_world_to_camera_with_other_axes(mine: Path) -> None:
    with_poses(mine, lambda k, T: np.linalg.inv(T @ FLIPPED))
    assert "world-to-camera, and with the other camera axes" in told_by(mine)


def test_poses_in_another_unit_than_depth(mine: Path) -> None:
    with_poses(mine, lambda k, T: np.block([[T[:3, :3], 100 * T[:3, 3:]], [np.zeros((1, 3)), np.ones((1, 1))]]))
    assert "no two frames see the same place" in told_by(mine)


def test_no_overlap(mine: Path) -> None:
    def apart(k, T):
        T[:3, 3] += [50.0 * k, 0, 0]
        return T

    with_poses(mine, apart)
    assert "no two frames see the same place" in told_by(mine)


@pytest.mark.parametrize("frames", [3, [], [1, 2], None])
def test_frames_that_are_no_list_of_objects(mine: Path, frames: object) -> None:
    edited(mine, frames=frames)
    assert f"found {frames}" in told_by(mine)


@pytest.mark.parametrize(
    "change",
    [
        lambda record: record.update(camera=[1]),
        lambda record: record.update(depth_scale="x"),
        lambda record: record["camera"].update(fx=10**400),
        lambda record: record["frames"][0].update(camera="none"),
        lambda record: record["frames"][0].update(color="a\0.jpg"),
    ],
)
def test_a_description_that_makes_no_sense(mine: Path, change) -> None:
    record = json.loads((mine / "frames.json").read_text())
    change(record)
    (mine / "frames.json").write_text(json.dumps(record))
    assert "is broken" in told_by(mine)


def test_too_few_frames(mine: Path) -> None:
    told = json.loads((mine / "frames.json").read_text())
    edited(mine, frames=told["frames"][:2])
    assert "found 2 usable frames" in told_by(mine)


def test_depth_that_is_empty(mine: Path) -> None:
    for path in (mine / "depth").iterdir():
        Image.fromarray(np.zeros((120, 160), np.uint16)).save(path)
    assert "no frame has any depth" in told_by(mine)


def test_pictures_without_depth_name_the_extra(mine: Path) -> None:
    told = json.loads((mine / "frames.json").read_text())
    edited(mine, frames=[{k: v for k, v in f.items() if k != "depth"} for f in told["frames"]])
    try:
        import gsplat  # noqa: F401
    except ImportError:
        assert "scan-gpu" in told_by(mine, MissingExtraError)


def test_a_frame_that_drifted_is_left_out(mine: Path) -> None:
    def drifted(k, T):
        T[:3, 3] += [0.06, 0.05, 0.03] if k == 5 else 0
        return T

    with_poses(mine, drifted)
    report = scan(mine, mine.parent / "out.glb", voxel=0.015)
    assert report.dropped == ("5",)
    assert "1 of 24 frames disagree with the others" in " ".join(report.warnings)


def test_frames_that_agree_stay(recording: Path) -> None:
    glimpses = [glimpse(frame) for frame in read_frames(recording).frames]
    found = agreement(glimpses)
    assert np.isfinite(found.of).all()
    assert found.usual < 0.006  # noise of .15 % of the depth at 1 m, of a millimetre's rounding


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"voxel": 0.0}, "--voxel"),
        ({"voxel": 1e-5}, "--voxel"),
        ({"depth_scale": -1.0}, "--depth-scale"),
        ({"crop": (0.0, 0.0, 0.0, 1.0, 1.0)}, "--crop"),
        ({"crop": (1.0, 0.0, 0.0, 0.0, 1.0, 1.0)}, "--crop"),
        ({"faces": 10}, "--faces"),
    ],
)
def test_options_that_are_not_valid(mine: Path, options: dict, told: str) -> None:
    assert told in told_by(mine, OptionError, **options)


def test_a_crop_that_leaves_nothing(mine: Path) -> None:
    assert "--crop leaves nothing" in told_by(mine, crop=(90.0, 90.0, 90.0, 91.0, 91.0, 91.0))


def test_an_output_that_is_there_stays(recording: Path, tmp_path: Path) -> None:
    out = tmp_path / "kept.glb"
    out.write_bytes(b"mine")
    with pytest.raises(OutputError, match="--force"):
        scan(recording, out)
    with pytest.raises(OutputError, match=r"written as \.glb"):
        scan(recording, tmp_path / "mesh.obj")
    assert out.read_bytes() == b"mine"


def test_scale_is_of_the_poses_and_depth_scale_of_the_depth(mine: Path, recording: Path) -> None:
    def centimetres(k, T):
        T[:3, 3] *= 100
        return T

    with_poses(mine, centimetres)
    for a, b in zip(read_frames(mine, scale=0.01).frames, read_frames(recording).frames, strict=True):
        np.testing.assert_allclose(a.T_world_camera, b.T_world_camera, atol=1e-9)
        np.testing.assert_array_equal(a.observe().depth, b.observe().depth)


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
