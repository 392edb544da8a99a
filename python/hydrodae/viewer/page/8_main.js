// Camera, light, picking, and the loop that draws.

const canvas = byId("scene");

/// Whether WebGL is drawn by the processor: then resolution is what costs.
function softwareGl(gl) {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  return /swiftshader|llvmpipe|software/i.test(name);
}

function makeRenderer() {
  const probe = document.createElement("canvas").getContext("webgl2");
  if (!probe) {
    const trouble = document.createElement("div");
    trouble.id = "trouble";
    trouble.textContent = "This browser shows no WebGL 2: switch hardware acceleration on, or take "
      + "another browser.";
    document.body.append(trouble);
    throw new Error("no WebGL 2");
  }
  const software = softwareGl(probe);
  const renderer = new L.WebGLRenderer({ canvas, antialias: !software, alpha: true });
  return { renderer, software };
}

const { renderer, software } = makeRenderer();
const scene = new L.Scene();
const camera = new L.PerspectiveCamera(32, 1, RADIUS / 100, RADIUS * 200);
camera.up.set(0, 0, 1);
const lights = makeLights(scene);

const bodies = DATA.bodies.map(makeBody);
bodies.forEach((body) => scene.add(body.group));
const joints = DATA.joints.map((joint) => makeJoint(joint, bodies, scene));
const lines = makeLines(scene);
const spots = DATA.spots.map((spot) => makeSpot(spot, scene));
const water = DATA.sea ? makeWater() : null;
if (water) scene.add(water.mesh);
const bed = DATA.bed !== null ? makeBed() : null;
if (bed) scene.add(bed);
const surfaces = new Surfaces(scene, lights.uniforms);
const edges = bodies.flatMap((body) => body.group.children.filter((part) => part.isLineSegments));
const labels = makeLabels(bodies);
drawLegend(lines.range);
describe();

const controls = new L.OrbitControls(camera, canvas);
controls.target.set(...DATA.home.center);
controls.minDistance = RADIUS / 20, controls.maxDistance = RADIUS * 60;

/// Distance from which the whole box around the scene is seen in a direction, with a margin.
function fitting(direction) {
  const up = Math.tan((camera.fov * Math.PI) / 360), across = up * camera.aspect;
  const right = new L.Vector3().crossVectors(camera.up, direction).normalize();
  const above = new L.Vector3().crossVectors(direction, right);
  let distance = 0.5 * RADIUS;
  for (let i = 0; i < 8; ++i) {
    const corner = new L.Vector3(...DATA.home.half.map((h, c) => ((i >> c) & 1 ? h : -h)));
    const near = corner.dot(direction);
    distance = Math.max(distance, near + Math.abs(corner.dot(right)) / (0.82 * across),
      near + Math.abs(corner.dot(above)) / (0.78 * up));
  }
  return distance;
}

/// Puts the camera at an azimuth (from +x) and elevation [deg], `zoom` times as near as usual.
function look(azimuth, elevation, zoom = 1) {
  const a = (azimuth * Math.PI) / 180, e = (elevation * Math.PI) / 180;
  const direction = new L.Vector3(Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e));
  controls.target.set(...DATA.home.center);
  const distance = fitting(direction) / zoom;
  camera.position.copy(controls.target).addScaledVector(direction, distance);
  controls.update();
  redraw();
}

let dirty = true, still = 2 * Math.min(devicePixelRatio, 1), ratio = 0, last = 0, slow = 0;
let bare = software ? 1 : 0;
if (!software) still = devicePixelRatio;
const least = 0.35;
let moving = Math.min(still, software ? 0.8 : still);
const player = new Player(() => redraw());
const curves = new Curves((time) => player.seek(time));

function redraw() {
  dirty = true;
}

function resize() {
  const { innerWidth: width, innerHeight: height } = window;
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  renderer.setSize(width, height, false);
  redraw();
}

function draw(level = player.playing ? bare : 0) {
  const wanted = player.playing ? moving : still;
  if (wanted !== ratio) renderer.setPixelRatio((ratio = wanted));
  showDetails(level);
  const sample = sampleAt(player.time);
  bodies.forEach((body) => body.place(sample, player.time));
  const pixel = (2 * Math.tan((camera.fov * Math.PI) / 360)) / window.innerHeight;
  lines.place(sample, camera, pixel);
  spots.forEach((spot) => spot.place(sample, camera, pixel));
  water?.place(player.time);
  lights.aim(camera, controls.target);
  renderer.render(scene, camera);
  labels.place(camera, window.innerWidth, window.innerHeight);
  drawAxes(camera);
  drawScale(pixel * camera.position.distanceTo(controls.target));
  curves.mark(player.time);
}

