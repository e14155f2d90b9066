"""Khronos' glTF validator, on the GLB, in Node. NODE_MODULES: the folder of its packages."""

from __future__ import annotations

import json
import os
import subprocess

from common import Asset, serve

PROGRAM = """
const { createRequire } = require('node:module');
const validator = createRequire(process.env.NODE_MODULES + '/x.js')('gltf-validator');
validator.validateBytes(new Uint8Array(require('node:fs').readFileSync(process.argv[1]))).then((report) =>
  console.log(JSON.stringify({ version: validator.version(), issues: report.issues })));
"""


def read(asset: Asset, variant: str) -> dict:
    environment = {**os.environ, "NODE_MODULES": os.path.abspath(os.environ["NODE_MODULES"])}  # noqa: PTH100
    command = ["node", "-e", PROGRAM, str(asset.file("glb"))]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    got = json.loads(done.stdout)
    issues = got["issues"]["messages"]
    faults = [f"{m['code']} at {m['pointer']}" for m in issues if m["severity"] < 2]  # errors and warnings
    said = sorted({f"{m['code']} ({('error', 'warning', 'information', 'hint')[m['severity']]})" for m in issues})
    return {"version": f"glTF validator {got['version']}", "faults": faults, "said": said}


serve(read)
