"""Content of asset.json; its schema is `asset.schema.json` beside this file."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from importlib.resources import files
from typing import Any

import numpy as np

import anymesh
from anymesh.entry_points import PROBABILITY, resolve
from anymesh.export.formats import main_file
from anymesh.export.model import ExportLink, Model, SubstanceShare, faces_path
from anymesh.export.options import Format
from anymesh.physics.mechanism import HandleFrame, Mechanism
from anymesh.physics.resistance import Resistance
from anymesh.rendering.viewpoints import away
from anymesh.types import Asset, Exchange, Joint, Loop, ProposedJoint, Source

SCHEMA_VERSION = "1.4"
STATED = ("name", "density", "static_friction", "dynamic_friction", "restitution")  # of substances
TIMING_FILE = "timing.json"  # separate, so that everything else is the same in every run


def asset_record(model: Model) -> dict[str, Any]:
    """Return the content of asset.json as plain values."""
    asset, states = model.asset, model.states
    return {
        "schema_version": SCHEMA_VERSION,
        "generator": {"name": "articulate-anymesh", "version": anymesh.__version__},
        "name": asset.name,
        **({"category": asset.category} if asset.category else {}),
        **({} if asset.front is None else {"front": away(np.deg2rad(asset.front), 0.0).round(6).tolist()}),
        "source": source_record(asset.source),
        **model.how.record(),
        "files": {str(kind): main_file(kind, asset.name) for kind in model.how.formats},
        "mass": _round(sum(body.inertia.mass for body in model.bodies)),
        "mass_range": [_round(sum(b.inertia.mass * b.inertia.spread[k] for b in model.bodies)) for k in (0, 1)],
        "parts": [_part(asset, body) for body in model.bodies],
        "joints": [_joint(model, joint) for joint in asset.joints],
        **({"loops": [_loop(loop) for loop in asset.loops]} if asset.loops else {}),
        **({"proposals": [_proposal(asset, p) for p in asset.proposals]} if model.how.precision else {}),
        **({"states": {name: {j: _round(v) for j, v in at.items()} for name, at in states.items()}} if states else {}),
        **({"places": [p.record() for p in model.places]} if model.places else {}),
        "no_contact": [{"links": [e.a, e.b], "reason": e.why} for e in model.exclusions],
        "answerer": asset.answerer,
        "usage": usage(asset.exchanges),
        "finish": list(asset.notes),
        "warnings": list(asset.warnings),
        "timing": TIMING_FILE,
    }


def source_record(source: Source) -> dict[str, Any]:
    """Return where a mesh came from as plain values."""
    place = {"T_asset_source": source.T_asset_source.tolist(), "up": source.up}
    notes = {"notes": list(source.notes)} | ({"credits": dict(source.credits)} if source.credits else {})
    return {"path": source.path, "sha256": source.sha256, **place, **notes}


def usage(exchanges: Sequence[Exchange]) -> dict[str, Any]:
    """Return the usage of a model: calls (and those from a cache or a recording), tokens, and dollars paid."""
    exchanges = [e for e in exchanges if not e.skipped]
    costs = [e.cost for e in exchanges if not e.cached]
    return {
        "calls": len(exchanges),
        "cached_calls": sum(e.cached for e in exchanges),
        "input_tokens": sum(e.input_tokens for e in exchanges),
        "output_tokens": sum(e.output_tokens for e in exchanges),
        "cost_usd": None if None in costs else _round(sum((c for c in costs if c is not None), 0.0)),
    }


def schema() -> dict[str, Any]:
    """Return the JSON schema (2020-12) of asset.json."""
    return json.loads(files("anymesh.export").joinpath("asset.schema.json").read_text(encoding="utf-8"))


def json_text(record: Mapping[str, Any]) -> str:
    """Return indented ASCII JSON with a final newline."""
    return json.dumps(record, indent=2, allow_nan=False) + "\n"


def _part(asset: Asset, body: ExportLink) -> dict[str, Any]:
    link, shapes = body.link, [type(shape).__name__.lower() for shape in body.shapes]
    of_source = len(asset.source_faces(link.faces))
    return {
        "name": link.name,
        "label": link.part.label,
        "parent": None if link.joint is None else link.joint.parent,
        "area": _round(asset.mesh.face_areas[link.faces].sum()),
        "mass": _round(body.inertia.mass),
        "mass_range": [_round(body.inertia.mass * factor) for factor in body.inertia.spread],
        **({"wall": _round(body.inertia.wall)} if body.inertia.wall else {}),
        "substances": [_substance(share) for share in body.substances],
        "face_count": of_source,
        "faces": faces_path(body.name),
        "new_faces": len(link.faces) - of_source,
        "collision": {kind: shapes.count(kind) for kind in ("box", "cylinder", "hull") if kind in shapes},
        **({} if body.openings is None else {"openings": _round(body.openings)}),
        "confidence": _round(link.part.confidence),
        "reason": link.part.reason,
    }


def _substance(share: SubstanceShare) -> dict[str, Any]:
    known = {} if share.substance is None else {key: v for key, v in asdict(share.substance).items() if key in STATED}
    return {"name": None, "source": share.source, "share": _round(share.share)} | known


def _joint(model: Model, joint: Joint) -> dict[str, Any]:
    resistance, mechanism = model.resistances.get(joint.name), model.mechanisms.get(joint.name)
    handle = next((h for h in model.handles if h.joint == joint.name), None)
    return {
        **_motion(joint),
        **({} if resistance is None else _resistance(resistance)),
        **({} if mechanism is None else {"mechanism": _mechanism(mechanism, model.how.formats)}),
        **({} if handle is None else {"handle": _handle(model.asset, handle)}),
        **_certainty(joint),
        "probability": _round(resolve(PROBABILITY)(model.asset.segmentation.parts, joint)),
    }


def _motion(joint: Joint) -> dict[str, Any]:
    axis = {"origin": [_round(v) for v in joint.origin], "axis": [_round(v) for v in joint.axis]}
    limits = None if joint.limits is None else [_round(v) for v in joint.limits]
    links = {"parent": joint.parent, "child": joint.child}
    more: dict[str, Any] = {"pitch": _round(joint.pitch)} if joint.pitch else {}
    if (m := joint.mimic) is not None:
        more |= {"mimic": {"joint": m.joint, "ratio": _round(m.ratio), "offset": _round(m.offset)}}
    return {"name": joint.name, "type": str(joint.type), **links, **axis, "limits": limits, **more}


def _loop(loop: Loop) -> dict[str, Any]:
    place = {"origin": [_round(v) for v in loop.origin], "axis": [_round(v) for v in loop.axis]}
    return {"name": loop.name, "type": str(loop.kind), "links": [loop.first, loop.second], **place}


def _certainty(joint: Joint) -> dict[str, Any]:
    """Return confidence and reason, and the weighted articulations where there are several: the joint's own first."""
    every = [_motion(way) | {"weight": _round(way.confidence)} for way in (joint, *joint.others)]
    ways = [{k: way[k] for k in ("weight", "type", "origin", "axis", "limits", "pitch") if k in way} for way in every]
    articulations = {"articulations": ways} if joint.others else {}
    return {"confidence": _round(joint.confidence), "reason": joint.reason, **articulations}


