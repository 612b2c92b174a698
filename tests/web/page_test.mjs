// The report in a browser: page_test.mjs WEB RUN COMPARISON SCALARS OUT
//   WEB has node_modules; RUN is a folder of make_run with its report.html (200 frames, about 5,000
//   triangles); COMPARISON a page of two runs; SCALARS a folder as RUN of a run with bulk scalars; OUT takes
//   the pictures to be looked at.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { findChromium, openBrowser, openPage, pixels, processorSeconds, until } from "./browser.mjs";

const [web, run, comparison, scalars, out] = process.argv.slice(2).map((path) => resolve(path));
const chromium = findChromium();
const report = join(run, "report.html");
const STAGE = ".stage canvas";
let browser;
let opened;
let page;

before(async () => {
  mkdirSync(out, { recursive: true });
  browser = await openBrowser(web, chromium);
  opened = await openPage(browser.context, pathToFileURL(report).href);
  page = opened.page;
  await until(page, () => performance.getEntriesByName("prepared").length > 0);
});
after(() => browser.close());

/** Rows of a table of the run as objects of texts. */
function rowsOf(name) {
  const [head, ...lines] = readFileSync(join(run, name), "utf8").trim().split("\n").map((l) => l.split(","));
  return lines.map((cells) => Object.fromEntries(head.map((column, k) => [column, cells[k]])));
}

function setSlider(at) {
  return page.evaluate((value) => {
    const slider = document.querySelector(".timeline input[type=range]");
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
  }, at);
}

const time = () => page.evaluate(() => window.meniscus.timeline.t);

test("a page of 200 frames is below 20 MB and asks for nothing", () => {
  const size = statSync(report).size;
  console.log(`report.html: ${(size / 1e6).toFixed(2)} MB`);
  assert.ok(size < 20e6);
  assert.deepEqual(opened.requests, [pathToFileURL(report).href]);
});

/** Seconds to show `count` frames in the 3-D view: as the slider is dragged, or one frame drawn anew. */
const drawingSeconds = (count, isDragged) => page.evaluate(async ([frames, isMoved]) => {
  const view = window.meniscus.explorer.views[0];
  const slider = document.querySelector(".timeline input[type=range]");
  const gl = view.canvas.getContext("webgl2");
  const pixel = new Uint8Array(4);
  const begin = performance.now();
  for (let k = 0; k < frames; ++k) {
    slider.value = k;
    await new Promise((drawn) => {
      view.onDrawn = drawn;
      if (isMoved) slider.dispatchEvent(new Event("input"));
      else view.draw();
    });
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits until all is drawn
  }
  view.onDrawn = undefined;
  return (performance.now() - begin) / 1000;
}, [count, isDragged]);

test("the first picture is there within two seconds, or thirty redraws where drawing is slow", async () => {
  const times = [];
  const processor = [];
  for (let i = 0; i < 3; ++i) {
    const before = processorSeconds();
    await page.reload({ waitUntil: "commit" });
    await until(page, () => performance.getEntriesByName("first-picture").length > 0);
    times.push(await page.evaluate(() => {
      const stage = document.querySelector(".stage canvas");
      const copy = document.createElement("canvas").getContext("2d");
      copy.drawImage(stage, stage.width / 2, stage.height / 2, 1, 1, 0, 0, 1, 1);
      const isDrawn = copy.getImageData(0, 0, 1, 1).data[3] === 255; // waits until all is drawn
      return isDrawn ? performance.now() / 1000 : Infinity;
    }));
    processor.push(processorSeconds() - before);
  }
  await until(page, () => performance.getEntriesByName("prepared").length > 0);
  const redraw = (await drawingSeconds(20, false)) / 20;
  const shown = (list) => list.map((t) => t.toFixed(2)).join(", ");
  console.log(`first picture after ${shown(times)} s, of the processors' time ${shown(processor)} s; ` +
    `a redraw ${redraw.toFixed(3)} s`);
  assert.ok(Math.max(...times) < Infinity, "a blank picture");
  assert.ok(Math.min(...times, ...processor) < Math.max(2, 30 * redraw));
});

