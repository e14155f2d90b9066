"""The tab "Correct" of the live page: numbers and names of the selected part, the snapping and dragging of its axis."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from typing import Any

import numpy as np

from anymesh.correcting import (
    ChangeParent,
    ChangeType,
    CorrectionError,
    FaceSet,
    MergeParts,
    MoveFaces,
    Relabel,
    SetAxis,
    SetLimits,
    SplitComponents,
)
from anymesh.correcting.corrections import vector
from anymesh.correcting.picking import Line, PickedPart
from anymesh.export.notation import quaternion, turning_x_to
from anymesh.types import Joint, JointType
from anymesh.viewer.panels import Page, offer, scale_of, selection
from anymesh.viewer.session import Hit, Session

NONE = "-"  # in dropdown lists
QUIET = "gray"  # colour of buttons that are not the expected next step
GIZMO = 0.25  # size of the handles, as a share of the diagonal


class CorrectPanel:
    """Controls for corrections, which follow the selection. Lists act when changed, numbers when their button is pressed."""

    def __init__(self, page: Page, tab: Any) -> None:
        self._page, gui = page, page.gui
        with tab:
            self._part = gui.add_dropdown("Part", (NONE,))
            self._description = gui.add_html("")
            self._joint_folder = gui.add_folder("Joint")
            self._part_folder = gui.add_folder("Part")
        self._on(self._part, lambda: page.select(None if self._part.value == NONE else self._part.value))
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
        self._joint_folder.visible = joint is not None
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

    def _set_limits(self) -> None:
        name, session = self._name(), self._page.session
        joint = None if session is None else session.joint()
        if joint is None:
            raise CorrectionError(f"{name!r} is the root, which has no joint")
        scale, _ = scale_of(joint)
        self._page.correct(SetLimits(name, self._low.value / scale, self._high.value / scale))


class Snap(StrEnum):
    """What the next click on the mesh snaps the axis to."""

    EDGE = "Edge"
    PLANE = "Plane"
    ROUND = "Round"


SNAP_HINTS = {
    Snap.EDGE: "Click near an edge: the axis goes along it. Esc leaves.",
    Snap.PLANE: "Click a flat face: the axis goes along its normal. Esc leaves.",
    Snap.ROUND: "Click a round face: the axis becomes its own. Esc leaves.",
}


class CorrectionTools:
    """The folders "Axis" and "Faces" of the tab "Correct"."""

    def __init__(self, page: Page, tab: Any) -> None:
        self._page, gui = page, page.gui
        self._snap: Snap | None = None
        self._gizmo: Any = None
        with tab:
            self._axis_folder = gui.add_folder("Axis")
            self._face_folder = gui.add_folder("Chosen faces", visible=False)
        with self._axis_folder:
            self._snaps = gui.add_button_group("Snap to", tuple(Snap))
            self._drag = gui.add_checkbox("Drag the axis", False)
        with self._face_folder:
            self._into = gui.add_dropdown("Move to", (NONE,))
            self._move = gui.add_button("Move faces", color=QUIET)
        self._snaps.on_click(lambda event: page.act(lambda: self._take(Snap(event.target.value))))
        self._drag.on_update(lambda event: page.act(page.refresh) if event.client is not None else None)
        self._move.on_click(lambda _: page.act(self._move_faces))

    @property
    def hint(self) -> str:
        """Hint for the current tool, "" if there is none."""
        return "" if self._snap is None else SNAP_HINTS[self._snap]

    def leave(self) -> bool:
        """Leave the current tool; return False if there was none."""
        busy = self._snap is not None or self._drag.value
        self._snap, self._drag.value = None, False
        return busy

    def refresh(self, session: Session) -> None:
        """Update the tools for the selection."""
        joint = session.joint()
        self._axis_folder.visible = joint is not None
        self._face_folder.visible = len(session.chosen) > 0
        offer(self._into, (NONE, *(p.name for p in session.asset.segmentation.parts)), self._into.value)
        if self._gizmo is not None:
            self._gizmo.remove()
            self._gizmo = None
        if joint is not None and self._drag.value:
            self._add_gizmo(session, joint)

    def _take(self, snap: Snap) -> None:
        self._snap = snap
        self._page.tell_head()

    def takes(self, hit: Hit | None) -> bool:
        """Snap the axis to what was clicked, if that was asked for; return whether it was."""
        session, snap = self._page.session, self._snap
        if snap is None or session is None:
            return False
        if hit is not None and session.selected is not None:
            line = _line(snap, PickedPart(session.asset, hit.face), hit.point)
            self._snap = None
            joint = session.joint()
            axis = line.axis if joint is None or line.axis @ joint.axis >= 0 else -line.axis  # keep the opening direction
            self._page.correct(SetAxis(session.selected, vector(axis), vector(line.origin), line.how))
        return True

    def _move_faces(self) -> None:
        if self._page.session is not None:
            self._page.correct(MoveFaces(FaceSet.of(self._page.session.chosen), self._into.value))

    def _add_gizmo(self, session: Session, joint: Joint) -> None:
        """Show handles at the joint, with its axis as the red arrow; releasing them makes a correction."""
        self._gizmo = self._page.server.scene.add_transform_controls(
            "/gizmo", scale=GIZMO * session.asset.mesh.diagonal, depth_test=False,
            wxyz=quaternion(turning_x_to(joint.axis)), position=joint.origin,
        )  # fmt: skip

        def let_go(event: Any) -> None:
            w, x, y, z = event.target.wxyz
            axis = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
            c = SetAxis(joint.child, vector(axis), vector(np.asarray(event.target.position)), "dragged")
            self._page.act(lambda: self._page.correct(c))

        self._gizmo.on_drag_end(let_go)


def _line(snap: Snap, picked: PickedPart, point: np.ndarray) -> Line:
    if snap is Snap.EDGE:
        return picked.edge(point)
    return picked.normal(point) if snap is Snap.PLANE else picked.symmetry()