def _proposal(asset: Asset, proposal: ProposedJoint) -> dict[str, Any]:
    part, faces = proposal.part, asset.source_faces(proposal.faces)
    return {
        "label": part.label, **_motion(proposal.joint), **_certainty(proposal.joint), "motion": proposal.motion,
        "part_confidence": _round(part.confidence), "part_reason": part.reason, "probability": _round(proposal.probability),
        "face_count": len(faces), "faces": faces_path(part.name),
    }  # fmt: skip


def _resistance(r: Resistance) -> dict[str, Any]:
    numbers = {"typical": r.pull.typical, "least": r.pull.least, "most": r.pull.most}
    vectors = {"at": r.pull.at, "direction": r.pull.direction}
    pull = {name: _round(v) for name, v in numbers.items()} | {name: [_round(v) for v in vs] for name, vs in vectors.items()}
    least, most = (_round(v) for v in r.friction_range)
    return {
        "effort": _round(r.effort), "velocity": _round(r.velocity), "damping": _round(r.damping),
        "friction": _round(r.friction), "friction_range": [least, most], "armature": _round(r.armature),
        "pull": {"unit": r.pull.unit, **pull}, "resistance": r.source,
    }  # fmt: skip


def _mechanism(m: Mechanism, formats: Sequence[Format]) -> dict[str, Any]:
    """Return a mechanism, with the formats that hold it; numbers that are 0 are left out."""
    numbers = {name: value for name, value in asdict(m).items() if name not in ("kind", "reason")}
    catches = bool(m.slope or m.torque)
    held = {Format.MJCF} if catches else {*Format} - {Format.URDF if m.stiffness else Format.GLB}
    values = {name: _round(value) for name, value in numbers.items() if value or (name == "reference" and m.stiffness)}
    values |= {"steps": m.steps} if m.steps else {}
    return {"kind": str(m.kind), **values, "formats": [str(f) for f in formats if f in held], "reason": m.reason}


def _handle(asset: Asset, h: HandleFrame) -> dict[str, Any]:
    """Return a handle; its vectors are in the asset frame at rest."""
    vectors = {"place": h.place, "approach": h.R[:, 2], "closing": h.R[:, 1]}
    sizes = dict(zip(("length", "width", "depth"), map(_round, h.size), strict=True))
    places = {key: [_round(v) for v in vector] for key, vector in vectors.items()}
    faces = {"face_count": len(asset.source_faces(h.faces)), "faces": faces_path(h.name)}
    return {"name": h.name, "link": h.link, **places, **sizes, **faces}


def _round(value: float) -> float:
    """Round to ten significant digits, as in the URDF; -0 becomes 0."""
    return 0.0 if abs(value) < 1e-12 else float(f"{float(value):.10g}")
