"""Error distributions as SVG charts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from math import log10

from anymesh.evaluation.score import JointScore
from anymesh.types import JointType

COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#785a3c", "#7f7f7f")  # after Okabe and Ito
WIDTH, HEIGHT = 400, 250
LEFT, RIGHT, TOP, BOTTOM = 40, 10, 12, 36  # [px] margins of the plot
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True)
class Error:
    """A joint error: name, field, displayed range [low, high], and the joint types that have it."""

    name: str
    of: str  # field of JointScore
    low: float
    high: float
    types: tuple[JointType, ...] = tuple(JointType)

    def values(self, joints: Sequence[JointScore]) -> list[float | None]:
        """Return the errors of the joints; None if missing."""
        return [getattr(j, self.of) for j in joints if j.type_true in self.types]


TURNING = (JointType.REVOLUTE, JointType.CONTINUOUS)
ERRORS = (
    Error("angle between the axes [deg]", "angle", 0.01, 100.0),
    Error("distance of the axes (diagonal = 2)", "line_distance", 0.0001, 1.0, TURNING),
    Error("distance of the part's points, opened (diagonal = 2)", "displacement", 0.0001, 1.0),
)


def error_charts(groups: Mapping[str, Sequence[JointScore]]) -> list[str]:
    """Draw a chart per error: the share of each group's joints whose error is at most x."""
    error_curves = ((error, {name: error.values(joints) for name, joints in groups.items()}) for error in ERRORS)
    return [
        cumulative(error.name, {k: v for k, v in curves.items() if v}, error.low, error.high)
        for error, curves in error_curves
        if any(v is not None for values in curves.values() for v in values)
    ]


def cumulative(name: str, curves: Mapping[str, Sequence[float | None]], low: float, high: float) -> str:
    """Draw the share of values up to x, on a logarithmic axis from low to high. Curves with None values stay below 1."""
    inner = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def x(value: float) -> float:
        return LEFT + inner[0] * log10(min(max(value, low), high) / low) / log10(high / low)

    def y(share: float) -> float:
        return TOP + inner[1] * (1 - share)

    lines = [f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img"><title>{escape(name)}</title>']
    for share in SHARES:
        lines.append(f'<path class="grid" d="M{LEFT} {y(share):.1f}H{WIDTH - RIGHT}"/>')
        lines.append(f'<text x="{LEFT - 5}" y="{y(share) + 4:.1f}" text-anchor="end">{share:g}</text>')
    for power in range(round(log10(low)), round(log10(high)) + 1):
        at = x(10.0**power)
        lines.append(f'<path class="grid" d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}"/>')
        lines.append(f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 14}" text-anchor="middle">{10.0**power:g}</text>')
    for k, (label, values) in enumerate(curves.items()):
        color = COLORS[k % len(COLORS)]
        known = sorted(v for v in values if v is not None)
        steps = "".join(f"H{x(v):.1f}V{y((n + 1) / len(values)):.1f}" for n, v in enumerate(known))
        lines.append(f'<path d="M{LEFT} {y(0.0):.1f}{steps}H{WIDTH - RIGHT}" fill="none" stroke="{color}" stroke-width="2"/>')
        row = y(0.0) - 8 - 15 * (len(curves) - 1 - k)
        lines.append(f'<text x="{WIDTH - RIGHT - 6}" y="{row:.1f}" text-anchor="end" fill="{color}">{escape(label)}</text>')
    lines.append(f'<text x="{LEFT + inner[0] / 2}" y="{HEIGHT - 6}" text-anchor="middle">{escape(name)}</text></svg>')
    return "\n".join(lines)
