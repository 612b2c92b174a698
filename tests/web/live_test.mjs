// The live view of a short run in a browser: live_test.mjs WEB PROGRAM CASE WORK
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, readFileSync, rmSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, test } from "node:test";
import { findChromium, openBrowser, openPage, pixels, until } from "./browser.mjs";

const [web, program, caseFile, work] = process.argv.slice(2).map((path) => resolve(path));
const chromium = findChromium();
const folder = join(work, "run");
rmSync(folder, { recursive: true, force: true });
const browser = await openBrowser(web, chromium);
// It goes on until it is told to stop: on no machine is it over before the page has seen it grow.
const run = spawn(program, [
  "run", caseFile, "-o", folder, "--watch", "--port", "0", "--set", "time.end=1000",
  "--set", "output.interval=0.05", "--set", "output.volume-interval=0.1",
], { stdio: ["ignore", "pipe", "inherit"] });
const ended = new Promise((resolve) => run.on("exit", resolve));
after(async () => {
  run.kill();
  await browser.close();
});

test("the page follows a run to its end", { timeout: 240000 }, async () => {
  const url = await new Promise((resolve, reject) => {
    let text = "";
    run.stdout.on("data", (part) => {
      text += part;
      const found = text.match(/http:\/\/\S+/);
      if (found) resolve(found[0]);
    });
    ended.then(() => reject(new Error(`the run ended without an address: ${text}`)));
  });
  const { page, complaints, requests } = await openPage(browser.context, url);
  await until(page, () => window.meniscus?.explorer && window.meniscus?.history);
  const first = await pixels(page, ".stage canvas");
  const frames = () => page.evaluate(() => window.meniscus.timeline.times.length);
  const before = await frames();
  await until(page, (n) => window.meniscus.timeline.times.length > n, before, 60);
  await page.evaluate(() => window.meniscus.timeline.set(window.meniscus.timeline.times.length - 1));
  run.kill("SIGINT");
  await until(page, () => document.querySelector(".live").textContent.includes("The run is stopped"), null, 90);
  assert.equal(await ended, 1);
  assert.notEqual(await pixels(page, ".stage canvas"), first);
  // All that the run has written has come.
  const rows = readFileSync(join(folder, "history.csv"), "utf8").trim().split("\n").length - 1;
  const shown = await page.evaluate(() => ({
    rows: window.meniscus.history.runs[0].tables.history.length,
    frames: window.meniscus.timeline.times.length,
    cuts: window.meniscus.cut.cuts.length,
  }));
  const numbered = (name) => readFileSync(join(folder, name), "utf8").match(/<DataSet /g).length;
  assert.deepEqual(shown, { rows, frames: numbered("surface.pvd"), cuts: numbered("volume.pvd") });
  assert.ok(existsSync(join(folder, "report.html")));
  assert.ok(requests.every((request) => request.startsWith(url)), requests.join("\n"));
  assert.deepEqual(complaints, []);
});
