#!/usr/bin/env bash
# Guess: a glTF node called door.left is found in three.js by getObjectByName('door.left').
# Truth: GLTFLoader removes . : / [ ] from names and turns spaces into _, and numbers names that are equal then: door.left becomes
#   doorleft, and a node that is truly called doorleft becomes doorleft_1. The name of the file is in userData.name, unless the
#   node's extras have a name of their own, which replaces it. Names of animations stay.
# Version: three 0.187.0
# Source: github.com/mrdoob/three.js/issues/27873
# Who cares: web viewers that match nodes with the links and joints of asset.json: give links names of letters, digits and _.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund three@0.187.0 > /dev/null
cat > names.mjs <<'JS'
import { REVISION } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const nodes = [
  { name: 'case', children: [1, 2, 3] },
  { name: 'door.left' },
  { name: 'doorleft' },
  { name: 'drawer 1', extras: { name: 'top' } },
];
const scene = JSON.stringify({ asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes });
const loaded = await new GLTFLoader().parseAsync(scene, '');
const found = loaded.scene.children[0].children.map((node) => [node.name, node.userData.name]);
console.log(`three.js r${REVISION}`);
nodes.slice(1).forEach((node, k) => console.log(`  ${node.name}: name ${found[k][0]}, userData.name ${found[k][1]}`));
console.log(`  getObjectByName('door.left'): ${loaded.scene.getObjectByName('door.left')}`);
if (found.join() !== 'doorleft,door.left,doorleft_1,doorleft,drawer_1,top') {
  console.log('changed: see above');
  process.exit(1);
}
JS
node names.mjs
