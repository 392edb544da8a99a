// Ropes, mooring lines, springs and rods: pieces of round bar, coloured by their load.

const COLOURS = ["#0d0887", "#6a00a8", "#b12a90", "#e16462", "#fca636"].map((c) => new L.Color(c));
const PLAIN = new L.Color("#3b4750");
const TURNS = 9;

function colourOf(part, out) {
  const at = Math.min(Math.max(part, 0), 1) * (COLOURS.length - 1);
  const i = Math.min(Math.floor(at), COLOURS.length - 2);
  return out.copy(COLOURS[i]).lerp(COLOURS[i + 1], at - i);
}

/// Least and largest load of all lines and times [N]; null if no line has one.
function loadRange() {
  let low = Infinity, high = -Infinity;
  for (const line of DATA.lines)
    if (line.load)
      for (const value of numbers(line.load)) low = Math.min(low, value), high = Math.max(high, value);
  return high >= low ? { low, high: high > low ? high : low + 1 } : null;
}

/// Corners of a spring drawn as a zigzag between two points.
function zigzag(from, to) {
  const along = to.clone().sub(from), length = along.length();
  const side = new L.Vector3(0, 1, 0);
  if (Math.abs(along.y) > 0.8 * length) side.set(1, 0, 0);
  side.cross(along).normalize().multiplyScalar(0.03 * RADIUS);
  const points = [from];
  for (let i = 0; i <= 2 * TURNS; ++i)
    points.push(from.clone().addScaledVector(along, 0.15 + (0.7 * i) / (2 * TURNS))
      .addScaledVector(side, i % 2 ? 1 : i === 0 || i === 2 * TURNS ? 0 : -1));
  return [...points, to];
}

function makeLines(scene) {
  const range = loadRange();
  const pieces = DATA.lines.map((l) => (l.kind === "spring" ? 2 * TURNS + 2 : l.count - 1));
  const total = pieces.reduce((sum, n) => sum + n, 0);
  const bar = new L.CylinderGeometry(1, 1, 1, 8, 1);
  const mesh = new L.InstancedMesh(bar, new L.MeshLambertMaterial(), Math.max(total, 1));
  mesh.count = total;
  mesh.frustumCulled = false;
  mesh.userData.names = DATA.lines.flatMap((line, i) => Array(pieces[i]).fill(line.name));
  scene.add(mesh);

  const up = new L.Vector3(0, 1, 0), along = new L.Vector3(), middle = new L.Vector3();
  const turn = new L.Quaternion(), size = new L.Vector3(), matrix = new L.Matrix4();
  const paint = new L.Color();
  const put = (i, from, to, radius) => {
    along.subVectors(to, from);
    const length = along.length();
    middle.addVectors(from, to).multiplyScalar(0.5);
    if (length > 0) turn.setFromUnitVectors(up, along.multiplyScalar(1 / length));
    mesh.setMatrixAt(i, matrix.compose(middle, turn, size.set(radius, length, radius)));
  };
  const cornersOf = (line, values, sample) => {
    const corners = [];
    for (let k = 0; k < line.count; ++k)
      corners.push(new L.Vector3(...[0, 1, 2].map(
        (c) => between(values, 3 * line.count, sample, 3 * k + c))));
    return line.kind === "spring" ? zigzag(corners[0], corners[1]) : corners;
  };
  /// At least two pixels wide, wherever the camera is.
  const radiusAt = (point, line, camera, pixel) => {
    const thick = line.kind === "rod" || line.kind === "telescope" ? 0.011 : 0.004;
    return Math.max(thick * RADIUS, 1.1 * pixel * camera.position.distanceTo(point));
  };
  const place = (sample, camera, pixel) => {
    let piece = 0;
    DATA.lines.forEach((line) => {
      const corners = cornersOf(line, numbers(line.points), sample);
      const load = line.load && numbers(line.load);
      const width = load ? load.length / TIME.length : 0;
      for (let k = 0; k + 1 < corners.length; ++k, ++piece) {
        put(piece, corners[k], corners[k + 1], radiusAt(corners[k], line, camera, pixel));
        if (load) {
          const value = between(load, width, sample, Math.min(k, width - 1));
          mesh.setColorAt(piece, colourOf((value - range.low) / (range.high - range.low), paint));
        } else mesh.setColorAt(piece, PLAIN);
      }
    });
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    mesh.boundingSphere = null;
  };
  return { mesh, place, range };
}
