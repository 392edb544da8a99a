// Bodies as surfaces, joints as symbols.

const SHARP = Math.cos((38 * Math.PI) / 180); // beyond this angle two panels have an edge

/// Surface of triangles, smooth but for its edges.
function surface(positions, center) {
  const moved = new Float32Array(positions.length);
  for (let i = 0; i < moved.length; ++i) moved[i] = positions[i] - center[i % 3];
  const geometry = new L.BufferGeometry();
  const { places, normals, index, kept } = shared(moved, creasedNormals(moved));
  geometry.setAttribute("position", new L.BufferAttribute(places, 3));
  geometry.setAttribute("normal", new L.BufferAttribute(normals, 3));
  geometry.setIndex(index);
  geometry.userData.kept = kept;
  return geometry;
}

/// Corners of one place and normal as one: fewer to be turned in every frame.
function shared(positions, normals) {
  const known = new Map(), index = [], kept = [];
  for (let i = 0; i < positions.length; i += 3) {
    const key = [0, 1, 2].map((c) => Math.round((positions[i + c] / RADIUS) * 1e5)).join()
      + [0, 1, 2].map((c) => Math.round(normals[i + c] * 100)).join();
    if (!known.has(key)) known.set(key, kept.push(i) - 1);
    index.push(known.get(key));
  }
  const take = (from) => Float32Array.from(kept.flatMap((i) => [...from.subarray(i, i + 3)]));
  return { places: take(positions), normals: take(normals), index, kept };
}

function creasedNormals(p) {
  const flat = [], corners = new Map(), out = new Float32Array(p.length);
  const key = (i) => [0, 1, 2].map((c) => Math.round((p[i + c] / RADIUS) * 1e5)).join();
  const a = new L.Vector3(), b = new L.Vector3();
  for (let t = 0; t < p.length; t += 9) {
    a.set(p[t + 3] - p[t], p[t + 4] - p[t + 1], p[t + 5] - p[t + 2]);
    b.set(p[t + 6] - p[t], p[t + 7] - p[t + 1], p[t + 8] - p[t + 2]);
    const normal = a.clone().cross(b); // twice the area: large triangles weigh more
    flat.push({ normal, unit: normal.clone().normalize() });
    for (let c = 0; c < 9; c += 3) {
      const at = key(t + c);
      if (!corners.has(at)) corners.set(at, []);
      corners.get(at).push(flat.length - 1);
    }
  }
  const sum = new L.Vector3();
  for (let i = 0; i < p.length; i += 3) {
    const own = flat[Math.floor(i / 9)];
    sum.set(0, 0, 0);
    for (const other of corners.get(key(i)))
      if (flat[other].unit.dot(own.unit) > SHARP) sum.add(flat[other].normal);
    sum.normalize().toArray(out, i);
  }
  return out;
}

/// Pieces of edges that follow each other in one direction as one piece: a line costs as much as
/// many panels where the processor draws.
function straightened(edges) {
  const p = edges.attributes.position.array, ends = new Map(), used = new Set(), kept = [];
  const key = (i) => [0, 1, 2].map((c) => Math.round((p[i + c] / RADIUS) * 1e5)).join();
  for (let i = 0; i < p.length; i += 3) {
    if (!ends.has(key(i))) ends.set(key(i), []);
    ends.get(key(i)).push(i);
  }
  const other = (i) => (i % 6 ? i - 3 : i + 3); // the other end of a piece
  const from = new L.Vector3(), to = new L.Vector3(), way = new L.Vector3();
  const farthest = (i) => { // where the line ends that leaves through the end i
    for (;;) {
      way.subVectors(to.fromArray(p, i), from.fromArray(p, other(i))).normalize();
      const next = ends.get(key(i)).find((j) => !used.has(Math.floor(j / 6))
        && to.fromArray(p, other(j)).sub(from.fromArray(p, j)).normalize().dot(way) > 0.99999);
      if (next === undefined) return i;
      used.add(Math.floor(next / 6));
      i = other(next);
    }
  };
  for (let i = 0; i < p.length; i += 6) {
    if (used.has(i / 6)) continue;
    used.add(i / 6);
    for (const end of [farthest(i), farthest(i + 3)]) kept.push(p[end], p[end + 1], p[end + 2]);
  }
  edges.setAttribute("position", new L.BufferAttribute(new Float32Array(kept), 3));
  return edges;
}

