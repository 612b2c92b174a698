// What is drawn, out of the texts that a page carries (or a server sends): tables, frames, cuts.
import { edgesOfFaces } from "./surface.js";

/** Bytes of a text in base 64. */
function bytesOfBase64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** What the program deflated (format zlib). */
async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export function pageData() {
  return JSON.parse(document.getElementById("page-data").textContent);
}

/** The text of an element of the page; the element goes, its text is not needed twice. */
export function takenElement(id) {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page lacks ${id}`);
  const text = element.textContent;
  element.remove();
  return text;
}

export async function fetched(url) {
  const response = await fetch(url, { cache: "no-store" });
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return inflated(new Uint8Array(await response.arrayBuffer()));
}

/** A table: columns by name, numbers where every cell of the column is one or empty, else texts. */
export class Table {
  constructor(names = []) {
    this.names = names;
    this.cells = names.map(() => []);
    this.length = 0;
    this.numbers = new Map();
  }

  /** Adds the rows of a CSV text; the first line of the first text names the columns. */
  append(text) {
    for (const row of rowsOfCsv(text)) {
      if (this.names.length === 0) {
        this.names = row;
        this.cells = row.map(() => []);
        continue;
      }
      if (row.length !== this.names.length) continue; // cut short by a crash
      row.forEach((cell, k) => this.cells[k].push(cell));
      ++this.length;
    }
    this.numbers.clear();
    return this;
  }

  has(name) {
    return this.names.includes(name) && this.column(name).some(Number.isFinite);
  }

  texts(name) {
    return this.cells[this.names.indexOf(name)] ?? [];
  }

  /** NaN where a cell is empty or no number. */
  column(name) {
    if (!this.numbers.has(name)) {
      this.numbers.set(name, this.texts(name).map((cell) => (cell.trim() === "" ? NaN : Number(cell))));
    }
    return this.numbers.get(name);
  }
}

/** Rows of a CSV text (RFC 4180); lines that begin with # and blank ones are left out. */
export function* rowsOfCsv(text) {
  let row = [""];
  let isQuoted = false;
  let isAtStart = true; // of a row
  const isKept = () => row.length > 1 || row[0].trim() !== "";
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if (isAtStart && c === "#") { // a quote within a comment quotes nothing
      const end = text.indexOf("\n", i);
      if (end < 0) return;
      i = end;
      continue;
    }
    isAtStart = false;
    if (c === '"' && isQuoted && text[i + 1] === '"') {
      row[row.length - 1] += '"';
      ++i;
    } else if (c === '"') {
      isQuoted = !isQuoted;
    } else if (c === "," && !isQuoted) {
      row.push("");
    } else if (c === "\n" && !isQuoted) {
      if (isKept()) yield row;
      row = [""];
      isAtStart = true;
    } else if (c !== "\r") {
      row[row.length - 1] += c;
    }
  }
  if (isKept()) yield row;
}

/** Reads a `Package` of the program: its header, then arrays, their bytes in planes. */
class Reader {
  constructor(bytes) {
    const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
    this.header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
    this.bytes = bytes;
    this.at = 4 + length;
  }
  take(Type, length) {
    const array = new Type(length);
    for (let shift = 0; shift < 8 * Type.BYTES_PER_ELEMENT; shift += 8) {
      for (let i = 0; i < length; ++i) array[i] |= this.bytes[this.at + i] << shift;
      this.at += length;
    }
    return array;
  }
  /** Signed numbers of 16 bits. */
  takeSigned(length) {
    return Int16Array.from(this.take(Uint16Array, length)); // modulo 2^16
  }
  /** Numbers of 16 bits that were packed as differences. */
  takeSums(length) {
    const array = this.take(Uint16Array, length);
    for (let i = 1; i < length; ++i) array[i] += array[i - 1];
    return array;
  }
  /** The corners of faces: the first less that of the face before, the others less the first. */
  takeFaces(Type, count) {
    const [a, b, c] = [this.take(Type, count), this.take(Type, count), this.take(Type, count)];
    const index = new Type(3 * count);
    let first = 0;
    for (let f = 0; f < count; ++f) {
      first += a[f];
      index[3 * f] = first;
      index[3 * f + 1] = first + b[f];
      index[3 * f + 2] = first + c[f];
    }
    return index;
  }
}

const GRID_STEPS = 65534;
const GRID_NONE = 65535;

function ungridded(indices, low, high) {
  const step = (high - low) / GRID_STEPS;
  return Float32Array.from(indices, (i) => (i === GRID_NONE ? NaN : low + step * i));
}

/** The middles of the edges of curved faces, and which edges faces have: {middles, faceEdges}. */
function takeMiddles(reader, index, position, step) {
  const { faceEdges, ends } = edgesOfFaces(index);
  const middles = new Float32Array(3 * ends.length);
  for (let axis = 0; axis < 3; ++axis) {
    reader.takeSigned(ends.length).forEach((offset, e) => {
      const [a, b] = ends[e];
      middles[3 * e + axis] = 0.5 * (position[3 * a + axis] + position[3 * b + axis]) + step[axis] * offset;
    });
  }
  return { middles, faceEdges };
}

/** A surface: {t, index, position, values, low, high}, and where faces are curved as `surface.js` says. */
export function unpackedFrame(bytes) {
  const reader = new Reader(bytes);
  const { t, vertices, faces, middles: edges, wide, low, high, fields } = reader.header;
  const index = reader.takeFaces(wide ? Uint32Array : Uint16Array, faces);
  const step = [0, 1, 2].map((axis) => (high[axis] - low[axis]) / GRID_STEPS);
  const position = new Float32Array(3 * vertices);
  for (let axis = 0; axis < 3; ++axis) {
    reader.takeSums(vertices).forEach((i, v) => (position[3 * v + axis] = low[axis] + step[axis] * i));
  }
  const curved = edges > 0 ? takeMiddles(reader, index, position, step) : {};
  const values = {};
  for (const field of fields) {
    values[field.name] = ungridded(reader.takeSums(vertices), field.low, field.high);
  }
  return { t, index, position, values, low, high, ...curved };
}

/** The cuts of one moment, each a list of polygons. */
export function unpackedCuts(bytes) {
  const reader = new Reader(bytes);
  return reader.header.cuts.map((cut) => ({
    ...cut,
    t: reader.header.t,
    corners: reader.take(Uint8Array, cut.polygons),
    region: reader.take(Uint8Array, cut.polygons),
    quality: Float32Array.from(reader.take(Uint8Array, cut.polygons), (q) => (q / 255) * cut.quality),
    x: ungridded(reader.takeSums(cut.points), cut.low[0], cut.high[0]),
    y: ungridded(reader.takeSums(cut.points), cut.low[1], cut.high[1]),
    values: Object.fromEntries(cut.fields.map(({ name, low, high }) =>
      [name, ungridded(reader.takeSums(cut.polygons), low, high)])),
  }));
}

/**
 * The fields that frames (or cuts) have, by their entries: those that the program describes, then the
 * others under their own names.
 */
export function fieldsOf(entries, described) {
  const names = new Set(entries.flatMap((entry) => Object.keys(entry.ranges)));
  const known = described.filter(({ name }) => names.delete(name));
  return [...known, ...[...names].map((name) => ({ name, label: name, unit: "" }))];
}

/** [low, high] of a field over all entries that have it; undefined where none has. */
export function rangeOf(entries, name) {
  const ranges = entries.map((entry) => entry.ranges[name]).filter(Boolean);
  if (ranges.length === 0) return undefined;
  return [Math.min(...ranges.map((r) => r[0])), Math.max(...ranges.map((r) => r[1]))];
}

/**
 * The frames (or cuts) of a run, unpacked when first asked for. `entries` says what is known of each
 * beforehand; `load` gives the bytes of the k-th.
 */
export class Frames {
  constructor(entries, load, unpack) {
    this.entries = entries;
    this.load = load;
    this.unpack = unpack;
    this.promises = [];
    this.ready = [];
  }
  get length() {
    return this.entries.length;
  }
  get times() {
    return this.entries.map((entry) => entry.t);
  }
  get(k) {
    this.promises[k] ??= this.load(k).then((bytes) => (this.ready[k] = this.unpack(bytes))).catch((error) => {
      delete this.promises[k]; // it may come when asked for again
      throw error;
    });
    return this.promises[k];
  }
  /** The frame if it has been unpacked already. */
  now(k) {
    return this.ready[k];
  }
  nearest(t) {
    let best = 0;
    this.entries.forEach((entry, k) => {
      if (Math.abs(entry.t - t) < Math.abs(this.entries[best].t - t)) best = k;
    });
    return best;
  }
  all() {
    return Promise.all(this.entries.map((_, k) => this.get(k)));
  }
  /** Unpacks all, a few at a time, so that the page stays awake. */
  async prepare() {
    for (let k = 0; k < this.length; ++k) {
      await this.get(k).catch(() => {});
      if (k % 4 === 3) await new Promise((resume) => setTimeout(resume));
    }
  }
}

/** A run out of the texts that a page carries: `textOf(id)` gives each, compressed and in base 64. */
export async function embeddedRun(run, number, textOf) {
  const prefix = `run${number}-`;
  const bytesOf = async (id) => inflated(bytesOfBase64(await textOf(id)));
  const tables = {};
  for (const name of run.tables) {
    tables[name] = new Table().append(new TextDecoder().decode(await bytesOf(prefix + name)));
  }
  return {
    ...run,
    tables,
    frames: new Frames(run.frames, (k) => bytesOf(`${prefix}frame${k}`), unpackedFrame),
    cuts: new Frames(run.cuts, (k) => bytesOf(`${prefix}cut${k}`), unpackedCuts),
  };
}
