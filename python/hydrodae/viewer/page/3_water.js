// The free surface of the run's own waves, and the seabed.

const CELLS = 56;

/// Part of their height that the waves have at time t: a polynomial of degree 7, then 1.
function growth(t) {
  if (!(DATA.sea.ramp > 0) || t >= DATA.sea.ramp) return 1;
  const x = Math.max(t / DATA.sea.ramp, 0);
  return x ** 4 * (35 + x * (-84 + x * (70 - 20 * x)));
}

/// Elevation at time t by place: ramp(t) sum a cos(w t - k.x + phase).
function elevationAt(t) {
  const table = numbers(DATA.sea.waves), ramp = growth(t), waves = [];
  for (let i = 0; i < table.length; i += 5) {
    const [w, k, heading, a, phase] = table.subarray(i, i + 5);
    waves.push(ramp * a, w * t + phase, k * Math.cos(heading), k * Math.sin(heading));
  }
  return (x, y) => {
    let sum = 0;
    for (let i = 0; i < waves.length; i += 4)
      sum += waves[i] * Math.cos(waves[i + 1] - waves[i + 2] * x - waves[i + 3] * y);
    return sum;
  };
}

/// Elevations on a grid: ramp(t) sum a cos(w t - k.x + phase), by products of factors in x and y.
class Waves {
  constructor(xs, ys) {
    const table = numbers(DATA.sea.waves);
    this.count = table.length / 5;
    this.omega = [], this.amplitude = [], this.phase = [];
    const along = [], across = [];
    for (let c = 0; c < this.count; ++c) {
      const [w, k, heading, a, phase] = table.subarray(5 * c, 5 * c + 5);
      this.omega.push(w), this.amplitude.push(a), this.phase.push(phase);
      along.push(k * Math.cos(heading)), across.push(k * Math.sin(heading));
    }
    this.same = across.every((k) => Math.abs(k * ys[ys.length - 1]) < 1e-4); // crests along y
    this.nx = xs.length, this.ny = ys.length;
    this.x = this.factors(xs, along), this.y = this.factors(ys, across);
    for (const name of ["re", "im", "pr", "pi"]) this[name] = new Float64Array(this.count);
    this.z = new Float32Array(this.nx * this.ny);
    this.highest = this.amplitude.reduce((sum, a) => sum + a * a, 0);
    this.highest = 2 * Math.sqrt(Math.max(this.highest, 1e-30)); // of most crests
  }

  factors(points, k) {
    const re = new Float32Array(points.length * this.count), im = new Float32Array(re.length);
    points.forEach((x, i) => k.forEach((kc, c) => {
      re[i * this.count + c] = Math.cos(kc * x);
      im[i * this.count + c] = -Math.sin(kc * x);
    }));
    return { re, im };
  }

  at(t) {
    const { count, nx, ny, re, im, pr, pi, x, y, z } = this, ramp = growth(t);
    for (let c = 0; c < count; ++c) {
      const angle = this.omega[c] * t + this.phase[c], a = ramp * this.amplitude[c];
      pr[c] = a * Math.cos(angle), pi[c] = a * Math.sin(angle);
    }
    for (let j = 0; j < ny; ++j) {
      if (j > 0 && this.same) {
        z.copyWithin(j * nx, 0, nx);
        continue;
      }
      for (let c = 0, o = j * count; c < count; ++c, ++o) {
        re[c] = pr[c] * y.re[o] - pi[c] * y.im[o];
        im[c] = pr[c] * y.im[o] + pi[c] * y.re[o];
      }
      for (let i = 0; i < nx; ++i) {
        let sum = 0;
        for (let c = 0, o = i * count; c < count; ++c, ++o) sum += re[c] * x.re[o] - im[c] * x.im[o];
        z[j * nx + i] = sum;
      }
    }
    return z;
  }
}

