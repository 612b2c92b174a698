// What the live view makes of its server's answers: live_run_test.mjs SOURCES, the folder web/src.
import assert from "node:assert/strict";
import { afterEach, beforeEach, test } from "node:test";
import { join, resolve } from "node:path";
import { deflateSync } from "node:zlib";

const { LiveRun } = await import(join(resolve(process.argv[2]), "live.js"));
const MOST_BYTES = 60; // of an answer

class Element {
  constructor() {
    this.text = "";
    this.className = "";
    this.classList = { toggle() {} };
  }
  setAttribute() {}
  append(...parts) {
    this.text += parts.map((part) => part.text ?? part).join("");
  }
  replaceChildren(...parts) {
    this.text = "";
    this.append(...parts);
  }
}

/** A server by `answer(path, arguments)`; it counts what it is asked. */
class Server {
  constructor() {
    Object.assign(this, { run: "1-1", status: "running", frames: [], cuts: [], asked: [] });
    this.tables = { history: "step,t,drops,surface_nodes\n", drops: "", events: "", timing: "step,t\n", reference: "" };
  }
  fetch(url) {
    const { pathname, searchParams } = new URL(url, "http://localhost");
    this.asked.push(pathname);
    const path = pathname.slice(1);
    const run = searchParams.get("run");
    if (run !== null && run !== this.run) return new Response("another run", { status: 409 });
    const from = Number(searchParams.get("from"));
    if (path === "state") return Response.json(this.state());
    if (path === "frames" || path === "cuts") return Response.json(this[path].slice(from));
    if (path === "frame" || path === "cut") return new Response(deflateSync(""));
    const bytes = new TextEncoder().encode(this.tables[path.replace(".csv", "")]);
    return new Response(bytes.subarray(from, from + MOST_BYTES));
  }
  state() {
    const sizes = Object.entries(this.tables).map(([name, text]) => [name, new TextEncoder().encode(text).length]);
    return { run: this.run, status: this.status, frames: this.frames.length, cuts: this.cuts.length,
      tables: Object.fromEntries(sizes) };
  }
  addRows(count) {
    const { length } = this.tables.history.split("\n");
    for (let k = 0; k < count; ++k) this.tables.history += `${length + k},${0.5 * k},2,110\n`;
  }
}

let server;
let live;
let reloads;
let badge;
const wait = globalThis.setTimeout;

beforeEach(() => {
  server = new Server();
  reloads = 0;
  badge = new Element();
  globalThis.document = { createElement: () => new Element(), querySelector: () => badge };
  globalThis.location = { reload: () => ++reloads };
  globalThis.fetch = async (url) => server.fetch(url);
  globalThis.setTimeout = (action) => wait(action, 0);
  live = new LiveRun({ name: "run", end: "" }, "1-1");
});
afterEach(() => (globalThis.setTimeout = wait));

const rows = () => live.run.tables.history.length;

test("another run at the same address is never added: the page begins anew", async () => {
  server.addRows(1);
  await live.ask();
  assert.equal(rows(), 1);
  server.run = "2-2";
  server.addRows(1);
  await live.follow(() => assert.fail("there is no news of this run"));
  assert.deepEqual([reloads, rows()], [1, 1]);
});

test("a table or a list that became shorter begins anew as well", async () => {
  server.addRows(2);
  server.frames = [{ t: 0 }];
  await live.ask();
  server.frames = [];
  await live.ask();
  assert.equal(reloads, 1);
  server.frames = [{ t: 0 }];
  server.tables.history = "step,t,drops,surface_nodes\n";
  await live.ask();
  assert.deepEqual([reloads, rows()], [2, 2]);
});

test("parts of another run are refused, and may come later", async () => {
  server.frames = [{ t: 0 }];
  await live.ask();
  server.run = "2-2";
  await assert.rejects(live.run.frames.get(0), /409/);
  server.run = "1-1";
  live.run.frames.unpack = () => "unpacked";
  assert.equal(await live.run.frames.get(0), "unpacked");
});

test("the end is told when all has come", async () => {
  await live.ask();
  server.addRows(30); // several answers
  server.frames = [{ t: 0 }, { t: 1 }];
  server.cuts = [{ t: 1 }];
  server.status = "stopped";
  let calls = 0;
  await live.follow(async (news) => {
    ++calls;
    assert.deepEqual(news, { rows: true, frames: true, cuts: true });
  });
  assert.equal(calls, 1);
  assert.deepEqual([rows(), live.run.frames.length, live.run.cuts.length], [30, 2, 1]);
  assert.match(live.status.text, /^The run is stopped.*report\.html\.$/);
  assert.deepEqual([badge.textContent, badge.className], ["stopped", "status other"]);
});

test("a row cut short does not hold up the end", { timeout: 5000 }, async () => {
  server.addRows(2);
  server.tables.history += "7,1.";
  server.status = "failed: no disk";
  await live.follow(() => {});
  assert.equal(rows(), 2);
  assert.deepEqual([badge.textContent, badge.className], ["failed", "status failed"]);
});

test("a reference without a last line break shows its last row and is asked for once", async () => {
  server.tables.reference = "# He said \"no\".\n\nt,D\n0,0\n1,0.25";
  await live.ask();
  await live.ask();
  assert.deepEqual(live.run.tables.reference.column("D"), [0, 0.25]);
  assert.equal(server.asked.filter((path) => path === "/reference.csv").length, 1);
});
