// The page is readable without this; it adds filters, figures and tables that unpack when opened, moving trajectories.
"use strict";
const all = (selector, inside = document) => [...inside.querySelectorAll(selector)];
const node = (tag, set = {}, ...children) => { const made = Object.assign(document.createElement(tag), set); made.append(...children); return made; };
const drawn = (tag, attributes, parent, text) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
};
const words = (name) => name.replaceAll("_", " ");

// Numbers with an exponent stay on one line. The markup is the page's own.
const keep_numbers = (part) => { part.innerHTML = part.innerHTML.replace(/\d[\d.]*e-\d+/g, '<span class="number-kept">$&</span>'); };

// --- Light and dark
const root = document.documentElement, theme = document.getElementById("theme"), prefers = matchMedia("(prefers-color-scheme: dark)");
const is_dark = () => (root.dataset.theme ? root.dataset.theme === "dark" : prefers.matches);
const settle = () => { root.classList.toggle("dark-figures", is_dark()); theme.setAttribute("aria-pressed", is_dark()); };
theme.hidden = false;
theme.onclick = () => { root.dataset.theme = is_dark() ? "light" : "dark"; settle(); };
prefers.addEventListener("change", settle);
settle();

// --- Packed data: zlib as base64 in elements of the page
async function unpacked(name) {
  const packed = document.getElementById("data-" + name);
  if (!packed) return null;
  const bytes = Uint8Array.from(atob(packed.textContent), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
}
const tables = new Map();
function table_of(file) {
  if (!tables.has(file)) tables.set(file, unpacked("table-" + file).then((text) => text && JSON.parse(text)));
  return tables.get(file);
}

// --- Figures: an image runs no script and fetches no file
const addresses = new Map();
function address(name) {
  if (!addresses.has(name)) addresses.set(name, unpacked("figure-" + name).then((svg) => svg && URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }))));
  return addresses.get(name);
}
const large = document.getElementById("large");
async function enlarge(name) {
  const url = await address(name);
  if (!url) return;
  large.querySelector("b").textContent = words(name);
  Object.assign(large.querySelector("a"), { href: url, download: name + ".svg" });
  large.querySelector("div").replaceChildren(node("img", { src: url, alt: words(name) }));
  large.showModal();
}
large.addEventListener("click", (event) => { if (event.target === large) large.close(); });
async function draw(button) {
  if (button.childElementCount) return;
  button.hidden = false;
  button.append(node("img", { src: await address(button.dataset.figure), alt: "" }));
}
document.addEventListener("click", (event) => {
  const button = event.target.closest("[data-figure]");
  if (button) { event.preventDefault(); enlarge(button.dataset.figure); }
  const link = event.target.closest("[data-records]"), table = link && document.getElementById(decodeURIComponent(link.hash.slice(1)));
  if (!table) return;
  Object.assign(table.dataset, { records: link.dataset.records, columns: link.dataset.columns });
  table.only?.(link.dataset.records, link.dataset.columns);
  if (location.hash === link.hash) open_target();
});