/// While it moves, what costs most for its worth is left out first if 30 frames a second are not
/// reached: pixels, light at each pixel and the net of the water, edges and points of the water, more
/// pixels; and comes back if there is time.
function adapt(milliseconds) {
  slow = 0.9 * slow + 0.1 * milliseconds;
  if (slow > 29) {
    if (moving > 0.6) moving = Math.max(0.6, 0.8 * moving);
    else if (bare < 2) ++bare;
    else moving = Math.max(least, 0.85 * moving);
    slow = 22;
  } else if (slow < 16.8) {
    if (moving < 0.6) moving = Math.min(0.6, 1.1 * moving);
    else if (bare > 0) --bare;
    else moving = Math.min(still, 1.1 * moving);
    slow = 20;
  }
}

function showDetails(level) {
  if (water) water.net.visible = level < 1, water.mesh.userData.showFewer(level > 1);
  surfaces.show(level > 0);
  for (const lines of edges) lines.visible = level < 2;
}

function frame(now) {
  requestAnimationFrame(frame);
  const passed = now - last;
  last = now;
  if (player.playing) {
    player.advance(Math.min(passed, 200) / 1000);
    adapt(passed);
    dirty = true;
  }
  if (!dirty) return;
  dirty = false;
  draw();
}

const caster = new L.Raycaster();
let picked = null;

function thingAt(event) {
  const at = new L.Vector2((2 * event.clientX) / innerWidth - 1, 1 - (2 * event.clientY) / innerHeight);
  caster.setFromCamera(at, camera);
  const solid = [...bodies, ...joints, ...spots].flatMap((b) => b.group.children.filter((c) => c.isMesh));
  const hit = caster.intersectObjects([...solid, lines.mesh], false)[0];
  if (!hit) return null;
  return thing(hit.object.userData.name ?? lines.mesh.userData.names[hit.instanceId]);
}

function thing(name) {
  const found = [...bodies, ...joints, ...spots].find((b) => b.name === name);
  if (found) return found;
  const line = DATA.lines.find((l) => l.name === name);
  return line ? { name, paints: [], origin: `${line.kind} of ${line.bodies.join(" and ")}` } : null;
}

function pick(what) {
  picked?.paints.forEach((paint) => paint.emissive.set(0));
  picked = what;
  if (picked) {
    picked.paints.forEach((paint) => paint.emissive.set(0x553311));
    curves.open(picked);
  } else curves.close();
  redraw();
}

let down = null;
canvas.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
canvas.addEventListener("pointerup", (event) => {
  if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) pick(thingAt(event));
});
const hint = document.createElement("span");
hint.className = "hint";
hint.style.visibility = "hidden";
byId("labels").append(hint);
canvas.addEventListener("pointermove", (event) => {
  const found = event.buttons || player.playing ? null : thingAt(event);
  hint.style.visibility = found ? "visible" : "hidden";
  hint.textContent = found?.name ?? "";
  hint.style.transform = `translate(${event.clientX + 12}px, ${event.clientY + 12}px)`;
});
document.addEventListener("keydown", (event) => event.key === "Escape" && pick(null));

for (const [name, view] of Object.entries(DATA.views)) {
  const button = document.createElement("button");
  button.textContent = name;
  button.onclick = () => look(...view);
  byId("views").append(button);
}

function addSwitch(name, on, call) {
  const button = document.createElement("button");
  button.textContent = name;
  const set = (value) => {
    button.setAttribute("aria-pressed", value);
    call(value);
    redraw();
  };
  button.onclick = () => set(button.getAttribute("aria-pressed") !== "true");
  set(on);
  byId("switches").append(button);
}

function seeThrough(on) {
  for (const paint of bodies.flatMap((body) => body.paints)) {
    paint.transparent = on, paint.opacity = on ? 0.35 : 1, paint.depthWrite = !on;
    paint.needsUpdate = true;
  }
}

if (water) addSwitch("water", true, (on) => (water.mesh.visible = on));
if (bed) addSwitch("seabed", true, (on) => (bed.visible = on));
addSwitch("names", DATA.bodies.length <= 24, (on) => labels.show(on));
addSwitch("see through", false, seeThrough);

window.addEventListener("resize", resize);
controls.addEventListener("change", redraw);
resize();
look(...DATA.camera);
requestAnimationFrame(frame);

/// What programs use: picture and video, tests.
window.hydrodae = {
  times: TIME, player, look, redraw,
  show(time, level) { player.toggle(false), player.seek(time), draw(level), (dirty = false); },
  pick: (name) => pick(thing(name)),
  elevation: (t, x, y) => elevationAt(t)(x, y),
  place: (name) => bodies.find((body) => body.name === name).group.position.toArray(),
  corners: (name) => drawnCorners(bodies.find((body) => body.name === name)),
  resolution: () => ratio,
  leftOut: () => bare,
  sharpen: (pixels) => (still = pixels),
  hideControls() { document.body.classList.add("still"); },
};
