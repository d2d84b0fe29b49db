// What the page can do beyond showing: filter claims, sort tables, open what a link names, move motions through time.
"use strict";

let printing = false;

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
  const search = form.querySelector("[data-search]"), groups = [...document.querySelectorAll(".group")];
  const apply = () => {
    const wanted = search.value.trim().toLowerCase();
    for (const claim of claims) {
      claim.hidden = choices.some((choice) => choice.value && claim.dataset[choice.dataset.filter] !== choice.value)
        || (wanted !== "" && !claim.textContent.toLowerCase().includes(wanted));
    }
    // A closed group whose claims were chosen opens.
    const narrows = wanted !== "" || choices.some((choice) => choice.value);
    for (const group of groups) group.open = narrows && [...group.querySelectorAll(".claim")].some((claim) => !claim.hidden);
    form.querySelector("output").value = claims.filter((claim) => !claim.hidden).length + " of " + claims.length + " claims";
  };
  form.addEventListener("change", apply);
  search.addEventListener("input", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
  apply();
}

// --- Answers show their figures small.
for (const link of document.querySelectorAll("a.small")) {
  const drawn = document.getElementById(link.hash.slice(1))?.querySelector("img");
  if (!drawn) continue;
  const name = link.textContent;
  link.replaceChildren(drawn.cloneNode(true));
  link.title = name;
}

// --- On narrow screens figures scroll sideways, by keys too.
const is_narrow = matchMedia("(max-width: 40rem)");
function let_scroll(figure) {
  if (is_narrow.matches) figure.tabIndex = 0;
  else figure.removeAttribute("tabindex");
}
function let_all_scroll() { for (const figure of document.querySelectorAll("figure:not(.motion)")) let_scroll(figure); }
is_narrow.addEventListener("change", let_all_scroll);
let_all_scroll();

// --- A claim that is opened shows its figures in place.
function show_figures(claim) {
  if (claim.dataset.shown) return;
  claim.dataset.shown = "yes";
  for (const link of claim.querySelectorAll("a[href^='#figure-']")) {
    const drawn = document.getElementById(link.hash.slice(1))?.querySelector("img");
    if (!drawn) continue;
    const figure = document.createElement("figure");
    figure.append(drawn.cloneNode(true));
    let_scroll(figure);
    claim.append(figure);
  }
}
for (const claim of document.querySelectorAll(".claim")) claim.addEventListener("toggle", () => { if (claim.open && !printing) show_figures(claim); });

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
function make_sortable(table) {
  if (table.dataset.sortable) return;
  table.dataset.sortable = "yes";
  const terms = [...(table.closest(".table")?.querySelectorAll(".columns dt") ?? [])];
  const meanings = new Map(terms.map((name) => [name.textContent.trim(), name.nextElementSibling.textContent.trim()]));
  for (const head of table.tHead.rows[0].cells) {
    const meaning = meanings.get(head.firstChild.textContent.trim());
    if (meaning) head.title = meaning;
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => sort_by(head));
  }
}
// What is closed is made ready when it is opened: there are hundreds of tables.
for (const table of document.querySelectorAll("table")) if (!table.closest("details")) make_sortable(table);
addEventListener("toggle", (event) => { if (event.target.open) event.target.querySelectorAll("table").forEach(make_sortable); }, true);

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
  const script = figure.querySelector("script");
  if (!script) return;
  const data = JSON.parse(script.textContent);
  const svg = figure.querySelector("svg"), radius = Number(svg.dataset.radius);
  // Curves over time have a line at the time that is shown.
  const cursor = data.cursor && element("line", { class: "cursor", y1: 0, y2: data.cursor.height }, svg);
  const moving = data.motions.map((motion, i) => ({
    ...motion,
    rods: motion.points.map((point) => (point.rod ? element("line", { class: "rod method-" + i }, svg) : null)),
    marks: motion.points.map((point) => {
      const mark = element("circle", { class: "point method-" + i, r: radius }, svg);
      element("title", {}, mark).textContent = motion.method + " " + point.name;
      return mark;
    }),
  }));
  const slider = figure.querySelector("input"), button = figure.querySelector("button"), output = figure.querySelector("output");
  const of_what = button.getAttribute("aria-label").replace(/^Play/, "");
  const first = Math.min(...moving.map((motion) => motion.t[0]));
  const duration = Math.max(...moving.map((motion) => motion.t[motion.t.length - 1])) - first;
  const place = (motion, t) => {
    let from = [0, 0];
    motion.points.forEach((point, i) => {
      const at = [between(motion.t, point.x, t), -between(motion.t, point.y, t)];
      motion.marks[i].setAttribute("cx", at[0]);
      motion.marks[i].setAttribute("cy", at[1]);
      if (motion.rods[i]) {
        for (const [key, value] of [["x1", from[0]], ["y1", from[1]], ["x2", at[0]], ["y2", at[1]]]) motion.rods[i].setAttribute(key, value);
      }
      from = at;
    });
  };
  const show = () => {
    const t = first + (duration * slider.value) / slider.max;
    for (const motion of moving) place(motion, t);
    if (cursor) for (const key of ["x1", "x2"]) cursor.setAttribute(key, (data.cursor.width * slider.value) / slider.max);
    output.value = "t = " + t.toPrecision(3) + " " + data.unit;
    slider.setAttribute("aria-valuetext", output.value);
  };
  // Nothing moves unless it is asked to; where motion is not wanted, Play goes to the end in steps.
  const seconds = 5, calm = matchMedia("(prefers-reduced-motion: reduce)");
  let begun = null;
  const say = (word) => { button.textContent = word; button.setAttribute("aria-label", word + of_what); };
  const stop = () => { begun = null; say("Play"); };
  const frame = (now) => {
    if (begun === null) return;
    const share = Math.min(1, (now - begun) / (1000 * seconds));
    slider.value = slider.max * (calm.matches ? Math.floor(share * 10) / 10 : share);
    show();
    if (share < 1) requestAnimationFrame(frame); else stop();
  };
  button.addEventListener("click", () => {
    if (begun !== null) return stop();
    say("Pause");
    const share = Number(slider.value) < Number(slider.max) ? slider.value / slider.max : 0;
    begun = performance.now() - 1000 * seconds * share;
    requestAnimationFrame(frame);
  });
  slider.addEventListener("input", () => { stop(); show(); });
  figure.querySelector(".controls").hidden = false;
  figure.classList.add("moves");
  show();
}
document.querySelectorAll(".motion").forEach(start_motion);

// --- Print shows what is closed on the screen.
addEventListener("beforeprint", () => { printing = true; document.querySelectorAll(".claim").forEach((claim) => { claim.open = true; }); });
open_target();