// --- Tables: 50 rows at a time, sorted by a head, constant columns in a sentence
const brief = (text) => { if (!/^-?\d+\.\d{5,}|^-?[\d.]+e[-+]\d/.test(text)) return text; const v = Number(text); return String(Number(v.toPrecision(6))); };
const is_number = (text) => text !== "" && !Number.isNaN(+text);
const compare = (a, b) => (is_number(a) && is_number(b) ? a - b : a.localeCompare(b));
async function show_table(details) {
  if (details.dataset.shown) return;
  details.dataset.shown = "yes";
  const table = await table_of(details.id.slice("table-".length)), names = table.columns.map((column) => column.name);
  const every = table.rows.map((fields, i) => ({ fields, record: i + 2 }));  // claims count the head as record 1
  const status = names.indexOf("status"), size = 50;
  const places = names.map((name, i) => i), differs = (i) => every.length < 2 || every.some((row) => row.fields[i] !== every[0].fields[i]);
  const differing = places.filter(differs).sort((a, b) => (b === status) - (a === status)), constant = places.filter((i) => !differs(i) && every[0]?.fields[i]);
  if (constant.length) details.append(node("p", { className: "muted", textContent: "In all rows " + constant.map((i) => names[i] + " = " + brief(every[0].fields[i])).join(", ") }));
  let rows = [...every], columns = differing, first = 0, by = -1, down = false;
  const body = node("tbody"), heads = node("tr"), place = node("span"), said = node("p", { className: "muted", hidden: true });
  const back = node("button", { type: "button", textContent: "◂ previous" }), next = node("button", { type: "button", textContent: "next ▸" });
  const fill = () => {
    body.replaceChildren(...rows.slice(first, first + size).map(({ fields }) => node("tr", { className: status >= 0 && fields[status] !== "solved" ? "unsolved" : "" },
      ...columns.map((i) => node("td", { textContent: brief(fields[i]), title: fields[i], className: is_number(fields[i]) ? "n" : "" })))));
    place.textContent = `rows ${Math.min(first + 1, rows.length)} to ${Math.min(first + size, rows.length)} of ${rows.length.toLocaleString("en")}`;
    back.disabled = first === 0;
    next.disabled = first + size >= rows.length;
  };
  const sort = (i) => {
    down = by === i && !down;
    by = i;
    const is_empty = (row) => row.fields[i] === "";
    rows.sort((a, b) => (is_empty(a) || is_empty(b) ? is_empty(a) - is_empty(b) : (down ? -1 : 1) * compare(a.fields[i], b.fields[i])));
    first = 0;
    fill();
    for (const head of heads.cells) head.ariaSort = +head.dataset.i === i ? (down ? "descending" : "ascending") : "none";
  };
  const draw_heads = () => heads.replaceChildren(...columns.map((i) => {
    const { unit, meaning } = table.columns[i];
    const head = node("th", { scope: "col", title: meaning }, node("button", { type: "button", textContent: words(names[i]) + (unit ? ` [${unit}]` : ""), onclick: () => sort(i) }));
    head.dataset.i = i;
    return head;
  }));
  details.only = (records, wanted) => {  // the rows and columns behind a verdict, or all again
    const ranges = (records ?? "").split(" ").filter(Boolean).map((range) => range.split("-").map(Number));
    rows = ranges.length ? every.filter((row) => ranges.some(([a, b = a]) => row.record >= a && row.record <= b)) : [...every];
    const named = places.filter((i) => i === status || (wanted ?? "").split(" ").includes(names[i]));
    columns = ranges.length && named.length ? named : differing;
    first = 0;
    said.hidden = !ranges.length;
    said.replaceChildren(`Evidence: ${rows.length} of ${every.length} rows. `, node("button", { type: "button", textContent: "Show all", onclick: () => details.only() }));
    draw_heads();
    fill();
  };
  back.onclick = () => { first -= size; fill(); };
  next.onclick = () => { first += size; fill(); };
  if (!every.length || !differing.length) return;
  const box = node("div", { className: "scroll", tabIndex: 0, role: "region", ariaLabel: "rows of " + details.id.slice("table-".length) }, node("table", {}, node("thead", {}, heads), body));
  details.append(said, box);
  if (every.length > size) details.append(node("p", { className: "pages" }, back, next, place));
  details.only(details.dataset.records, details.dataset.columns);
}

