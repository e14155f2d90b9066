// Loads files by three.js: for each line of input, a JSON request, prints a line of what it makes of the file; see three_.py.
// NODE_MODULES: the folder that has three, urdf-loader and jsdom.
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const modules = path.resolve(process.env.NODE_MODULES, 'node_modules');
const bring = (name) => import(pathToFileURL(path.join(modules, name)));
const { JSDOM } = createRequire(path.join(modules, 'x.js'))('jsdom');
const { window } = new JSDOM('');
for (const name of ['DOMParser', 'Document', 'Element', 'Node']) globalThis[name] = window[name];
globalThis.self = globalThis;
const three = await bring('three/build/three.module.js');
let said = [];
for (const kind of ['warn', 'error']) console[kind] = (...words) => said.push(words.join(' '));
const matrix = (object) => object.matrixWorld.clone().transpose().toArray();
const nameOf = (object) => object.userData?.name ?? object.name;

function read(file) {
  const data = fs.readFileSync(file);
  return data.buffer.slice(data.byteOffset, data.byteOffset + data.length);
}

// The pose of each link, and the corners of what is drawn of it, in the frame of the root link.
function placed(scene, { root, links }) {
  scene.updateMatrixWorld(true);
  const found = {};
  scene.traverse((object) => {
    if (links.includes(nameOf(object)) && !(nameOf(object) in found)) found[nameOf(object)] = { pose: matrix(object) };
  });
  const inverse = new three.Matrix4();
  scene.traverse((o) => { if (nameOf(o) === root) inverse.copy(o.matrixWorld).invert(); });
  const hulls = [];
  scene.traverseVisible((object) => {
    if (!object.isMesh) return;
    if (/collision/.test(object.name)) { hulls.push(object.name); return; }
    let link = object;
    while (link && !links.includes(nameOf(link))) link = link.parent;
    if (!link) return;
    const box = new three.Box3();
    const { position } = object.geometry.attributes;
    const at = new three.Vector3();
    for (let k = 0; k < position.count; k++) {
      box.expandByPoint(at.fromBufferAttribute(position, k).applyMatrix4(object.matrixWorld).applyMatrix4(inverse));
    }
    const one = found[nameOf(link)];
    if (one.box) box.union(new three.Box3(new three.Vector3(...one.box[0]), new three.Vector3(...one.box[1])));
    one.box = [box.min.toArray(), box.max.toArray()];
  });
  return { links: found, hulls: hulls.length };
}

async function load(request) {
  const { variant, file, links, amounts } = request;
  const result = { version: `three.js ${three.REVISION}`, said };
  if (variant === 'urdf') {
    const { default: Loader } = await bring('urdf-loader/src/URDFLoader.js');
    const { version } = JSON.parse(fs.readFileSync(path.join(modules, 'urdf-loader/package.json')));
    result.version += ` with urdf-loader ${version}`;
    const loader = new Loader();
    loader.loadMeshCb = (_, __, ___, done) => done(new three.Object3D());
    const robot = loader.parse(fs.readFileSync(file, 'utf8'));
    Object.assign(result, placed(robot, request));
    result.joints = {};
    for (const [name, joint] of Object.entries(robot.joints)) {
      const child = joint.children.find((o) => o.isURDFLink);
      const { lower, upper, effort, velocity } = joint.limit;
      result.joints[name] = { type: joint.jointType, parent: joint.parent.name, child: child.name, lower, upper, effort, velocity };
      joint.setJointValue(amounts[name]);
      robot.updateMatrixWorld(true);
      result.joints[name].moved = matrix(child);
      joint.setJointValue(0);
    }
  } else if (variant === 'glb') {
    const { GLTFLoader } = await bring('three/examples/jsm/loaders/GLTFLoader.js');
    const { scene, animations } = await new GLTFLoader().parseAsync(read(file), '');
    Object.assign(result, placed(scene, request));
    result.extras = {};
    scene.traverse((o) => { if (o.userData.joint) result.extras[nameOf(o)] = o.userData.joint; });
    const mixer = new three.AnimationMixer(scene);
    const times = new Set([0]);
    for (const clip of animations) {
      mixer.clipAction(clip).setLoop(three.LoopOnce).play();
      for (const track of clip.tracks) track.times.forEach((time) => times.add(time));
    }
    result.poses = [...times].sort((a, b) => a - b).map((time) => {
      mixer.setTime(Math.min(time, Math.max(...times) - 1e-4));
      scene.updateMatrixWorld(true);
      const poses = {};
      scene.traverse((o) => { if (links.includes(nameOf(o)) && !(nameOf(o) in poses)) poses[nameOf(o)] = matrix(o); });
      return poses;
    });
  } else {
    globalThis.document = window.document; // for textures; those of glTF would be waited for
    const { USDLoader } = await bring('three/examples/jsm/loaders/USDLoader.js');
    Object.assign(result, placed(new USDLoader().parse(read(file)), request));
  }
  return result;
}

for await (const line of readline.createInterface({ input: process.stdin })) {
  said = [];
  let answer;
  try {
    answer = await load(JSON.parse(line));
  } catch (error) {
    answer = { error: `${error.name}: ${error.message}` };
  }
  process.stdout.write(`${JSON.stringify(answer)}\n`);
}
