// Time: slider, play and pause, speed.

const SPEEDS = [0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50];

class Player {
  constructor(changed) {
    this.time = Math.min(Math.max(DATA.begin, FIRST), LAST), this.playing = false, this.changed = changed;
    this.slider = byId("slider"), this.button = byId("play");
    if (TIME.length < 2) byId("player").hidden = true;
    this.slider.min = FIRST, this.slider.max = LAST;
    this.slider.oninput = () => this.seek(Number(this.slider.value));
    this.button.onclick = () => this.toggle();
    const choice = byId("speed"), span = LAST - FIRST;
    // a short run slowed down until it lasts some seconds
    this.speed = SPEEDS.filter((s) => s <= 1 && span / s >= 5).pop() ?? (span > 0 ? SPEEDS[0] : 1);
    for (const speed of SPEEDS) {
      const option = document.createElement("option");
      option.value = speed, option.textContent = `× ${speed}`;
      option.selected = speed === this.speed;
      choice.append(option);
    }
    choice.onchange = () => (this.speed = Number(choice.value));
    document.addEventListener("keydown", (event) => this.key(event));
    this.digits = Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(span || 1))));
    this.show();
  }

  key(event) {
    if (event.target.tagName === "INPUT" && event.key !== " ") return;
    const step = (LAST - FIRST) / 200;
    if (event.key === " ") this.toggle();
    else if (event.key === "ArrowRight") this.seek(this.time + step);
    else if (event.key === "ArrowLeft") this.seek(this.time - step);
    else return;
    event.preventDefault();
  }

  toggle(on = !this.playing) {
    if (TIME.length < 2) return;
    this.playing = on;
    this.button.textContent = on ? "❚❚" : "▶";
    if (on && this.time >= LAST) this.time = FIRST;
    this.changed();
  }

  seek(time) {
    this.time = Math.min(Math.max(time, FIRST), LAST);
    this.show();
    this.changed();
  }

  /// Goes on by `seconds` of real time; begins again after the end.
  advance(seconds) {
    this.time += seconds * this.speed;
    if (this.time > LAST) this.time = FIRST;
    this.show();
  }

  show() {
    this.slider.value = this.time;
    byId("clock").textContent = `${this.time.toFixed(this.digits)} of ${LAST.toFixed(this.digits)} s`;
  }
}
