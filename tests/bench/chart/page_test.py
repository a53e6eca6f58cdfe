#!/usr/bin/env python3
"""The chart's page in a real browser: at desktop and phone width, in light and dark.

usage: page_test.py SAMPLE_PAGE [PICTURES]

SAMPLE_PAGE is the program that writes the pages; PICTURES a folder for screenshots, for a person to look at. Exit
status 77 (skipped) where there is no Chromium.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

import browser

# What a visible plot holds, and whether anything in it lies over anything else.
PLOTS = """[...document.querySelectorAll("figure.chart")].map((figure) => {
  const data = JSON.parse(document.getElementById("data").textContent)[figure.dataset.plot];
  const svgs = [...figure.querySelectorAll("svg.plot")].filter((svg) => svg.checkVisibility());
  const isa = document.querySelector('input[name="isa"]:checked').value;
  const labels = [...(svgs[0]?.querySelectorAll("text.label") ?? [])].map((text) => text.getBoundingClientRect());
  let collisions = 0;
  labels.forEach((a, i) => labels.slice(i + 1).forEach((b) => {
    // Boxes of lines are taller than their letters.
    const inset = a.height * 0.15;
    if (a.left < b.right && b.left < a.right && a.top + inset < b.bottom - inset && b.top + inset < a.bottom - inset)
      ++collisions;
  }));
  return {
    plot: figure.dataset.plot, drawings: svgs.length, layout: svgs[0]?.classList[1], shown: svgs[0]?.parentElement.dataset.isa,
    points: svgs[0]?.querySelectorAll(".point[data-point]").length, labels: labels.length, collisions,
    expected: Object.values(data).filter((point) => isa in point.cost).length,
    others: svgs[0]?.querySelectorAll(".other[data-point]").length, isa,
    at: [...(svgs[0]?.querySelectorAll(".dot") ?? [])].map((dot) => dot.getAttribute("cx")).join(),
  };
})"""
POINT = """(() => {
  const point = [...document.querySelectorAll(".point[data-point]")].find((p) => p.checkVisibility());
  point.scrollIntoView({block: "center", behavior: "instant"});
  const box = point.querySelector(".dot").getBoundingClientRect();
  return {x: box.x + box.width / 2, y: box.y + box.height / 2, id: point.dataset.point};
})()"""
TOOLTIP = """(() => {
  const tip = document.getElementById("tooltip"), box = tip.getBoundingClientRect();
  return {visible: tip.checkVisibility(), text: tip.textContent, left: box.left, top: box.top, right: box.right,
          bottom: box.bottom, width: innerWidth, height: innerHeight};
})()"""
FURTHER = """(() => {
  const plots = Object.values(JSON.parse(document.getElementById("data").textContent));
  const point = plots.find((plot) => "POINT" in plot)["POINT"];
  const isa = document.querySelector('input[name="isa"]:checked').value;
  return {columns: Object.keys(point.extra),
          others: Object.keys(point.cost).filter((name) => name !== isa).map((name) => " " + name)};
})()"""

failures = []


def check(holds, what):
    if not holds:
        failures.append(what)
        print("FAILED:", what)


def check_plots(page, where, compared):
    plots = page.evaluate(PLOTS)
    check(len(plots) == 3, f"{where}: three plots, found {len(plots)}")
    for plot in plots:
        name = f"{where}: {plot['plot']}"
        check(plot["drawings"] == 1, f"{name}: one drawing is shown, not {plot['drawings']}")
        check(plot["shown"] == plot["isa"], f"{name}: the drawing of {plot['isa']} is shown, not {plot['shown']}")
        check(plot["points"] == plot["expected"] > 0, f"{name}: {plot['expected']} points, found {plot['points']}")
        check(plot["collisions"] == 0, f"{name}: {plot['collisions']} labels collide")
        check(plot["labels"] >= 0.9 * plot["points"], f"{name}: {plot['labels']} labels for {plot['points']} points")
        narrow = "narrow" if page.evaluate("innerWidth") < 600 else "wide"
        check(plot["layout"] == narrow, f"{name}: the {narrow} layout, not {plot['layout']}")
        check(plot["others"] == (plot["points"] if compared else 0), f"{name}: {plot['others']} points of the other run")
    return plots


def check_tooltip(page, where):
    page.mouse("mouseMoved", 1, 1)
    point = page.evaluate(POINT)
    page.mouse("mouseMoved", point["x"], point["y"])
    tip = page.evaluate(TOOLTIP)
    check(tip["visible"], f"{where}: the tooltip appears over a point")
    for word in ("ns", "Method error", "Arithmetic", "Formula", "Source", "Code"):
        check(word in tip["text"], f"{where}: the tooltip says '{word}': {tip['text']}")
    further = page.evaluate(FURTHER.replace("POINT", point["id"]))
    for word in further["columns"]:
        check((word in tip["text"]) == (not word.endswith(tuple(further["others"]))),
              f"{where}: the tooltip has the further columns of this instruction set, '{word}': {tip['text']}")
    check(tip["left"] >= 0 and tip["top"] >= 0 and tip["right"] <= tip["width"] and tip["bottom"] <= tip["height"],
          f"{where}: the tooltip is inside the window: {tip}")
    lit = page.evaluate(f"document.querySelectorAll('tr.active[data-point=\"{point['id']}\"]').length")
    check(lit == 1, f"{where}: the point's row lights up, {lit} do")
    page.mouse("mouseMoved", 1, 1)
    check(not page.evaluate(TOOLTIP)["visible"], f"{where}: the tooltip goes away")
    page.evaluate(POINT.replace("scrollIntoView", "focus({preventScroll: false}); point.scrollIntoView"))
    check(page.evaluate(TOOLTIP)["visible"], f"{where}: the tooltip appears at a point with the keyboard's focus")
    page.press("Escape")
    check(not page.evaluate(TOOLTIP)["visible"], f"{where}: Escape hides the tooltip")


def check_instruction_sets(page, where, compared):
    before = check_plots(page, where, compared)
    for isa in ("sse42", "avx2"):
        box = page.evaluate(f"""(() => {{
          const box = document.querySelector('input[value="{isa}"]').nextElementSibling.getBoundingClientRect();
          return {{x: box.x + box.width / 2, y: box.y + box.height / 2}};
        }})()""")
        page.click(box["x"], box["y"])
        after = check_plots(page, f"{where}, {isa}", compared)
        check(after[0]["shown"] == isa, f"{where}: {isa} is shown once chosen")
        check(after[0]["at"] != before[0]["at"], f"{where}: points stand elsewhere for {isa}")
        chosen = page.evaluate(f"document.querySelectorAll('td.chosen[data-column-isa=\"{isa}\"]').length")
        check(chosen > 0, f"{where}: the columns of {isa} are marked")


def check_table(page, where):
    values = page.evaluate("""(() => {
      const table = document.querySelector("table[data-plot]"), head = table.querySelectorAll("th[aria-sort]")[2];
      head.querySelector("button").click();
      return [head.getAttribute("aria-sort"), ...[...table.tBodies[0].rows].map((row) => Number(row.cells[2].dataset.value))];
    })()""")
    check(values[0] == "ascending" and values[1:] == sorted(values[1:]), f"{where}: a column sorts its table: {values}")
    check(page.evaluate("[...document.querySelectorAll('table')].every((t) => t.caption && t.querySelector('th[scope]'))"),
          f"{where}: every table has a caption and headers")


def check_page(page, url, width, dark, compared, pictures):
    where = f"{'compared' if compared else 'plain'}, {width} px, {'dark' if dark else 'light'}"
    page.look(width, 900 if width > 600 else 760, dark)
    page.open(url)
    overflow = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    check(overflow <= 0, f"{where}: {overflow} pixels too wide")
    check(page.evaluate("[...document.images].every((i) => i.alt && i.complete && i.naturalWidth > 0)"),
          f"{where}: every picture is there and has words")
    check(page.evaluate("document.images.length") == 9, f"{where}: nine error maps")
    check(page.evaluate("document.querySelector('.about').innerHTML").find("<b>") < 0, f"{where}: text is not markup")
    if pictures:
        page.picture(os.path.join(pictures, where.replace(", ", "-").replace(" ", "") + ".png"), whole=True)
    check_instruction_sets(page, where, compared)
    check_tooltip(page, where)
    if pictures:
        page.evaluate(POINT.replace("scrollIntoView", "blur(); point.focus(); point.scrollIntoView"))
        page.picture(os.path.join(pictures, where.replace(", ", "-").replace(" ", "") + "-tooltip.png"))
    check_table(page, where)
    check(not page.complaints, f"{where}: the browser complains: {page.complaints}")
    outside = [url for url in page.requests if not url.startswith(("file:", "data:", "about:"))]
    check(not outside, f"{where}: nothing is fetched, but {outside}")
    page.complaints.clear()
    page.requests.clear()


def main():
    program = browser.find()
    if not program:
        print("skipped: there is no Chromium here")
        return 77
    pictures = sys.argv[2] if len(sys.argv) > 2 else None
    if pictures:
        os.makedirs(pictures, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="tessera-chart-") as folder:
        subprocess.run([sys.argv[1], folder], check=True, stdout=subprocess.DEVNULL)
        page = browser.Browser(program)
        try:
            for name in ("plain", "compared"):
                url = pathlib.Path(folder, name, "index.html").as_uri()
                for width in (1280, 375):
                    for dark in (False, True) if name == "plain" else (False,):
                        check_page(page, url, width, dark, name == "compared", pictures)
        finally:
            page.close()
    print("failures:", len(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
