"""Ten questions with known answers, which tell how far a model can be trusted on each kind of question.

They are asked by the code of a run, about four objects of boards and discs whose parts and joints are known.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from jaxtyping import Float, Int

from anymesh.config import Config
from anymesh.errors import OptionError
from anymesh.pipeline.options import FILES, GEOMETRY
from anymesh.pipeline.solving import Solver
from anymesh.prompted.answerers.answering import open_model, pictures_per_call
from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer
from anymesh.prompted.answerers.vlm_answerer import Patience, VlmAnswerer
from anymesh.prompted.models.reliability import ProbeCount
from anymesh.prompted.models.servers import VALID
from anymesh.prompted.motions.lines import hinge
from anymesh.prompted.motions.verify import KINDS
from anymesh.prompted.questions.grounding import MarksAnswer, WhichMarks
from anymesh.prompted.questions.prompting import MotionPick, PointTable, WhichArrows, WhichMotions, WhichPoints
from anymesh.prompted.questions.recognition import Recognize
from anymesh.runtime import CALL_SECONDS
from anymesh.types import Brief, Exchange, JointType, KnownJoint, Material, Mesh, Node, Part, Segmentation
from anymesh.types.motion import Recognition
from anymesh.types.questions import Answer, Question, VisualAnswerer
from anymesh.vocabulary import recognize

ASKED = {  # kinds of question about each object
    "cabinet": ("recognize", "marks", "motions"),
    "cart": ("recognize", "marks"),
    "window": ("marks", "motions", "arrows"),
    "chest": ("motions", "points"),
}
MIN_IOU = 0.5  # of a marked part with the true one, as in evaluation
MAX_ANGLE_DEG, MAX_DISTANCE_RATIO = 10.0, 0.05  # of a right line to the known one; distance as a share of the part's size
DISC_SIDES = 32
ENDLESS = 10**6  # invalid answers in a row after which a model is given up
COLORS = ((0.55, 0.42, 0.3, 1.0), (0.75, 0.75, 0.78, 1.0))  # linear, of the base and of the parts
Solid = tuple[np.ndarray, np.ndarray]  # vertices and faces
Label = TypeVar("Label", bound=str)


@dataclass(frozen=True, eq=False)
class KnownObject(Brief):
    """An object of the probe. labels: of its parts, the base first; joints: of each part, None for the base."""

    name: str
    mesh: Mesh
    face_part: Int[np.ndarray, " F"]
    labels: tuple[str, ...]
    joints: tuple[KnownJoint | None, ...]

    @property
    def reference(self) -> Reference:
        size, base = float(self.mesh.extents.max()), (0,) * len(self.labels)
        return Reference(self.name, size, self.face_part, self.mesh.face_areas, self.labels, base, self.joints)

    @property
    def segmentation(self) -> Segmentation:
        return Segmentation(self.face_part, tuple(Part(f"{label}_{k}", label) for k, label in enumerate(self.labels)))


@dataclass(frozen=True, eq=False)
class KnownQuestion:
    """One of the ten questions, in as many calls as a run makes of it, each with the right answer."""

    kind: str
    about: str
    calls: tuple[tuple[Question[Any], Any], ...]


@dataclass(frozen=True)
class ProbeResult:
    """Result of a probe. rows: kind of question, object, right answers and answers of each question; counts: by kind."""

    rows: tuple[tuple[str, str, int, int], ...]
    counts: tuple[ProbeCount, ...]
    exchanges: tuple[Exchange, ...] = ()

    @property
    def right(self) -> int:
        """Return the number of questions without a wrong answer."""
        return sum(right == asked for _, _, right, asked in self.rows)


class UnansweredError(Exception):
    """A model gave no valid answer to a question of the probe."""


class _Refuses:
    """Fallback of a model that is probed."""

    name, exchanges, warnings = "none", (), ()

    def ask(self, question: Question[Answer]) -> Answer:
        raise UnansweredError(question.kind)


class _Noted:
    """Answerer that keeps each question with its answer."""

    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def __init__(self, answerer: VisualAnswerer) -> None:
        self.name, self._answerer = answerer.name, answerer
        self.asked: list[tuple[Question[Any], Any]] = []

    def ask(self, question: Question[Answer]) -> Answer:
        answer = self._answerer.ask(question)
        self.asked.append((question, answer))
        return answer


def probe_model(name: str, pictures: str, timeout: float = CALL_SECONDS) -> ProbeResult:
    """Ask a model the questions; its cached answers are not used.

    Raise OptionError for a name that is no model's, ModelError if it cannot be reached.
    """
    if name == GEOMETRY or name.startswith((FILES, "replay:")):
        raise OptionError(f"--probe: found {name!r}, which is no model; valid are {VALID.partition(', files')[0]}")
    most, model = pictures_per_call(Config(pictures=pictures)), open_model(name, timeout=timeout)
    return probe(known_questions(pictures), VlmAnswerer(model, _Refuses(), Patience(ENDLESS), most=most))


def probe(questions: Iterable[KnownQuestion], answerer: VisualAnswerer) -> ProbeResult:
    """Ask an answerer the questions. It may raise UnansweredError."""
    rows, items = [], list[tuple[str, bool, float]]()
    for question in questions:
        own = list[tuple[str, bool, float]]()
        for asked, truth in question.calls:
            try:
                answer = answerer.ask(asked)
            except UnansweredError:
                answer = None
            own += compared(asked, answer, truth)
        rows.append((question.kind, question.about, sum(right for _, right, _ in own), len(own)))
        items += own
    counts = []
    for kind in dict.fromkeys(kind for kind, _, _ in items):
        of_kind = [(right, chance) for k, right, chance in items if k == kind]
        counts.append((kind, sum(r for r, _ in of_kind), len(of_kind), float(np.mean([c for _, c in of_kind]))))
    return ProbeResult(tuple(rows), tuple(counts), answerer.exchanges)


def known_questions(pictures: str = "many") -> Iterator[KnownQuestion]:
    """Return the questions as a run asks them, with the right answers, object by object. pictures: as in `Config`."""
    for known in known_objects():
        kinds = ASKED[known.name]
        asked = list(_asked(known, kinds, pictures))
        for kind in kinds:
            yield KnownQuestion(kind, known.name, tuple((q, a) for q, a in asked if q.kind == kind))


def _asked(known: KnownObject, kinds: Sequence[str], pictures: str) -> Iterator[tuple[Question[Any], Any]]:
    """Return the questions that runs ask about an object, with the right answers."""
    for verify in ("motion", "free") if {"points", "arrows"} & set(kinds) else ("motion",):
        answerer = _Noted(ReferenceAnswerer("known", lambda: known.reference))
        solver = Solver(known.mesh, Config(verify=verify, ask="all", pictures=pictures), lambda _, made=answerer: made)
        recognition = solver.answers.recognize().recognition
        if "marks" in kinds and verify == "motion":
            solver.parts("auto", recognition)
        solver.joints(known.segmentation, recognition)
        asked, answerer.asked = answerer.asked, []  # the solver holds the answerer, and the questions hold the solver
        yield from (each for each in asked if verify == "motion" or each[0].kind in ("points", "arrows"))


def compared(question: Question[Any], answer: Any, truth: Any) -> list[tuple[str, bool, float]]:
    """Return what an answer says, each with its kind, whether it is right, and the probability to guess it rightly.

    answer: None for no valid one, which is wrong in all.
    """
    match question:
        case Recognize():
            return [("recognize", right, 0.0) for right in _recognized(answer, truth)]
        case WhichMarks():
            return [("marks", right, 0.0) for right in _marked(question, answer, truth)]
        case WhichMotions():
            picks = answer or [MotionPick(-1)] * len(truth)
            chances = [1 / (len(t.motions) + 1) for t in question.tables]
            motions = [("motions", p.motion == t.motion, c) for p, t, c in zip(picks, truth, chances, strict=True)]
            kinds = [_is_kind(p, t) for p, t in zip(picks, truth, strict=True) if t.attached is not None]
            return [*motions, *(("kinds", right, 1 / KINDS) for right in kinds)]
        case WhichPoints():
            rows = answer or [None] * len(truth)
            same = [_same_line(*each) for each in zip(question.tables, rows, truth, strict=True)]
            return [("points", right, 1 / len(t.points)) for right, t in zip(same, question.tables, strict=True)]
        case WhichArrows():
            rows = answer or [None] * len(truth)
            return [("arrows", a == t, 1 / len(q.directions)) for a, t, q in zip(rows, truth, question.tables, strict=True)]
    raise TypeError(type(question).__name__)


def _recognized(answer: Recognition | None, truth: Recognition) -> list[bool]:
    """Return whether each kind of part was named, and turns or slides as it does."""
    named = {} if answer is None else {_word(r.label): r.moves is JointType.PRISMATIC for r in answer.labels}
    return [named.get(_word(r.label)) == (r.moves is JointType.PRISMATIC) for r in truth.labels]


def _word(label: str) -> str:
    word = recognize(label)
    return word.label if word else label


def _marked(question: WhichMarks, answer: MarksAnswer | None, truth: MarksAnswer) -> list[bool]:
    """Return whether the marks of each part are right, by what they cover in the pictures."""
    pixels = np.bincount(np.concatenate([r[r > 0] for r in question.regions]))
    parts = () if answer is None else answer.parts
    right = []
    for part in truth.parts:
        own = set(part.marks)
        shares = [
            pixels[list(own & set(p.marks))].sum() / pixels[list(own | set(p.marks))].sum()
            for p in parts
            if p.label == part.label
        ]
        right.append(bool(max(shares, default=0.0) >= MIN_IOU))
    return right


def _is_kind(pick: MotionPick, truth: MotionPick) -> bool:
    """Return whether the kinds of joint are the same where they are weighed: all rotations are."""
    if pick.attached is None or truth.attached is None:
        return False
    kind, true = pick.attached.kind, truth.attached.kind
    return kind is true or (kind.is_rotation and true.is_rotation)


def _same_line(table: PointTable, rows: tuple[int, ...] | None, truth: tuple[int, ...]) -> bool:
    """Return whether picked points stand for the line of the right ones."""
    if rows is None:
        return False
    axes = [None if table.axes is None else table.axes[r[0]] for r in (rows, truth)]
    picked, true = (hinge(table.points[list(r)], table.part.normal, a) for r, a in zip((rows, truth), axes, strict=True))
    size = float(np.linalg.norm(np.ptp(table.part.points, axis=0)))
    near = float(picked.distance(true.origin[None])[0]) <= MAX_DISTANCE_RATIO * size
    return near and abs(float(picked.axis @ true.axis)) >= float(np.cos(np.deg2rad(MAX_ANGLE_DEG)))


def known_objects() -> list[KnownObject]:
    """Return the objects of the probe [m, Z up, front at -Y]."""
    return [_cabinet(), _cart(), _window(), _chest()]


def _cabinet() -> KnownObject:
    door = [_box((0.01, 0.59), (-0.02, 0.0), (0.02, 0.5)), _box((0.53, 0.55), (-0.05, -0.02), (0.2, 0.36))]
    drawer = [
        _box((0.01, 0.59), (-0.02, 0.0), (0.54, 0.78)), _box((0.22, 0.38), (-0.05, -0.02), (0.65, 0.67)),
        *_tray((0.03, 0.57), (0.0, 0.4), (0.55, 0.72), 0.01),
    ]  # fmt: skip
    case = [
        _box((0.0, 0.6), (0.0, 0.45), (0.0, 0.02)), _box((0.0, 0.6), (0.0, 0.45), (0.78, 0.8)),
        _box((0.0, 0.6), (0.43, 0.45), (0.02, 0.78)), _box((0.02, 0.58), (0.0, 0.43), (0.51, 0.53)),
        _box((0.0, 0.02), (0.0, 0.43), (0.02, 0.78)), _box((0.58, 0.6), (0.0, 0.43), (0.02, 0.78)),
    ]  # fmt: skip
    hinged = KnownJoint(JointType.REVOLUTE, np.array([0.01, 0.0, 0.26]), np.array([0.0, 0.0, -1.0]), (0.0, 1.8))
    slides = KnownJoint(JointType.PRISMATIC, np.array([0.3, 0.0, 0.66]), np.array([0.0, -1, 0]), (0.0, 0.35))
    return _object("cabinet", case, ("door", door, hinged), ("drawer", drawer, slides))


def _cart() -> KnownObject:
    at = [(x, y) for x in (0.12, 0.58) for y in (-0.03, 0.38)]
    wheels = [[_disc(0.09, (y - 0.02, y + 0.02), (x, 0.09))] for x, y in at]
    bed = [*_tray((0.0, 0.7), (0.0, 0.35), (0.12, 0.3), 0.015)]
    bed += [_disc(0.012, (-0.01, 0.36), (x, 0.09)) for x in (0.12, 0.58)]
    bed += [_box((x - 0.02, x + 0.02), (y, y + 0.03), (0.08, 0.12)) for x in (0.12, 0.58) for y in (0.02, 0.3)]
    spins = [KnownJoint(JointType.CONTINUOUS, np.array([x, y, 0.09]), np.array([0.0, 1, 0]), None) for x, y in at]
    return _object("cart", bed, *(("wheel", w, joint) for w, joint in zip(wheels, spins, strict=True)))


def _window() -> KnownObject:
    frame = [*_frame((0.0, 1.2), (0.0, 0.08), (0.0, 0.9), 0.05), _box((0.05, 0.6), (0.05, 0.055), (0.05, 0.85))]
    frame += [_box((0.58, 0.62), (0.045, 0.075), (0.05, 0.85))]
    sash = [*_frame((0.58, 1.15), (0.01, 0.04), (0.051, 0.849), 0.05), _box((0.63, 1.1), (0.022, 0.028), (0.101, 0.799))]
    sash += [_box((0.595, 0.61), (-0.02, 0.01), (0.4, 0.5))]
    slides = KnownJoint(JointType.PRISMATIC, np.array([0.86, 0.025, 0.45]), np.array([-1.0, 0.0, 0]), (0.0, 0.5))
    return _object("window", frame, ("window", sash, slides))


def _chest() -> KnownObject:
    lid = [_box((0.0, 0.8), (0.0, 0.45), (0.4, 0.43)), _box((0.36, 0.44), (-0.02, 0.0), (0.36, 0.42))]
    hinged = KnownJoint(JointType.REVOLUTE, np.array([0.4, 0.45, 0.4]), np.array([-1.0, 0.0, 0]), (0.0, 1.8))
    return _object("chest", _tray((0.0, 0.8), (0.0, 0.45), (0.0, 0.4), 0.02), ("lid", lid, hinged))


Range = tuple[float, float]


def _object(name: str, base: list[Solid], *parts: tuple[str, list[Solid], KnownJoint]) -> KnownObject:
    """Return an object of solids."""
    groups = [base, *(solids for _, solids, _ in parts)]
    solids = [(k, *solid) for k, group in enumerate(groups) for solid in group]
    starts = np.cumsum([0, *(len(v) for _, v, _ in solids)])
    face_part = np.concatenate([np.full(len(f), k) for k, _, f in solids])
    mesh = Mesh(
        vertices=np.concatenate([v for _, v, _ in solids]),
        faces=np.concatenate([f + start for (_, _, f), start in zip(solids, starts, strict=False)]),
        face_node=np.zeros(len(face_part), int),
        nodes=(Node("object"),),
        face_material=np.minimum(face_part, 1),
        materials=tuple(Material(base_color=color) for color in COLORS),
    )
    return KnownObject(name, mesh, face_part, ("base", *(p[0] for p in parts)), (None, *(p[2] for p in parts)))


def _extruded(outline: Float[np.ndarray, "n 2"], y: Range) -> Solid:
    """Return the prism of a convex outline in x and z, counter-clockwise as seen from -y, between two y."""
    n = len(outline)
    rings = [np.insert(outline, 1, value, axis=1) for value in y]
    k = np.arange(n)
    after = (k + 1) % n
    fan = np.stack([np.zeros(n - 2, int), k[1:-1], k[2:]], 1)
    sides = np.concatenate([np.stack([k, k + n, after], 1), np.stack([after, k + n, after + n], 1)])
    return np.concatenate(rings), np.concatenate([fan, fan[:, ::-1] + n, sides])


def _box(x: Range, y: Range, z: Range) -> Solid:
    return _extruded(np.array([(x[0], z[0]), (x[1], z[0]), (x[1], z[1]), (x[0], z[1])]), y)


def _disc(radius: float, y: Range, center: tuple[float, float]) -> Solid:
    """Return a disc about an axis along y. center: its x and z."""
    turn = 2 * np.pi * np.arange(DISC_SIDES) / DISC_SIDES
    return _extruded(np.array(center) + radius * np.stack([np.cos(turn), np.sin(turn)], 1), y)


def _tray(x: Range, y: Range, z: Range, thick: float) -> list[Solid]:
    """Return the boards of a box that is open at the top."""
    inner = (x[0] + thick, x[1] - thick)
    walls = z[0] + thick, z[1]
    ends = [_box(side, y, walls) for side in ((x[0], inner[0]), (inner[1], x[1]))]
    fronts = [_box(inner, side, walls) for side in ((y[0], y[0] + thick), (y[1] - thick, y[1]))]
    return [_box(x, y, (z[0], z[0] + thick)), *ends, *fronts]


def _frame(x: Range, y: Range, z: Range, wide: float) -> list[Solid]:
    """Return the bars of an upright frame."""
    inner = (z[0] + wide, z[1] - wide)
    posts = [_box(side, y, inner) for side in ((x[0], x[0] + wide), (x[1] - wide, x[1]))]
    return [*posts, *(_box(x, y, side) for side in ((z[0], inner[0]), (inner[1], z[1])))]
