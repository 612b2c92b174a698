// The drawing code by itself: drawing_test.mjs SOURCES, the folder web/src.
import assert from "node:assert/strict";
import { test } from "node:test";
import { join, resolve } from "node:path";

const sources = resolve(process.argv[2]);
const from = (file) => import(join(sources, file));
const { linearTicks, logTicks } = await from("ticks.js");
const { curvePath, drawPlot, plotArea } = await from("plot.js");
const { commonView, drawInterface } = await from("interface.js");
const { sectionThroughCentroids } = await from("section.js");
const { edgesOfFaces, refined } = await from("surface.js");
const { PALETTES, viridis } = await from("colors.js");
const { svgFile } = await from("svg.js");
const { Table } = await from("data.js");
const { readoutText, rowAt } = await from("plots.js");
const { historyPlot, specsOf } = await from("curves.js");
const { drawLiquidKey, liquidName } = await from("cut-picture.js");
const { pointsLeftOut, withGaps } = await from("study.js");

/** An octahedron's faces in n² pieces each on the unit sphere; curved: with middles of edges on it. */
function ball(parts, isCurved, axes = [1, 1, 1]) {
  const octahedron = {
    position: [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1], values: {},
    index: [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5],
  };
  const { index, position } = refined(octahedron, parts);
  const onBall = (x) => x.map((value, k) => (axes[k] * value) / Math.hypot(...x));
  const points = Array.from({ length: position.length / 3 }, (_, v) => [...position.slice(3 * v, 3 * v + 3)]);
  const { faceEdges, ends } = edgesOfFaces(index);
  const unit = points.map((x) => x.map((value) => value / Math.hypot(...x)));
  const middles = ends.flatMap(([a, b]) => onBall(unit[a].map((value, k) => value + unit[b][k])));
  return { t: 0, index, position: points.flatMap(onBall), values: {}, ...(isCurved ? { middles, faceEdges } : {}) };
}