test("dragging the slider costs at most twice what drawing one frame anew does, at 800 × 600", async (t) => {
  await page.evaluate(() => {
    const stage = document.querySelector(".stage");
    Object.assign(stage.style, { width: "800px", height: "600px" });
  });
  t.after(async () => {
    await page.evaluate(() => document.querySelector(".stage").removeAttribute("style"));
    await until(page, () => document.querySelector(".stage canvas").width !== 800);
  });
  await until(page, () => document.querySelector(".stage canvas").width === 800);
  // Redrawing is the machine's own share: without a graphics card it is nearly all there is.
  const count = 100;
  const pairs = [];
  for (let i = 0; i < 3; ++i)
    pairs.push({ dragged: await drawingSeconds(count, true), redrawn: await drawingSeconds(count, false) });
  const shown = (name) => pairs.map((pair) => (count / pair[name]).toFixed(0)).join(", ");
  console.log(`slider: ${shown("dragged")} frames a second; one frame redrawn: ${shown("redrawn")} a second`);
  assert.ok(Math.min(...pairs.map(({ dragged, redrawn }) => dragged / redrawn)) < 2);
});

test("the slider changes the picture and the time", async () => {
  await setSlider(0);
  const first = await pixels(page, STAGE);
  assert.equal(await time(), 0);
  await setSlider(150);
  assert.notEqual(await pixels(page, STAGE), first);
  assert.ok(Math.abs((await time()) - (6 * 150) / 199) < 1e-9);
  await setSlider(0);
  assert.equal(await pixels(page, STAGE), first);
});

test("play advances and stops", async () => {
  await setSlider(0);
  const first = await pixels(page, STAGE);
  await page.click(".timeline .play");
  await until(page, () => window.meniscus.timeline.at >= 3);
  await page.click(".timeline .play");
  assert.notEqual(await pixels(page, STAGE), first);
  const at = await page.evaluate(() => window.meniscus.timeline.at);
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => window.meniscus.timeline.at), at);
});

test("each field has colours of its own", async () => {
  await setSlider(150);
  const seen = new Set();
  const names = await page.$$eval("#field option", (options) => options.map((option) => option.value));
  assert.deepEqual(names, ["curvature", "normal_velocity", "pressure_jump", "node_density"]);
  for (const name of names) {
    await page.selectOption("#field", name);
    seen.add(await pixels(page, STAGE));
  }
  assert.equal(seen.size, names.length);
  await page.selectOption("#field", "curvature");
});

test("wireframe, opacity, range of colours and views change the picture", async () => {
  const plain = await pixels(page, STAGE);
  const changes = {
    wireframe: () => page.getByLabel("Wireframe").click(),
    opacity: () => page.getByLabel("Opacity").fill("0.4"),
    range: async () => {
      await page.getByLabel("Highest value of the colours").fill("9");
      await page.getByLabel("Highest value of the colours").press("Enter");
    },
    view: () => page.getByRole("button", { name: "x–y" }).click(),
  };
  const undo = {
    wireframe: changes.wireframe,
    opacity: () => page.getByLabel("Opacity").fill("1"),
    range: () => page.getByRole("button", { name: "Auto" }).click(),
    view: () => page.getByRole("button", { name: "Oblique" }).click(),
  };
  for (const name of Object.keys(changes)) {
    await changes[name]();
    assert.notEqual(await pixels(page, STAGE), plain, name);
    await undo[name]();
    assert.equal(await pixels(page, STAGE), plain, `${name} undone`);
  }
});

test("the mouse turns the drop", async () => {
  const plain = await pixels(page, STAGE);
  const box = await page.locator(STAGE).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 30, { steps: 4 });
  await page.mouse.up();
  assert.notEqual(await pixels(page, STAGE), plain);
  await page.getByRole("button", { name: "Oblique" }).click();
});

test("the mouse on a plot shows a value of the table, to the last digit", async () => {
  const rows = rowsOf("drops.csv");
  const over = page.locator(".plot .over").first();
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  for (const share of [0.1, 0.37, 0.8]) {
    await page.mouse.move(box.x + share * box.width, box.y + box.height / 2);
    const value = await page.$eval(".plot .value", (e) => ({ ...e.dataset, text: e.textContent }));
    const row = rows.find(({ t }) => Number(t) === Number(value.t));
    assert.ok(row, `no row at t = ${value.t}`);
    assert.equal(Number(value.value), Number(row.D));
    assert.equal(value.text, `D = ${Number(Number(row.D).toPrecision(6))}`);
  }
  // Linked: the other plots tell their values of the same moment.
  const t = await page.$$eval(".plot", (plots) => plots.map((p) => p.querySelector(".value").dataset.t));
  const hovered = Number(t[0]);
  for (const other of t.slice(1, 4)) assert.ok(Math.abs(Number(other) - hovered) < 0.011);
});

