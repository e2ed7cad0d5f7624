// The viewer of a scene run: bodies, translucent, with the triangles of a pose that touch or are undecided, and the segments
// in which they meet. What was answered comes from `data`; nothing is decided here.
"use strict";
(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const element = (tag, attributes, ...children) => {
    const made = document.createElement(tag);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
    made.append(...children);
    return made;
  };
  const BODIES = [0x7d97b5, 0xb89767, 0x7fa67f, 0xa887b0];
  const dark = matchMedia("(prefers-color-scheme: dark)");

  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(devicePixelRatio);
  $("view").prepend(renderer.domElement);
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xffffff, 0x555555, 2.2));
  const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
  camera.up.set(0, 0, 1);
  const light = new THREE.DirectionalLight(0xffffff, 1.4);
  camera.add(light);
  scene.add(camera);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);

  // Bodies, one for each object.
  const geometries = data.meshes.map((mesh) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(mesh.vertices), 3));
    geometry.setIndex(mesh.faces);
    const flat = geometry.toNonIndexed();
    flat.computeVertexNormals();
    return flat;
  });
  const bodies = data.objects.map((object, i) => {
    const material = new THREE.MeshLambertMaterial({ color: BODIES[i % BODIES.length], transparent: true, opacity: 0.28, depthWrite: false, side: THREE.DoubleSide });
    const body = new THREE.Mesh(geometries[object.mesh], material);
    body.matrixAutoUpdate = false;
    scene.add(body);
    return body;
  });

  // Triangles and segments of contacts; they are made anew for each pose. Each triangle is painted once, with its most
  // important kind; what is clicked is found among those of all pairs, which are not painted.
  const contacts = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide, transparent: true, opacity: 0.6, depthTest: false }));
  const pairs = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
  pairs.visible = false;
  const segments = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x000000, transparent: true, depthTest: false }));
  const filling = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ color: 0xe0409a, side: THREE.DoubleSide, transparent: true, opacity: 0.75, depthTest: false }));
  const chosen = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xe0409a, transparent: true, depthTest: false }));
  [pairs, contacts, filling, segments, chosen].forEach((mesh, i) => {
    mesh.renderOrder = i + 1;
    mesh.frustumCulled = false;
    scene.add(mesh);
  });

  // Contacts come as lists, which are shorter: kind, objects, triangles, exact answer, and what there is of the rest.
  for (const frame of data.frames) {
    frame.contacts = frame.contacts.map(([kind, a, b, p, q, exact, says, segment, reason]) => ({ kind, a, b, p, q, exact, says, segment, reason }));
    // What the unit left open comes first in the list.
    frame.contacts.sort((x, y) => (data.kinds[x.kind].verdict === "intersect") - (data.kinds[y.kind].verdict === "intersect"));
  }

  let frame = null;
  let picked = null;
  const kind = (contact) => data.kinds[contact.kind];
  const called = (object, face) => `${data.objects[object].name} ${data.objects[object].triangles[face] ?? face}`;
  const corner = (object, mesh, face, k) => {
    const { vertices, faces } = data.meshes[mesh];
    const i = faces[3 * face + k];
    return new THREE.Vector3(...vertices.slice(3 * i, 3 * i + 3)).applyMatrix4(bodies[object].matrix);
  };
  const triangle = (object, face) => [0, 1, 2].map((k) => corner(object, data.objects[object].mesh, face, k));
  const points = (list) => new THREE.BufferAttribute(new Float32Array(list.flatMap((p) => [p.x, p.y, p.z])), 3);
  const replace = (mesh, attributes) => {
    mesh.geometry.dispose();
    mesh.geometry = new THREE.BufferGeometry();
    Object.entries(attributes).forEach(([name, attribute]) => mesh.geometry.setAttribute(name, attribute));
  };

  function show(number) {
    frame = data.frames[number];
    $("step").value = number;
    $("frame").textContent = `pose ${frame.number}: ${frame.label}`;
    $("counts").textContent = frame.summary;
    bodies.forEach((body, i) => {
      const [m, t] = [frame.poses[i].slice(0, 9), frame.poses[i].slice(9)];
      body.matrix.set(m[0], m[1], m[2], t[0], m[3], m[4], m[5], t[1], m[6], m[7], m[8], t[2], 0, 0, 0, 1);
      body.updateMatrixWorld(true);
    });
    const [all, ends, marked] = [[], [], new Map()];
    frame.owners = [];
    frame.contacts.forEach((contact, i) => {
      for (const [object, face] of [[contact.a, contact.p], [contact.b, contact.q]]) {
        const corners = triangle(object, face);
        all.push(...corners);
        frame.owners.push(i);
        const key = `${object} ${face}`;
        if (!marked.has(key) || contact.kind < marked.get(key).kind) {
          marked.set(key, { kind: contact.kind, corners });
        }
      }
      if (contact.segment) {
        ends.push(new THREE.Vector3(...contact.segment.slice(0, 3)), new THREE.Vector3(...contact.segment.slice(3)));
      }
    });
    // The most important kind is drawn last, over the others.
    const order = [...marked.values()].sort((x, y) => y.kind - x.kind);
    const colours = order.flatMap(({ kind }) => Array(3).fill(new THREE.Color(data.kinds[kind].colour)));
    const painted = new THREE.BufferAttribute(new Float32Array(colours.flatMap((c) => [c.r, c.g, c.b])), 3);
    replace(contacts, { position: points(order.flatMap(({ corners }) => corners)), color: painted });
    replace(pairs, { position: points(all) });
    replace(segments, { position: points(ends) });
    const rows = frame.contacts.map((contact, i) => {
      const swatch = element("i", { style: `color:${kind(contact).colour}` }, "■ ");
      const row = element("tr", { tabindex: "0" }, element("td", {}, swatch, called(contact.a, contact.p)), element("td", {}, called(contact.b, contact.q)), element("td", {}, kind(contact).verdict), element("td", {}, contact.exact));
      row.addEventListener("click", () => pick(i));
      row.addEventListener("keydown", (event) => event.key === "Enter" && pick(i));
      return row;
    });
    $("pairs").tBodies[0].replaceChildren(...rows);
    pick(null);
  }

  // Looks at the contacts, or at everything.
  function look(close) {
    const box = new THREE.Box3();
    if (close && frame.contacts.length > 0) {
      box.setFromBufferAttribute(contacts.geometry.getAttribute("position"));
    } else {
      bodies.forEach((body) => box.expandByObject(body));
    }
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    const away = Math.max(sphere.radius, 1e-9) / Math.sin((Math.min(1, camera.aspect) * camera.fov * Math.PI) / 360);
    const direction = camera.position.clone().sub(controls.target);
    direction.lengthSq() > 0 && picked !== null ? direction.normalize() : direction.set(1, 1, 0.8).normalize();
    controls.target.copy(sphere.center);
    camera.position.copy(sphere.center).addScaledVector(direction, 1.05 * away);
    camera.near = away / 1000;
    camera.far = away * 100;
    camera.updateProjectionMatrix();
    controls.update();
    draw();
  }

  function pick(number) {
    picked = number;
    const contact = number === null ? null : frame.contacts[number];
    const [lines, faces] = [[], []];
    if (contact) {
      for (const [object, face] of [[contact.a, contact.p], [contact.b, contact.q]]) {
        const [p, q, r] = triangle(object, face);
        lines.push(p, q, q, r, r, p);
        faces.push(p, q, r);
      }
    }
    replace(chosen, { position: points(lines) });
    replace(filling, { position: points(faces) });
    [...$("pairs").tBodies[0].rows].forEach((row, i) => row.classList.toggle("on", i === number));
    const box = $("pair");
    if (!contact) {
      box.replaceChildren(element("p", { class: "soft" }, frame.contacts.length > 0 ? "Click a coloured triangle, or a row above, to see the answers and the reason." : "No pair touches or is undecided in this pose."));
    } else {
      $("pairs").tBodies[0].rows[number].scrollIntoView({ block: "nearest" });
      const facts = element("dl", {});
      const fact = (name, text) => facts.append(element("dt", {}, name), element("dd", {}, text));
      fact("triangles", `${called(contact.a, contact.p)}, ${called(contact.b, contact.q)}`);
      fact("unit’s answer", kind(contact).verdict);
      fact("exact answer", contact.exact);
      if (contact.reason !== null) {
        fact("undecided, as", contact.reason);
      }
      box.replaceChildren(element("h2", {}, kind(contact).words), facts, ...why(contact));
    }
    draw();
  }

  // What each axis, or each determinant, says.
  function why(contact) {
    if (contact.says === null) {
      return [element("p", { class: "soft" }, data.silent)];
    }
    const rows = [...contact.says].map((sign, i) => element("tr", {}, element("td", {}, data.witnesses[i]), element("td", {}, data.words[sign])));
    const table = element("table", {}, element("thead", {}, element("tr", {}, element("th", {}, data.witness), element("th", {}, "says"))), element("tbody", {}, ...rows));
    return [table];
  }

  const caster = new THREE.Raycaster();
  function aim(event) {
    const { left, top, width, height } = renderer.domElement.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    caster.setFromCamera(at, camera);
    return [...new Set(caster.intersectObject(pairs).map((hit) => frame.owners[hit.faceIndex]))];
  }

  let down = null;
  renderer.domElement.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
  renderer.domElement.addEventListener("pointerup", (event) => {
    if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) {
      const hits = aim(event);
      // A second click at the same place goes on to what is behind.
      const next = hits.indexOf(picked) + 1;
      pick(hits.length > 0 ? hits[next % hits.length] : null);
    }
  });

  let asked = false;
  function draw() {
    if (!asked) {
      asked = true;
      requestAnimationFrame(() => {
        asked = false;
        scene.background = new THREE.Color(dark.matches ? 0x16181c : 0xffffff);
        segments.material.color.set(dark.matches ? 0xffffff : 0x000000);
        renderer.render(scene, camera);
      });
    }
  }
  function fit() {
    const { clientWidth, clientHeight } = $("view");
    renderer.setSize(clientWidth, clientHeight);
    camera.aspect = clientWidth / clientHeight;
    camera.updateProjectionMatrix();
    draw();
  }

  controls.addEventListener("change", draw);
  new ResizeObserver(fit).observe($("view"));
  dark.addEventListener("change", draw);
  const go = (number) => show(Math.min(Math.max(number, 0), data.frames.length - 1));
  const at = () => Number($("step").value);
  $("step").max = data.frames.length - 1;
  $("step").addEventListener("input", () => go(at()));
  $("back").addEventListener("click", () => go(at() - 1));
  $("forth").addEventListener("click", () => go(at() + 1));
  $("all").addEventListener("click", () => look(false));
  $("near").addEventListener("click", () => look(true));
  addEventListener("keydown", (event) => {
    if (!(event.target instanceof HTMLInputElement)) {
      event.key === "ArrowLeft" && go(at() - 1);
      event.key === "ArrowRight" && go(at() + 1);
    }
  });
  $("opacity").addEventListener("input", () => {
    bodies.forEach((body) => (body.material.opacity = Number($("opacity").value)));
    draw();
  });
  $("legend").replaceChildren(
    ...data.kinds.filter((_, kind) => data.frames.some((frame) => frame.contacts.some((contact) => contact.kind === kind))).map((kind) => element("span", {}, element("i", { style: `background:${kind.colour}` }), kind.words)),
    ...data.objects.slice(0, 6).map((object, i) => element("span", {}, element("i", { style: `background:#${BODIES[i % BODIES.length].toString(16)}` }), object.name)),
  );
  fit();
  show(data.first);
  look(false);
})();
