// What the file holds: JSON, in which [offset, count] points into one list of 32-bit numbers.

const L = LIBRARIES;
const DATA = JSON.parse(document.getElementById("data").textContent);
const NUMBERS = decode(DATA.numbers);
const TIME = numbers(DATA.time);
const FIRST = TIME[0], LAST = TIME[TIME.length - 1];
const RADIUS = DATA.home.radius; // length of the scene [m]: all sizes of symbols follow from it

function decode(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return new Float32Array(bytes.buffer);
}

function numbers(place) {
  return NUMBERS.subarray(place[0], place[0] + place[1]);
}

/// Sample before time t and the part of the way to the next one.
function sampleAt(t) {
  if (TIME.length < 2 || t <= FIRST) return { at: 0, part: 0 };
  if (t >= LAST) return { at: TIME.length - 2, part: 1 };
  let low = 0, high = TIME.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (TIME[middle] <= t) low = middle;
    else high = middle;
  }
  return { at: low, part: (t - TIME[low]) / (TIME[low + 1] - TIME[low]) };
}

/// Straight-line value of component c of `width` at a sample.
function between(values, width, sample, c) {
  const i = sample.at * width + c;
  const next = Math.min(i + width, values.length - width + c);
  return values[i] + sample.part * (values[next] - values[i]);
}

/// Number with three figures and its unit in a size that people read: 12.3 kN, 4 mm.
function withUnit(value, unit) {
  const prefixes = unit === "m" ? [[1e3, "k"], [1, ""], [1e-2, "c"], [1e-3, "m"]]
    : [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"]];
  if (value === 0) return `0 ${unit}`;
  const size = Math.abs(value);
  const found = prefixes.find(([p]) => size >= p * 0.9999) ?? prefixes[prefixes.length - 1];
  return `${Number((value / found[0]).toPrecision(3))} ${found[1]}${unit}`;
}
