"""Scores that are set by hand and added to fitted ones [log-odds].

`benchmarks/by_hand.py` measures what each costs when it is removed (docs/decisions/0039).
"""

from __future__ import annotations

from collections.abc import Mapping

from anymesh.types import JointType

# For a part that is cut out of a surface: the score grows with the IoU, and the border of a cut is not exact.
# Chosen on kinds left out of training: a higher F1 on fused surfaces, and the same on other objects.
CUT_SCORE = 0.5
# For a candidate whose name in the file is known, by the class of the name; no training mesh has names.
NAME_SCORE: Mapping[str, float] = {"movable": 5.0, "fixed": -6.0}
# For a motion that the sweep finds blocked, but for the best about a pivot of the file: artists let what they turn clip.
BLOCKED_SCORE = -4.0
# For a slide into a solid that leaves no room, of a part that is sunk into it and no button: it stands for "never".
STUCK_SCORE = -12.0
# For a part with a pivot in the file at a hinge: for a rotation about a line elsewhere, and for a slide.
OFF_PIVOT_SCORE = -4.0
PIVOT_SLIDE_SCORE = -2.0
# For a part whose label has a typical joint: for a hinge, for a rotation about the axis of a round outline, for a slide.
LABEL_PRIOR: Mapping[JointType, tuple[float, float, float]] = {
    JointType.REVOLUTE: (1.5, -2.5, -2.0),
    JointType.PRISMATIC: (-2.0, -2.5, 2.0),
}
