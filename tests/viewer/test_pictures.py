"""Turntables and contact sheets."""

import io
import sys
from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet, slanted
from PIL import Image
from shown import folder_of

from anymesh.errors import InputError, MissingExtraError, OptionError, OutputError
from anymesh.rendering.drawing import ground
from anymesh.rendering.preview import BASE, PALETTE
from anymesh.types import Asset, JointType
from anymesh.viewer import pictures_ as pictures_write
from anymesh.viewer import pictures_ as sheets
from anymesh.viewer.pictures_ import Turntable, contact_sheet, film, gif_bytes, sheet_film, write_mp4, write_picture

SMALL = Turntable(size=64, rate=4.0)


def hue(frame: np.ndarray, color: np.ndarray) -> np.ndarray:
    """Where a frame shows a colour, however lit."""
    unit = frame / np.maximum(np.linalg.norm(frame.astype(float), axis=-1, keepdims=True), 1)
    return (unit @ (color / np.linalg.norm(color.astype(float))) > 0.999) & (frame < 250).any(-1)


def frames(asset: Asset, how: Turntable = SMALL) -> np.ndarray:
    return np.stack(list(film(asset, how))).astype(int)


def still(asset: Asset) -> Asset:
    """The same with nothing that moves."""
    fixed = (replace(j, type=JointType.FIXED, limits=None) for j in asset.joints)
    return replace(asset, joints=tuple(fixed))


def test_the_film_is_a_loop_that_moves_parts_and_goes_round():
    asset = cabinet()
    shown = frames(asset)
    assert shown.shape == (24, 64, 64, 3)  # three times 2 s at 4 frames a second
    door = np.array([hue(frame, PALETTE[0]).sum() for frame in shown])
    assert door.max() > 40
    assert door.min() == 0, "from behind, the closed door is not seen"
    first, last = shown[0], shown[-1]
    assert np.abs(first - last).mean() < np.abs(first - shown[12]).mean(), "the end leads to the begin"
    held = frames(asset, replace(SMALL, turn=0.0))
    np.testing.assert_array_equal(held[0], held[8])
    assert (held[0] != held[4]).any(-1).mean() > 0.02
    front = frames(still(asset), replace(SMALL, turn=0.0))
    assert (front == front[0]).all()


def test_nothing_leaves_the_frame():
    for asset in (cabinet(), slanted()):
        edge = frames(asset)
        behind = np.round(ground(64, 64))
        assert (edge[:, [0, -1]] == behind[[0, -1]]).all()
        assert (edge[:, :, [0, -1]] == behind[:, [0, -1]]).all()
        assert (edge != behind).any(-1).any(0).sum() > 0.15 * 64 * 64


def test_materials_or_colours_of_parts():
    plain, looks = frames(cabinet())[0], frames(cabinet(), replace(SMALL, materials=True))[0]
    assert hue(plain, PALETTE[1]).sum() > 10
    assert hue(looks, PALETTE[1]).sum() == 0
    assert (plain != looks).any()


def test_a_gif_loops_for_ever_with_one_palette():
    shown = list(film(cabinet(), SMALL))
    data = gif_bytes(shown, 4.0)
    with Image.open(io.BytesIO(data)) as image:
        assert (image.format, image.size, image.n_frames, image.info["loop"]) == ("GIF", (64, 64), 24, 0)
        assert image.info["duration"] == 250
        for k in (0, 5, 17):
            image.seek(k)
            close = np.abs(np.asarray(image.convert("RGB")).astype(int) - shown[k])
            assert close.mean() < 3
    assert gif_bytes(list(film(cabinet(), SMALL)), 4.0) == data


def test_a_sheet_has_a_cell_an_asset():
    sheet = contact_sheet([("cabinet", cabinet()), ("x" * 90, slanted()), ("broken", None)], columns=2)
    high, wide = sheets.CELL + sheets.BAR, sheets.CELL
    assert sheet.shape == (2 * high, 2 * wide, 3)
    cells = [sheet[r * high : r * high + wide, c * wide : (c + 1) * wide] for r, c in ((0, 0), (0, 1), (1, 0), (1, 1))]
    behind = np.round(ground(wide, wide))[4:-4, 4:-4]
    inked = [(cell[4:-4, 4:-4] != behind).any(-1).mean() for cell in cells[:2]]
    empty = [(cell[4:-4, 4:-4] < 245).any(-1).mean() for cell in cells[2:]]
    assert min(inked) > 0.03
    assert max(empty) == 0
    assert hue(cells[0], PALETTE[0]).sum() > 500
    assert hue(cells[0], BASE).sum() > 500
    under = sheet[wide + 3 : high - 3, 3 : wide - 3]
    assert (under < 100).any()


