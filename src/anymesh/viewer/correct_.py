"""The tab "Correct" of the live page: the selected part, its corrections, and the mesh tools.

The tools select by click, snap an axis, drag it, and choose faces.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from typing import Any

import numpy as np

from anymesh.correcting import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    CorrectionError,
    FaceSet,
    FlipSign,
    MergeParts,
    MoveFaces,
    Relabel,
    SetAxis,
    SetLimits,
    SplitComponents,
    SplitPart,
)
from anymesh.correcting.corrections import vector
from anymesh.correcting.picking import Line, PickedPart
from anymesh.export.notation import quaternion, turning_x_to
from anymesh.types import Joint, JointType
from anymesh.viewer.panels import Page, distinct, offer, scale_of, selection, shortened
from anymesh.viewer.scene_ import ray_through
from anymesh.viewer.session import Hit, Session

NONE = "-"  # in dropdown lists
FIND = "Find other motions"
NOT_FOUND_YET = "find them first"
QUIET = "gray"  # colour of buttons that are not the expected next step
GIZMO = 0.25  # size of the handles, as a share of the diagonal


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


class Tool(StrEnum):
    """Action of the next click on the mesh."""

    SELECT = "Select"
    EDGE = "Edge"
    PLANE = "Plane"
    ROUND = "Round"
    PATCH = "Patch"
    BRUSH = "Brush"


TOOL_HINTS = {
    Tool.EDGE: "Click near an edge: the axis goes along it. Esc leaves.",
    Tool.PLANE: "Click a flat face: the axis goes along its normal. Esc leaves.",
    Tool.ROUND: "Click a round face: the axis becomes its own. Esc leaves.",
    Tool.PATCH: "Click patches to choose their faces, again to deselect. Esc leaves.",
    Tool.BRUSH: "Hold Shift and drag over faces to choose what is seen. Esc leaves.",
}
SNAPS, BRUSHES = (Tool.EDGE, Tool.PLANE, Tool.ROUND), (Tool.PATCH, Tool.BRUSH)


class CorrectionTools:
    """The folders "Axis" and "Faces" of the tab "Correct", and the handling of clicks."""

    def __init__(self, page: Page, tab: Any) -> None:
        self._page, gui = page, page.gui
        self._tool = Tool.SELECT
        self._gizmo: Any = None
        with tab:
            self._axis_folder = gui.add_folder("Axis", expand_by_default=False)
            self._face_folder = gui.add_folder("Faces", expand_by_default=False)
        with self._axis_folder:
            self._snap = gui.add_button_group("Snap to", tuple(SNAPS))
            self._drag = gui.add_checkbox("Drag the axis", False)
        with self._face_folder:
            self._choose = gui.add_button_group("Choose by", tuple(BRUSHES))
            self._count = gui.add_text("Chosen", "no faces", disabled=True)
            self._into = gui.add_dropdown("Move to", (NONE,))
            self._move = gui.add_button("Move faces", color="gray")
            self._name = gui.add_text("New part", "part")
            self._make = gui.add_button("Make them a part", color="gray")
        for group in (self._snap, self._choose):
            group.on_click(lambda event: page.act(lambda: self._take(Tool(event.target.value))))
        self._drag.on_update(lambda event: page.act(page.refresh) if event.client is not None else None)
        self._move.on_click(lambda _: page.act(self._move_faces))
        self._make.on_click(lambda _: page.act(self._make_part))
        page.server.scene.on_click()(lambda event: page.act(lambda: self._clicked(event)))
        page.server.scene.on_rect_select(modifier="shift")(lambda event: page.act(lambda: self._brushed(event)))

    @property
    def hint(self) -> str:
        """Hint for the current tool, "" if there is none."""
        return TOOL_HINTS.get(self._tool, "")

    def leave(self) -> bool:
        """Leave the current tool; return False if there was none."""
        busy = self._tool is not Tool.SELECT or self._drag.value
        self._tool, self._drag.value = Tool.SELECT, False
        return busy

    def refresh(self, session: Session) -> None:
        """Update the tools for the selection."""
        joint = session.joint()
        self._axis_folder.visible = joint is not None
        self._count.value = f"{len(session.chosen):,} faces"
        offer(self._into, (NONE, *(p.name for p in session.asset.segmentation.parts)), self._into.value)
        if self._gizmo is not None:
            self._gizmo.remove()
            self._gizmo = None
        if joint is not None and self._drag.value:
            self._add_gizmo(session, joint)

    def _take(self, tool: Tool) -> None:
        self._tool = tool
        self._page.tell_head()

    def _clicked(self, event: Any) -> None:
        session = self._page.session
        if session is None:
            return
        hit = session.hit(np.array(event.ray_origin), np.array(event.ray_direction))
        if self._tool in SNAPS:
            if hit is not None and session.selected is not None:
                self._snap_to(session, session.selected, hit)
        elif self._tool is Tool.PATCH:
            if hit is not None:
                patch = PickedPart(session.asset, hit.face).patch()
                again = np.isin(patch, session.chosen).all()
                self._choose_faces(session, np.setdiff1d(session.chosen, patch) if again else np.union1d(session.chosen, patch))
        else:
            self._page.select(None if hit is None else session.asset.segmentation.parts[hit.part].name)

    def _snap_to(self, session: Session, part: str, hit: Hit) -> None:
        line = _line(self._tool, PickedPart(session.asset, hit.face), hit.point)
        self._tool = Tool.SELECT
        joint = session.joint()
        axis = line.axis if joint is None or line.axis @ joint.axis >= 0 else -line.axis  # keep the opening direction
        self._page.correct(SetAxis(part, vector(axis), vector(line.origin), line.how))

    def _brushed(self, event: Any) -> None:
        session = self._page.session
        if session is None or self._tool is not Tool.BRUSH:
            return
        (x0, y0), (x1, y1) = event.screen_min, event.screen_max
        camera = event.client.camera
        across, down = (
            max(2, round(abs(b - a) * n)) for a, b, n in ((x0, x1, camera.image_width), (y0, y1, camera.image_height))
        )
        x, y = np.meshgrid(np.linspace(x0, x1, across), np.linspace(y0, y1, down))
        eye, ways = ray_through(camera, x.reshape(-1), y.reshape(-1))
        seen = session.hits(np.tile(eye, (len(ways), 1)), ways)
        faces = np.unique([h.face for h in seen if h is not None and session.selected in (None, self._part_of(session, h))])
        self._choose_faces(session, np.union1d(session.chosen, faces.astype(np.int64)))

    def _part_of(self, session: Session, hit: Hit) -> str:
        return session.asset.segmentation.parts[hit.part].name

    def _choose_faces(self, session: Session, faces: np.ndarray) -> None:
        session.chosen = faces
        self._count.value = f"{len(faces):,} faces"
        self._page.view.mark(session.selected, faces)

    def _move_faces(self) -> None:
        if self._page.session is not None:
            self._page.correct(MoveFaces(FaceSet.of(self._page.session.chosen), self._into.value))

    def _make_part(self) -> None:
        session = self._page.session
        if session is not None:
            of = session.asset.segmentation.face_part[session.chosen]
            part = session.selected or session.asset.segmentation.parts[int(of[0]) if len(of) else 0].name
            self._page.correct(SplitPart(part, FaceSet.of(session.chosen), self._name.value))

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


def _line(tool: Tool, picked: PickedPart, point: np.ndarray) -> Line:
    if tool is Tool.EDGE:
        return picked.edge(point)
    return picked.normal(point) if tool is Tool.PLANE else picked.symmetry()
