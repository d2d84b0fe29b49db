// What the page can do beyond showing: filter claims, sort tables, open what a link names, move motions through time.
"use strict";

// --- Links open what they lead to.
function open_target() {
  const target = location.hash.length > 1 && document.getElementById(location.hash.slice(1));
  if (!target) return;
  for (let element = target; element; element = element.parentElement) {
    if (element instanceof HTMLDetailsElement) element.open = true;
    if (element.classList.contains("claim")) element.hidden = false;
  }
  target.scrollIntoView();
}
addEventListener("hashchange", open_target);

// --- Claims by verdict, problem and whose they are.
for (const form of document.querySelectorAll(".filter")) {
  const claims = [...document.querySelectorAll(".claim")];
  const choices = [...form.querySelectorAll("select")];
  const apply = () => {
    for (const claim of claims) {
      claim.hidden = choices.some((choice) => choice.value && claim.dataset[choice.dataset.filter] !== choice.value);
    }
    form.querySelector("output").value = claims.filter((claim) => !claim.hidden).length + " of " + claims.length + " claims";
  };
  form.addEventListener("change", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
  apply();
}

// --- Tables sort by a column: numbers by size, texts by letters, empty fields last.
function compare(a, b) {
  if (a === "" || b === "") return (a === "") - (b === "");
  const x = Number(a), y = Number(b);
  return Number.isNaN(x) || Number.isNaN(y) ? a.localeCompare(b) : x - y;
}
function sort_by(head) {
  const column = head.cellIndex;
  const direction = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
  for (const other of head.parentElement.cells) other.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
  const body = head.closest("table").tBodies[0];
  const text = (row) => row.cells[column].textContent.trim();
  const rows = [...body.rows].sort((a, b) => {
    const order = compare(text(a), text(b));
    return text(a) === "" || text(b) === "" ? order : direction * order;
  });
  body.append(...rows);
}
for (const head of document.querySelectorAll("thead th")) {
  const button = document.createElement("button");
  button.type = "button";
  button.append(...head.childNodes);
  head.append(button);
  button.addEventListener("click", () => sort_by(head));
}

// --- Motions.
function element(name, attributes, parent) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  parent.append(made);
  return made;
}
// The number at time t between the nodes.
function between(times, values, t) {
  let k = 1;
  while (k < times.length - 1 && times[k] < t) ++k;
  const share = Math.min(1, Math.max(0, (t - times[k - 1]) / (times[k] - times[k - 1])));
  return values[k - 1] + share * (values[k] - values[k - 1]);
}
function start_motion(figure) {
  const data = JSON.parse(figure.querySelector("script").textContent);
  const svg = figure.querySelector("svg");
  const all_x = [0, ...data.points.flatMap((point) => point.x)], all_y = [0, ...data.points.flatMap((point) => point.y)];
  const low_x = Math.min(...all_x), low_y = Math.min(...all_y);
  const size = Math.max(Math.max(...all_x) - low_x, Math.max(...all_y) - low_y);
  const margin = 0.06 * size;
  const width = Math.max(...all_x) - low_x + 2 * margin, height = Math.max(...all_y) - low_y + 2 * margin;
  svg.setAttribute("viewBox", [low_x - margin, -Math.max(...all_y) - margin, width, height].join(" "));
  const radius = 0.015 * size;
  element("circle", { class: "origin", cx: 0, cy: 0, r: 0.6 * radius }, svg);
  for (const point of data.points) {
    element("polyline", { class: "path", points: point.x.map((x, k) => x + "," + -point.y[k]).join(" ") }, svg);
  }
  const rods = data.points.map((point) => (point.rod ? element("line", { class: "rod" }, svg) : null));
  const marks = data.points.map((point) => {
    const mark = element("circle", { class: "point", r: radius }, svg);
    element("title", {}, mark).textContent = point.name;
    return mark;
  });

  const slider = figure.querySelector("input"), button = figure.querySelector("button"), output = figure.querySelector("output");
  const first = data.t[0], duration = data.t[data.t.length - 1] - first;
  const show = () => {
    const t = first + (duration * slider.value) / slider.max;
    let from = [0, 0];
    data.points.forEach((point, i) => {
      const at = [between(data.t, point.x, t), -between(data.t, point.y, t)];
      marks[i].setAttribute("cx", at[0]);
      marks[i].setAttribute("cy", at[1]);
      if (rods[i]) {
        for (const [key, value] of [["x1", from[0]], ["y1", from[1]], ["x2", at[0]], ["y2", at[1]]]) rods[i].setAttribute(key, value);
      }
      from = at;
    });
    output.value = "t = " + t.toPrecision(3) + " " + data.unit;
  };
  // Nothing moves unless it is asked to; where motion is not wanted, Play goes to the end in steps.
  const seconds = 5, calm = matchMedia("(prefers-reduced-motion: reduce)");
  let begun = null;
  const stop = () => { begun = null; button.textContent = "Play"; };
  const frame = (now) => {
    if (begun === null) return;
    const share = Math.min(1, (now - begun) / (1000 * seconds));
    slider.value = slider.max * (calm.matches ? Math.floor(share * 10) / 10 : share);
    show();
    if (share < 1) requestAnimationFrame(frame); else stop();
  };
  button.addEventListener("click", () => {
    if (begun !== null) return stop();
    button.textContent = "Pause";
    const share = Number(slider.value) < Number(slider.max) ? slider.value / slider.max : 0;
    begun = performance.now() - 1000 * seconds * share;
    requestAnimationFrame(frame);
  });
  slider.addEventListener("input", () => { stop(); show(); });
  show();
}
for (const section of document.querySelectorAll("#motions")) {
  section.querySelectorAll(".motion").forEach(start_motion);
  section.hidden = false;
}

// --- Print shows what is closed on the screen.
addEventListener("beforeprint", () => document.querySelectorAll(".claim").forEach((claim) => { claim.open = true; }));
open_target();
