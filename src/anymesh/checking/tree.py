"""Check "schema": the joints form a tree, and all files that it refers to exist."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from anymesh.checking.content import Content
from anymesh.checking.engines.files import PACKAGE
from anymesh.checking.engines.robot import Robot
from anymesh.checking.report import Finding, failure, warning

CHECK = "schema"


def check_tree(robot: Robot) -> Iterator[Finding]:
    """Check for unique names, existing links, one root and no cycle, which all other checks require."""
    for subject, text in robot.problems:
        yield failure(CHECK, subject, text)
    if not robot.links:
        yield failure(CHECK, "", "it holds no link; at least one is needed")
        return
    for word, names in (("link", [b.name for b in robot.links]), ("joint", [j.name for j in robot.joints])):
        for name, count in Counter(names).items():
            if count > 1 or not name:
                shown = f"{count} {word}s are called {name!r}" if name else f"{count} {word}s have no name"
                yield failure(CHECK, name, f"{shown}; names must be unique and not empty")
    known = {link.name for link in robot.links}
    for joint in robot.joints:
        for word, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in known:
                yield failure(CHECK, joint.name, f"its {word} is the link {link!r}, which is not there")
    for child, count in Counter(j.child for j in robot.joints).items():
        if count > 1:
            yield failure(CHECK, child, f"{count} joints have this link as their child; one is valid")
    if len(robot.roots) != 1:
        roots = ", ".join(robot.roots) or "none, since the joints form a cycle"
        yield failure(CHECK, "", f"the links that no joint carries are: {roots}; valid is one")
    elif len(robot.carried(robot.roots[0])) < len(known):
        lost = sorted(known - robot.carried(robot.roots[0]))
        yield failure(CHECK, lost[0], f"the links {lost} are not connected to the root {robot.roots[0]!r}; valid is a tree")


def check_files(content: Content) -> Iterator[Finding]:
    """Check that mesh files exist, and that their paths are portable."""
    for link, file in content.missing:
        yield failure(CHECK, link, f"the mesh {file} is not there")
    for link in content.robot.links:
        for file in dict.fromkeys(s.file for s in (*link.visuals, *link.collisions) if s.file):
            if file.startswith(("/", "file:")) or file[1:2] == ":":
                yield warning(CHECK, link.name, f"the mesh path {file} is absolute; a relative path works everywhere")
            elif "\\" in file:
                yield warning(CHECK, link.name, f"the mesh path {file} has backslashes; forward slashes work everywhere")
            elif "://" in file and not file.startswith(PACKAGE):
                yield warning(CHECK, link.name, f"the mesh path {file} is a URL; engines read relative paths and package://")