// --- Motions: vertices of the paths in the page are the places at the instants of the motion
// The number at time t between the instants.
function between(times, values, t) {
  let k = 1;
  while (k < times.length - 1 && times[k] < t) ++k;
  const share = Math.min(1, Math.max(0, (t - times[k - 1]) / (times[k] - times[k - 1])));
  return values[k - 1] + share * (values[k] - values[k - 1]);
}
// A point that keeps its distance from the one before, or the first one from the origin, is at the end of a rod.
const is_rod = (from, to) => { const lengths = to.x.map((x, k) => Math.hypot(x - (from?.x[k] ?? 0), to.y[k] - (from?.y[k] ?? 0))), most = Math.max(...lengths); return most > 0 && most - Math.min(...lengths) < 2e-3 * most; };
function start_motion(card) {
  const svg = card.querySelector(".motion"), controls = card.querySelector(".controls");
  if (!svg || !controls) return;
  const moving = all("g[data-times]", svg).map((group) => {
    let before;
    const paths = all("polyline", group).map((path) => {
      const vertices = path.getAttribute("points").trim().split(" ").map((vertex) => vertex.split(",").map(Number));
      const point = { x: vertices.map(([x]) => x), y: vertices.map(([, y]) => y) };
      if (is_rod(before, point)) point.rod = drawn("line", { class: "moving" }, group);
      point.mark = drawn("circle", { class: "point", r: svg.dataset.radius }, group);
      before = point;
      return point;
    });
    return { times: group.dataset.times.trim().split(" ").map(Number), paths };
  });
  const cursor = moving.length === 0 && drawn("line", { class: "cursor", y1: 0, y2: svg.viewBox.baseVal.height }, svg);
  const slider = controls.querySelector("input"), button = controls.querySelector("button"), output = controls.querySelector("output");
  const of_what = button.getAttribute("aria-label").replace(/^Play/, "");
  const { begin, end, unit } = svg.dataset;
  const show = () => {
    const share = slider.value / slider.max, t = +begin + (end - begin) * share;
    for (const { times, paths } of moving) {
      let from = [0, 0];
      for (const { x, y, rod, mark } of paths) {
        const at = [between(times, x, t), between(times, y, t)];
        mark.setAttribute("cx", at[0]);
        mark.setAttribute("cy", at[1]);
        if (rod) ["x1", "y1", "x2", "y2"].forEach((key, i) => rod.setAttribute(key, [...from, ...at][i]));
        from = at;
      }
    }
    if (cursor) for (const key of ["x1", "x2"]) cursor.setAttribute(key, 320 * share);
    output.value = `t = ${t.toPrecision(3)} ${unit}`;
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
    begun = performance.now() - 1000 * seconds * (Number(slider.value) < Number(slider.max) ? slider.value / slider.max : 0);
    requestAnimationFrame(frame);
  });
  slider.addEventListener("input", () => { stop(); show(); });
  controls.hidden = false;
  show();
}

// --- What is opened is drawn
document.addEventListener("toggle", (event) => {
  const details = event.target;
  if (!(details instanceof HTMLDetailsElement) || !details.open) return;
  if (details.classList.contains("table")) show_table(details);
  if (details.dataset.shown) return;
  if (details.classList.contains("problem")) {
    details.dataset.shown = "yes";
    const more = details.querySelector("noscript");
    more.outerHTML = more.textContent;  // of this page: texts in it are escaped
    all("dd:not(:has(math))", details).forEach(keep_numbers);
    start_motion(details);
  }
  if (details.classList.contains("claim")) {
    details.dataset.shown = "yes";
    const smalls = node("div", { className: "smalls" });
    for (const link of all("a[data-figure]", details)) {
      const button = node("button", { type: "button", ariaLabel: "Enlarge " + link.textContent });
      button.dataset.figure = link.dataset.figure;
      smalls.append(button);
      draw(button);
    }
    if (smalls.childElementCount) details.append(smalls);
    all("li", details).forEach(keep_numbers);
  }
  for (const button of all(".pair [data-figure]", details)) draw(button);
}, true);
function open_target() {
  const target = location.hash.length > 1 && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  for (let part = target; part; part = part.parentElement) { if (part instanceof HTMLDetailsElement) part.open = true; part.hidden = false; }
  target.scrollIntoView();
}
addEventListener("hashchange", open_target);

// --- Filters of claims and of tables
for (const form of all(".filter")) {
  const section = form.parentElement, select = form.querySelector("select"), search = form.querySelector("input");
  const items = all("details.claim, details.table", section), groups = all("details.group", section);
  const apply = () => {
    const wanted = search.value.trim().toLowerCase(), verdict = select?.value ?? "", narrows = wanted !== "" || verdict !== "";
    for (const item of items) item.hidden = (verdict !== "" && !item.dataset.verdicts.includes(`|${verdict}|`)) || !item.textContent.toLowerCase().includes(wanted);
    for (const group of groups) {
      const some = all("details.claim, details.table", group).some((item) => !item.hidden);
      group.hidden = !some;
      group.open = narrows && some;
    }
    form.querySelector("output").value = narrows ? `${items.filter((item) => !item.hidden).length} of ${items.length}` : "";
  };
  form.addEventListener("input", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
}

open_target();
