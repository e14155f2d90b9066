"""Test what the scripts that compare revisions count and find."""

from pathlib import Path, PurePosixPath

import pytest

from benchmarks.house import TREE, counted, part_of
from benchmarks.same_bytes import contents, differences


@pytest.mark.parametrize(
    ("path", "part"),
    [
        ("segmentation/segment.py", "core"),
        ("segmentation/ask_marks.py", "prompted"),
        ("prompted/questions/ask.py", "prompted"),
        ("models/meshy_task.py", "finishing"),
        ("models/sam.py", "prompted"),
        ("checking/command_line.py", "checking"),
        ("cli/commands.py", "core"),
        ("applications/plan/__init__.py", "applications and their commands"),
    ],
)
def test_modules_belong_to_the_same_part_before_and_after_the_move(path: str, part: str) -> None:
    assert part_of(PurePosixPath(path)) == part


def test_parts_of_the_package_add_up() -> None:
    for counts in counted(TREE):
        tops = ("src", "tests", "training without kinds", "training kinds", "benchmarks without reports and recordings")
        parts = sum(counts.values()) - sum(counts[top] for top in tops) - counts["all Python"]
        assert parts == counts["src"]


def test_a_byte_is_a_difference_and_a_duration_or_a_version_is_none(tmp_path: Path) -> None:
    for side, version, seconds, mesh in (("a", "0.1", "1", "v 1\n"), ("b", "0.2", "2", "v 2\n")):
        (tmp_path / side).mkdir()
        (tmp_path / side / "asset.json").write_text(f'{{"generator": {{"name": "x", "version": "{version}"}}}}')
        (tmp_path / side / "timing.json").write_text(seconds)
        (tmp_path / side / "lid.obj").write_text(mesh)
        (tmp_path / side / f"{side}.mtl").write_text("")
    found = differences(contents(tmp_path / "a"), contents(tmp_path / "b"))
    assert found == ["a.mtl: only before", "b.mtl: only after", "lid.obj: 4 and 4 bytes, different from byte 2"]
