// Plays the recorded frames of the running belt. Finds its data in #animation-data and its controls by their ids;
// window.beltlife_animation has play(), pause(), range(index), seek(ms) and state(), for whoever drives it by script.
(() => {
'use strict';
const data = JSON.parse(document.getElementById('animation-data').textContent);
const element = name => document.getElementById('animation-' + name);
const canvas = element('picture'), pen = canvas.getContext('2d');
const [playButton, rangeList, speedList, timeSlider, now] = ['play', 'range', 'speed', 'time', 'now'].map(element);

// Positions in m and tensions in N as they were recorded, to within half a step of the coding.
function decoded(range) {
  const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const places = (text, low, high) => {
    const b = bytes(text), to = new Float32Array(b.length / 2);
    for (let i = 0; i < to.length; ++i) to[i] = low + (high - low) * (b[2 * i] + 256 * b[2 * i + 1]) / 65535;
    return to;
  };
  const [left, right, bottom, top] = data.box, [low, high] = range.tension_n;
  const r = {...range, x: places(range.x, left, right), y: places(range.y, bottom, top)};
  r.tension = Float32Array.from(bytes(range.tension), b => low + (high - low) * b / 255);
  r.length = r.time_ms[r.time_ms.length - 1];
  // Which way the belt runs along its nodes: +1, -1, or 0 at rest.
  let along = 0, far = 0;
  for (let i = 0; i < r.nodes; ++i) {
    const next = (i + 1) % r.nodes, dx = r.x[r.nodes + i] - r.x[i], dy = r.y[r.nodes + i] - r.y[i];
    along += dx * (r.x[next] - r.x[i]) + dy * (r.y[next] - r.y[i]);
    far = Math.max(far, Math.hypot(dx, dy));
  }
  r.ahead = far < 1e-5 ? 0 : Math.sign(along);
  return r;
}

const ranges = data.ranges.map(() => null);
let shown, time = 0, playing = false, visible = true, last = 0, asked = 0;
const slower = () => Number(speedList.value);

// The drive between two frames: positions on cubics through the frames beside them, all else straight.
function moment(r, t) {
  const times = r.time_ms, count = times.length;
  let k = 0;
  while (k < count - 2 && times[k + 1] <= t) ++k;
  const before = Math.max(k - 1, 0), after = Math.min(k + 2, count - 1), span = times[k + 1] - times[k];
  const u = (t - times[k]) / span, v = 1 - u;
  const a = v * v * (1 + 2 * u), b = u * u * (1 + 2 * v);
  const c = v * v * u * span / (times[k + 1] - times[before]), d = u * u * v * span / (times[after] - times[k]);
  const cubic = p => {
    const out = new Float32Array(r.nodes), n = r.nodes;
    for (let i = 0; i < n; ++i) {
      const p0 = p[before * n + i], p1 = p[k * n + i], p2 = p[(k + 1) * n + i], p3 = p[after * n + i];
      out[i] = a * p1 + b * p2 + c * (p2 - p0) - d * (p3 - p1);
    }
    return out;
  };
  const line = (from, to) => from.map((value, i) => v * value + u * to[i]);
  return {x: cubic(r.x), y: cubic(r.y), turn: line(r.turn[k], r.turn[k + 1]),
          tension: line(r.tension.subarray(k * r.nodes, (k + 1) * r.nodes),
                        r.tension.subarray((k + 1) * r.nodes, (k + 2) * r.nodes)),
          centre: r.centre.length ? line(r.centre[k], r.centre[k + 1]) : null};
}

// The same colours as in the layout: from slack, blue, to tight, red.
function colour(value, [low, high]) {
  const s = high > low ? Math.min(Math.max((value - low) / (high - low), 0), 1) : 0.5;
  const mix = (slack, tight) => Math.round(slack + (tight - slack) * s);
  return `rgb(${mix(20, 220)},${mix(90, 30)},${mix(210, 40)})`;
}

const box = (() => {
  let [left, right, bottom, top] = data.box;
  for (const p of data.pulleys) {
    left = Math.min(left, p.x - p.radius);
    right = Math.max(right, p.x + p.radius);
    bottom = Math.min(bottom, p.y - p.radius);
    top = Math.max(top, p.y + p.radius);
  }
  const margin = 0.04 * Math.max(right - left, top - bottom);
  return {left: left - margin, right: right + margin, bottom: bottom - margin, top: top + margin};
})();

function draw() {
  // As large as leaves the controls on the screen: beside the picture if it is a narrow one, else below.
  const foot = 34, wide = box.right - box.left, high = box.top - box.bottom, room = canvas.parentElement.clientWidth;
  const within = share => (Math.min(Math.max(share * window.innerHeight, 320), 760) - foot) / high;
  const beside = room - within(0.85) * wide > 360;
  const scale = beside ? within(0.85) : Math.min(room / wide, within(0.62));
  const width = wide * scale, height = high * scale + foot;
  const dense = window.devicePixelRatio || 1, size = Math.min(Math.max(width / 620, 0.6), 1);
  if (canvas.width !== Math.round(width * dense) || canvas.height !== Math.round(height * dense)) {
    canvas.width = Math.round(width * dense);
    canvas.height = Math.round(height * dense);
    canvas.style.width = width + 'px';
    canvas.style.height = height + 'px';
  }
  pen.setTransform(dense, 0, 0, dense, 0, 0);
  pen.clearRect(0, 0, width, height);
  const X = x => (x - box.left) * scale, Y = y => (box.top - y) * scale;
  const m = moment(shown, time), n = shown.nodes;
  const centre = i => data.arm && i === data.arm.pulley && m.centre ? m.centre : [data.pulleys[i].x, data.pulleys[i].y];
  const disc = (x, y, radius, fill, stroke) => {
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    if (fill) { pen.fillStyle = fill; pen.fill(); }
    if (stroke) { pen.strokeStyle = stroke; pen.stroke(); }
  };
  const ray = (x0, y0, x1, y1) => { pen.beginPath(); pen.moveTo(x0, y0); pen.lineTo(x1, y1); pen.stroke(); };

  data.pulleys.forEach((p, i) => {
    const [cx, cy] = centre(i), x = X(cx), y = Y(cy), radius = p.radius * scale;
    pen.lineWidth = 1;
    disc(x, y, radius, p.front ? '#e9eef3' : '#f4efe6', '#999');
    for (let spoke = 0; spoke < 3; ++spoke) {
      const angle = m.turn[i] + spoke * 2 * Math.PI / 3, ux = Math.cos(angle), uy = -Math.sin(angle);
      pen.strokeStyle = spoke ? '#c3c9cf' : '#333';
      pen.lineWidth = (spoke ? 2 : 4) * size;
      ray(x + 0.2 * radius * ux, y + 0.2 * radius * uy, x + 0.9 * radius * ux, y + 0.9 * radius * uy);
    }
    pen.lineWidth = 1;
    disc(x, y, Math.max(2, 0.1 * radius), '#fff', '#777');
  });
  if (data.arm && m.centre) {
    pen.globalAlpha = 0.6;
    pen.lineCap = 'round';
    pen.lineWidth = 6 * size;
    pen.strokeStyle = '#555';
    ray(X(data.arm.x), Y(data.arm.y), X(m.centre[0]), Y(m.centre[1]));
    pen.globalAlpha = 1;
    pen.lineCap = 'butt';
    disc(X(data.arm.x), Y(data.arm.y), 5 * size, '#333');
  }

  pen.lineWidth = 6 * size;
  pen.lineCap = 'round';
  for (let i = 0; i < n; ++i) {
    const next = (i + 1) % n;
    pen.strokeStyle = colour(m.tension[i], shown.tension_n);
    ray(X(m.x[i]), Y(m.y[i]), X(m.x[next]), Y(m.y[next]));
  }
  pen.lineCap = 'butt';
  const dots = Math.max(1, Math.round(n / 96)), heads = 6;  // an arrow head every so many dots
  for (let i = 0, count = 0; i + dots <= n; i += dots, ++count) {
    const x = X(m.x[i]), y = Y(m.y[i]), next = (i + 1) % n;
    const dx = shown.ahead * (X(m.x[next]) - x), dy = shown.ahead * (Y(m.y[next]) - y), length = Math.hypot(dx, dy);
    if (count % heads || length === 0) { disc(x, y, 1.3 * size, '#fff'); continue; }
    const ux = 5 * size * dx / length, uy = 5 * size * dy / length;
    pen.beginPath();
    pen.moveTo(x + 1.5 * ux, y + 1.5 * uy);
    pen.lineTo(x - ux - uy, y - uy + ux);
    pen.lineTo(x - ux + uy, y - uy - ux);
    pen.closePath();
    pen.fillStyle = '#fff';
    pen.fill();
    pen.lineWidth = 1.2;
    pen.strokeStyle = '#333';
    pen.stroke();
  }
  pen.lineWidth = 2.5 * size;
  disc(X(m.x[0]), Y(m.y[0]), 7 * size, null, '#111');

  pen.font = `bold ${Math.round(9 + 3 * size)}px Helvetica, sans-serif`;
  pen.textAlign = 'center';
  pen.lineJoin = 'round';
  data.pulleys.forEach((p, i) => {
    const [x, y] = centre(i), half = 0.5 * pen.measureText(p.name).width + 2;
    const middle = Math.max(half, Math.min(X(x), width - half));  // inside the picture
    pen.lineWidth = 3;
    pen.strokeStyle = '#fff';
    pen.strokeText(p.name, middle, Y(y) + 4);
    pen.fillStyle = '#111';
    pen.fillText(p.name, middle, Y(y) + 4);
    // The mark's end once more, where a name may hide it.
    const reach = 0.8 * p.radius;
    disc(X(x + reach * Math.cos(m.turn[i])), Y(y + reach * Math.sin(m.turn[i])), 3 * size, '#333');
  });
  pen.font = '12px Helvetica, sans-serif';
  pen.textAlign = 'left';
  pen.lineWidth = 2;
  pen.strokeStyle = '#333';
  ray(8, height - 22, 8 + 0.1 * scale, height - 22);
  pen.fillStyle = '#333';
  pen.fillText('100 mm', 8, height - 6);
}

function tell() {
  const place = `${time.toFixed(1)} ms of ${shown.length.toFixed(1)} ms`;
  timeSlider.value = Math.round(1000 * time / shown.length);
  timeSlider.setAttribute('aria-valuetext', place);
  now.textContent = `${place}, at 1/${slower()} of real speed` +
                    (shown.crank_rpm ? `; driven body at ${shown.crank_rpm} r/min.` : '.');
}

function show() {
  draw();
  tell();
}

function choose(index) {
  ranges[index] = ranges[index] || decoded(data.ranges[index]);
  shown = ranges[index];
  time = 0;
  rangeList.value = index;
  const [low, high] = shown.tension_n.map(value => Math.round(value) + ' N');
  element('low').textContent = low;
  element('high').textContent = high;
  element('printed').textContent = `Printed is the first frame of range ${shown.name}.`;
  canvas.setAttribute('aria-label', `The running belt in range ${shown.name}, coloured by tension from ${low}, blue, ` +
                                    `to ${high}, red`);
  show();
}

function tick(at) {
  asked = 0;
  if (!playing || !visible) { last = 0; return; }
  // A tab that slept goes on where it was.
  if (last) time = (time + Math.min(at - last, 100) / slower()) % shown.length;
  last = at;
  show();
  ask();
}
function ask() { if (!asked) asked = requestAnimationFrame(tick); }

function play(on) {
  playing = on;
  last = 0;
  playButton.textContent = on ? 'Pause' : 'Play';
  if (on) ask();
}

function seek(ms) {
  time = Math.min(Math.max(ms, 0), shown.length);
  show();
}

playButton.addEventListener('click', () => play(!playing));
rangeList.addEventListener('change', () => choose(Number(rangeList.value)));
speedList.addEventListener('change', tell);
timeSlider.addEventListener('input', () => {
  play(false);
  seek(timeSlider.value / 1000 * shown.length);
});
window.addEventListener('resize', draw);
let beforePrint = 0;
window.addEventListener('beforeprint', () => { beforePrint = time; seek(0); });
window.addEventListener('afterprint', () => seek(beforePrint));
if (window.IntersectionObserver)
  new IntersectionObserver(seen => {
    visible = seen[seen.length - 1].isIntersecting;
    if (visible && playing) ask();
  }).observe(canvas);

choose(data.first);
play(!window.matchMedia('(prefers-reduced-motion: reduce)').matches);
window.beltlife_animation = {
  play: () => play(true), pause: () => play(false), range: choose, seek,
  state: () => ({range: shown.name, time_ms: time, length_ms: shown.length, playing, slower: slower(),
                 ...moment(shown, time)})};
})();
