"""The contact sheet of a question."""

import io

import numpy as np
import pytest
from PIL import Image

from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.types import Picture


def plain(color: tuple[int, int, int], size: tuple[int, int], caption: str = "") -> Picture:
    buffer = io.BytesIO()
    Image.new("RGB", size, color).save(buffer, "PNG")
    return Picture(buffer.getvalue(), caption)


def pixels(picture: Picture) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(picture.png)))


@pytest.mark.parametrize(("count", "size"), [(1, (500, 500)), (8, (600, 600)), (3, (900, 400)), (12, (300, 700))])
def test_every_picture_shows_in_its_proportions(count: int, size: tuple[int, int]) -> None:
    colors = [(250 - 5 * k, 6 * k, 40) for k in range(count)]
    sheet = question_sheet([plain(c, size, f"view {k}: " + "from far away, " * 20) for k, c in enumerate(colors, 1)])
    found = pixels(sheet)
    assert found.shape[1] <= 2000
    shown = []
    for color in colors:
        rows, columns = np.nonzero((np.abs(found.astype(int) - color) <= 1).all(axis=2))
        width, height = np.ptp(columns) + 1, np.ptp(rows) + 1
        assert len(rows) == width * height
        assert width / height == pytest.approx(size[0] / size[1], rel=0.02)
        shown.append((rows.min(), columns.min()))
    assert shown == sorted(shown)  # row by row
    assert width * height >= min(1.0, (240 / max(size)) ** 2) * size[0] * size[1] * 0.97


def test_a_caption_that_begins_with_its_number_is_not_numbered_twice() -> None:
    told, bare = (question_sheet([plain((200, 30, 30), (400, 300), c)]) for c in ("picture 1: from the left", "from the left"))
    other = question_sheet([plain((200, 30, 30), (400, 300), "picture 2: from the left")])
    assert told.png == bare.png != other.png


def test_a_sheet_of_nothing_is_an_error() -> None:
    with pytest.raises(ValueError, match="at least one"):
        question_sheet([])
