// Sections of an interface with planes.
import { flatFaces, surfacesOf } from "./surface.js";
import { cross, dot } from "./vectors.js";

const PARTS = 4; // of the edges of curved faces

/** The z (or y) of the centroid of what faces enclose, from the volumes under them. */
function centroid(position, faces, axis) {
  let [volume, moment] = [0, 0];
  for (const corners of faces) {
    const [a, b, c] = corners.map((v) => [position[3 * v], position[3 * v + 1], position[3 * v + 2]]);
    const part = dot(a, cross(b, c));
    volume += part;
    moment += (part * (a[axis] + b[axis] + c[axis])) / 4;
  }
  return moment / volume;
}

/** Appends the closed curves in which a plane cuts faces. */
function addLoops(curve, position, faces, normal, offset) {
  const height = (v) => position[3 * v + normal] - offset;
  const next = new Map(); // from an edge that goes down through the plane to the one that comes up
  for (const face of faces) {
    let [down, up] = [];
    face.forEach((a, k) => {
      const b = face[(k + 1) % 3];
      if (height(a) >= 0 === height(b) >= 0) return;
      const edge = { key: `${Math.min(a, b)} ${Math.max(a, b)}`, ends: [Math.min(a, b), Math.max(a, b)] };
      if (height(a) >= 0) down = edge;
      else up = edge;
    });
    if (down) next.set(down.key, { ends: down.ends, to: up.key });
  }
  const add = ([a, b]) => {
    const share = height(a) / (height(a) - height(b));
    const coordinate = (axis) => position[3 * a + axis] + share * (position[3 * b + axis] - position[3 * a + axis]);
    curve.x.push(coordinate(0));
    curve.y.push(coordinate(3 - normal));
  };
  while (next.size > 0) {
    const [[start, { ends }]] = next;
    for (let key = start; next.has(key);) {
      const link = next.get(key);
      add(link.ends);
      next.delete(key);
      key = link.to;
    }
    add(ends);
    curve.x.push(NaN);
    curve.y.push(NaN);
  }
}

/** The sections of all drops, each through its centroid, normal to the y-axis (1) or the z-axis (2): {x, y}. */
export function sectionThroughCentroids(frame, normal) {
  const { index, position } = flatFaces(frame, PARTS);
  const surfaces = surfacesOf({ index, position });
  const bySurface = new Map();
  for (let i = 0; i < index.length; i += 3) {
    const surface = surfaces[index[i]];
    if (!bySurface.has(surface)) bySurface.set(surface, []);
    bySurface.get(surface).push([index[i], index[i + 1], index[i + 2]]);
  }
  const curve = { x: [], y: [] };
  for (const faces of bySurface.values()) addLoops(curve, position, faces, normal, centroid(position, faces, normal));
  return curve;
}
