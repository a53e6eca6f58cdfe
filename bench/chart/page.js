"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const tooltip = document.getElementById("tooltip");
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  let isa = document.querySelector('input[name="isa"]:checked')?.value ?? "";

  // Instruction sets: one drawing of each plot is shown, and its columns are marked.
  const choose = (name) => {
    isa = name;
    hide();
    for (const drawing of all(".drawing")) drawing.hidden = drawing.dataset.isa !== name;
    for (const cell of all("[data-column-isa]")) cell.classList.toggle("chosen", cell.dataset.columnIsa === name);
  };
  for (const input of all('input[name="isa"]')) input.addEventListener("change", () => choose(input.value));

  // Tooltips, and the row of the table and the point of the plot lighting up together.
  const plotOf = (element) => element.closest("[data-plot]")?.dataset.plot;
  const mark = (plot, id, on) => {
    for (const root of all("[data-plot]"))
      if (root.dataset.plot === plot)
        for (const element of all("[data-point]", root))
          if (element.dataset.point === id) element.classList.toggle("active", on);
  };
  const element = (tag, text, name = "") => {
    const made = document.createElement(tag);
    made.textContent = text;
    made.className = name;
    return made;
  };
  const fill = (point) => {
    const list = document.createElement("dl");
    const row = (key, text) => { if (text) list.append(element("dt", key), element("dd", text)); };
    row("Cost", point.cost[isa]);
    row("Against", point.ratio[isa] && `${point.ratio[isa]} × the other run`);
    row("Method error", point.method);
    row("Arithmetic", point.arithmetic);
    const others = Object.keys(point.cost).filter((name) => name !== isa);
    for (const [name, value] of Object.entries(point.extra))
      if (!others.some((other) => name.endsWith(` ${other}`))) row(name, value);
    row("Formula", point.formula);
    row("Source", point.paper);
    row("Code", point.file);
    row("Fails", point.fails);
    row("Note", point.note);
    tooltip.replaceChildren(element("b", point.title, "title"));
    if (point.frontier.includes(isa)) tooltip.append(element("span", "on the Pareto frontier", "badge"));
    tooltip.append(list);
  };
  const place = (target) => {
    const at = target.querySelector(".dot")?.getBoundingClientRect() ?? target.getBoundingClientRect();
    const box = tooltip.getBoundingClientRect(), gap = 12;
    const page = document.documentElement;
    const right = at.right + gap, left = at.left - gap - box.width;
    let x = right + box.width <= page.clientWidth - gap ? right : left;
    let y = at.top + at.height / 2 - box.height / 2;
    if (x < gap) {  // neither side has room: below the point, or above it
      x = at.left + at.width / 2 - box.width / 2;
      y = at.bottom + gap + box.height <= page.clientHeight ? at.bottom + gap : at.top - gap - box.height;
    }
    const within = (value, size, room) => Math.max(gap, Math.min(value, room - size - gap));
    tooltip.style.left = `${within(x, box.width, page.clientWidth)}px`;
    tooltip.style.top = `${within(y, box.height, page.clientHeight)}px`;
  };
  let shown = null;
  const hide = () => {
    if (shown) mark(shown.plot, shown.id, false);
    shown = null;
    tooltip.hidden = true;
  };
  const show = (target) => {
    hide();
    const plot = plotOf(target), id = target.dataset.point;
    const point = data[plot]?.[id];
    if (!point) return;
    shown = {plot, id, target};
    mark(plot, id, true);
    fill(point);
    tooltip.hidden = false;
    place(target);
  };
  for (const point of all("svg [data-point]")) {
    point.addEventListener("pointerenter", () => show(point));
    point.addEventListener("pointerleave", hide);
    point.addEventListener("focus", () => show(point));
    point.addEventListener("blur", hide);
    point.addEventListener("click", (event) => { show(point); event.stopPropagation(); });
    point.setAttribute("aria-describedby", "tooltip");
  }
  for (const row of all("tbody tr[data-point]")) {
    row.addEventListener("pointerenter", () => mark(plotOf(row), row.dataset.point, true));
    row.addEventListener("pointerleave", () => mark(plotOf(row), row.dataset.point, false));
  }
  document.addEventListener("click", hide);
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") hide(); });
  document.addEventListener("scroll", () => { if (shown) place(shown.target); }, {passive: true});

  // Tables sort by any column; what has no number goes last.
  for (const head of all("th[aria-sort]")) {
    head.querySelector("button").addEventListener("click", () => {
      const body = head.closest("table").tBodies[0];
      const column = head.cellIndex;
      const descending = head.getAttribute("aria-sort") === "ascending";
      for (const other of all("th[aria-sort]", head.parentElement)) other.setAttribute("aria-sort", "none");
      head.setAttribute("aria-sort", descending ? "descending" : "ascending");
      const key = (row) => {
        const cell = row.cells[column];
        if (!("value" in cell.dataset)) return cell.querySelector(".name").textContent;
        return cell.dataset.value === "" ? null : Number(cell.dataset.value);
      };
      const order = (a, b) => {
        const x = key(a), y = key(b);
        if (x === null || y === null) return (x === null) - (y === null);
        return (typeof x === "string" ? x.localeCompare(y) : x - y) * (descending ? -1 : 1);
      };
      body.append(...[...body.rows].sort(order));
    });
  }
  // A phone has room for the chosen instruction set's columns only (page.css).
  const phone = matchMedia("(max-width: 720px)");
  const span = () => {
    const columns = phone.matches ? 1 : all('input[name="isa"]').length;
    for (const group of all("th[data-isas]")) group.colSpan = columns;
  };
  phone.addEventListener("change", span);
  span();
  choose(isa);
})();
