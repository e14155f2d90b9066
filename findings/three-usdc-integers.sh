#!/usr/bin/env bash
# Guess: three.js' USDLoader reads a binary USD file as it reads the same stage as text.
# Truth: it throws on a .usdc in which a translation of type double3 has whole numbers only, such as (0, 0, 1): the format stores
#   small whole numbers as bytes in the field itself, which the reader expands for float3 but not for double3. (0, 0, 0),
#   (0, 0, 1.1), a float3 translation and the same stage as .usda load.
# Version: three 0.187.0, files written by usd-core 26.11
# Source: found by running
# Who cares: whoever shows USD in a browser: an asset that loads fails after it was moved by exactly a metre.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv
venv/bin/pip install -q --disable-pip-version-check usd-core==26.11
npm install --silent --no-audit --no-fund three@0.187.0 > /dev/null
venv/bin/python - <<'PY'
from pxr import Gf, Usd, UsdGeom

for name, value in {"zero": (0, 0, 0), "whole": (0, 0, 1), "fraction": (0, 0, 1.1), "single": (0, 0, 1)}.items():
    for kind in ("usda", "usdc"):
        stage = Usd.Stage.CreateNew(f"{name}.{kind}")
        door = UsdGeom.Xform.Define(stage, "/door")
        stage.SetDefaultPrim(door.GetPrim())
        single = name == "single"
        move = door.AddTranslateOp(UsdGeom.XformOp.PrecisionFloat if single else UsdGeom.XformOp.PrecisionDouble)
        move.Set((Gf.Vec3f if single else Gf.Vec3d)(*value))
        stage.Save()
PY
cat > load.mjs <<'JS'
import { readFileSync } from 'node:fs';
import { REVISION } from 'three';
import { USDLoader } from 'three/addons/loaders/USDLoader.js';

console.log(`three.js r${REVISION}`);
const failed = [];
for (const name of ['zero', 'whole', 'fraction', 'single']) {
  for (const kind of ['usda', 'usdc']) {
    const bytes = readFileSync(`${name}.${kind}`);
    const data = kind === 'usda' ? bytes.toString() : bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
    try {
      const door = new USDLoader().parse(data).getObjectByName('door');
      console.log(`  ${name}.${kind}: at ${door.position.toArray()}`);
    } catch (error) {
      console.log(`  ${name}.${kind}: ${error.message}`);
      failed.push(`${name}.${kind}`);
    }
  }
}
if (failed.join() !== 'whole.usdc') {
  console.log('changed: see above');
  process.exit(1);
}
JS
node load.mjs
