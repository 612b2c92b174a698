// Bundles the page: node build.mjs SOURCES OUT, the packages lying beside this file.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [sources, out] = process.argv.slice(2);
const packages = join(dirname(fileURLToPath(import.meta.url)), "node_modules");

await build({
  entryPoints: { page: join(sources, "page.js") },
  outdir: out,
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome108", "firefox113", "safari16.4"], // the first with streams that inflate
  charset: "ascii", // the same bytes however a server labels the page
  legalComments: "inline",
  nodePaths: [packages],
  logLevel: "warning",
});
