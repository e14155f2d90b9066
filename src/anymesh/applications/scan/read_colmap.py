"""COLMAP models, text and binary, with depth maps of the dense workspace or of a folder of depth pictures."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.applications.scan.frames import Frames, Observation, Pinhole, RgbdFrame, check_distortion, fitted, quaternion_pose
from anymesh.applications.scan.pictures import clean_depth, file_reader, observed, picture_size, read_color, within
from anymesh.errors import InputError, OptionError
from anymesh.types import Brief

# Number, name and parameter count of each model (COLMAP's src/colmap/sensor/models.h); fisheye models are not supported.
MODELS = {0: ("SIMPLE_PINHOLE", 3), 1: ("PINHOLE", 4), 2: ("SIMPLE_RADIAL", 4), 3: ("RADIAL", 5), 4: ("OPENCV", 8)}
FOLDERS = ("sparse/0", "sparse", "colmap/sparse/0", ".")
DEPTHS = ("stereo/depth_maps/{name}.geometric.bin", "stereo/depth_maps/{name}.photometric.bin", "depth/{stem}.png",
          "depth/{name}.png", "depths/{stem}.png")  # fmt: skip
IMAGES = ("images", "rgb", ".")


@dataclass(frozen=True, eq=False)
class _Image(Brief):
    name: str
    camera: int
    T_camera_world: Float[np.ndarray, "4 4"]


def model_folder(folder: Path) -> Path | None:
    """Return the folder of the COLMAP model within a folder, None if there is none."""
    for name in FOLDERS:
        for suffix in (".bin", ".txt"):
            if (folder / name / f"cameras{suffix}").is_file() and (folder / name / f"images{suffix}").is_file():
                return folder / name
    return None


def read_colmap(folder: Path, depth_scale: float | None, scale: float | None) -> Frames:
    """Read a COLMAP workspace. Raise OptionError without a scale, since a reconstruction from pictures has no unit."""
    model = model_folder(folder)
    if model is None:
        raise InputError(f"{folder}: found no cameras and images of COLMAP in {', '.join(FOLDERS)}")
    if scale is None:
        raise OptionError("a COLMAP model has no unit of length: --scale METRES_PER_UNIT is needed (measure one known length)")
    binary = (model / "cameras.bin").is_file()
    cameras, warnings = _cameras(_binary_cameras(model) if binary else _text_cameras(model))
    frames = []
    for image in sorted(_binary_images(model) if binary else _text_images(model), key=lambda i: i.name):
        if image.camera not in cameras:
            raise InputError(f"{model}: image {image.name} has camera {image.camera}, which is missing")
        color = _picture(folder, image.name)
        camera = fitted(cameras[image.camera], picture_size(color), image.name)
        T = np.linalg.inv(image.T_camera_world)
        T[:3, 3] *= scale
        depth = _depth(folder, image.name)
        frames.append((RgbdFrame(image.name, camera, T, _reader(color, depth, depth_scale, scale)), depth is not None))
    return Frames.read(frames, "COLMAP", None, *warnings)


def _picture(folder: Path, name: str) -> Path:
    home = next((folder / i for i in IMAGES if (folder / i / name).is_file()), folder / IMAGES[0])
    return within(home, name)


def _depth(folder: Path, name: str) -> Path | None:
    paths = (folder / d.format(name=name, stem=Path(name).with_suffix("").as_posix()) for d in DEPTHS)
    return next((p for p in paths if p.is_file()), None)


def _reader(color: Path, depth: Path | None, depth_scale: float | None, scale: float) -> Callable[[], Observation]:
    """Return a reader of a frame.

    Depth maps of COLMAP are in units of the model; pictures of a depth camera in their own, by default millimetres.
    """
    if depth is None or depth.suffix != ".bin":
        return file_reader(color, depth, depth_scale or 0.001)
    return lambda: observed(read_color(color, color.name), clean_depth(read_array(depth), depth.name, scale))


def read_array(path: Path) -> Float[np.ndarray, "h w"]:
    """Read a dense map of COLMAP: `width&height&channels&`, then floats. Raise InputError if the file is truncated."""
    data = path.read_bytes()
    try:
        width, height, channels = (int(v) for v in data[:64].split(b"&", 3)[:3])
        start = len(b"&".join(data.split(b"&", 3)[:3])) + 1
        return np.frombuffer(data, "<f4", width * height * channels, start).reshape(channels, height, width)[0]
    except ValueError:
        raise InputError(f"{path} is not a depth map of COLMAP, or is cut short ({len(data)} bytes)") from None


def _cameras(rows: Iterator[tuple[int, str, int, int, list[float]]]) -> tuple[dict[int, Pinhole], list[str]]:
    valid, cameras, warnings = {name for name, _ in MODELS.values()}, {}, []
    for number, model, width, height, p in rows:
        if model not in valid:
            raise InputError(f"COLMAP camera {number} is a {model}; valid are {', '.join(sorted(valid))}: undistort the images")
        single = model in ("SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL")
        fx, fy, cx, cy = (p[0], p[0], *p[1:3]) if single else p[:4]
        cameras[number] = Pinhole(fx, fy, cx, cy, width, height)
        warnings.append(check_distortion(cameras[number], p[3 if single else 4 :][:2], f"COLMAP camera {number}"))
    return cameras, [w for w in warnings if w]


def _text_rows(path: Path) -> list[list[str]]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.split() for line in lines if not line.lstrip().startswith("#")]


def _text_cameras(model: Path) -> Iterator[tuple[int, str, int, int, list[float]]]:
    for row in _text_rows(model / "cameras.txt"):
        if row:
            try:
                yield int(row[0]), row[1], int(row[2]), int(row[3]), [float(v) for v in row[4:]]
            except (ValueError, IndexError):
                raise InputError(
                    f"{model / 'cameras.txt'}: expected ID MODEL WIDTH HEIGHT PARAMS, found {' '.join(row)}"
                ) from None


def _text_images(model: Path) -> Iterator[_Image]:
    """Parse images.txt, in which the line after that of an image lists its points and may be empty."""
    rows = iter(_text_rows(model / "images.txt"))
    for row in rows:
        if not row:  # an empty line between images
            continue
        next(rows, None)  # points of the image
        try:
            q, t = [float(v) for v in row[1:5]], [float(v) for v in row[5:8]]
            camera, name = int(row[8]), " ".join(row[9:])
        except (ValueError, IndexError):
            raise InputError(f"{model / 'images.txt'}: expected ID QW QX QY QZ TX TY TZ CAMERA NAME, found {row}") from None
        yield _Image(name, camera, quaternion_pose([*q[1:], q[0]], t, name))


def _binary_cameras(model: Path) -> Iterator[tuple[int, str, int, int, list[float]]]:
    data = _Bytes(model / "cameras.bin")
    for _ in range(data.take("<Q")[0]):
        number, kind, width, height = data.take("<iiQQ")
        if kind not in MODELS:
            raise InputError(f"COLMAP camera {number} is of model {kind}; valid are {sorted(MODELS)}: undistort the images")
        name, count = MODELS[kind]
        yield number, name, width, height, list(data.take(f"<{count}d"))


def _binary_images(model: Path) -> Iterator[_Image]:
    data = _Bytes(model / "images.bin")
    for _ in range(data.take("<Q")[0]):
        _, *numbers, camera = data.take("<i7di")
        name = data.text()
        data.skip(24 * data.take("<Q")[0])
        yield _Image(name, camera, quaternion_pose([*numbers[1:4], numbers[0]], numbers[4:], name))


class _Bytes:
    """Sequential reader of a binary file. Raise InputError if it ends too soon."""

    def __init__(self, path: Path) -> None:
        self._path, self._data, self._at = path, path.read_bytes(), 0

    def take(self, form: str) -> tuple:
        size = struct.calcsize(form)
        self.skip(size)
        return struct.unpack_from(form, self._data, self._at - size)

    def skip(self, size: int) -> None:
        self._at += size
        if self._at > len(self._data):
            raise InputError(f"{self._path} is cut short: {len(self._data)} bytes, at least {self._at} needed")

    def text(self) -> str:
        end = self._data.find(b"\0", self._at)
        if end < 0:
            raise InputError(f"{self._path} is cut short in a name")
        begin, self._at = self._at, end + 1
        return self._data[begin:end].decode("utf-8", "replace")
