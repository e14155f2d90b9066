#!/usr/bin/env bash
# Guess: three.js' USDLoader leaves out collision shapes: prims of purpose "guide", or at least invisible ones.
# Truth: it reads neither purpose nor visibility. Hulls are drawn over the object, also those that are invisible themselves or
#   below an invisible parent.
# Version: three 0.187.0
# Source: found by running; openusd.org, UsdGeomImageable, for purpose and visibility
# Who cares: web viewers of simulation-ready USD: remove the collision prims by their names after loading.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund three@0.187.0 > /dev/null
cat > show.mjs <<'JS'
import { REVISION } from 'three';
import { USDLoader } from 'three/addons/loaders/USDLoader.js';

const mesh = (name, attribute) => `
    def Mesh "${name}"
    {
        ${attribute}
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    }`;
const scene = new USDLoader().parse(`#usda 1.0
(
    defaultPrim = "door"
    upAxis = "Y"
)
def Xform "door"
{
    ${mesh('panel', '')}
    ${mesh('guide', 'uniform token purpose = "guide"')}
    ${mesh('invisible', 'token visibility = "invisible"')}
    def Xform "hulls"
    {
        token visibility = "invisible"
        ${mesh('below', '')}
    }
}
`);
const drawn = [];
scene.traverseVisible((object) => { if (object.isMesh) drawn.push(object.name); });
console.log(`three.js r${REVISION} draws: ${drawn.join(', ')} (right: panel)`);
if (drawn.sort().join() !== 'below,guide,invisible,panel') {
  console.log('changed: see above');
  process.exit(1);
}
JS
node show.mjs