test("a drag zooms in, a double click shows all, log is logarithmic", async () => {
  const over = page.locator(".plot .over").nth(1);
  await over.scrollIntoViewIfNeeded();
  const scales = () => page.evaluate(() => {
    const { area, plot } = window.meniscus.history.plots[1];
    return { min: area.x.min, max: area.x.max, isLog: plot.isLog };
  });
  const box = await over.boundingBox();
  await page.mouse.move(box.x + 0.25 * box.width, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 60, { steps: 4 });
  await page.mouse.up();
  const zoomed = await scales();
  assert.ok(zoomed.min > 1 && zoomed.max < 3.5, JSON.stringify(zoomed));
  await over.dblclick();
  assert.deepEqual([(await scales()).min, (await scales()).max], [0, 6]);
  const first = await page.evaluate(() => window.meniscus.history.plots[0].plot.curves[0].y[0]);
  assert.equal(first, 0); // D of a sphere: left out where the axis is logarithmic
  await page.locator(".plot .log").nth(0).click();
  assert.equal(await page.evaluate(() => window.meniscus.history.plots[0].plot.isLog), true);
  await page.locator(".plot .log").nth(0).click();
  await page.locator(".plot .log").nth(1).click();
  assert.equal((await scales()).isLog, true);
  await page.locator(".plot .log").nth(1).click();
  assert.equal((await scales()).isLog, false);
});

test("a button pressed elsewhere, or another one, changes no window", async () => {
  const over = page.locator(".plot .over").first();
  await over.scrollIntoViewIfNeeded();
  const state = () => page.evaluate(() => [window.meniscus.history.plots[0].plot.window, window.meniscus.timeline.at]);
  const before = await state();
  const box = await over.boundingBox();
  const [y, from, to] = [box.y + box.height / 2, box.x + 0.3 * box.width, box.x + 0.6 * box.width];
  await page.mouse.move(from, box.y + box.height + 60);
  await page.mouse.down();
  await page.mouse.move(to, y, { steps: 4 });
  await page.mouse.up();
  assert.deepEqual(await state(), before);
  await page.mouse.move(from, y);
  await page.mouse.down({ button: "middle" });
  await page.mouse.move(to, y, { steps: 4 });
  await page.mouse.up({ button: "middle" });
  assert.deepEqual(await state(), before);
});

test("a plot can be had as SVG and as CSV", async () => {
  const text = async (name) => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.locator(".plot").first().getByRole("button", { name }).click(),
    ]);
    return readFileSync(await download.path(), "utf8");
  };
  const svg = await text("SVG");
  assert.match(svg, /^<\?xml[\s\S]*<svg [\s\S]*<path class="ln s0" d="M[\s\S]*Deformation[\s\S]*<\/svg>\s*$/);
  assert.doesNotMatch(svg, /NaN|undefined/);
  const lines = (await text("CSV")).trim().split("\n");
  assert.equal(lines[0], 't,D,"D, reference"');
  const rows = rowsOf("drops.csv");
  assert.equal(lines.length, rows.length + 1);
  assert.equal(lines[2].split(",")[1], String(Number(rows[1].D)));
});

test("the reference is drawn beside D and beside nothing else", async () => {
  const labels = await page.$$eval(".plot", (plots) =>
    plots.map((p) => [...p.querySelectorAll(".value")].map((v) => v.dataset.curve)));
  assert.deepEqual(labels[0], ["D", "D, reference"]);
  assert.ok(labels.slice(1).flat().every((label) => !label.includes("reference")));
});

test("marks of events jump there", async () => {
  await setSlider(0);
  const marks = page.locator(".timeline .mark");
  assert.equal(await marks.count(), 2);
  for (const [k, event] of rowsOf("events.csv").entries()) {
    const before = await pixels(page, STAGE);
    await marks.nth(k).click();
    assert.ok(Math.abs((await time()) - Number(event.t)) <= 0.5 * (6 / 199) + 1e-9, `event ${k}`);
    assert.notEqual(await pixels(page, STAGE), before);
    const target = await page.evaluate(() => window.meniscus.explorer.views[0].controls.target.toArray());
    assert.deepEqual(target.slice(0, 2), [Number(event.x), Number(event.y)]);
  }
  await page.getByRole("button", { name: "Oblique" }).click();
});

test("a click on a plot goes to its time", async () => {
  const over = page.locator(".plot .over").first();
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  assert.ok(Math.abs((await time()) - 3) < 0.1);
});

