"""The example objects: parts as solids, and the truth of every joint [m, Z up, front at -Y]."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from solids import bar_handle, box, cut, join, knob, ring, rod, tray, tube, turned
from trimesh import Trimesh


@dataclass
class Truth:
    """A joint: positive opens. limits None: continuous. A kind "revolute" without limits is continuous."""

    type: str
    origin: tuple[float, float, float]
    axis: tuple[float, float, float]
    limits: tuple[float, float] | None
    parent: str = "base"
    label: str = ""


@dataclass
class Thing:
    """An object: (part, solid, colour) pieces, and the joint of every part but the base."""

    name: str
    category: str
    pieces: list[tuple[str, Trimesh, str]] = field(default_factory=list)
    joints: dict[str, Truth] = field(default_factory=dict)
    fused: bool = False

    def add(self, part: str, *solids: Trimesh, color: str = "body") -> None:
        self.pieces += [(part, s, color) for s in solids]


def hinge(origin, axis, degrees, label="door", parent="base") -> Truth:
    low, high = degrees if isinstance(degrees, tuple) else (0, degrees)
    return Truth("revolute", origin, axis, (float(np.deg2rad(low)), float(np.deg2rad(high))), parent, label)


def slide(axis, limits, label="drawer", parent="base", origin=(0.0, 0.0, 0.0)) -> Truth:
    return Truth("prismatic", origin, axis, limits, parent, label)


def spin(origin, axis, label="knob", parent="base") -> Truth:
    return Truth("continuous", origin, axis, None, parent, label)


def microwave(fused: bool = False) -> Thing:
    t = Thing("microwave", "microwave", fused=fused)
    shell = cut(box((-0.25, 0.25), (-0.18, 0.18), (0.01, 0.3)), box((-0.22, 0.11), (-0.19, 0.15), (0.035, 0.275)))
    t.add("base", shell, *(rod("z", 0.015, 0.012, (x, y, 0.006)) for x in (-0.2, 0.2) for y in (-0.13, 0.13)))
    t.add("base", box((0.125, 0.248), (-0.2, -0.178), (0.012, 0.298)), color="panel")
    t.add("base", box((0.15, 0.23), (-0.203, -0.199), (0.23, 0.28)), color="dark")
    back = -0.172 if fused else -0.182
    leaf = box((-0.248, 0.119), (-0.204, back), (0.012, 0.298))
    if not fused:
        leaf = cut(leaf, box((-0.21, 0.07), (-0.21, -0.17), (0.05, 0.26)))
        t.add("door", box((-0.212, 0.072), (-0.196, -0.19), (0.048, 0.262)), color="glass")
        t.add("turntable", rod("z", 0.13, 0.008, (-0.055, -0.02, 0.042), 48), color="glass")
    t.add("door", leaf, color="panel")
    t.add("door", bar_handle((0.088, 0.102), (0.06, 0.25), -0.203), color="metal")
    t.joints["door"] = hinge((-0.248, -0.182, 0.15), (0, 0, -1), 110)
    if not fused:
        t.add("knob", knob((0.187, 0.08), -0.2, 0.022, 0.028), color="metal")
        t.joints["knob"] = spin((0.187, -0.21, 0.08), (0, -1, 0))
        t.joints["turntable"] = spin((-0.055, -0.02, 0.042), (0, 0, 1), "turntable")
    return t


def cabinet(fused: bool = False, name: str = "cabinet") -> Thing:
    t = Thing(name, "cabinet", fused=fused)
    w, d, h, b = 0.45, 0.25, 0.8, 0.018
    t.add("base", box((-w, -w + b), (-d, d), (0.05, h)), box((w - b, w), (-d, d), (0.05, h)))
    t.add("base", box((-w, w), (-d, d), (h, h + b)), box((-w, w), (-d, d), (0.05, 0.05 + b)))
    t.add("base", box((-w, w), (d - 0.006, d), (0.05, h)), box((-0.009, 0.009), (-d, d - 0.006), (0.068, h)))
    t.add("base", box((-w + b, -0.009), (-d + 0.03, d - 0.006), (0.4, 0.415)))
    t.add("base", *(box((x - 0.02, x + 0.02), (y - 0.02, y + 0.02), (0, 0.051)) for x in (-0.4, 0.4) for y in (-0.2, 0.2)))
    if fused:
        t.add("base", box((-w + 0.005, w - 0.005), (-d + 0.03, d), (0.055, h + 0.005)))
    back = -d + 0.012 if fused else -d - 0.001
    for k, x in enumerate(((-w + 0.002, -0.228), (-0.224, -0.002))):
        handle = (x[1] - 0.03, x[1] - 0.018) if k == 0 else (x[0] + 0.018, x[0] + 0.03)
        part, hinge_x, sign = f"door_{k + 1}", (x[0], x[1])[k], (-1, 1)[k]
        t.add(part, box(x, (-d - 0.019, back), (0.054, 0.796)), color="wood")
        t.add(part, bar_handle(handle, (0.4, 0.56), -d - 0.018), color="metal")
        t.joints[part] = hinge((hinge_x, -d - 0.001, 0.42), (0, 0, sign), 110)
    for k in range(3):
        z = (0.054 + k * 0.249, 0.054 + k * 0.249 + 0.245)
        part = f"drawer_{k + 1}"
        t.add(part, box((0.002, w - 0.002), (-d - 0.019, back), z), color="wood")
        t.add(part, bar_handle((0.15, 0.3), (z[0] + 0.16, z[0] + 0.172), -d - 0.018), color="metal")
        if not fused:
            inner = (max(z[0] + 0.02, 0.075), z[1] - 0.05)
            t.add(part, tray((0.014, w - b - 0.006), (-d - 0.002, d - 0.03), inner, 0.01), color="wood")
        t.joints[part] = slide((0, -1, 0), (0.0, 0.4))
    return t


def named_cabinet() -> Thing:
    t = cabinet(name="named_cabinet")
    names = {"door_1": "door_left", "door_2": "door_right", "drawer_1": "drawer_bottom", "drawer_2": "drawer_middle",
             "drawer_3": "drawer_top"}  # fmt: skip
    t.pieces = [(names.get(p, p), s, c) for p, s, c in t.pieces]
    t.joints = {names[p]: j for p, j in t.joints.items()}
    return t


def laptop(fused: bool = False) -> Thing:
    t = Thing("laptop", "laptop", fused=fused)
    t.add("base", box((-0.16, 0.16), (-0.11, 0.11), (0, 0.014)), color="metal")
    t.add("base", box((-0.14, 0.14), (-0.02, 0.085), (0.0135, 0.0165)), color="dark")
    t.add("base", box((-0.05, 0.05), (-0.095, -0.035), (0.0135, 0.0145)), color="dark")
    axis = (0.0, 0.116, 0.014)
    t.add("base", *(rod("x", 0.006, 0.05, (x, *axis[1:]), 24) for x in (-0.1, 0.1)), color="dark")
    lid = box((-0.16, 0.16), (-0.112, 0.113 if fused else 0.1085), (0.0165, 0.0225))
    glass = box((-0.15, 0.15), (-0.1, 0.09), (0.0158, 0.0168))
    arms = [box((x - 0.02, x + 0.02), (0.1, 0.116), (0.0145, 0.0215)) for x in (-0.1, 0.1)]
    for solid, color in ((lid, "metal"), (glass, "dark"), *((a, "metal") for a in arms)):
        t.add("lid", turned(solid, (-1, 0, 0), 105, axis), color=color)
    t.joints["lid"] = hinge(axis, (-1, 0, 0), (-100, 60), "lid")
    return t


def bucket() -> Thing:
    t = Thing("bucket", "bucket")
    outer = rod("z", 0.14, 0.28, (0, 0, 0.14), 48)
    t.add("base", cut(outer, rod("z", 0.136, 0.28, (0, 0, 0.146), 48)))
    t.add("base", ring("z", 0.141, 0.004, (0, 0, 0.277)))
    t.add("base", *(rod("x", 0.014, 0.008, (s * 0.143, 0, 0.25), 24) for s in (-1, 1)))
    t.add("base", *(rod("x", 0.004, 0.014, (s * 0.152, 0, 0.25), 16) for s in (-1, 1)))
    a = np.linspace(0, np.pi, 41)
    path = np.c_[0.156 * np.cos(a), 0 * a, 0.25 + 0.17 * np.sin(a)]
    bow = tube(path, 0.0035)
    eyes = [
        cut(rod("x", 0.009, 0.005, (s * 0.156, 0, 0.25), 24), rod("x", 0.0048, 0.02, (s * 0.156, 0, 0.25), 24)) for s in (-1, 1)
    ]
    clear = [rod("x", 0.0075, 0.03, (s * 0.156, 0, 0.25), 24) for s in (-1, 1)]
    t.add("handle", cut(bow, *clear), *eyes, color="metal")
    t.add("handle", rod("x", 0.009, 0.1, (0, 0, 0.42), 24), color="wood")
    t.joints["handle"] = hinge((0, 0, 0.25), (1, 0, 0), (-90, 90), "handle")
    return t


def drill() -> Thing:
    t = Thing("drill", "drill")
    grip = cut(box((-0.018, 0.018), (0.0, 0.045), (0.03, 0.15)), box((-0.009, 0.009), (-0.01, 0.025), (0.1, 0.136)))
    body = rod("y", 0.03, 0.15, (0, 0.02, 0.17), 40)
    t.add("base", body, grip, box((-0.03, 0.03), (-0.02, 0.07), (0, 0.031)))
    t.add("trigger", cut(box((-0.0075, 0.0075), (-0.012, 0.014), (0.102, 0.134)), rod("x", 0.011, 0.1, (0, -0.018, 0.118), 24)),
          color="dark")  # fmt: skip
    t.joints["trigger"] = slide((0, -1, 0), (-0.01, 0.0), "trigger")
    chuck = join(rod("y", 0.019, 0.03, (0, -0.0715, 0.17), 32), rod("y", 0.013, 0.02, (0, -0.095, 0.17), 32))
    t.add("chuck", chuck, rod("y", 0.003, 0.07, (0, -0.135, 0.17), 16), color="metal")
    t.joints["chuck"] = spin((0, -0.08, 0.17), (0, -1, 0), "chuck")
    return t


def toy_car() -> Thing:
    t = Thing("toy_car", "car")
    lower = cut(box((-0.075, 0.075), (-0.2, 0.2), (0.03, 0.1)), box((-0.065, 0.065), (-0.08, 0.1), (0.045, 0.11)))
    for y in (-0.125, 0.125):
        lower = cut(lower, rod("x", 0.042, 0.2, (0, y, 0.035), 40))
    cab = cut(box((-0.07, 0.07), (-0.085, 0.105), (0.095, 0.16)), box((-0.062, 0.062), (-0.078, 0.098), (0.08, 0.152)))
    opening = box((-0.1, 0.1), (-0.06, 0.03), (0.05, 0.145))
    t.add("base", cut(lower, opening), cut(cab, opening, box((-0.05, 0.05), (-0.1, 0.12), (0.11, 0.145))))
    t.add("base", box((-0.062, -0.012), (0.02, 0.08), (0.045, 0.07)), box((0.012, 0.062), (0.02, 0.08), (0.045, 0.07)),
          color="dark")  # fmt: skip
    t.add("base", *(rod("x", 0.006, 0.13, (0, y, 0.035), 16) for y in (-0.125, 0.125)), color="metal")
    for k, (x, y) in enumerate((a, b) for a in (-1, 1) for b in (-0.125, 0.125)):
        tyre = cut(rod("x", 0.035, 0.022, (x * 0.082, y, 0.035), 40), rod("x", 0.0072, 0.1, (x * 0.082, y, 0.035), 24))
        t.add(f"wheel_{k + 1}", tyre, color="dark")
        t.joints[f"wheel_{k + 1}"] = spin((x * 0.082, y, 0.035), (1, 0, 0), "wheel")
    column = turned(rod("z", 0.003, 0.05, (-0.035, -0.03, 0.09), 16), (1, 0, 0), 35, (-0.035, -0.03, 0.09))
    t.add("steering_wheel", column, color="dark")
    at = np.array([-0.035, -0.03, 0.09]) + 0.025 * np.array([0, -np.sin(np.deg2rad(35)), np.cos(np.deg2rad(35))])
    at[1] = -0.03 - 0.025 * np.sin(np.deg2rad(35))
    wheel = [ring("z", 0.018, 0.0025, (0, 0, 0)), box((-0.018, 0.018), (-0.002, 0.002), (-0.0015, 0.0015)),
             box((-0.002, 0.002), (0, 0.018), (-0.0015, 0.0015))]  # fmt: skip
    for solid in wheel:
        solid = turned(solid, (1, 0, 0), 35, (0, 0, 0))
        solid.apply_translation(at)
        t.add("steering_wheel", solid, color="dark")
    t.joints["steering_wheel"] = spin(tuple(at), (0, -np.sin(np.deg2rad(35)), np.cos(np.deg2rad(35))), "wheel")
    for k, s in enumerate((-1, 1)):
        x = tuple(sorted((s * 0.069, s * 0.0755)))
        leaf = cut(box(x, (-0.0585, 0.0285), (0.052, 0.1435)), box((-0.2, 0.2), (-0.048, 0.018), (0.105, 0.136)))
        t.add(f"door_{k + 1}", leaf, box(tuple(sorted((s * 0.0715, s * 0.0735))), (-0.049, 0.019), (0.104, 0.137)))
        t.add(f"door_{k + 1}", box(tuple(sorted((s * 0.0745, s * 0.08))), (0.006, 0.022), (0.088, 0.093)), color="metal")
        t.joints[f"door_{k + 1}"] = hinge((s * 0.0755, -0.0585, 0.1), (0, 0, -float(s)), 70)
    return t


def sliding_window() -> Thing:
    t = Thing("sliding_window", "window")
    frame = cut(box((-0.5, 0.5), (-0.05, 0.05), (0, 1)), box((-0.45, 0.45), (-0.06, 0.06), (0.05, 0.95)))
    tracks = [box((-0.47, 0.47), y, (0.03, 0.97)) for y in ((-0.035, -0.005), (0.005, 0.035))]
    t.add("base", cut(frame, *tracks))
    for part, x, y in (("base", (-0.02, 0.47), (0.005, 0.035)), ("sash", (-0.468, 0.02), (-0.033, -0.007))):
        z = (0.03, 0.97) if part == "base" else (0.032, 0.968)
        t.add(part, cut(box(x, y, z), box((x[0] + 0.06, x[1] - 0.06), (-1, 1), (0.09, 0.91))))
        middle = (y[0] + y[1]) / 2
        t.add(part, box((x[0] + 0.059, x[1] - 0.059), (middle - 0.002, middle + 0.002), (0.089, 0.911)), color="glass")
    t.joints["sash"] = slide((1, 0, 0), (0.0, 0.43), "sash")
    return t


def toaster() -> Thing:
    t = Thing("toaster", "toaster")
    body = cut(box((-0.14, 0.14), (-0.08, 0.08), (0.01, 0.19)), box((-0.11, 0.11), (-0.05, -0.015), (0.06, 0.2)),
               box((-0.11, 0.11), (0.015, 0.05), (0.06, 0.2)), box((0.125, 0.15), (-0.006, 0.006), (0.05, 0.16)))  # fmt: skip
    t.add("base", body, *(rod("z", 0.012, 0.012, (x, y, 0.006), 24) for x in (-0.11, 0.11) for y in (-0.05, 0.05)))
    lever = join(box((0.128, 0.15), (-0.0045, 0.0045), (0.14, 0.152)), box((0.143, 0.165), (-0.02, 0.02), (0.138, 0.154)))
    t.add("lever", lever, color="dark")
    t.joints["lever"] = slide((0, 0, -1), (0.0, 0.085), "lever")
    dial = turned(knob((0.0, 0.0), 0.0, 0.016, 0.02), (0, 0, 1), 90, (0, 0, 0))
    dial.apply_translation((0.14, 0.045, 0.06))
    t.add("knob", dial, color="dark")
    t.joints["knob"] = spin((0.15, 0.045, 0.06), (1, 0, 0))
    return t


def stove(fused: bool = False) -> Thing:
    t = Thing("stove", "oven", fused=fused)
    body = box((-0.3, 0.3), (-0.3, 0.3), (0.05, 0.85))
    if not fused:
        body = cut(body, box((-0.25, 0.25), (-0.31, 0.25), (0.12, 0.62)))
    t.add("base", body, box((-0.3, 0.3), (-0.318, -0.299), (0.69, 0.849)))
    t.add("base", *(rod("z", 0.022, 0.052, (x, y, 0.025), 24) for x in (-0.25, 0.25) for y in (-0.25, 0.25)))
    t.add("base", *(rod("z", 0.085, 0.012, (x, y, 0.855), 40) for x in (-0.14, 0.14) for y in (-0.13, 0.14)), color="dark")
    t.add("door", box((-0.298, 0.298), (-0.325, -0.29 if fused else -0.3015), (0.09, 0.684)), color="dark")
    t.add("door", bar_handle((-0.24, 0.24), (0.625, 0.64), -0.324, 0.045), color="metal")
    t.joints["door"] = hinge((0, -0.3015, 0.09), (1, 0, 0), 90)
    for k, x in enumerate((-0.22, -0.08, 0.08, 0.22)):
        front = -0.318 + (0.002 if fused else 0)
        t.add(f"knob_{k + 1}", knob((x, 0.77), front, 0.024, 0.03), color="metal")
        t.joints[f"knob_{k + 1}"] = spin((x, -0.33, 0.77), (0, -1, 0))
    return t


def tilting_flap() -> Thing:
    t = Thing("tilting_flap", "bin")
    shell = cut(box((-0.16, 0.16), (-0.13, 0.13), (0, 0.5)), box((-0.15, 0.15), (-0.12, 0.12), (0.01, 0.6)))
    hood = cut(box((-0.165, 0.165), (-0.135, 0.135), (0.49, 0.68)), box((-0.155, 0.155), (-0.125, 0.125), (0.4, 0.67)))
    away = turned(box((-1, 1), (-1, -0.135), (0.3, 1.2)), (1, 0, 0), -20, (0, -0.135, 0.5))
    plate = turned(box((-0.165, 0.165), (-0.135, -0.123), (0.491, 0.67)), (1, 0, 0), -20, (0, -0.135, 0.5))
    hole = turned(box((-0.122, 0.122), (-0.2, 0.0), (0.52, 0.64)), (1, 0, 0), -20, (0, -0.135, 0.5))
    t.add("base", shell, cut(join(cut(hood, away), plate), hole))
    flap = turned(box((-0.12, 0.12), (-0.134, -0.126), (0.522, 0.638)), (1, 0, 0), -20, (0, -0.135, 0.5))
    t.add("flap", flap, color="dark")
    top = turned(box((-0.001, 0.001), (-0.131, -0.129), (0.637, 0.639)), (1, 0, 0), -20, (0, -0.135, 0.5)).centroid
    t.joints["flap"] = hinge(tuple(top), (-1, 0, 0), (-60, 60), "flap")
    return t


def tilted_drawer() -> Thing:
    t = Thing("tilted_drawer", "cabinet")
    about = (0.0, 0.0, 0.3)
    shell = cut(box((-0.2, 0.2), (-0.2, 0.2), (0.15, 0.45)), box((-0.18, 0.18), (-0.21, 0.18), (0.17, 0.43)))
    t.add("base", turned(shell, (1, 0, 0), -20, about), box((-0.15, 0.15), (-0.05, 0.05), (0, 0.15)))
    t.add("base", box((-0.22, 0.22), (-0.2, 0.2), (0, 0.02)))
    parts = [(box((-0.178, 0.178), (-0.2, -0.185), (0.172, 0.428)), "wood"),
             (tray((-0.17, 0.17), (-0.186, 0.16), (0.18, 0.4), 0.008), "wood"),
             (bar_handle((-0.07, 0.07), (0.33, 0.342), -0.199), "metal")]  # fmt: skip
    for solid, color in parts:
        t.add("drawer", turned(solid, (1, 0, 0), -20, about), color=color)
    a = np.deg2rad(20)
    t.joints["drawer"] = slide((0, -np.cos(a), np.sin(a)), (0.0, 0.32))
    return t


def fridge() -> Thing:
    t = Thing("fridge", "fridge")
    t.add("base", cut(box((-0.3, 0.3), (-0.28, 0.3), (0.03, 1.4)), box((-0.255, 0.255), (-0.29, 0.255), (0.08, 1.355))))
    t.add("base", *(rod("z", 0.02, 0.032, (x, y, 0.015), 24) for x in (-0.25, 0.25) for y in (-0.22, 0.25)), color="dark")
    t.add("base", *(box((-0.256, 0.256), (-0.2, 0.256), (z, z + 0.008)) for z in (0.95, 0.65, 0.33)), color="glass")
    for k, z in enumerate(((0.1, 0.29), (0.37, 0.56))):
        t.add(f"tray_{k + 1}", tray((-0.25, 0.25), (-0.23, 0.22), z, 0.006), color="glass")
        t.joints[f"tray_{k + 1}"] = slide((0, -1, 0), (0.0, 0.4), "tray")
    t.add("door", box((-0.298, 0.298), (-0.335, -0.282), (0.035, 1.395)))
    t.add(
        "door",
        box((-0.2, 0.2), (-0.283, -0.27), (0.5, 0.508)),
        box((-0.2, 0.2), (-0.283, -0.27), (0.9, 0.908)),
        color="glass",
    )
    t.add("door", bar_handle((-0.255, -0.24), (0.65, 1.1), -0.334, 0.05), color="metal")
    t.joints["door"] = hinge((0.298, -0.282, 0.7), (0, 0, 1), 110)
    t.add("knob", knob((-0.24, 0.5), -0.335, 0.02, 0.026), color="metal")
    t.joints["knob"] = spin((-0.24, -0.35, 0.5), (0, -1, 0), "knob", "door")
    return t


def storage_box() -> Thing:
    t = Thing("storage_box", "box")
    t.add("base", tray((-0.3, 0.3), (-0.2, 0.2), (0, 0.3), 0.01), color="wood")
    axis = (0.0, 0.206, 0.301)
    t.add("base", *(rod("x", 0.006, 0.06, (x, *axis[1:]), 24) for x in (-0.2, 0.2)), color="metal")
    t.add("lid", box((-0.305, 0.305), (-0.205, 0.199), (0.3015, 0.325)), color="wood")
    t.add("lid", box((-0.04, 0.04), (-0.22, -0.204), (0.302, 0.315)), color="metal")
    t.joints["lid"] = hinge(axis, (-1, 0, 0), 100, "lid")
    return t


def valve() -> Thing:
    t = Thing("valve", "valve")
    t.add(
        "base",
        rod("x", 0.03, 0.4, (0, 0, 0.03), 40),
        rod("z", 0.022, 0.08, (0, 0, 0.08), 32),
        rod("z", 0.008, 0.06, (0, 0, 0.14), 24),
    )
    hub = cut(rod("z", 0.02, 0.02, (0, 0, 0.16), 32), rod("z", 0.009, 0.1, (0, 0, 0.16), 24))
    spokes = [
        turned(box((0.016, 0.08), (-0.005, 0.005), (0.155, 0.165)), (0, 0, 1), a, (0, 0, 0)) for a in (0, 72, 144, 216, 288)
    ]
    t.add("wheel", ring("z", 0.08, 0.008, (0, 0, 0.16)), hub, *spokes, color="red")
    t.joints["wheel"] = spin((0, 0, 0.16), (0, 0, 1), "wheel")
    return t


def table() -> Thing:
    t = Thing("table", "table")
    t.add("base", box((-0.6, 0.6), (-0.4, 0.4), (0.72, 0.75)), color="wood")
    t.add("base", *(rod("z", 0.03, 0.721, (x, y, 0.36), 24) for x in (-0.53, 0.53) for y in (-0.33, 0.33)), color="wood")
    t.add("base", *(box((-0.53, 0.53), (y - 0.01, y + 0.01), (0.63, 0.721)) for y in (-0.33, 0.33)), color="wood")
    return t


def bookcase() -> Thing:
    t = Thing("bookcase", "shelf")
    t.add("base", box((-0.4, -0.38), (-0.15, 0.15), (0, 1.2)), box((0.38, 0.4), (-0.15, 0.15), (0, 1.2)), color="wood")
    t.add("base", *(box((-0.381, 0.381), (-0.15, 0.15), (z, z + 0.02)) for z in (0.03, 0.42, 0.8, 1.18)), color="wood")
    t.add("base", box((-0.4, 0.4), (0.15, 0.156), (0, 1.2)))
    t.add("base", *(box((x, x + 0.03), (-0.08, 0.12), (0.8199, 1.05)) for x in (-0.37, -0.34, -0.31)), color="red")
    return t


def _fused(make, name: str) -> Thing:
    t = make(fused=True)
    t.name = name
    return t


def all_things() -> list[Thing]:
    """Every example object."""
    return [
        microwave(), cabinet(), named_cabinet(), laptop(), bucket(), drill(), toy_car(), sliding_window(), toaster(),
        stove(), tilting_flap(), tilted_drawer(), fridge(), storage_box(), valve(), table(), bookcase(),
        _fused(microwave, "microwave_fused"), _fused(cabinet, "cabinet_fused"), _fused(laptop, "laptop_fused"),
        _fused(stove, "stove_fused"),
    ]  # fmt: skip