test("ticks are round numbers around the data", () => {
  assert.deepEqual(linearTicks(0, 0.37, 5).labels, ["0.0", "0.1", "0.2", "0.3", "0.4"]);
  assert.deepEqual(linearTicks(-1, 1, 4).labels, ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
  const small = linearTicks(0, 4e-13, 4);
  assert.deepEqual([small.factor, small.labels], ["×10⁻¹³", ["0", "1", "2", "3", "4"]]);
  assert.equal(linearTicks(0, 3e4, 3).factor, "");
  const inner = linearTicks(0.3, 5.7, 6, false);
  assert.deepEqual([inner.min, inner.max, inner.labels], [0.3, 5.7, ["1", "2", "3", "4", "5"]]);
  assert.deepEqual(logTicks(150, 38000).labels, ["10²", "10³", "10⁴", "10⁵"]);
  assert.deepEqual(logTicks(0.3, 0.9).labels, ["0.2", "0.5", "1"]);
  for (const value of [5, 0, 1e-300, -3e20]) assert.ok(linearTicks(value, value, 4).min < linearTicks(value, value, 4).max);
  for (let k = -20; k <= 20; ++k) {
    const ticks = linearTicks(-0.37 * 10 ** k, 0.11 * 10 ** k, 5);
    assert.equal(new Set(ticks.labels).size, ticks.labels.length);
    assert.ok(ticks.values.length >= 2 && ticks.values.length <= 12);
  }
});

test("a line has gaps, lone points are dots, no spike is lost", () => {
  const path = curvePath([[0, 0], [1, 2], null, null, [3, 3], null, [4, 4], [5, 5.25]]);
  assert.deepEqual(path, { line: "M0 0L1 2M4 4L5 5.3", dots: [[3, 3]] });
  const { line } = curvePath(Array.from({ length: 50000 }, (_, i) => [0.01 * i, i === 31234 ? 99 : 0.5]));
  assert.ok(line.length < 20000 && line.includes("312.3 99") && line.startsWith("M0 0.5") && line.endsWith("500 0.5"));
});

test("plots bear any data", () => {
  const series = [[], [1], [NaN], [0, 0], [NaN, 1, NaN], [-1, 1e300], [1e-300, 2], [Infinity, 1], [5, NaN, Infinity], [-1e-320, 1e-320]];
  for (const y of series) {
    for (const [isLog, hasEqualScales, window] of [[false, false], [true, false], [false, true], [false, false, [0.2, 0.7]]]) {
      const svg = drawPlot({ title: "A & <B>", unit: '"', xLabel: "<x>", isLog, hasEqualScales, window, width: 560, height: 300,
        curves: [{ name: "a<b", legend: "a<b", x: y.map((_, i) => i), y }], marks: [{ x: 0, label: "<event>" }, { x: NaN, label: "" }] });
      assert.doesNotMatch(svg, /NaN|Infinity|undefined|<B>/);
    }
  }
});

test("a window between two rows has the range of the lines within it", () => {
  const plot = { title: "", xLabel: "", width: 560, height: 300, window: [0.25, 0.75],
    curves: [{ x: [0, 1, 2], y: [100, 200, 1e6] }, { x: [2, 1.5, 1], y: [-1e6, -1e6, -1e6] }] };
  const { y } = plotArea(plot);
  assert.ok(y.min > 100 && y.min <= 125 && y.max >= 175 && y.max < 200, `${y.min} to ${y.max}`);
  Object.assign(plot, { isLog: true, curves: [{ x: [0, 1], y: [1, 1e4] }] });
  const { y: log } = plotArea(plot);
  assert.ok(Math.abs(Math.log10(log.min) - 1) < 0.01 && Math.abs(Math.log10(log.max) - 3) < 0.01, `${log.min} to ${log.max}`);
});

test("a value is told of its own time, and none beyond the rows of a curve", () => {
  const plot = {};
  const curve = { name: "D", x: [1, 2, 4, 5], y: [0.1, 0.2, 0.4, NaN] };
  const at = (x) => {
    const row = rowAt(plot, curve, x);
    return readoutText("D", "t", [curve.x[row], curve.y[row]], x);
  };
  assert.deepEqual([0.9, 4.1, 5].map(at), ["D = –", "D = –", "D = –"]);
  assert.deepEqual([1, 1 - 1e-12, 4].map(at), ["D = 0.1", "D = 0.1", "D = 0.4"]);
  assert.deepEqual([1.4, 3.5].map(at), ["D = 0.1 (t = 1)", "D = 0.4 (t = 4)"]);
});

test("comments and blank lines of a table are no rows, whatever they hold", () => {
  const table = new Table().append('# By "him.\n\n \t\nt,D\n# 5" pipe\r\n0,0\r\n\r\n1,"0.5"\n');
  assert.deepEqual([table.names, table.column("t"), table.column("D")], [["t", "D"], [0, 1], [0, 0.5]]);
  const quoted = new Table().append('t,note\n1,"a\n#b,""c"""\n');
  assert.deepEqual(quoted.texts("note"), ['a\n#b,"c"']);
});

const runOf = (name, more) => ({ name, ...more,
  tables: { drops: new Table().append("step,t,drop,D,velocity_x\n0,0,0,0,1\n1,1,0,0.5,1\n") } });
const specOf = (title) => specsOf([runOf("")]).find((spec) => spec.title.startsWith(title));

test("eight runs have eight kinds of line, for every quantity", () => {
  const runs = Array.from({ length: 8 }, (_, k) => runOf(`run ${k}`));
  for (const title of ["Deformation", "Velocity"]) {
    const { curves } = historyPlot(specOf(title), runs, []);
    assert.equal(new Set(curves.map(({ color, dash }) => `${color % 6} ${dash}`)).size, 8);
  }
  const svg = svgFile("", 1, 1);
  for (let dash = 1; dash < 8; ++dash) assert.ok(svg.includes(`svg .d${dash}{stroke-dasharray:`), `dash ${dash}`);
});

test("units are those of the flow", () => {
  const units = (runs) => {
    const { xLabel, unit } = historyPlot(specOf("Velocity"), runs, []);
    return [xLabel, unit];
  };
  const [sheared, resting] = [runOf("a", { isQuiescent: false }), runOf("b", { isQuiescent: true })];
  assert.deepEqual(units([sheared]), ["time t [1/G]", "GR₀"]);
  assert.deepEqual(units([resting]), ["time t [μR₀/σ]", "σ/μ"]);
  assert.deepEqual(units([sheared, resting]), ["time t [1/G or μR₀/σ]", "GR₀ or σ/μ"]);
});

test("the liquids of a cut have the names of their drops", () => {
  const cut = { region: [0, 2, 1, 3, 4], drops: [7, 2, -1] };
  assert.deepEqual([0, 1, 2, 3, 4].map((region) => liquidName(cut, region)),
    ["matrix", "drop 7", "drop 2", "region 3", "region 4"]);
  const names = (of) => [...drawLiquidKey(of, 0, 0).matchAll(/<text[^>]*>([^<]*)/g)].map(([, name]) => name);
  assert.deepEqual(names({ region: [0, 2], drops: [7, 2] }), ["matrix", "drop 2"]);
  assert.deepEqual(names({ region: [0, 1], drops: [7] }), ["matrix", "drop"]);
});

test("points of a study without a finite place are left out, and it is said", () => {
  const plot = { xLabel: "Ca", curves: [{ x: [0.1, null, 0.3], y: [1, 2, null] }] };
  assert.deepEqual(withGaps(plot).curves[0], { x: [0.1, 0.3], y: [1, NaN] });
  assert.match(pointsLeftOut([plot]), /^Not drawn: runs whose Ca is no finite number/);
  assert.equal(pointsLeftOut([{ xLabel: "Ca", curves: [{ x: [1], y: [null] }] }]), "");
});

/** The points of the outlines of a picture, of curved ones with points along each parabola. */
function outlinePoints(svg) {
  const points = [];
  for (const [, d] of svg.matchAll(/ d="([^"]*)"/g)) {
    let [x, y] = [0, 0];
    for (const [, command, text] of d.matchAll(/([Mlq])([^Mlqz]*)/g)) {
      const numbers = text.trim().split(/[ ,]+/).map(Number);
      if (command === "M") points.push([x, y] = numbers);
      for (let i = 0; command !== "M" && i < numbers.length; i += command === "q" ? 4 : 2) {
        const [cx, cy, ex, ey] = command === "q" ? numbers.slice(i, i + 4) : [0, 0, ...numbers.slice(i, i + 2)];
        if (command === "q") for (const s of [0.25, 0.5, 0.75])
          points.push([x + 2 * s * (1 - s) * cx + s * s * ex, y + 2 * s * (1 - s) * cy + s * s * ey]);
        [x, y] = [x + ex, y + ey];
        points.push([x, y]);
      }
    }
  }
  return points;
}

