// What lies over the scene: labels, axes, scale bar, legend of loads.

const byId = (id) => document.getElementById(id);

function makeLabels(bodies) {
  const holder = byId("labels"), at = new L.Vector3();
  const labels = bodies.map((body) => {
    const span = document.createElement("span");
    span.textContent = body.name;
    holder.append(span);
    const box = body.group.children.filter((part) => part.isMesh);
    let top = 0;
    for (const mesh of box) {
      mesh.geometry.computeBoundingBox();
      top = Math.max(top, mesh.geometry.boundingBox.max.z);
    }
    return { span, body, top };
  });
  const place = (camera, width, height) => {
    const taken = [];
    for (const { span, body, top } of labels) {
      at.copy(body.group.position);
      at.z += top + 0.03 * RADIUS;
      at.project(camera);
      const seen = at.z < 1 && Math.abs(at.x) < 1.05 && Math.abs(at.y) < 1.05;
      const x = ((at.x + 1) / 2) * width, y = ((1 - at.y) / 2) * height;
      const half = 4 * span.textContent.length + 8;
      const free = !taken.some((t) => Math.abs(t.x - x) < t.half + half && Math.abs(t.y - y) < 22);
      span.style.visibility = seen && free ? "visible" : "hidden";
      if (seen && free) taken.push({ x, y, half });
      span.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -100%)`;
    }
  };
  return { place, show: (on) => (holder.style.display = on ? "" : "none") };
}

/// Main direction of the waves [rad], weighted by their energy; null in still water.
function mainHeading() {
  if (!DATA.sea || DATA.sea.waves[1] === 0) return null;
  const table = numbers(DATA.sea.waves);
  let x = 0, y = 0;
  for (let i = 0; i < table.length; i += 5) {
    x += table[i + 3] ** 2 * Math.cos(table[i + 2]);
    y += table[i + 3] ** 2 * Math.sin(table[i + 2]);
  }
  return Math.hypot(x, y) > 0 ? Math.atan2(y, x) : null;
}

let turned = null;

function drawAxes(camera) {
  if (turned?.equals(camera.quaternion)) return;
  turned = camera.quaternion.clone();
  const heading = mainHeading(), svg = byId("axes"), inverse = camera.quaternion.clone().invert();
  const arms = [["x", [1, 0, 0], "#c92a2a"], ["y", [0, 1, 0], "#2b8a3e"], ["z", [0, 0, 1], "#1864ab"]];
  if (heading !== null)
    arms.push(["waves", [Math.cos(heading), Math.sin(heading), 0], "#0b7285"]);
  const drawn = arms.map(([name, axis, colour]) => {
    const v = new L.Vector3(...axis).applyQuaternion(inverse);
    const wave = name === "waves", from = wave ? [-v.x * 40, v.y * 40] : [0, 0];
    const reach = wave ? -14 : 30;
    const dash = wave ? ' stroke-dasharray="4 3"' : "";
    const label = wave ? [from[0] * 0.6, from[1] * 0.6 + 10] : [v.x * 40, -v.y * 40];
    const size = wave ? ' style="font-size:10px"' : "";
    return [v.z, `<g stroke="${colour}" fill="${colour}"><line x1="${from[0]}" y1="${from[1]}"
      x2="${v.x * reach}" y2="${-v.y * reach}" stroke-width="2.5"${dash}/>
      <text stroke="none" x="${label[0]}" y="${label[1]}"${size}>${name}</text></g>`];
  });
  svg.innerHTML = drawn.sort((a, b) => a[0] - b[0]).map((d) => d[1]).join("");
}

/// A round length of some 120 pixels at the distance of the middle of the picture.
function drawScale(metresPerPixel) {
  const most = 150 * metresPerPixel, power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map((f) => f * power).find((l) => l <= most);
  const bar = byId("scale");
  bar.style.width = `${length / metresPerPixel}px`;
  bar.firstElementChild.textContent = withUnit(length, "m");
}

function drawLegend(range) {
  if (!range) return;
  byId("legend").hidden = false;
  const canvas = byId("colours"), pen = canvas.getContext("2d"), paint = new L.Color();
  for (let y = 0; y < canvas.height; ++y) {
    pen.fillStyle = `#${colourOf(1 - y / canvas.height, paint).getHexString()}`;
    pen.fillRect(0, y, canvas.width, 1);
  }
  byId("most").textContent = withUnit(range.high, "N");
  byId("least").textContent = withUnit(range.low, "N");
}

function describe() {
  document.title = byId("title").textContent = DATA.title;
  const span = TIME.length > 1 ? `, ${Number(FIRST.toPrecision(6))} to ${Number(LAST.toPrecision(6))} s` : "";
  byId("state").textContent = DATA.state + span;
  const say = (text) => {
    const item = document.createElement("li");
    item.textContent = text;
    byId("notes").append(item);
  };
  DATA.bodies.forEach((body) => say(`${body.name}: ${body.origin}`));
  if (DATA.joints.some((joint) => joint.driven)) say("orange joints: with a power take-off");
  DATA.notes.forEach(say);
}
