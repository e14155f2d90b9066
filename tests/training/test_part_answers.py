"""Test how the answers of viewers on what moves are compared with the classifier of parts."""

import json
from pathlib import Path

from training import part_answers


def test_answers_are_compared_with_the_truth(tmp_path: Path) -> None:
    """Two of five regions move; the classifier finds one and one that does not move.

    The first viewer names both, unsure of one; the second only the second, and one that does not move. Of the classifier's two
    errors, both viewers correct one. In the other object the second viewer makes the classifier's two errors.
    """
    regions = {"1": [True, True], "2": [True, False], "3": [False, True], "4": [False, False], "5": [False, False]}
    other = {"1": [True, True], "2": [True, False], "3": [False, True]}
    truth = {"1": {"group": "worst", "regions": regions}, "2": {"group": "random", "regions": other}}
    first = {"1": {"moves": [1, 2], "unsure": [1]}, "2": {"moves": [1, 2], "unsure": []}}
    second = {"1": {"moves": [2, 3], "unsure": []}, "2": {"moves": [1, 3], "unsure": []}}
    for name, content in (("truth", truth), ("viewer_1", first), ("viewer_2", second)):
        (tmp_path / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")
    _, _, worst, random = part_answers.table(tmp_path).splitlines()
    assert worst == "| 1 worst | 5 | 2 | 0.50 | 1.00 | 0.50 | 0.40 | 0.00 | 0.10 | 0.50 |"
    assert random == "| 1 random | 3 | 2 | 0.50 | 1.00 | 0.50 | 0.67 | 0.00 | 0.00 | 0.00 |"


def test_the_page_states_the_answers_that_are_kept() -> None:
    page = (Path(__file__).parents[2] / "docs" / "worst_parts.md").read_text(encoding="utf-8")
    assert part_answers.table(part_answers.KEPT) in page
