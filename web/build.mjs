// Bundles the page, and the drawer that node runs: node build.mjs SOURCES OUT, the packages beside this file.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [sources, out] = process.argv.slice(2);
const packages = join(dirname(fileURLToPath(import.meta.url)), "node_modules");

const common = {
  outdir: out,
  bundle: true,
  minify: true,
  charset: "ascii", // the same bytes however a server labels the page
  legalComments: "inline",
  nodePaths: [packages],
  logLevel: "warning",
};

await build({
  ...common,
  entryPoints: { page: join(sources, "page.js") },
  format: "iife",
  target: ["chrome108", "firefox113", "safari16.4"], // the first with streams that inflate
});
await build({
  ...common,
  entryPoints: { drawer: join(sources, "drawer.js") },
  platform: "node",
  format: "cjs", // what `node -e` runs
  target: "node18",
});
