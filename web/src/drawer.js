// The program's pictures: reads what is to be drawn from standard input, writes the pictures to standard
// output. Input, in JSON: {page, texts, pictures}; `page` and `texts` are what a page carries, `pictures`
// names of STILLS or "film". Output, for each picture: a line {"name", "bytes"}, then so many bytes of SVG.
import { readFileSync, writeSync } from "node:fs";
import { embeddedRun } from "./data.js";
import { deformationStill, filmStills, historyStill, interfaceStill, meshStill } from "./stills.js";

const STILLS = { interface: interfaceStill, deformation: deformationStill, mesh: meshStill, history: historyStill };

function put(text) {
  const bytes = Buffer.from(text);
  for (let done = 0; done < bytes.length;) done += writeSync(1, bytes, done);
}

function putPicture(name, svg) {
  put(`${JSON.stringify({ name, bytes: Buffer.byteLength(svg) })}\n`);
  put(svg);
}

async function draw({ page, texts, pictures }) {
  const [run] = await Promise.all(page.runs.map((entry, number) => embeddedRun(entry, number, (id) => texts[id])));
  for (const name of pictures) {
    if (name === "film") {
      for await (const svg of filmStills(run)) putPicture(name, svg);
      continue;
    }
    const svg = await STILLS[name](run);
    if (svg) putPicture(name, svg);
  }
}

draw(JSON.parse(readFileSync(0, "utf8"))).catch((error) => {
  if (error.code !== "EPIPE") console.error(`the drawer: ${error.stack}`); // else the program has ended
  process.exitCode = 1;
});
