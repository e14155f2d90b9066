"""All checks of one asset."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from anymesh.checking.bodies import check_collision, check_inertia, check_usual, still
from anymesh.checking.content import Content, read_content
from anymesh.checking.engines import check_engine
from anymesh.checking.engines.driving import SweepReport
from anymesh.checking.engines.locate import MJCF, find_description, kind_of, mjcf_beside
from anymesh.checking.engines.mjcf_ import read_mjcf
from anymesh.checking.engines.rest_ import Rest, at_rest
from anymesh.checking.engines.robot import Robot, read_urdf
from anymesh.checking.joints import check_damping, check_direction, check_joints, check_motion
from anymesh.checking.report import CheckReport, Finding, Severity, failure
from anymesh.checking.schema_ import NAME, SCHEMA, beyond_urdf, check_asset_json, check_files, check_naming, check_tree
from anymesh.checking.shapes import HANDLES, check_handles, check_meshes, check_scale, check_texture
from anymesh.errors import InputError, MissingExtraError
from anymesh.runtime import read_json


def check_asset(path: str | Path, *, engines: Sequence[str] = ("mujoco",)) -> CheckReport:
    """Check an asset for everything that a simulator needs: an output folder, any URDF or MJCF, or a folder with one.

    engines: names of `checking.engines.ENGINES` in which every joint is driven; empty for static checks only. Problems of the
    asset are findings.
    Raise InputError if there is nothing to check, OptionError for an unknown engine, MissingExtraError for an MJCF without
    MuJoCo.
    """
    chosen = tuple(dict.fromkeys(check_engine(name) for name in engines))
    file = find_description(Path(path))
    try:
        robot = read_mjcf(file) if kind_of(file) == MJCF else read_urdf(file)
    except InputError as error:
        return CheckReport(str(path), (failure(SCHEMA, file.name, str(error)),))
    broken = tuple(check_tree(robot))
    if any(f.severity is Severity.FAILURE for f in broken):
        return CheckReport(str(path), broken)
    content = read_content(robot)
    ours = (file.parent / NAME).is_file()
    findings = [*_still(content)]
    sweeps: list[SweepReport] = []
    if any(f.check in (SCHEMA, "joints") and f.severity is Severity.FAILURE for f in findings):
        chosen = ()  # engines disagree on what is broken, or end the process
    mjcf = mjcf_beside(file) if ours and chosen and beyond_urdf(read_json(file.parent / NAME) or {}, robot) else None
    for engine in chosen:
        of_motion, sweep = check_motion(mjcf if mjcf is not None and engine == "mujoco" else file, engine, ours=ours)
        findings += of_motion
        sweeps += [] if sweep is None else [sweep]
    return CheckReport(str(path), tuple(findings), tuple(sweeps))


def _still(content: Content) -> Iterator[Finding]:
    """Yield the findings of checks without simulation; a check without problems reports what it checked."""
    robot = content.robot
    beside = robot.path.parent / NAME
    ours = beside.is_file()
    schema = [*check_files(content), *(check_asset_json(beside, robot) if ours else ())]
    record = read_json(beside) if ours and not any(f.severity is Severity.FAILURE for f in schema) else None
    beyond = beyond_urdf(record or {}, robot)
    joints = [f for f in (*check_joints(robot, content.diagonal), *check_damping(robot)) if f.subject not in beyond]
    straight = not any(f.severity is Severity.FAILURE for f in joints)
    tree = f"{len(robot.links)} links and {len(robot.joints)} joints in a tree with the root {robot.roots[0]!r}"
    yield from _or_ok(SCHEMA, schema, f"{tree}{', asset.json matches its schema' if ours else ''}")
    yield from _or_ok("naming", [*check_naming(robot)], "names are legal, unique and plain ASCII")
    shapes = sum(len(some) for kind in (content.visuals, content.collisions) for some in kind.values())
    yield from _or_ok("meshes", [*check_meshes(content)], f"{shapes} shapes are read, with area, and of sensible size")
    yield from _or_ok("scale", [*check_scale(content)], f"the diagonal is {content.diagonal:.3g} m")
    yield from _or_ok("joints", joints, f"{len(robot.moving)} joints move, with axes, limits, effort and velocity")
    yield from _or_ok("inertia", [*check_inertia(content)], _masses(robot))
    yield from _or_ok("usual", [*check_usual(content, record or {})], "size and mass are plausible for what it is")
    if record is not None:
        handles = sum("handle" in joint for joint in record["joints"])
        yield from _or_ok(HANDLES, [*check_handles(content, record)], f"{handles} handles lie on their links")
    rest = _rest(robot)
    collision = [*check_collision(content, rest, ours=ours)]
    fine = "moving links have collision shapes, cavities and round openings are open"
    fine += "" if rest is None else f", {still(robot, rest)}"
    yield from _or_ok("collision", collision, fine)
    yield from _or_ok("texture", [*check_texture(content, ours=ours)], "materials and pictures are there")
    if straight:
        ways = [f for f in check_direction(content) if f.subject not in beyond]
        yield from _or_ok("direction", ways, "no joint drives its link into its parent")


def _or_ok(check: str, findings: list[Finding], text: str) -> Iterator[Finding]:
    yield from findings or [Finding(check, Severity.OK, "", text)]


def _masses(robot: Robot) -> str:
    masses = [link.inertial.mass for link in robot.links if link.inertial is not None]
    return f"{len(masses)} links have a total mass of {sum(masses):.3g} kg, with valid inertias"


def _rest(robot: Robot) -> Rest | None:
    """Return what MuJoCo does at rest; None without it, or if it rejects the file, which the motion check reports."""
    try:
        return at_rest(robot.path)
    except (InputError, MissingExtraError):
        return None
