// Curves of what is picked, one chart for each quantity.

const INKS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];

class Curves {
  constructor(seek) {
    this.charts = [];
    this.seek = seek;
    byId("panel").querySelector("button").onclick = () => this.close();
  }

  /// Shows the channels about a body, joint or line.
  open(thing) {
    this.close();
    byId("panel").hidden = false;
    byId("panel").querySelector("h2").textContent = thing.name;
    byId("origin").textContent = thing.origin ?? "";
    const groups = new Map();
    for (const curve of DATA.curves) {
      if (!curve.about.includes(thing.name)) continue;
      const key = `${curve.group} [${curve.unit}]`;
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(curve);
    }
    for (const [title, curves] of groups) this.draw(title, curves);
    this.mark(this.time ?? FIRST);
  }

  draw(title, curves) {
    const holder = document.createElement("div");
    holder.className = "chart";
    byId("charts").append(holder);
    const series = curves.map((curve, i) => (
      { label: curve.label, stroke: INKS[i % INKS.length], width: 1.5,
        points: { show: TIME.length < 2 } }));
    const plot = new L.uPlot({
      title, width: Math.min(376, holder.clientWidth), height: 150, series: [{ label: "t" }, ...series],
      scales: { x: { time: false } }, legend: { show: curves.length > 1, live: false },
      cursor: { drag: { x: false } },
      axes: [{ size: 24 }, { size: 58, values: (_, ticks) => ticks.map(short) }],
    }, [TIME, ...curves.map((curve) => numbers(curve.values))], holder);
    const now = document.createElement("div");
    now.className = "now";
    plot.over.append(now);
    plot.over.addEventListener("click", (event) => {
      const box = plot.over.getBoundingClientRect();
      this.seek(plot.posToVal(event.clientX - box.left, "x"));
    });
    this.charts.push({ plot, now });
  }

  mark(time) {
    this.time = time;
    for (const { plot, now } of this.charts) now.style.left = `${plot.valToPos(time, "x")}px`;
  }

  close() {
    this.charts.forEach(({ plot }) => plot.destroy());
    this.charts = [];
    byId("charts").replaceChildren();
    byId("panel").hidden = true;
  }
}

/// Tick of an axis: 1.2M, 300k, 0.05.
function short(value) {
  if (value === null) return "";
  const size = Math.abs(value);
  const found = [[1e9, "G"], [1e6, "M"], [1e4, "k"]].find(([p]) => size >= p);
  const unit = found ? (found[1] === "k" ? 1e3 : found[0]) : 1;
  return `${Number((value / unit).toPrecision(4))}${found ? found[1] : ""}`;
}