test("the keyboard does all of it", async () => {
  await page.evaluate(() => document.activeElement.blur());
  const at = () => page.evaluate(() => window.meniscus.timeline.at);
  await page.keyboard.press("Home");
  assert.equal(await at(), 0);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  assert.equal(await at(), 2);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await at(), 1);
  await page.keyboard.press("End");
  assert.equal(await at(), 199);
  await page.keyboard.press(" ");
  await until(page, () => window.meniscus.timeline.isPlaying);
  await page.keyboard.press(" ");
  assert.equal(await page.evaluate(() => window.meniscus.timeline.isPlaying), false);
  await page.keyboard.press("Home");
  const first = await pixels(page, STAGE);
  await page.locator(STAGE).focus();
  await page.keyboard.press("ArrowLeft");
  assert.equal(await at(), 0); // turned, not stepped
  assert.notEqual(await pixels(page, STAGE), first);
  // Everything that can be used can be reached.
  const unreachable = await page.$$eval("button, input, select", (all) => all.filter((e) => e.tabIndex < 0).length);
  assert.equal(unreachable, 0);
  await page.getByRole("button", { name: "Oblique" }).click();
});

test("the cut shows liquids and quality at every time of a volume mesh", async () => {
  const drawn = () => page.$eval(".cut-stage", (stage) => stage.innerHTML);
  await page.locator(".cut-stage").scrollIntoViewIfNeeded();
  const liquid = await drawn();
  assert.match(await page.textContent(".cut .colorbar"), /matrix.*drop 0/);
  await page.selectOption("#cut-coloring", "quality");
  const quality = await drawn();
  assert.notEqual(quality, liquid);
  assert.equal(await page.locator(".cut select").first().locator("option").count(), 3);
  await page.selectOption("#cut-coloring", "liquid");
  await page.locator(".cut select").first().selectOption({ index: 0 });
  await until(page, () => document.querySelector(".cut figcaption").textContent.includes("t = 0 "));
  assert.notEqual(await drawn(), liquid);
  await page.locator(".cut select").nth(1).selectOption({ index: 1 });
  await until(page, () => document.querySelector(".cut figcaption").textContent.includes("plane y"));
});

test("the case can be copied", async () => {
  await browser.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.click("#copy-case");
  await until(page, () => document.querySelector("#copy-case").textContent === "Copied");
  const text = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(text, JSON.parse(readFileSync(join(run, "run.json"), "utf8")).case_text);
});

test("no complaint in all of that", () => assert.deepEqual(opened.complaints, []));

test("on a phone, a laptop and paper, by day and night, nothing sticks out", async () => {
  const shot = async (name, { width, height, ...media }, fullPage) => {
    await page.setViewportSize({ width, height });
    await page.emulateMedia({ media: null, colorScheme: "light", ...media });
    await page.waitForTimeout(400);
    await page.evaluate(() => window.scrollTo(0, 0));
    await page.screenshot({ path: join(out, `${name}.png`), fullPage });
    const excess = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(excess <= 0, `${name}: ${excess} px too wide`);
  };
  await setSlider(199);
  await shot("laptop", { width: 1366, height: 768 }, true);
  await shot("laptop-dark", { width: 1366, height: 768, colorScheme: "dark" }, true);
  await shot("phone", { width: 390, height: 844 }, true);
  await shot("phone-dark", { width: 390, height: 844, colorScheme: "dark" }, false);
  await shot("print", { width: 794, height: 1123, media: "print", colorScheme: "dark" }, true);
  const paper = await page.evaluate(() => ({
    dynamic: [...document.querySelectorAll(".dynamic")].filter((e) => e.offsetParent !== null).length,
    pictures: [...document.querySelectorAll(".printed svg, .plot svg, .cut-stage > svg")]
      .filter((e) => e.getBoundingClientRect().width > 0).length,
    background: getComputedStyle(document.body).backgroundColor,
  }));
  assert.equal(paper.dynamic, 0);
  assert.ok(paper.pictures >= 8 + 2 + 10, `${paper.pictures} pictures`);
  assert.equal(paper.background, "rgb(255, 255, 255)");
});

test("without scripts the tables are there, and a word on the pictures", async () => {
  const plain = await openBrowser(web, chromium, { javaScriptEnabled: false });
  const still = await plain.context.newPage();
  await still.goto(pathToFileURL(report).href);
  assert.ok(await still.locator("noscript p").isVisible());
  assert.ok(await still.locator("table").first().isVisible());
  await plain.close();
});