/// A square of points in a plane whose opacity fades towards a circle.
function fadingPlane(middle, half, cells, colour, opacity) {
  const n = cells + 1, count = n * n;
  const position = new Float32Array(3 * count), normal = new Float32Array(3 * count);
  const colours = new Float32Array(4 * count), fine = [], coarse = [];
  const paint = new L.Color(colour);
  const panel = (index, i, j, size) => { // within the circle
    if (i + size > cells || j + size > cells) return;
    const middle = (k) => (2 * k + size) / cells - 1, v = j * n + i, up = size * n;
    if (Math.hypot(middle(i), middle(j)) < 1 + (2 * size) / cells)
      index.push(v, v + size, v + up + size, v, v + up + size, v + up);
  };
  for (let j = 0, v = 0; j < n; ++j)
    for (let i = 0; i < n; ++i, ++v) {
      const u = (2 * i) / cells - 1, w = (2 * j) / cells - 1;
      position.set([middle[0] + half * u, middle[1] + half * w, middle[2]], 3 * v);
      normal.set([0, 0, 1], 3 * v);
      const fade = Math.min(Math.max((1 - Math.hypot(u, w)) / 0.25, 0), 1);
      colours.set([paint.r, paint.g, paint.b, opacity * fade * fade * (3 - 2 * fade)], 4 * v);
      panel(fine, i, j, 1);
      if (i % 2 === 0 && j % 2 === 0) panel(coarse, i, j, 2);
    }
  const geometry = new L.BufferGeometry();
  geometry.setAttribute("position", new L.BufferAttribute(position, 3));
  geometry.setAttribute("normal", new L.BufferAttribute(normal, 3));
  geometry.setAttribute("color", new L.BufferAttribute(colours, 4));
  geometry.setIndex([...fine, ...coarse]);
  const show = (few) => few ? geometry.setDrawRange(fine.length, coarse.length)
    : geometry.setDrawRange(0, fine.length);
  show(false);
  const material = new L.MeshPhongMaterial({
    vertexColors: true, transparent: true, depthWrite: false, side: L.DoubleSide,
    forceSinglePass: true, specular: 0x446677, shininess: 70,
  });
  const mesh = new L.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.userData.showFewer = show; // every second point
  return mesh;
}

/// Every fourth row of the points of a plane as a line, which shows how it is bent.
function gridLines(plane) {
  const n = CELLS + 1, index = [], colours = new Float32Array(4 * n * n);
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < n; ++i) {
      const fade = plane.attributes.color.array[4 * (j * n + i) + 3];
      colours.set([1, 1, 1, 0.5 * fade], 4 * (j * n + i));
      if (j % 4 === 0 && i < CELLS) index.push(j * n + i, j * n + i + 1);
      if (i % 4 === 0 && j < CELLS) index.push(j * n + i, (j + 1) * n + i);
    }
  const geometry = new L.BufferGeometry();
  geometry.setAttribute("position", plane.attributes.position);
  geometry.setAttribute("color", new L.BufferAttribute(colours, 4));
  geometry.setIndex(index);
  const lines = new L.LineSegments(geometry, new L.LineBasicMaterial({
    vertexColors: true, transparent: true, depthWrite: false,
  }));
  lines.renderOrder = 2.5;
  lines.frustumCulled = false;
  return lines;
}

function makeWater() {
  const half = DATA.home.water, [x0, y0] = DATA.home.center;
  const mesh = fadingPlane([x0, y0, 0], half, CELLS, "#2b7fb0", 0.55);
  mesh.renderOrder = 2;
  const net = gridLines(mesh.geometry);
  mesh.add(net);
  const n = CELLS + 1, step = (2 * half) / CELLS;
  const grid = (x) => Array.from({ length: n }, (_, i) => x - half + i * step);
  const waves = new Waves(grid(x0), grid(y0));
  const { position, normal, color } = mesh.geometry.attributes;
  const deep = new L.Color("#0b5a94"), light = new L.Color("#6cc5ee"), paint = new L.Color();
  const place = (t) => {
    if (waves.count === 0) return;
    const z = waves.at(t);
    for (let j = 0, v = 0; j < n; ++j)
      for (let i = 0; i < n; ++i, ++v) {
        position.array[3 * v + 2] = z[v];
        const dx = z[v + (i < CELLS ? 1 : 0)] - z[v - (i > 0 ? 1 : 0)];
        const dy = z[v + (j < CELLS ? n : 0)] - z[v - (j > 0 ? n : 0)];
        const size = Math.hypot(dx, dy, 2 * step);
        normal.array[3 * v] = -dx / size;
        normal.array[3 * v + 1] = -dy / size;
        normal.array[3 * v + 2] = (2 * step) / size;
        paint.lerpColors(deep, light, Math.min(Math.max(0.4 + (0.5 * z[v]) / waves.highest, 0), 1));
        color.array[4 * v] = paint.r, color.array[4 * v + 1] = paint.g;
        color.array[4 * v + 2] = paint.b;
      }
    position.needsUpdate = normal.needsUpdate = color.needsUpdate = true;
  };
  return { mesh, net, place };
}

function makeBed() {
  const [x, y] = DATA.home.center;
  const mesh = fadingPlane([x, y, DATA.bed], DATA.home.bed, 24, "#c8b48a", 0.75);
  mesh.material.specular.set(0);
  mesh.renderOrder = 1;
  return mesh;
}
