// A headless Chromium for the tests, with nothing kept from one to the next and no network.
import assert from "node:assert/strict";
import { accessSync, constants, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";

// As on a machine without a graphics card: pages are put together by the processor, WebGL is drawn by it.
const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader",
  "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync",
];

/** Ends the test as skipped (77, for ctest) where no browser is installed. */
export function findChromium() {
  for (const name of ["chromium", "chromium-browser", "google-chrome"]) {
    for (const folder of process.env.PATH.split(delimiter)) {
      try {
        accessSync(join(folder, name), constants.X_OK);
        return join(folder, name);
      } catch {} // not in this folder
    }
  }
  console.log("SKIPPED: there is no chromium here (Debian: apt install chromium)");
  process.exit(77);
}

/** `web`: the folder whose node_modules holds playwright-core. */
export async function openBrowser(web, chromium, options = {}) {
  const { chromium: driver } = createRequire(join(web, "package.json"))("playwright-core");
  const profile = mkdtempSync(join(tmpdir(), "meniscus-browser-"));
  const context = await driver.launchPersistentContext(profile, {
    executablePath: chromium, headless: true, args: FLAGS, acceptDownloads: true,
    viewport: { width: 1366, height: 768 }, ...options,
  });
  return {
    context,
    close: async () => {
      await context.close();
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
    },
  };
}

/** Opens a page and notes all it complains of and all it asks for. */
export async function openPage(context, url) {
  const page = await context.newPage();
  const complaints = [];
  const requests = [];
  page.on("console", (message) => {
    // The software renderer's remarks on its own speed are no fault of the page.
    if (["error", "warning"].includes(message.type()) && !message.text().includes("GPU stall"))
      complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(url);
  return { page, complaints, requests };
}

/** The picture of a canvas that has come to rest, as text that two can be compared by. */
export function pixels(page, selector) {
  return page.evaluate(async (s) => {
    const frame = () => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    const pause = () => new Promise((over) => setTimeout(over, 50));
    let last = "";
    for (let i = 0; i < 40; ++i) {
      await frame();
      const picture = document.querySelector(s).toDataURL();
      if (picture === last) return picture;
      last = picture;
      await pause(); // a change of size is told to the page after the frame
    }
    throw new Error(`${s} never came to rest`);
  }, selector);
}

/**
 * Seconds of processor time that this process and all below it, the browser's, have taken so far. Where
 * other programs want the processors too, this is nearer to what the page needs than the clock.
 */
export function processorSeconds() {
  const processes = new Map();
  for (const name of readdirSync("/proc").filter((entry) => /^\d+$/.test(entry))) {
    try {
      const stat = readFileSync(`/proc/${name}/stat`, "utf8");
      const fields = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
      processes.set(Number(name), { parent: Number(fields[1]), ticks: Number(fields[11]) + Number(fields[12]) });
    } catch {} // has ended meanwhile
  }
  const isOurs = (id) => id === process.pid || (processes.has(id) && isOurs(processes.get(id).parent));
  const ticks = [...processes].filter(([id]) => isOurs(id)).reduce((sum, [, { ticks: t }]) => sum + t, 0);
  return ticks / 100; // USER_HZ of every Linux
}

/** Waits until a condition holds in the page; says which one did not. */
export async function until(page, condition, argument, seconds = 20) {
  try {
    await page.waitForFunction(condition, argument, { timeout: 1000 * seconds });
  } catch {
    assert.fail(`never came true: ${condition}`);
  }
}
