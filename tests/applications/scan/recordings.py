"""One small recording, and the same in the layouts of others."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
from assets import box
from PIL import Image

from anymesh.applications.scan.frames import FLIPPED, Frames
from anymesh.applications.scan.read_record3d_ import pack
from anymesh.types import Mesh, Node

SIZE = (160, 120)
VOXEL = 0.008  # [m] coarse, for speed
EXTENTS = np.array([0.4, 0.3, 0.5])  # of the box [m]; a smaller one is on its front


def thing() -> Mesh:
    """A box on the ground with a knob on its front, 64 cm across."""
    body, faces = box(-EXTENTS * [0.5, 0.5, 0], EXTENTS * [0.5, 0.5, 1])
    knob, more = box(np.array([-0.05, -0.2, 0.3]), np.array([0.05, -0.15, 0.4]))
    color = np.full((len(faces) + len(more), 3, 4), 255, np.uint8)
    color[: len(faces), :, :3] = [200, 60, 40]
    color[len(faces) :, :, :3] = [40, 90, 200]
    return Mesh(
        vertices=np.concatenate([body, knob]),
        faces=np.concatenate([faces, more + len(body)]),
        face_node=np.zeros(len(color), np.int64),
        nodes=(Node("thing"),),
        face_material=np.full(len(color), -1),
        corner_color=color,
    )


def _pictures(frames: Frames):
    for number, frame in enumerate(frames.frames):
        found = frame.read()
        yield number, frame, found.color, np.rint(found.depth * 1000).astype(np.uint16)


def as_nerfstudio(frames: Frames, out: Path) -> Path:
    """transforms.json: OpenGL axes, depth in millimetres."""
    out.mkdir()
    entries = []
    for number, frame, color, depth in _pictures(frames):
        Image.fromarray(color).save(out / f"{number}.png")
        Image.fromarray(depth).save(out / f"{number}_depth.png")
        pose = (frame.T_world_camera @ FLIPPED).tolist()
        entries.append({"file_path": f"{number}.png", "depth_file_path": f"{number}_depth.png", "transform_matrix": pose})
    c = frames.frames[0].camera
    about = {"fl_x": c.fx, "fl_y": c.fy, "cx": c.cx, "cy": c.cy, "w": c.width, "h": c.height, "camera_model": "OPENCV"}
    (out / "transforms.json").write_text(json.dumps(about | {"frames": entries}))
    return out


def as_polycam(frames: Frames, out: Path) -> Path:
    """keyframes/: OpenGL axes, depth half as large in millimetres, confidence 0, 127 or 255."""
    home = out / "keyframes"
    for name in ("images", "cameras", "depth", "confidence"):
        (home / name).mkdir(parents=True)
    for number, frame, color, depth in _pictures(frames):
        Image.fromarray(color).save(home / "images" / f"{number:03d}.jpg")
        Image.fromarray(np.ascontiguousarray(depth[::2, ::2])).save(home / "depth" / f"{number:03d}.png")
        sure = np.full((depth.shape[0] // 2, depth.shape[1] // 2), 255, np.uint8)
        sure[:10] = 0
        Image.fromarray(sure).save(home / "confidence" / f"{number:03d}.png")
        c, T = frame.camera, frame.T_world_camera @ FLIPPED
        told = {"fx": c.fx, "fy": c.fy, "cx": c.cx, "cy": c.cy, "width": c.width, "height": c.height}
        told |= {f"t_{i}{j}": T[i, j] for i in range(3) for j in range(4)}
        (home / "cameras" / f"{number:03d}.json").write_text(json.dumps(told))
    return out


def as_record3d(frames: Frames, out: Path) -> Path:
    """metadata and rgbd/: quaternions with OpenGL axes, compressed float depth."""
    (out / "rgbd").mkdir(parents=True)
    poses = []
    for number, frame, color, depth in _pictures(frames):
        Image.fromarray(color).save(out / "rgbd" / f"{number}.jpg")
        metres = (depth / 1000).astype("<f4")
        metres[depth == 0] = np.nan
        (out / "rgbd" / f"{number}.depth").write_bytes(pack(metres.tobytes()))
        (out / "rgbd" / f"{number}.conf").write_bytes(pack(np.full(depth.shape, 2, np.uint8).tobytes()))
        T = frame.T_world_camera @ FLIPPED
        poses.append([*quaternion(T[:3, :3]), *T[:3, 3]])
    c = frames.frames[0].camera
    K = np.array([[c.fx, 0, c.cx], [0, c.fy, c.cy], [0, 0, 1]]).T.reshape(-1).tolist()
    told = {"w": c.width, "h": c.height, "dw": c.width, "dh": c.height, "K": K, "poses": poses, "fps": 30}
    (out / "metadata").write_text(json.dumps(told))
    return out


def as_colmap(frames: Frames, out: Path, *, binary: bool, unit: float) -> Path:
    """sparse/0, images/ and the depth maps of a dense workspace, in units of `unit` metres."""
    (out / "sparse" / "0").mkdir(parents=True)
    (out / "images").mkdir()
    (out / "stereo" / "depth_maps").mkdir(parents=True)
    rows = []
    for number, frame, color, depth in _pictures(frames):
        Image.fromarray(color).save(out / "images" / f"{number}.png")
        data = b"%d&%d&1&" % depth.shape[::-1] + (depth / 1000 / unit).astype("<f4").tobytes()
        (out / "stereo" / "depth_maps" / f"{number}.png.geometric.bin").write_bytes(data)
        T = np.linalg.inv(frame.T_world_camera)
        x, y, z, w = quaternion(T[:3, :3])
        rows.append((number + 1, w, x, y, z, *(T[:3, 3] / unit), 1, f"{number}.png"))
    c, model = frames.frames[0].camera, out / "sparse" / "0"
    if binary:
        head = struct.pack("<QiiQQ4d", 1, 1, 1, c.width, c.height, c.fx, c.fy, c.cx, c.cy)
        body = [
            struct.pack("<i7di", *row[:-1]) + row[-1].encode() + b"\0" + struct.pack("<Q2dq", 1, 1.0, 2.0, -1) for row in rows
        ]
        (model / "cameras.bin").write_bytes(head)
        (model / "images.bin").write_bytes(struct.pack("<Q", len(rows)) + b"".join(body))
    else:
        (model / "cameras.txt").write_text(f"# cameras\n1 PINHOLE {c.width} {c.height} {c.fx} {c.fy} {c.cx} {c.cy}\n")
        lines = "\n".join(" ".join(str(v) for v in row) + "\n" for row in rows)
        (model / "images.txt").write_text(f"# images\n{lines}\n")
    return out


def quaternion(R: np.ndarray) -> np.ndarray:
    """x, y, z, w of a rotation."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(R).as_quat()


def edited(folder: Path, **changes) -> dict:
    """The description of a recording of ours with some entries changed; None takes one out."""
    told = json.loads((folder / "frames.json").read_text()) | changes
    told = {k: v for k, v in told.items() if v is not None}
    (folder / "frames.json").write_text(json.dumps(told))
    return told