function makeBody(body) {
  const group = new L.Group();
  const colour = new L.Color(body.colour);
  const material = new L.MeshLambertMaterial({
    color: colour, side: L.DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
  const pale = material.clone();
  pale.color = colour.clone().lerp(new L.Color("white"), 0.35);
  const parts = [[body.surface, body.cut ? cutMaterial(material) : material, body.shapes],
                 [body.above, pale, body.shapes_above]];
  let level = () => {};
  const bends = [];
  for (const [place, paint, shapes] of parts) {
    if (place[1] === 0) continue;
    const geometry = surface(numbers(place), body.center);
    if (body.cut) level = levels(geometry, group, body.cut);
    const mesh = new L.Mesh(geometry, paint);
    mesh.userData.name = body.name;
    const line = new L.LineBasicMaterial({ color: 0x16222b, transparent: true, opacity: 0.55 });
    const edges = new L.EdgesGeometry(geometry, 28);
    if (body.modes) bends.push(bending(body, geometry, edges, numbers(shapes)));
    group.add(mesh, new L.LineSegments(body.modes ? edges : straightened(edges), line));
  }
  const position = numbers(body.position), orientation = numbers(body.orientation);
  const next = new L.Quaternion();
  const place = (sample, time) => {
    for (let c = 0; c < 3; ++c) group.position.setComponent(c, between(position, 3, sample, c));
    const i = 4 * sample.at, j = Math.min(i + 4, orientation.length - 4);
    const q = orientation;
    group.quaternion.set(q[i + 1], q[i + 2], q[i + 3], q[i]);
    group.quaternion.slerp(next.set(q[j + 1], q[j + 2], q[j + 3], q[j]), sample.part);
    level(time);
    bends.forEach((bend) => bend(sample));
  };
  return { name: body.name, group, place, paints: [material, pale], origin: body.origin,
           kind: "body" };
}

/// Half the size of the symbol of a joint: small beside the scene and beside what it joins.
function symbolSize(joint, bodies) {
  let least = 0.032 * RADIUS;
  for (const { name, group } of bodies) {
    const parts = group.children.filter((part) => part.isMesh && part.userData.name === name);
    if (!joint.bodies.includes(name) || parts.length === 0) continue;
    const boxes = parts.map(({ geometry }) => (geometry.computeBoundingBox(), geometry.boundingBox));
    const box = boxes.reduce((all, other) => all.union(other), boxes[0].clone());
    least = Math.min(least, 0.12 * Math.max(...box.getSize(new L.Vector3()).toArray()));
  }
  return least;
}

/// Parts of the symbol of a joint along z, s half its size: cylinders about x, y, z, or a ball.
function symbolParts(type, s) {
  const pin = (axis, length = 2.4, radius = 0.42) => {
    const geometry = new L.CylinderGeometry(radius * s, radius * s, length * s, 14);
    if (axis === "z") geometry.rotateX(Math.PI / 2);
    if (axis === "x") geometry.rotateZ(Math.PI / 2);
    return geometry;
  };
  const ball = () => new L.SphereGeometry(0.8 * s, 12, 8); // small: few panels are enough
  const rail = () => new L.BoxGeometry(0.55 * s, 0.55 * s, 3.4 * s);
  const known = {
    revolute: () => [pin("z")],
    screw: () => [pin("z", 3.4, 0.3), pin("z", 1, 0.55)],
    cylindrical: () => [pin("z", 3.4, 0.3), pin("z", 1.2, 0.55)],
    prismatic: () => [rail()],
    sliding: () => [rail(), ball()],
    universal: () => [pin("x"), pin("y")],
    fixed: () => [new L.BoxGeometry(s, s, s)],
    planar: () => [new L.BoxGeometry(2.4 * s, 2.4 * s, 0.25 * s)],
  };
  return (known[type] ?? (() => [ball()]))();
}

function makeJoint(joint, bodies, scene) {
  const group = new L.Group();
  const paint = new L.MeshPhongMaterial({ color: joint.driven ? 0xe8590c : 0x343a40 });
  const hidden = new L.MeshLambertMaterial({ // seen through what covers it
    color: paint.color, depthTest: false, transparent: true, opacity: 0.3,
  });
  for (const geometry of symbolParts(joint.type, symbolSize(joint, bodies))) {
    const mesh = new L.Mesh(geometry, paint);
    mesh.userData.name = joint.name;
    const ghost = new L.Mesh(geometry, hidden);
    ghost.renderOrder = 3;
    ghost.raycast = () => {};
    group.add(mesh, ghost);
  }
  const up = new L.Vector3(0, 0, 1);
  group.quaternion.setFromUnitVectors(up, new L.Vector3(...joint.axis));
  const carrier = bodies.find((body) => body.name === joint.body);
  const center = DATA.bodies.find((body) => body.name === joint.body)?.center ?? [0, 0, 0];
  group.position.set(...joint.point.map((x, c) => x - center[c]));
  (carrier?.group ?? scene).add(group);
  const text = `${joint.type} joint of ${joint.bodies.join(" and ")}`;
  return { name: joint.name, group, paints: [paint], kind: "joint",
           origin: joint.driven ? `${text}, with a power take-off` : text };
}
