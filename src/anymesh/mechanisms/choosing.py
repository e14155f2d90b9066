"""Which mechanism a joint has, and its numbers. Formulas and sources: docs/resistance.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from anymesh.errors import OptionError
from anymesh.physics.inertia import Inertia
from anymesh.physics.mechanism import Mechanism, MechanismKind
from anymesh.physics.resistance import GRAVITY, Resistance
from anymesh.types import MOVING, Asset, Joint, JointType, Part
from anymesh.vocabulary import recognize, words_of

SURE = 0.8  # minimum confidence of what is written unasked
STABLE = 0.5 * 60.0**2  # [1/s^2] maximum stiffness over inertia: half of what steps of 1/60 s allow
DAMPED = 0.9 * 60.0  # [1/s] maximum damping over inertia, without armature
PRESS = 100.0  # [m/s^2] maximum force of a spring at the handle, over the mass that is felt there
MARGIN = 1.3  # friction of a hinge that holds, over what it must hold
EASY = 10.0  # [N at the handle] maximum friction of a hinge that holds without a spring
PRELOAD, CLOSING = float(np.deg2rad(20)), 1.6  # [rad] of a closing spring when closed; [rad/s] natural frequency with its door
REACH, RAMP = 0.03, 0.02  # [m at the handle] of a latch, and the end of it over which its force fades
SNAPPING = 0.2  # [s] maximum damping of a toggle, over its force at its range
STEPS = 12  # of a turn
MAX_REFERENCE = 4 * np.pi  # [rad] maximum preload of a spring that bears a weight


@dataclass(frozen=True)
class Rule:
    """A kind of part and its mechanism.

    words: one of them occurs in the name of the part or object; none: any; force: of the mechanism, at the handle [N], of a
    detent about the axis [N m].
    """

    labels: str
    words: str
    kind: MechanismKind
    confidence: float
    force: float = 0.0


FORCES = {MechanismKind.RETURN: 2.8, MechanismKind.TOGGLE: 2.8, MechanismKind.LATCH: 22.0, MechanismKind.DETENT: 0.04}
RULES = (
    Rule("button", "key keycap", MechanismKind.RETURN, 0.9, 0.55),
    Rule("button", "", MechanismKind.RETURN, 0.9, FORCES[MechanismKind.RETURN]),
    Rule("lever", "pedal brake", MechanismKind.RETURN, 0.8, 18.0),
    Rule("lever", "switch toggle rocker", MechanismKind.TOGGLE, 0.5, FORCES[MechanismKind.TOGGLE]),
    Rule("lever", "joystick stick", MechanismKind.RETURN, 0.6, FORCES[MechanismKind.RETURN]),
    Rule("lid", "screen display laptop notebook", MechanismKind.HOLD, 0.9),
    Rule("door lid flap", "dishwasher", MechanismKind.HOLD, 0.85),
    Rule("lid", "", MechanismKind.HOLD, 0.4),
    Rule("door drawer", "fridge refrigerator freezer microwave", MechanismKind.LATCH, 0.7, FORCES[MechanismKind.LATCH]),
    Rule("door drawer window", "", MechanismKind.LATCH, 0.5, FORCES[MechanismKind.LATCH]),
    Rule("flap", "", MechanismKind.CLOSE, 0.5),
    Rule("knob", "", MechanismKind.DETENT, 0.4, FORCES[MechanismKind.DETENT]),
)


def parse_mechanisms(text: str) -> Mapping[str, MechanismKind] | None:
    """Return the kinds of LABEL=KIND,... by label or part; None for auto, off and all. Raise OptionError for anything else."""
    if text in ("auto", "off", "all"):
        return None
    pairs = [(label.strip(), kind.strip()) for label, _, kind in (pair.partition("=") for pair in text.split(","))]
    if any(not label or kind not in set(MechanismKind) for label, kind in pairs):
        kinds = ", ".join(MechanismKind)
        raise OptionError(f"--mechanisms: found {text!r}; valid are auto, off, all, or LABEL=KIND,... with the kinds {kinds}")
    return {label: MechanismKind(kind) for label, kind in pairs}


def choose_mechanisms(
    asset: Asset, inertias: Mapping[str, Inertia], resistances: Mapping[str, Resistance], choice: str
) -> tuple[dict[str, Mechanism], dict[str, Resistance]]:
    """Return the mechanisms by joint, and the resistances of all joints with what the mechanisms need of them.

    inertias: of all links, about their own centres; choice: auto (what is sure), off, all, or LABEL=KIND,...

    Raise OptionError for another choice.
    """
    asked, parts, resisting = parse_mechanisms(choice), {p.name: p for p in asset.segmentation.parts}, dict(resistances)
    chosen: dict[str, Mechanism] = {}
    for joint in (
        [] if choice == "off" else [j for j in asset.joints if j.name in resisting and j.type in MOVING and j.mimic is None]
    ):
        part = parts[joint.child]
        rule, reason = _usual(f"{asset.name} {asset.category}", part, joint) if asked is None else _asked(part, joint, asked)
        if rule is not None and (rule.confidence >= SURE or choice == "all"):
            made = _Maker(joint, resisting[joint.name], _weight(asset, inertias, joint))
            m, resisting[joint.name] = made(rule)
            chosen[joint.name] = replace(m, confidence=rule.confidence, reason=reason)
    return chosen, resisting


def _asked(part: Part, joint: Joint, asked: Mapping[str, MechanismKind]) -> tuple[Rule | None, str]:
    label = _label(part)
    kind = asked.get(part.name, asked.get(part.label, asked.get(label)))
    if kind is None or not _fits(kind, joint):
        return None, ""
    return Rule(label, "", kind, 1.0, FORCES.get(kind, 0.0)), "as asked"


def _usual(name: str, part: Part, joint: Joint) -> tuple[Rule | None, str]:
    """Return the first rule for a part of an object, with its confidence, and the reason in words.

    A door that opens downwards or upwards has no latch, but holds.
    """
    label, words = _label(part), {*words_of(part.name), *words_of(part.label), *words_of(name)}
    tilts = joint.type is JointType.REVOLUTE and abs(joint.axis[2]) < np.sqrt(0.5)
    for rule in RULES:
        kind = MechanismKind.HOLD if tilts and rule.kind is MechanismKind.LATCH else rule.kind
        named = sorted(words & set(rule.words.split()))
        if label in rule.labels.split() and (named or not rule.words) and _fits(kind, joint):
            confidence = rule.confidence if named else min(rule.confidence, part.confidence, joint.confidence)
            return replace(rule, kind=kind, confidence=confidence), f"usual for: {' '.join((*named, label))}"
    return None, ""


def _label(part: Part) -> str:
    word = recognize(part.label) or recognize(part.name)
    return part.label if word is None else word.label


def _fits(kind: MechanismKind, joint: Joint) -> bool:
    match kind:
        case MechanismKind.DETENT:
            return joint.type is not JointType.PRISMATIC
        case MechanismKind.HOLD | MechanismKind.CLOSE:
            return joint.type is JointType.REVOLUTE
        case _:
            return joint.limits is not None


def _weight(asset: Asset, inertias: Mapping[str, Inertia], joint: Joint) -> tuple[float, float]:
    """Return what weight adds along a joint: a, b of `a cos q + b sin q` [N m] for a hinge; a [N], 0 for a slide."""
    carried, origins = [joint.child], {j.child: j.origin for j in asset.joints}
    for at in carried:
        carried += [j.child for j in asset.joints if j.parent == at]
    down = np.array([0.0, 0.0, -GRAVITY])
    if joint.type is JointType.PRISMATIC:
        return float(sum(inertias[n].mass for n in carried) * (down @ joint.axis)), 0.0
    arm = np.sum([inertias[n].mass * (origins[n] + inertias[n].center - joint.origin) for n in carried], axis=0)
    return float(np.cross(arm, down) @ joint.axis), float(np.cross(np.cross(joint.axis, arm), down) @ joint.axis)


class _Maker:
    """Makes a mechanism for a joint, and the resistance with the friction, damping and effort that it needs."""

    def __init__(self, joint: Joint, r: Resistance, weight: tuple[float, float]) -> None:
        self.r, self.inertia = r, r.inertia + r.armature
        self.low, self.high = joint.limits or (-np.pi, np.pi)
        self.span = self.high - self.low
        turns = joint.type is not JointType.PRISMATIC and r.pull.unit == "N"
        off = float(np.linalg.norm(np.cross(joint.axis, r.pull.at - joint.origin)))
        self.lever = max(off, 1e-3) if turns else 1.0  # [m]
        self.q = np.linspace(self.low, self.high, 65)
        turn = 0.0 if joint.type is JointType.PRISMATIC else self.q
        self.load = weight[0] * np.cos(turn) + weight[1] * np.sin(turn) + 0 * self.q  # of the weight, along the axis

    def __call__(self, rule: Rule) -> tuple[Mechanism, Resistance]:
        makers = {
            MechanismKind.RETURN: self._returning,
            MechanismKind.CLOSE: self._closing,
            MechanismKind.HOLD: self._holding,
            MechanismKind.LATCH: self._latched,
            MechanismKind.TOGGLE: self._toggled,
            MechanismKind.DETENT: self._stepped,
        }
        m, r = makers[rule.kind](Mechanism(rule.kind, 1.0, "", 0.0), rule.force)
        spring = max(abs(m.stiffness * (m.reference - q)) for q in (self.low, self.high))
        most = float(spring + max(-m.least, m.most) + m.torque)
        armature = max(r.armature, max(m.slope, m.torque * m.steps) / STABLE - r.inertia)
        return m, replace(r, armature=armature, load=r.load + most, effort=max(r.effort, 2 * (r.friction + most)))

    def _pressing(self, force: float) -> float:
        """Return a force at the handle along the joint [N or N m], as far as it is light enough for what it moves."""
        return min(force * self.lever, PRESS * self.inertia / self.lever)

    def _opening(self) -> float:
        """Return what friction and weight take to open from the closed position, the lower limit [N or N m]."""
        return self.r.friction - float(self.load[0])

    def _returning(self, m: Mechanism, force: float) -> tuple[Mechanism, Resistance]:
        full, stiffest = self._pressing(force), STABLE * self.inertia
        if min(-self.low, self.high) > self.span / 4:  # both ways
            return replace(m, stiffness=min(2 * full / self.span, stiffest), force=self.r.friction / self.lever), self.r
        rest = self.low if -self.low < self.high else self.high
        out = 1.0 if rest == self.low else -1.0
        k = min(full / 2 / self.span, stiffest)
        needed = 2 * self.r.friction + out * self.load - k * abs(self.q - rest)
        least = max(full / 2, float(needed.max()))
        start = least + self.r.friction - out * float(self.load[0 if out > 0 else -1])
        return replace(m, stiffness=k, reference=rest - out * least / k, force=start / self.lever), self.r

    def _closing(self, m: Mechanism, force: float) -> tuple[Mechanism, Resistance]:
        needed = (2 * self.r.friction + self.load) / (self.q - self.low + PRELOAD)
        k = min(max(CLOSING**2 * self.inertia, float(needed.max())), STABLE * self.inertia)
        damping = min(max(self.r.damping, 2 * float(np.sqrt(k * self.inertia))), DAMPED * self.r.inertia)
        m = replace(m, stiffness=k, reference=self.low - PRELOAD, force=(self._opening() + k * PRELOAD) / self.lever)
        return m, replace(self.r, damping=damping)

    def _holding(self, m: Mechanism, force: float) -> tuple[Mechanism, Resistance]:
        held = float(abs(self.load).max())
        if MARGIN * held > EASY * self.lever:
            slope, offset = np.polyfit(self.q, self.load, 1)
            k = min(float(slope), STABLE * self.inertia)
            rest = float(abs(self.load - k * self.q - offset).max())
            if rest < held / 2 and abs(offset) < MAX_REFERENCE * k:
                m, held = replace(m, stiffness=k, reference=float(-offset / k)), rest
        r = self._rubbing(MARGIN * held, np.inf)
        opens = -1.0 if self.low + self.high < 0 else 1.0
        return replace(m, force=r.pull.typical - opens * m.stiffness * m.reference / self.lever), r

    def _rubbing(self, least: float, most: float) -> Resistance:
        """Return the resistance with friction between bounds, and the pull that follows."""
        r, pull = self.r, self.r.pull
        before = np.array([r.friction, *r.friction_range])
        after = np.clip(before, least, most)
        typical, light, stiff = (np.array([pull.typical, pull.least, pull.most]) + (after - before) / self.lever).tolist()
        friction, low, high = after.tolist()
        pull = replace(pull, typical=typical, least=light, most=stiff)
        return replace(r, friction=friction, friction_range=(low, high), pull=pull)

    def _latched(self, m: Mechanism, force: float) -> tuple[Mechanism, Resistance]:
        width = min(RAMP / self.lever, self.span / 4)
        held = max(min(self._pressing(force), STABLE * self.inertia * width), 2 * self.r.friction)
        m = replace(m, at=self.low + width * REACH / RAMP, slope=held / width, least=-held)
        return replace(m, force=(held + self._opening()) / self.lever), self.r

    def _toggled(self, m: Mechanism, force: float) -> tuple[Mechanism, Resistance]:
        most = max(self._pressing(force), 2 * self.r.friction)
        m = replace(m, at=(self.low + self.high) / 2, slope=8 * most / self.span, least=-most, most=most)
        r = replace(self.r, damping=min(self.r.damping, SNAPPING * most / self.span))
        return replace(m, force=(most + r.friction) / self.lever), r

    def _stepped(self, m: Mechanism, force: float) -> tuple[Mechanism, Resistance]:
        torque = min(force, 2 * self.r.friction)
        r = self._rubbing(0.0, torque / 4)  # else it would rest beside the step
        return replace(m, torque=torque, steps=STEPS, force=(torque + r.friction) / self.lever), r
