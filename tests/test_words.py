"""One word, one meaning: names that the glossary replaced do not come back, and no two classes share a name."""

import ast
import re
from collections import defaultdict
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "src" / "anymesh"
FILES = sorted(SOURCE.rglob("*.py"))
PROSE = Path(__file__).parents[1] / ".ci" / "glossary.txt"  # words that codespell refuses in prose and names alike
# Words that no name may contain, neither alone nor joined to others (`find_grips`, `GripConfig`); in prose they may be right.
WORDS = frozenset(line.split("->")[0] for line in PROSE.read_text(encoding="utf-8").split("\n") if line) | frozenset(
    "knowing seeing blind voice spoken buried twin twins slim rods bail bails grip grips studio".split()
)
# Names that are refused as they stand; as part of a longer name they may be right (`contact_support`, `MIN_LEVEL_DEG`).
NAMES = frozenset(
    (
        "instead told MOST LEAST NEAR LITTLE MUCH LEVEL SLACK CARVED TOLD TURN SLIDE TURNS SLIDES HELD FOUND GRIP "
        "FRONT BODY LEAF TWINS INSTEAD core_box way_out ways_out held_by touches_ends is_body mesh_piece surroundings_of "
        "habit_of examine lever support Placed Recognized Segmented Jointed Completed Corrected Exported Studio Hidden "
        "Units Piece Front Fronts Grip Look Looks Found Subject Truth Asked Grounded Motions Habit Exam "
        "needs_images JointKind TypicalMotion"
    ).split()
)
# One adapter per engine or format, each private to its file.
SAME_NAME = frozenset("World _Reader _Embedding".split())


def words(name: str) -> set[str]:
    """Split snake_case and CamelCase into lower-case words."""
    return set(re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower().split("_")) - {""}


def names(path: Path) -> set[str]:
    """Return the names of classes, functions, arguments, fields and module constants, and of the file itself."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = {path.stem}
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            found.add(node.name)
            found |= {b.target.id for b in node.body if isinstance(b, ast.AnnAssign) and isinstance(b.target, ast.Name)}
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            a = node.args
            found.add(node.name)
            found |= {arg.arg for arg in (*a.posonlyargs, *a.args, *a.kwonlyargs)}
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id.isupper():
            found.add(node.id)
    return found


def test_replaced_words_do_not_come_back() -> None:
    bad = {path: {n for n in names(path) if n.strip("_") in NAMES or words(n) & WORDS} for path in FILES}
    assert not {str(path.relative_to(SOURCE)): some for path, some in bad.items() if some}, (
        "see the glossary for the names to use"
    )


def test_replaced_words_do_not_come_back_in_tests() -> None:
    tests = Path(__file__).parent
    bad = {str(path.relative_to(tests)): {n for n in names(path) if words(n) & WORDS} for path in tests.rglob("*.py")}
    assert not {path: some for path, some in bad.items() if some}


def test_variables_are_named_after_what_they_hold() -> None:
    bad = []
    for path in FILES:
        functions = [n for n in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(n, ast.FunctionDef)]
        stored = {n.id for f in functions for n in ast.walk(f) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
        if "found" in stored:
            bad.append(str(path.relative_to(SOURCE)))
    assert not bad, "see the glossary for the names to use"


def test_no_two_classes_share_a_name() -> None:
    places = defaultdict(list)
    for path in FILES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef):
                places[node.name].append(str(path.relative_to(SOURCE)))
    assert not {name: found for name, found in places.items() if len(found) > 1 and name not in SAME_NAME}


def test_no_two_constants_of_the_inner_stages_share_a_name() -> None:
    places = defaultdict(set)
    for path in FILES:
        if path.relative_to(SOURCE).parts[0] in ("segmentation", "motion", "articulation", "scoring"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and re.fullmatch("[A-Z][A-Z0-9_]+", node.id):
                    places[node.id].add(path.relative_to(SOURCE).as_posix())
    shared = {name for name, found in places.items() if len(found) > 1}
    assert not shared, {name: places[name] for name in shared}
