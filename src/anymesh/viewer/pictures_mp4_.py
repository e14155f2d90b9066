"""Encoding of frames as MP4 (H.264), by the ffmpeg of imageio-ffmpeg (BSD-2; the binary GPL)."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from jaxtyping import UInt8

from anymesh.errors import MissingExtraError


def write_mp4(frames: Iterable[UInt8[np.ndarray, "H W 3"]], path: Path, rate: float) -> None:
    """Write a widely playable MP4. rate: frames per second. Raise MissingExtraError without the package."""
    try:
        from imageio_ffmpeg import write_frames
    except ImportError as error:
        raise MissingExtraError("imageio-ffmpeg is missing; install it with `pip install articulate-anymesh[video]`") from error
    writer = None
    for frame in frames:
        if writer is None:
            size = (frame.shape[1], frame.shape[0])
            writer = write_frames(str(path), size, fps=rate, codec="libx264", quality=8, macro_block_size=2)
            writer.send(None)
        writer.send(np.ascontiguousarray(frame))
    if writer is not None:
        writer.close()
