"""The tab "Correct" of the live page: the selected part and all its corrections."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from anymesh.correcting import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    CorrectionError,
    FlipSign,
    MergeParts,
    Relabel,
    SetLimits,
    SplitComponents,
)
from anymesh.types import JointType
from anymesh.viewer.live import Session
from anymesh.viewer.panels import distinct, scale_of, selection, shortened
from anymesh.viewer.panels_page import Page, offer

NONE = "-"  # in dropdown lists
FIND = "Find other motions"
NOT_FOUND_YET = "find them first"
QUIET = "gray"  # colour of buttons that are not the expected next step


class CorrectPanel:
    """Controls for corrections, which follow the selection. Lists act when changed, numbers when their button is pressed."""

    def __init__(self, page: Page, tab: Any) -> None:
        self._page, gui = page, page.gui
        self._motions: dict[str, ChooseMotion] = {}
        self._motions_of: tuple[Any, str | None] | None = None
        with tab:
            self._part = gui.add_dropdown("Part", (NONE,))
            self._description = gui.add_html("")
            self._motion_folder = gui.add_folder("Motion")
            self._joint_folder = gui.add_folder("Joint")
            self._part_folder = gui.add_folder("Part", expand_by_default=False)
        self._on(self._part, lambda: page.select(None if self._part.value == NONE else self._part.value))
        with self._motion_folder:
            self._find = gui.add_button(
                "Find other motions", color=QUIET, hint="Motions that nothing blocks, the most likely first"
            )
            self._motion = gui.add_dropdown("Preview", (NOT_FOUND_YET,))
            self._use = gui.add_button("Use this motion")
            self._flip = gui.add_button("Flip direction", color=QUIET, hint="Positive the other way")
        self._find.on_click(lambda _: page.act(self._find_motions))
        self._on(self._motion, self._preview)
        self._use.on_click(lambda _: page.act(self._use_motion))
        self._flip.on_click(lambda _: page.act(lambda: page.correct(FlipSign(self._name()))))
        with self._joint_folder:
            self._type = gui.add_dropdown("Type", tuple(str(t) for t in JointType))
            self._parent = gui.add_dropdown("Parent", (NONE,))
            self._low, self._high = gui.add_number("Lower", 0.0), gui.add_number("Upper", 0.0)
            self._limits = gui.add_button("Set limits", color=QUIET)
        self._on(self._type, lambda: page.correct(ChangeType(self._name(), JointType(self._type.value))))
        self._on(self._parent, lambda: page.correct(ChangeParent(self._name(), self._parent.value)))
        self._limits.on_click(lambda _: page.act(self._set_limits))
        with self._part_folder:
            self._label = gui.add_text("Label", "")
            self._relabel = gui.add_button("Set label", color=QUIET)
            self._into = gui.add_dropdown("Merge into", (NONE,))
            self._merge = gui.add_button("Merge", color=QUIET)
            self._split = gui.add_button("Split by components", color=QUIET)
        self._relabel.on_click(lambda _: page.act(lambda: page.correct(Relabel(self._name(), self._label.value))))
        self._merge.on_click(lambda _: page.act(lambda: page.correct(MergeParts(self._name(), self._into.value))))
        self._split.on_click(lambda _: page.act(lambda: page.correct(SplitComponents(self._name()))))

    def refresh(self, session: Session) -> None:
        """Update the controls for the selection and the asset."""
        names = [p.name for p in session.asset.segmentation.parts]
        self._description.content = selection(session.asset, session.selected)
        offer(self._part, (NONE, *names), session.selected or NONE)
        others = tuple(n for n in names if n != session.selected)
        joint = session.joint()
        self._motion_folder.visible = self._joint_folder.visible = joint is not None
        self._part_folder.visible = session.selected is not None
        offer(self._into, (NONE, *others), NONE)
        if session.selected is not None:
            part = session.asset.segmentation.parts[names.index(session.selected)]
            self._label.value = part.label
        if joint is not None:
            offer(self._parent, others, joint.parent)
            self._type.value = str(joint.type)
            scale, unit = scale_of(joint)
            self._low.label, self._high.label = f"Lower {unit}", f"Upper {unit}"
            low, high = joint.limits or (0.0, 0.0)
            self._low.value, self._high.value = round(scale * low, 3), round(scale * high, 3)
            self._low.visible = self._high.visible = self._limits.visible = joint.type is not JointType.FIXED
        if self._motions_of != (session.asset, session.selected):
            self._motions = {}
            offer(self._motion, (NOT_FOUND_YET,), NOT_FOUND_YET)
        self._use.disabled = session.preview is None

    def _on(self, control: Any, what: Callable[[], None]) -> None:
        """Call a function when a person changes a control; if it is refused, the control is reset."""

        def done(event: Any) -> None:
            if event.client is not None:
                self._page.act(what)
                self._page.act(self._page.refresh)

        control.on_update(done)

    def _name(self) -> str:
        session = self._page.session
        if session is None or session.selected is None:
            raise CorrectionError("select a part first")
        return session.selected

    def _find_motions(self) -> None:
        session = self._page.session
        if session is None:
            return
        self._find.disabled, self._find.label = True, "Finding motions ..."
        try:
            motions = session.motions()
        finally:
            self._find.disabled, self._find.label = False, FIND
        labels = distinct([shortened(f"{m.type} {m.confidence:.2f} {m.reason}") for m in motions])
        self._motions, self._motions_of = dict(zip(labels, motions, strict=True)), (session.asset, session.selected)
        offer(self._motion, tuple(labels) or ("none is free",), labels[0] if labels else "none is free")
        self._preview()

    def _preview(self) -> None:
        session, motion = self._page.session, self._motions.get(self._motion.value)
        if session is not None and motion is not None:
            session.preview = motion
            self._page.refresh()
            self._page.play_joint(next(j.name for j in session.shown.joints if j.child == motion.part))

    def _use_motion(self) -> None:
        session = self._page.session
        if session is None or session.preview is None:
            raise CorrectionError("find the motions of this part and choose one first")
        self._page.correct(session.preview)

    def _set_limits(self) -> None:
        name, session = self._name(), self._page.session
        joint = None if session is None else session.joint()
        if joint is None:
            raise CorrectionError(f"{name!r} is the root, which has no joint")
        scale, _ = scale_of(joint)
        self._page.correct(SetLimits(name, self._low.value / scale, self._high.value / scale))
