"""three.js in Node: the URDF by urdf-loader, the GLB by GLTFLoader, the USD by USDLoader. NODE_MODULES: of its packages."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
from common import Asset, finite, motion, serve, swept

PIPES = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
NODE = subprocess.Popen(["node", str(Path(__file__).with_suffix(".mjs"))], **PIPES)


def matrix(values: list[float]) -> np.ndarray:
    return np.array(values, float).reshape(4, 4)


def read(asset: Asset, variant: str) -> dict:
    names = [p["name"] for p in asset.content["parts"]]
    amounts = {name: asset.amount(name) for name, j in asset.joints.items() if j["type"] != "fixed"}
    request = {"variant": variant, "file": str(asset.file(variant)), "root": asset.root, "links": names, "amounts": amounts}
    NODE.stdin.write(json.dumps(request) + "\n")
    NODE.stdin.flush()
    got = json.loads(NODE.stdout.readline())
    if "error" in got:
        raise RuntimeError(got["error"])
    places = {name: matrix(link["pose"]) for name, link in got["links"].items()}
    root = np.linalg.inv(places.get(asset.root, np.eye(4)))
    rest = {name: root @ T for name, T in places.items()}
    links = {name: {"place": T[:3, 3]} for name, T in rest.items()}
    for name, link in got["links"].items():
        links[name] |= {"box": link["box"]} if "box" in link else {}
    said = [text for text in got["said"] if "texture" not in text]  # Node draws no pictures
    said += ["draws collision shapes"] if got["hulls"] else []
    joints = {}
    for name, joint in got.get("joints", {}).items():
        record = joints[name] = {key: joint[key] for key in ("type", "parent", "child")}
        if joint["type"] != "fixed":
            record |= motion(rest[joint["child"]], root @ matrix(joint["moved"]), amounts[name])
            record |= {"limits": None if joint["type"] == "continuous" else finite(joint["lower"], joint["upper"])}
            record |= {key: joint[key] for key in ("effort", "velocity") if joint[key] is not None}
    for joint in asset.joints.values() if "poses" in got else ():
        parent, child, extras = joint["parent"], joint["child"], got["extras"].get(joint["child"])
        if extras is None or child not in rest:
            continue
        record = joints[extras["name"]] = {"type": extras["type"], "parent": parent, "child": child}
        if joint["type"] != "fixed":
            moves = [np.linalg.inv(matrix(at[parent])) @ matrix(at[child]) for at in got["poses"]]
            record |= swept(rest[parent], moves, joint["type"] == "prismatic", extras["axis"])
    return {"version": got["version"], "said": said, "joints": joints, "links": links}


with NODE:
    serve(read)
    NODE.stdin.close()
