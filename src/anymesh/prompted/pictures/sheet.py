"""Contact sheets of a question's pictures with their captions, for viewers that open a single file, and for models."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence

import numpy as np
from PIL import Image, ImageDraw

from anymesh.prompted.pictures.plates import window_sums
from anymesh.rendering.marks import font
from anymesh.types.exchange import Picture

SIDE = 2000  # [px] longest side of a sheet, which vision models accept without downscaling
MAX_PICTURES = 8  # pictures per call that models of 7 to 30 billion parameters take; an estimate
MAX_CELL, MIN_CELL = 900, 240  # [px] maximum and minimum of the longer side of one picture; the sheet grows to keep the minimum
TEXT, LINE, GAP = 16, 21, 8  # [px] font size, line height, space between cells
MAX_CAPTION_LINES = 3  # maximum number of lines per caption

# of pictures that are equal but for rounding: difference of colours that counts, share of pixels with it, and the most of them
# in a block [px]; another digit has more
DIFFERENT, FEW, BLOCK, IN_BLOCK = 24, 1e-3, 12, 8


def on_sheets(pictures: Sequence[Picture], most: int) -> tuple[Picture, ...]:
    """Lay out pictures, numbered through, on at most `most` sheets, each with as many of them; the last may have fewer."""
    each = math.ceil(len(pictures) / most)
    return tuple(question_sheet(pictures[k : k + each], k + 1, SIDE) for k in range(0, len(pictures), each))


def question_sheet(pictures: Sequence[Picture], first: int = 1, largest: int = MAX_CELL) -> Picture:
    """Lay out pictures in rows, numbered from `first`, with their captions. Raise ValueError without pictures.

    largest: longer side of one picture [px]; none is enlarged.
    """
    if not pictures:
        raise ValueError("a contact sheet needs at least one picture")
    columns, width = _layout([p.size for p in pictures], largest)
    titles = [_lines(_title(k, p), width) for k, p in enumerate(pictures, first)]
    images = [_shrunk(picture, width) for picture in pictures]
    bar = LINE * max(map(len, titles)) + 4
    heights = [max(i.height for i in images[k : k + columns]) + bar for k in range(0, len(images), columns)]
    size = columns * (width + GAP) + GAP, sum(heights) + (len(heights) + 1) * GAP
    sheet = Image.new("RGB", size, (200, 200, 200))
    draw = ImageDraw.Draw(sheet)
    for k, (image, lines) in enumerate(zip(images, titles, strict=True)):
        row, column = divmod(k, columns)
        x, y = GAP + column * (width + GAP), GAP + sum(heights[:row]) + row * GAP
        draw.rectangle([x, y, x + width - 1, y + heights[row] - 1], fill=(255, 255, 255))
        for n, line in enumerate(lines):
            draw.text((x + 4, y + 2 + n * LINE), line, fill=(20, 20, 20), font=font(TEXT))
        sheet.paste(image, (x + (width - image.width) // 2, y + bar))
    buffer = io.BytesIO()
    sheet.save(buffer, "PNG")
    numbers = f"{first}..{first + len(pictures) - 1}" if len(pictures) > 1 else str(first)
    return Picture(buffer.getvalue(), f"contact sheet of pictures {numbers}")


def nearly_equal(a: bytes, b: bytes) -> bool:
    """Return whether two PNG pictures differ by no more than rounding: in few pixels, nowhere in as many as a number has."""
    one, other = (np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), np.int16) for png in (a, b))
    if a == b or one.shape != other.shape:
        return a == b
    differs = (np.abs(one - other).max(2) > DIFFERENT).astype(float)
    return bool(differs.mean() < FEW and window_sums(differs, BLOCK, BLOCK).max(initial=0) <= IN_BLOCK)


def _title(number: int, picture: Picture) -> str:
    caption = picture.caption.removeprefix(f"picture {number}: ")
    plain = "".join(c if " " <= c <= "~" else "?" for c in caption)
    return f"{number}. {plain}" if plain else f"{number}."


def _shrunk(picture: Picture, width: int) -> Image.Image:
    with Image.open(io.BytesIO(picture.png)) as image:
        small = image.convert("RGB")
    small.thumbnail((width, 4 * width), Image.Resampling.LANCZOS)
    return small


def _layout(sizes: Sequence[tuple[int, int]], largest: int) -> tuple[int, int]:
    """Choose the number of columns that shows the pictures largest, and the width of a cell [px]."""
    wide, high = max(w for w, _ in sizes), max(h for _, h in sizes)
    least = min(1.0, MIN_CELL / max(wide, high))
    options = []
    for columns in range(1, len(sizes) + 1):
        rows = math.ceil(len(sizes) / columns)
        across, down = (SIDE / columns - GAP) / wide, (SIDE / rows - MAX_CAPTION_LINES * LINE - GAP) / high
        options.append((max(least, min(across, down, largest / max(wide, high), 1.0)), -max(rows, columns), columns))
    scale, _, columns = max(options)
    return columns, max(1, int(wide * scale))


def _lines(text: str, width: int) -> list[str]:
    """Break a caption into lines of at most `width` [px]; after MAX_CAPTION_LINES lines it ends in an ellipsis."""
    lines, letters = [""], font(TEXT)
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if letters.getlength(longer) <= width - 8 or not lines[-1]:
            lines[-1] = longer
        else:
            lines.append(word)
    if len(lines) > MAX_CAPTION_LINES:
        lines = [*lines[: MAX_CAPTION_LINES - 1], f"{lines[MAX_CAPTION_LINES - 1]} ..."]
    return lines
