"""2D Gaussian splatting."""

from __future__ import annotations

from anymesh.applications.scan.frames import Frames
from anymesh.errors import MissingExtraError
from anymesh.progress import Progress


def with_depth(frames: Frames, *, seed: int, progress: Progress) -> Frames:
    raise MissingExtraError("pictures without depth need the extra scan-gpu")