def test_a_film_of_several_assets_moves_every_joint_in_its_cell():
    shown = np.stack(list(sheet_film([("cabinet", cabinet()), ("slanted", slanted()), ("broken", None)], size=64, rate=4.0)))
    assert shown.shape == (16, 64 + sheets.BAR, 3 * 64, 3)  # 4 s, since joints of the second asset have negative limits
    cells = [shown[:, 2:62, 64 * k + 2 : 64 * k + 62].astype(int) for k in range(3)]
    door = np.array([hue(frame, PALETTE[0]).sum() for frame in cells[0]])
    assert door.min() > 20
    for cell in cells[:2]:
        assert (cell[0] != cell[4]).any(-1).mean() > 0.05
    np.testing.assert_array_equal(cells[0][1:4], cells[0][9:12])  # the first asset moves twice
    assert (cells[2] == cells[2][0]).all()
    assert (shown[:, 64:] == shown[0, 64:]).all()
    assert (shown[:, :, [0, 63]] == 210).all(-1).any(-1).all(), "the frames of the cells are drawn over the objects"


def test_a_moving_asset_fills_its_cell_and_stays_in_it():
    for asset in (cabinet(), slanted()):
        shown = np.stack(list(sheet_film([("a", asset)], size=96, rate=6.0)))[:, :96].astype(int)
        inked = (shown[:, 1:95, 1:95] != np.round(ground(96, 96))[1:95, 1:95]).any(-1).any(0)
        assert not inked[[0, -1]].any()
        assert not inked[:, [0, -1]].any()
        across, up = np.flatnonzero(inked.any(0)), np.flatnonzero(inked.any(1))
        assert max(np.ptp(across), np.ptp(up)) > 0.8 * 94


def test_the_name_of_the_file_tells_the_kind(tmp_path, monkeypatch):
    monkeypatch.setattr(pictures_write, "film", lambda asset, how: film(asset, replace(how, size=32, rate=2.0)))
    folder = folder_of(cabinet(), tmp_path / "all" / "cabinet")
    folder_of(slanted(), tmp_path / "all" / "slanted")
    for name, source, kind in (("a.gif", folder, "GIF"), ("a.png", folder, "PNG"), ("all.PNG", tmp_path / "all", "PNG")):
        assert write_picture(source, tmp_path / name) == tmp_path / name
        with Image.open(tmp_path / name) as image:
            assert image.format == kind
    first = (tmp_path / "a.gif").read_bytes(), (tmp_path / "a.png").read_bytes()
    for name, was in zip(("a.gif", "a.png"), first, strict=True):
        write_picture(folder, tmp_path / name)
        assert (tmp_path / name).read_bytes() == was


def test_a_gif_of_a_folder_of_assets_shows_all_of_them(tmp_path):
    folder_of(cabinet(), tmp_path / "all" / "cabinet")
    folder_of(slanted(), tmp_path / "all" / "slanted")
    made = write_picture(tmp_path / "all", tmp_path / "a.gif", size=32, rate=2.0, columns=1)
    with Image.open(made) as image:
        assert image.size == (32, 2 * (32 + sheets.BAR))
        assert image.n_frames == 8
    assert write_picture(tmp_path / "all", tmp_path / "b.gif", size=32, rate=2.0, columns=1).read_bytes() == made.read_bytes()


def test_what_cannot_be_drawn_is_told(tmp_path):
    folder = folder_of(cabinet(), tmp_path / "all" / "cabinet")
    folder_of(slanted(), tmp_path / "all" / "slanted")
    with pytest.raises(OptionError, match=r"\.gif"):
        write_picture(folder, tmp_path / "a.jpg")
    with pytest.raises(InputError, match="not a folder"):
        write_picture(tmp_path / "none", tmp_path / "a.gif")
    with pytest.raises(OutputError):
        write_picture(folder, tmp_path / "no" / "a.png")
    for wrong in ({"size": 4}, {"rate": 0.0}, {"turn": 400.0}, {"columns": 0}):
        with pytest.raises(OptionError, match=next(iter(wrong))):
            write_picture(folder, tmp_path / "a.gif", **wrong)


def test_an_mp4_needs_its_extra_or_is_a_film(tmp_path):
    ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="the extra 'video' is not installed")
    write_mp4(film(cabinet(), SMALL), tmp_path / "a.mp4", 4.0)
    reader = ffmpeg.read_frames(str(tmp_path / "a.mp4"))
    told = next(reader)
    assert tuple(told["size"]) == (64, 64)
    assert told["fps"] == 4
    assert len(list(reader)) == 24


def test_a_missing_ffmpeg_is_one_clear_error(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(MissingExtraError, match="video"):
        write_mp4(iter([]), tmp_path / "a.mp4", 4.0)
