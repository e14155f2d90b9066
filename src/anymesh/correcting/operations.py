"""The operations that correct a part: one set of names, texts and values for the command line, Python and the tools of agents.

`parsing.py` turns them into corrections. This module reads no library, so that help is fast.
"""

from __future__ import annotations

from dataclasses import dataclass

UNITS_TEXT = "degrees for a hinge and metres for a slide, or with a unit: deg, rad, mm, cm, m"


@dataclass(frozen=True)
class Operation:
    """One operation on a part. metavar: form of its value, empty for one without a value."""

    name: str
    metavar: str
    help: str

    @property
    def option(self) -> str:
        """Return the option of the command line."""
        return f"--{self.name.replace('_', '-')}"


# In the order in which they are applied, whatever their order in a command.
OPERATIONS = (
    Operation("undo", "", "Undo the last step of the corrections first, also one of an earlier command or of the page."),
    Operation("merge", "A,B", "Merge part A into part B, which keeps its name and joint."),
    Operation("split", "", "Make each connected component of the part but the largest a part, fixed to it."),
    Operation("new_part", "NAME", "Make a region of the part a new part, to which what follows applies; see region and faces."),
    Operation("region", "N,N..", "For the new part: numbers of regions, as they are listed."),
    Operation("faces", "A-B,C..", "For the new part: numbers of faces, instead of regions."),
    Operation("parent", "PART", "Attach the part to another one; its motion is unchanged."),
    Operation("motion", "N", "Choose a free motion, by its number as they are listed."),
    Operation(
        "type", "TYPE", "revolute (hinge), prismatic (slide), continuous (endless), ball, free or fixed, with the usual limits."
    ),
    Operation("axis", "AXIS", "x, y or z with or without a sign, or three numbers such as 0,0.6,0.8; Z is up."),
    Operation("through", "X,Y,Z", "Point that the axis of a hinge passes through, in metres or with units."),
    Operation("flip", "", "Reverse the direction in which the part opens; the limits keep their numbers."),
    Operation(
        "limits", "A,B", f"Lower and upper limit, which include 0, the pose as modelled: {UNITS_TEXT}. One number: from 0."
    ),
    Operation("screw", "PITCH", "The part turns about its axis and moves along it, by this length a turn, such as 3mm."),
    Operation("mimic", "PART,RATIO", "The part follows another one: it moves by RATIO (1) times as much; none: it does not."),
    Operation(
        "loop",
        "PART,X,Y,Z,KIND",
        "The part stays joined to another one at a point, revolute (the usual), ball, prismatic or fixed; none: it does not.",
    ),
    Operation("press", "TRAVEL", "The part is pushed in, as a button or trigger, by this travel: metres or with a unit."),
    Operation("label", "TEXT", "Say what the part is, such as drawer."),
    Operation("rename", "NAME", "Give the part's link another name."),
    Operation("right", "", "State that the joint is right as it is; this clears its warnings."),
    Operation("accept", "", "Accept a proposal, which --precision left fixed: its joint is right, and is written."),
    Operation(
        "copies", "", "The same for its copies: they get the part's label and joint, mirrored where they are mirror images."
    ),
    Operation("remove", "", "Merge the part into its parent, so that it no longer moves; with copies, also its copies."),
)


def operations_text() -> str:
    """Return all operations in one line each, for agents."""
    rows = (f"{o.name}: {o.metavar + ', ' if o.metavar else 'true; '}{o.help}" for o in OPERATIONS)
    return "\n".join(rows)