test("curved faces have a round silhouette, flat ones a polygon", () => {
  const dip = (isCurved) => { // the least reach of the silhouette over all directions, of its radius
    const frame = ball(3, isCurved);
    const view = commonView([frame], 320);
    const points = outlinePoints(drawInterface(frame, view)).map(([x, y]) => [x / 10 - view.width / 2, y / 10 - view.height / 2]);
    const reach = (angle) => Math.max(...points.map(([x, y]) => x * Math.cos(angle) + y * Math.sin(angle)));
    return Math.min(...Array.from({ length: 90 }, (_, k) => reach((k * Math.PI) / 45))) / view.scale;
  };
  assert.ok(dip(true) > 0.985, `curved ${dip(true)}`);
  assert.ok(dip(false) < 0.97, `flat ${dip(false)}`);
});

test("the section of an ellipsoid is an ellipse", () => {
  const axes = [2, 0.7, 0.5];
  for (const normal of [2, 1]) {
    const { x, y } = sectionThroughCentroids(ball(10, true, axes), normal);
    assert.equal(x.filter(Number.isNaN).length, 1);
    assert.equal(x[0], x.at(-2));
    x.forEach((value, i) => Number.isNaN(value) || assert.ok(Math.abs(Math.hypot(value / 2, y[i] / axes[3 - normal]) - 1) < 5e-3));
  }
});

test("colours can be told from the paper, and rise in lightness", () => {
  const luminance = (color) => {
    const [r, g, b] = color.map((part) => (part <= 10.3 ? part / 3294.6 : ((part / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ofHex = (text) => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16));
  const contrast = (a, b) => {
    const [low, high] = [luminance(ofHex(a)), luminance(ofHex(b))].sort((p, q) => p - q);
    return (high + 0.05) / (low + 0.05);
  };
  for (const { paper, ink, text, faint, axis, curves } of Object.values(PALETTES)) {
    for (const letters of [ink, text, faint]) assert.ok(contrast(letters, paper) >= 4.5, letters);
    for (const line of [axis, ...curves]) assert.ok(contrast(line, paper) >= 3, line);
  }
  for (let k = 0; k < 100; ++k) assert.ok(luminance(viridis(k / 100)) <= luminance(viridis((k + 1) / 100)));
});

test("a file stands alone", () => {
  const svg = svgFile("", 10, 20);
  assert.match(svg, /^<\?xml[\s\S]*viewBox="0 0 10 20"[\s\S]*<style>/);
  assert.doesNotMatch(svg.replace("http://www.w3.org/2000/svg", ""), /http|url\(|@import/);
});
