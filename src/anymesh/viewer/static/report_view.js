// One asset in 3D. Lengths are metres; the scene's own frame is the asset frame (Z up), glTF's Y up is turned into it.
"use strict";
const AnymeshView = (() => {
  const T = THREE, AXIS = 0xbe1428, PATH = 0x555555, PICKED = 0x1e6ef5, HELD = 0x00875a, GRASP = 0x00a0c8;
  const METAL = 0.4; // no more than this: there is no room to be mirrored
  const SLIDES = new Set(["prismatic", "free"]);
  const lead = (joint, amount) => (joint.pitch ?? 0) / (2 * Math.PI) * amount; // along the axis of a screw
  const vector = (a) => new T.Vector3(a[0], a[1], a[2]);

  class View {
    constructor(stage, data, gltf) {
      this.data = data;
      this.stage = stage;
      this.positions = data.joints.map(() => 0);
      this.apart = 0;
      this.dirty = true;
      this.picked = -1;
      this.renderer = new T.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
      this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
      this.renderer.setClearColor(0xf3f4f6, 1);
      this.canvas = this.renderer.domElement;
      this.canvas.tabIndex = 0;
      this.scene = new T.Scene();
      const size = vector(data.high).distanceTo(vector(data.low));
      this.camera = new T.PerspectiveCamera(32, 1, size / 200, size * 50);
      this.camera.up.set(0, 0, 1);
      this.scene.add(this.camera, new T.HemisphereLight(0xffffff, 0xb8b8b8, 1.9));
      const lamp = new T.DirectionalLight(0xffffff, 1.6);
      lamp.position.set(-0.6, 1.2, 1);
      this.camera.add(lamp);
      this.root = new T.Group();
      this.root.rotation.x = Math.PI / 2;
      this.root.add(gltf.scene);
      this.scene.add(this.root);
      this._adopt(gltf);
      this._marks();
      this._grippers();
      stage.prepend(this.canvas);
      this.controls = new T.OrbitControls(this.camera, this.canvas);
      this.controls.addEventListener("change", () => { this.dirty = true; });
      this.resize();
      this.home();
    }

    // Finds the links among the nodes of the file, by their names there, and what each of them shows.
    _adopt(gltf) {
      const numbers = new Map(this.data.links.map((link, k) => [link.name, k]));
      this.nodes = this.data.links.map(() => null);
      this.meshes = this.data.links.map(() => []);
      gltf.scene.traverse((object) => {
        if (object === gltf.scene || object.parent === gltf.scene) return; // what turns Z up, which may be called like a part
        const node = gltf.parser.associations.get(object)?.nodes;
        const link = numbers.get(node === undefined ? (object.userData.name ?? object.name) : gltf.parser.json.nodes[node].name);
        if (link !== undefined) this.nodes[link] ??= object;
      });
      const missing = this.data.links.filter((_, k) => !this.nodes[k]).map((link) => link.name);
      if (missing.length) throw new Error(`the 3D data lacks the parts ${missing.join(", ")}`);
      const found = [];
      gltf.scene.traverse((object) => { if (object.isMesh) found.push(object); });
      for (const mesh of found) this._dress(mesh, this.linkOf(mesh));
      this.colors(this.data.looks);
    }

    // The two materials of a mesh, and what marks it when it is picked: it shines through whatever hides it.
    _dress(mesh, link) {
      const looks = mesh.material;
      if (looks.metalness !== undefined) looks.metalness = looks.name ? Math.min(METAL, looks.metalness) : 0;
      const plain = new T.MeshStandardMaterial({
        color: this.data.links[link].color, roughness: 0.8, side: looks.side, flatShading: looks.flatShading,
      });
      const light = { color: PICKED, transparent: true, opacity: 0.35, depthTest: false, depthWrite: false };
      const glow = new T.Mesh(mesh.geometry, new T.MeshBasicMaterial(light));
      glow.visible = false;
      glow.renderOrder = 5;
      mesh.add(glow);
      Object.assign(mesh.userData, { looks, plain, glow });
      this.meshes[link].push(mesh);
    }

    linkOf(object) {
      for (let at = object; at; at = at.parent) {
        const link = this.nodes.indexOf(at);
        if (link >= 0) return link;
      }
      return -1;
    }

    // Axis arrow, ring of a turn, and the way of the part's middle between the limits; they ride on the parent.
    _marks() {
      this.marks = this.data.joints.map((joint) => {
        const group = new T.Group();
        const parent = this.data.links[joint.link].parent;
        const frame = vector(this.data.links[parent].origin);
        this.nodes[parent].add(group);
        if (joint.type === "fixed") return group;
        const paint = new T.MeshBasicMaterial({ color: AXIS, depthTest: false, transparent: true, opacity: 0.9 });
        const [start, end] = joint.ends.map((p) => vector(p).sub(frame));
        const thick = this.data.ring / 12;
        const along = end.clone().sub(start);
        const shaft = new T.Mesh(new T.CylinderGeometry(thick, thick, along.length(), 8), paint);
        const head = new T.Mesh(new T.ConeGeometry(4 * thick, 10 * thick, 12), paint);
        const turned = new T.Quaternion().setFromUnitVectors(new T.Vector3(0, 1, 0), along.normalize());
        shaft.position.copy(start).add(end).multiplyScalar(0.5);
        head.position.copy(end);
        shaft.quaternion.copy(turned);
        head.quaternion.copy(turned);
        group.add(shaft, head);
        if (!SLIDES.has(joint.type)) {
          const ring = new T.Mesh(new T.TorusGeometry(this.data.ring, thick, 6, 40, 1.5 * Math.PI), paint);
          ring.position.copy(vector(joint.center).sub(frame));
          ring.quaternion.setFromUnitVectors(new T.Vector3(0, 0, 1), vector(joint.axis));
          group.add(ring);
        }
        group.add(this._path(joint, frame));
        group.traverse((mark) => { mark.renderOrder = 10; mark.userData.mark = true; });
        return group;
      });
    }

    // Handles and best grasps: two fingers, a palm and an arm, as segments in the asset frame at rest.
    _grippers() {
      const thick = this.data.ring / 9;
      this.marked = this.data.grippers.map((gripper) => {
        const paint = new T.MeshBasicMaterial({ color: gripper.grasp ? GRASP : HELD, depthTest: false, transparent: true, opacity: 0.9 });
        const group = new T.Group(), origin = vector(this.data.links[gripper.link].origin);
        for (let k = 0; k < gripper.lines.length; k += 6) {
          const a = vector(gripper.lines.slice(k, k + 3)).sub(origin), b = vector(gripper.lines.slice(k + 3, k + 6)).sub(origin);
          const along = b.clone().sub(a), bar = new T.Mesh(new T.CylinderGeometry(thick, thick, along.length(), 8), paint);
          bar.position.copy(a).add(b).multiplyScalar(0.5);
          bar.quaternion.setFromUnitVectors(new T.Vector3(0, 1, 0), along.normalize());
          group.add(bar);
        }
        group.traverse((mark) => { mark.renderOrder = 10; mark.userData.mark = true; });
        this.nodes[gripper.link].add(group);
        return group;
      });
    }

    _path(joint, frame) {
      const [low, high] = joint.limits ?? [-Math.PI, Math.PI];
      const origin = vector(this.data.links[joint.link].origin), axis = vector(joint.axis), points = [];
      for (let k = 0; k <= 48; k++) {
        const amount = low + (high - low) * k / 48, point = vector(joint.middle);
        if (SLIDES.has(joint.type)) point.addScaledVector(axis, amount);
        else point.sub(origin).applyAxisAngle(axis, amount).add(origin).addScaledVector(axis, lead(joint, amount));
        points.push(...point.sub(frame).toArray());
      }
      const line = new T.BufferGeometry().setAttribute("position", new T.Float32BufferAttribute(points, 3));
      return new T.Line(line, new T.LineBasicMaterial({ color: PATH, depthTest: false, transparent: true, opacity: 0.6 }));
    }

    // Where a joint is: where its slider has it, or what it follows.
    amount(joint, k) {
      if (!joint.follows) return this.positions[k];
      const { joint: leader, positions } = joint.follows, [low, high] = this.data.joints[leader].limits ?? [-Math.PI, Math.PI];
      const at = (positions.length - 1) * Math.min(1, Math.max(0, (this.positions[leader] - low) / (high - low)));
      const before = Math.min(Math.floor(at), positions.length - 2);
      return positions[before] + (at - before) * (positions[before + 1] - positions[before]);
    }

    // Puts every link where the joint positions [rad, m] and the explosion (0..1) have it.
    pose() {
      const moved = new Map(this.data.joints.map((joint, k) => [joint.link, [joint, this.amount(joint, k)]]));
      this.data.links.forEach((link, k) => {
        if (link.parent < 0) return;
        const node = this.nodes[k], [joint, amount] = moved.get(k), axis = vector(joint.axis);
        node.position.copy(vector(link.origin)).sub(vector(this.data.links[link.parent].origin));
        node.position.addScaledVector(vector(link.away), this.apart);
        node.quaternion.identity();
        if (SLIDES.has(joint.type)) node.position.addScaledVector(axis, amount);
        else if (joint.type !== "fixed") node.quaternion.setFromAxisAngle(axis, amount);
        node.position.addScaledVector(axis, lead(joint, amount));
      });
      this.data.joints.forEach((joint, k) => {
        this.marks[k].position.copy(vector(this.data.links[joint.link].away)).multiplyScalar(this.apart);
      });
      this.dirty = true;
    }

    // Materials of the file, or a colour a part.
    colors(looks) {
      for (const mesh of this.meshes.flat()) mesh.material = looks ? mesh.userData.looks : mesh.userData.plain;
      this.dirty = true;
    }

    axes(shown) {
      for (const mark of this.marks) mark.visible = shown;
      this.dirty = true;
    }

    grippers(shown) {
      for (const gripper of this.marked) gripper.visible = shown;
      this.dirty = true;
    }

    // Marks a part, -1 for none.
    pick(link) {
      this.picked = link;
      this.meshes.forEach((meshes, k) => { for (const mesh of meshes) mesh.userData.glow.visible = k === link; });
      this.dirty = true;
    }

    // The part under the pointer, -1 for none.
    at(event) {
      const box = this.canvas.getBoundingClientRect();
      const x = 2 * (event.clientX - box.left) / box.width - 1, y = 1 - 2 * (event.clientY - box.top) / box.height;
      const ray = new T.Raycaster();
      ray.setFromCamera(new T.Vector2(x, y), this.camera);
      const hit = ray.intersectObjects(this.meshes.flat(), false)[0];
      return hit ? this.linkOf(hit.object) : -1;
    }

    // The view of the preview, as near as the opened asset lets it be.
    home() {
      const low = vector(this.data.low), high = vector(this.data.high), toward = vector(this.data.toward);
      const center = low.clone().add(high).multiplyScalar(0.5);
      const right = new T.Vector3(0, 0, 1).cross(toward).normalize(), up = toward.clone().cross(right);
      const tan = 0.92 * Math.tan(this.camera.fov * Math.PI / 360);
      let far = 0;
      for (let k = 0; k < 8; k++) {
        const corner = new T.Vector3(...[0, 1, 2].map((i) => (k >> i & 1 ? high : low).getComponent(i))).sub(center);
        const side = Math.max(Math.abs(corner.dot(up)) / tan, Math.abs(corner.dot(right)) / (tan * this.camera.aspect));
        far = Math.max(far, corner.dot(toward) + side);
      }
      this.camera.position.copy(center).addScaledVector(toward, far);
      this.controls.target.copy(center);
      this.controls.update();
      this.dirty = true;
    }

    resize() {
      const { clientWidth, clientHeight } = this.stage;
      if (!clientWidth || !clientHeight) return;
      this.renderer.setSize(clientWidth, clientHeight);
      this.camera.aspect = clientWidth / clientHeight;
      this.camera.updateProjectionMatrix();
      this.dirty = true;
    }

    draw() {
      if (!this.dirty) return;
      this.dirty = false;
      this.renderer.render(this.scene, this.camera);
    }

    // Link frames in the asset frame, rows of 4x4 matrices.
    transforms() {
      this.scene.updateMatrixWorld(true);
      const found = {};
      this.data.links.forEach((link, k) => {
        const m = this.nodes[k].matrixWorld.clone().transpose().elements;
        found[link.name] = [0, 4, 8, 12].map((row) => Array.from(m.slice(row, row + 4)));
      });
      return found;
    }

    // The middle of a link's first triangle on the screen [px of the window].
    onScreen(link) {
      const mesh = this.meshes[link][0], at = mesh.geometry.attributes.position, index = mesh.geometry.index;
      const point = new T.Vector3(), corner = new T.Vector3();
      for (let k = 0; k < 3; k++) point.add(corner.fromBufferAttribute(at, index ? index.getX(k) : k));
      mesh.localToWorld(point.divideScalar(3)).project(this.camera);
      const box = this.canvas.getBoundingClientRect();
      return [box.left + (point.x + 1) / 2 * box.width, box.top + (1 - point.y) / 2 * box.height];
    }

    dispose() {
      this.controls.dispose();
      this.scene.traverse((object) => {
        object.geometry?.dispose();
        for (const material of [object.material, object.userData.looks, object.userData.plain]) {
          material?.map?.dispose();
          material?.dispose();
        }
      });
      this.renderer.dispose();
      this.renderer.forceContextLoss();
      this.canvas.remove();
    }
  }

  async function unpack(base64) {
    const text = atob(base64), packed = new Uint8Array(text.length);
    for (let k = 0; k < text.length; k++) packed[k] = text.charCodeAt(k);
    return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  }

  // A view of gzipped base64 GLB data in an element.
  async function open(stage, data, base64) {
    const gltf = await new T.GLTFLoader().parseAsync(await unpack(base64), "");
    return new View(stage, data, gltf);
  }

  return { open };
})();
