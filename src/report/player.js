"use strict";
(() => {
  const data = document.getElementById("motion-data");
  if (!data) return;
  const motion = JSON.parse(data.textContent);
  const byId = (id) => document.getElementById(id);
  const [player, stage, play, scrub, time, speed] = ["player", "stage", "play", "scrub", "time", "speed"].map(byId);
  const times = motion.t, last = times.length - 1, end = times[last];
  if (!(end > 0)) return;

  // Where joint j (-1: the body) is at sample i; null where it is not there.
  const place = (j, i) => {
    const all = j < 0 ? motion.body : motion.points[j].at;
    const x = all[2 * i], y = all[2 * i + 1];
    return x === null || y === null ? null : [x, y];
  };
  // The sample at or before a time; of two at one time the later one.
  const sample = (t) => {
    let low = 0, high = last;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle] <= t) low = middle; else high = middle - 1;
    }
    return low;
  };
  const at = (j, t) => {
    const i = sample(t), from = place(j, i);
    if (from === null || i === last) return from;
    const to = place(j, i + 1), length = times[i + 1] - times[i];
    if (to === null || length <= 0) return from;
    const share = (t - times[i]) / length;
    return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
  };

  // How far the machine reaches around its body, and where it goes.
  const joints = [-1, ...motion.points.keys()];
  let reach = 1e-3;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i <= last; i++) {
    const body = place(-1, i);
    for (const j of joints) {
      const p = place(j, i);
      if (!p || !body) continue;
      reach = Math.max(reach, Math.hypot(p[0] - body[0], p[1] - body[1]));
      box[0] = Math.min(box[0], p[0]); box[1] = Math.min(box[1], p[1]);
      box[2] = Math.max(box[2], p[0]); box[3] = Math.max(box[3], p[1]);
    }
  }
  const wide = box[2] - box[0], high = box[3] - box[1];
  if (reach <= 1e-3) reach = 0.15 * Math.max(wide, high, 0.1);
  // All of the way where the machine is not too small on it; else the view goes along.
  const whole = Math.max(wide, high) <= 7 * reach;
  const view = whole ? Math.max(1.15 * Math.max(wide, high), 2.4 * reach) : 5 * reach;

  const svg = (name, attributes, parent) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    parent.appendChild(made);
    return made;
  };
  const unit = view / 100;
  const world = svg("g", { transform: "scale(1,-1)" }, stage);
  const grid = svg("g", { stroke: "var(--grid)", "stroke-width": 0.25 * unit }, world);
  const trail = svg("path", { fill: "none", stroke: "var(--accent)", "stroke-width": 0.5 * unit, opacity: 0.6 }, world);
  const marks = svg("g", { fill: "var(--muted)" }, world);
  const links = motion.links.map(() => svg("line", { stroke: "var(--ink)", "stroke-width": 1.1 * unit, "stroke-linecap": "round" }, world));
  const dots = motion.points.map((point) => svg("circle", { r: (point.held ? 1.5 : 1.1) * unit, fill: point.held ? "var(--mark)" : "var(--ink)" }, world));
  const body = svg("circle", { r: 2.4 * unit, fill: "var(--accent)" }, world);
  const labels = svg("g", { fill: "var(--muted)", "font-size": 3 * unit }, stage);

  // Round distances of the grid.
  const step = (() => {
    const power = 10 ** Math.floor(Math.log10(view / 5));
    return [1, 2, 5, 10].map((d) => d * power).find((d) => d >= view / 6);
  })();
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const drawGrid = (left, bottom, width, height) => {
    grid.replaceChildren();
    labels.replaceChildren();
    for (let n = Math.ceil(left / step); n * step <= left + width; n++) {
      svg("line", { x1: n * step, x2: n * step, y1: bottom, y2: bottom + height }, grid);
    }
    for (let n = Math.ceil(bottom / step); n * step <= bottom + height; n++) {
      svg("line", { x1: left, x2: left + width, y1: n * step, y2: n * step }, grid);
      // Not where the edge would cut it off.
      if ((n * step) + 4 * unit > bottom + height) continue;
      svg("text", { x: left + unit, y: -(n * step) - 0.6 * unit }, labels).textContent = (n * step).toFixed(decimals) + " m";
    }
  };
  // Attachment points so far stay as small marks.
  const held = motion.points.map((point, j) => (point.held ? j : null)).filter((j) => j !== null);
  const spots = [];
  for (const j of held) {
    let before = null;
    for (let i = 0; i <= last; i++) {
      const p = place(j, i);
      if (p && (!before || Math.hypot(p[0] - before[0], p[1] - before[1]) > 0.2 * unit)) spots.push([times[i], p]);
      before = p;
    }
  }
  const spotDots = spots.map(([, p]) => svg("circle", { cx: p[0], cy: p[1], r: 0.9 * unit }, marks));

  let now = 0, playing = false, before = null, frame = null, drawn = null;
  const draw = () => {
    const shape = stage.getBoundingClientRect();
    const ratio = shape.width > 0 && shape.height > 0 ? shape.width / shape.height : 1;
    const width = view * Math.max(1, ratio), height = view * Math.max(1, 1 / ratio);
    const middle = whole ? [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2] : at(-1, now) || [0, 0];
    const left = middle[0] - width / 2, bottom = middle[1] - height / 2;
    const here = [left, bottom, width, height].join(" ");
    if (here !== drawn) {
      drawn = here;
      stage.setAttribute("viewBox", [left, -bottom - height, width, height].join(" "));
      drawGrid(left, bottom, width, height);
    }
    const set = (circle, p) => {
      circle.setAttribute("visibility", p ? "visible" : "hidden");
      if (p) { circle.setAttribute("cx", p[0]); circle.setAttribute("cy", p[1]); }
    };
    set(body, at(-1, now));
    dots.forEach((dot, j) => set(dot, at(j, now)));
    motion.links.forEach(([a, b], n) => {
      const from = at(a, now), to = at(b, now), line = links[n];
      line.setAttribute("visibility", from && to ? "visible" : "hidden");
      if (!from || !to) return;
      line.setAttribute("x1", from[0]); line.setAttribute("y1", from[1]);
      line.setAttribute("x2", to[0]); line.setAttribute("y2", to[1]);
    });
    const way = [];
    for (let i = 0, until = sample(now); i <= until; i++) {
      const p = place(-1, i);
      if (p) way.push(p[0] + " " + p[1]);
    }
    const p = at(-1, now);
    if (p) way.push(p[0] + " " + p[1]);
    trail.setAttribute("d", way.length ? "M" + way.join("L") : "");
    spotDots.forEach((dot, n) => dot.setAttribute("visibility", spots[n][0] <= now ? "visible" : "hidden"));
    scrub.value = now;
    const shown = now.toFixed(3) + " s";
    scrub.setAttribute("aria-valuetext", shown);
    time.textContent = shown;
  };
  const tick = (stamp) => {
    if (!playing) return;
    if (before !== null) now += Math.min(stamp - before, 100) / 1000 * Number(speed.value);
    if (now > end) now = 0;
    before = stamp;
    draw();
    frame = requestAnimationFrame(tick);
  };
  const run = (wanted) => {
    playing = wanted;
    before = null;
    play.textContent = playing ? "Pause" : "Play";
    if (frame !== null) cancelAnimationFrame(frame);
    if (playing) frame = requestAnimationFrame(tick);
  };
  const go = (t) => { now = Math.min(Math.max(t, 0), end); draw(); };
  // `#t=1.2` opens at that time and stands still.
  const fromAddress = () => {
    const wanted = /^#t=([0-9]+(?:[.][0-9]*)?)$/.exec(location.hash);
    if (wanted) { run(false); go(Number(wanted[1])); }
    return wanted !== null;
  };

  scrub.max = end;
  player.hidden = false;
  play.addEventListener("click", () => run(!playing));
  scrub.addEventListener("input", () => { run(false); go(Number(scrub.value)); });
  stage.addEventListener("click", () => run(!playing));
  addEventListener("hashchange", fromAddress);
  new ResizeObserver(() => draw()).observe(stage);
  draw();
  if (!fromAddress()) run(!matchMedia("(prefers-reduced-motion: reduce)").matches);
})();
