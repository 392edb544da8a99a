// Hulls that bend: x + sum q_k phi_k(x), in the axes of the body, before the body moves.

/// Moves the corners of a surface and of its edges by the shapes of the modes at a sample.
function bending(body, geometry, edges, shapes) {
  const { kept } = geometry.userData, places = geometry.attributes.position;
  const amplitudes = numbers(body.amplitudes), size = shapes.length / body.modes;
  const rest = places.array.slice(), known = new Map();
  const key = (p, i) => [0, 1, 2].map((c) => Math.round((p[i + c] / RADIUS) * 1e5)).join();
  kept.forEach((_, i) => known.set(key(rest, 3 * i), i));
  const lines = edges.attributes.position, ends = [];
  for (let i = 0; i < lines.array.length; i += 3) ends.push(known.get(key(lines.array, i)));
  return (sample) => {
    places.array.set(rest);
    for (let k = 0; k < body.modes; ++k) {
      const q = between(amplitudes, body.modes, sample, k);
      kept.forEach((from, i) => {
        for (let c = 0; c < 3; ++c) places.array[3 * i + c] += q * shapes[k * size + from + c];
      });
    }
    ends.forEach((from, i) => {
      for (let c = 0; c < 3; ++c) lines.array[3 * i + c] = places.array[3 * from + c];
    });
    places.needsUpdate = lines.needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere(); // what lies outside of it is neither drawn nor picked
    edges.computeBoundingSphere();
  };
}

/// Corners of the surface of a body in its axes, from its centre of gravity, as they are drawn [m].
function drawnCorners(body) {
  const { geometry } = body.group.children.find((part) => part.isMesh);
  const { array } = geometry.attributes.position;
  return [...geometry.index.array].flatMap((i) => [...array.subarray(3 * i, 3 * i + 3)]);
}
