"""Mapping between a picture and the square input of a SAM model: points and pixels forward, mask logits back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8
from PIL import Image
from scipy.sparse import csr_array

MEAN = np.array([123.675, 116.28, 103.53], np.float32)  # of ImageNet's RGB, 0..255; every SAM and SAM 2 uses these
STD = np.array([58.395, 57.12, 57.375], np.float32)


@dataclass(frozen=True)
class Frame:
    """Square input of a model, with its side [px].

    padded: the longer side fills the square, the rest on the right and below is padding (SAM, MobileSAM). Otherwise the
    picture is stretched to the square (SAM 2). Sources: ResizeLongestSide and postprocess_masks of segment-anything,
    SAM2Transforms of sam2.
    """

    side: int
    padded: bool

    def inner(self, height: int, width: int) -> tuple[int, int]:
        """Return the rows and columns of the square that the picture fills [px]."""
        if not self.padded:
            return self.side, self.side
        scale = self.side / max(height, width)
        return max(1, int(height * scale + 0.5)), max(1, int(width * scale + 0.5))

    def resize(self, image: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "h w 3"]:
        """Resize the picture to its size in the square, without the padding."""
        rows, columns = self.inner(*image.shape[:2])
        return np.asarray(Image.fromarray(image).resize((columns, rows), Image.Resampling.BILINEAR))

    def normalized(self, image: UInt8[np.ndarray, "H W 3"]) -> Float[np.ndarray, "1 3 side side"]:
        """Return the whole square as the network's input: mean 0 and standard deviation 1 over ImageNet, padding 0."""
        small = self.resize(image)
        square = np.zeros((1, 3, self.side, self.side), np.float32)
        square[0, :, : small.shape[0], : small.shape[1]] = ((small - MEAN) / STD).transpose(2, 0, 1)
        return square

    def points(self, points: Float[np.ndarray, "n 2"], height: int, width: int) -> Float[np.ndarray, "n 2"]:
        """Map (x, y) in the picture [px] to (x, y) in the square [px]."""
        rows, columns = self.inner(height, width)
        return points * np.array([columns / width, rows / height])

    def upscaler(self, low: tuple[int, int], height: int, width: int) -> Upscaler:
        """Return the upscaler of logits of shape `low`, which cover the whole square, to the picture's pixels."""
        rows, columns = self.inner(height, width)
        return Upscaler(self._along(low[0], rows, height), self._along(low[1], columns, width))

    def _along(self, low: int, inner: int, full: int) -> csr_array:
        if not self.padded:
            return bilinear(low, full)
        # The reference resizes to the square, crops the padding, and resizes again; both are linear, hence one matrix.
        return bilinear(inner, full) @ bilinear(low, self.side)[:inner]


@dataclass(frozen=True, eq=False)
class Upscaler:
    """Resizing as two sparse matrices: vertical (H, h), horizontal (W, w)."""

    vertical: csr_array
    horizontal: csr_array

    def __call__(self, logits: Float[np.ndarray, "h w"]) -> Float[np.ndarray, "H W"]:
        rows = self.vertical @ logits.astype(np.float32, copy=False)
        return (self.horizontal @ rows.T).T


def bilinear(source: int, target: int) -> csr_array:
    """Return the (target, source) matrix of bilinear resizing of one side.

    Pixel centres are at halves, without smoothing (torch: align_corners=False).
    """
    at = np.clip((np.arange(target) + 0.5) * source / target - 0.5, 0, source - 1)
    low = np.floor(at).astype(int)
    columns = np.r_[low, np.minimum(low + 1, source - 1)]
    weights = np.r_[1 - (at - low), at - low].astype(np.float32)
    return csr_array((weights, (np.tile(np.arange(target), 2), columns)), (target, source))