test("the keyboard moves the cursor of a plot and zooms", async () => {
  await page.setViewportSize({ width: 1366, height: 768 });
  await page.emulateMedia({ media: null, colorScheme: "light" });
  const state = () => page.evaluate(() => {
    const { cursor, area } = window.meniscus.history.plots[0];
    return { x: cursor.x, min: area.x.min, max: area.x.max };
  });
  await page.locator(".plot .plot-body").first().focus();
  await page.keyboard.press("ArrowLeft");
  const first = await state();
  await page.keyboard.press("ArrowLeft");
  assert.ok((await state()).x < first.x);
  await page.keyboard.press("+");
  const zoomed = await state();
  assert.ok(zoomed.max - zoomed.min < 0.6 * (first.max - first.min));
  await page.keyboard.press("0");
  assert.equal((await state()).max, first.max);
});

test("two runs in one page move together", async () => {
  const both = await openPage(browser.context, pathToFileURL(comparison).href);
  await both.page.setViewportSize({ width: 1366, height: 768 });
  await until(both.page, () => performance.getEntriesByName("prepared").length > 0);
  assert.equal(await both.page.locator(STAGE).count(), 2);
  const pictures = () => both.page.$$eval(".stage canvas", (all) => all.map((c) => c.toDataURL()));
  const atEnd = await pictures();
  await both.page.keyboard.press("Home");
  await both.page.waitForTimeout(300);
  const atStart = await pictures();
  atStart.forEach((picture, k) => assert.notEqual(picture, atEnd[k]));
  assert.deepEqual(await both.page.$$eval(".stage-caption", (all) => all.map((e) => e.textContent)), ["t = 0", "t = 0"]);
  await both.page.locator(STAGE).first().focus();
  await both.page.keyboard.press("ArrowUp");
  await both.page.waitForTimeout(300);
  (await pictures()).forEach((picture, k) => assert.notEqual(picture, atStart[k], `view ${k}`));
  assert.ok((await both.page.locator(".plot").first().locator(".value").count()) >= 2);
  assert.ok(await both.page.locator("table.differences").isVisible());
  await both.page.screenshot({ path: join(out, "comparison.png"), fullPage: true });
  assert.deepEqual(both.complaints, []);
  assert.equal(both.requests.length, 1);
});

test("bulk scalars colour the view and the cut, and have plots", async () => {
  const shown = await openPage(browser.context, pathToFileURL(join(scalars, "report.html")).href);
  const { page: other } = shown;
  await until(other, () => performance.getEntriesByName("prepared").length > 0);
  const options = (id) => other.$$eval(`${id} option`, (all) => all.map((option) => option.value));
  assert.deepEqual((await options("#field")).slice(-2), ["dye", "temperature"]);
  assert.deepEqual(await options("#cut-coloring"), ["liquid", "quality", "field dye", "field temperature"]);
  const cut = () => other.$eval(".cut-stage", (stage) => stage.innerHTML);
  const seen = new Set([await pixels(other, STAGE), await cut()]);
  for (const name of ["temperature", "dye"]) {
    await other.selectOption("#field", name);
    await other.selectOption("#cut-coloring", `field ${name}`);
    await other.waitForTimeout(300);
    seen.add(await pixels(other, STAGE)).add(await cut());
  }
  assert.equal(seen.size, 6);
  assert.match(await other.textContent(".cut .colorbar"), /^1.*2$/); // dye: the matrix, the drop
  const titles = await other.$$eval(".plot .ttl", (all) => all.map((e) => e.textContent.trim()));
  for (const title of ["temperature: amount [R₀³]", "dye: amount gained per time [R₀³G]",
    "temperature: Nusselt number", "dye: Sherwood number"]) assert.ok(titles.includes(title), title);
  assert.ok(titles.every((title) => !title.includes("*") && title !== "dye: Nusselt number"), titles.join(", "));
  assert.deepEqual(shown.complaints, []);
  await other.close();
});

test("curved faces are drawn in pieces, flat ones as they are", async () => {
  const drawn = (where) => where.evaluate(() => {
    const { frame } = window.meniscus.explorer.views[0];
    return { pieces: frame.drawn.index.length / frame.index.length, isCurved: Boolean(frame.middles) };
  });
  const { page: curved } = await openPage(browser.context, pathToFileURL(join(scalars, "report.html")).href);
  await until(curved, () => performance.getEntriesByName("ready").length > 0);
  assert.deepEqual(await drawn(curved), { pieces: 16, isCurved: true });
  await curved.close();
  assert.deepEqual(await drawn(page), { pieces: 1, isCurved: false });
});
