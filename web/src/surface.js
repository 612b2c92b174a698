// The faces of a frame: flat, or parabolic ones through a point over the middle of each edge (those of
// quadratic elements and of boundary integrals). A curved frame has `middles`, three numbers an edge, and
// `faceEdges`, the numbers of the edges 01, 12, 20 of each face.

const at = (array, k) => [array[3 * k], array[3 * k + 1], array[3 * k + 2]];
const combination = (weights, points) => [0, 1, 2].map((axis) => weights.reduce((sum, w, i) => sum + w * points[i][axis], 0));

/** Corners of face f, then the points over the middles of its edges where it is curved. */
export function nodesOfFace(frame, f) {
  const corners = [0, 1, 2].map((k) => at(frame.position, frame.index[3 * f + k]));
  if (!frame.middles) return corners;
  return [...corners, ...[0, 1, 2].map((k) => at(frame.middles, frame.faceEdges[3 * f + k]))];
}

/** The weights of a curved face's nodes at a place with barycentric coordinates a, b, c. */
const weightsAt = (a, b, c) => [a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a];

/** The point of a face at barycentric coordinates a, b, c. */
export function pointOfFace(nodes, a, b, c) {
  return combination(nodes.length === 3 ? [a, b, c] : weightsAt(a, b, c), nodes);
}

export const numFaces = (frame) => frame.index.length / 3;

/** Numbers edges in the order in which faces name them: the numbers of edges 01, 12, 20 of each face. */
export function edgesOfFaces(index) {
  const numbers = new Map();
  const ends = [];
  const faceEdges = new Uint32Array(index.length);
  for (let f = 0; f < index.length; f += 3) {
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [index[f + k], index[f + ((k + 1) % 3)]];
      const key = Math.min(a, b) * 4294967296 + Math.max(a, b);
      if (!numbers.has(key)) {
        numbers.set(key, ends.length);
        ends.push([Math.min(a, b), Math.max(a, b)]);
      }
      faceEdges[f + k] = numbers.get(key);
    }
  }
  return { faceEdges, ends };
}

/**
 * The surface with every edge in `parts` pieces and every face in `parts`² flat ones: {index, position,
 * values, edges}; `edges` are pairs of vertices along the edges of the faces. Values are linear on faces.
 */
export function refined(frame, parts) {
  const { faceEdges, ends } = edgesOfFaces(frame.index);
  const numVertices = frame.position.length / 3;
  const position = [...frame.position];
  const sources = Array.from({ length: numVertices }, (_, v) => [[v, 1]]);
  const add = (x, source) => {
    position.push(...x);
    return sources.push(source) - 1;
  };
  const onEdges = ends.map(([a, b], e) => Array.from({ length: parts - 1 }, (_, i) => {
    const s = (i + 1) / parts;
    const nodes = [at(frame.position, a), at(frame.position, b), at(frame.position, b)];
    const curved = frame.middles ? [nodes[0], nodes[1], nodes[1], at(frame.middles, e), nodes[1], nodes[1]] : nodes;
    return add(pointOfFace(curved, 1 - s, s, 0), [[a, 1 - s], [b, s]]);
  }));
  const alongEdge = (f, k, i) => { // the i-th point from corner k on
    const [from, to] = [frame.index[3 * f + k], frame.index[3 * f + ((k + 1) % 3)]];
    if (i === 0) return from;
    if (i === parts) return to;
    return onEdges[faceEdges[3 * f + k]][from < to ? i - 1 : parts - i - 1];
  };
  const index = [];
  for (let f = 0; f < numFaces(frame); ++f) {
    const nodes = nodesOfFace(frame, f);
    const corners = [0, 1, 2].map((k) => frame.index[3 * f + k]);
    const inner = new Map();
    const vertexAt = (i, j) => { // i steps from corner 0 to 1, j to 2
      if (j === 0) return alongEdge(f, 0, i);
      if (i + j === parts) return alongEdge(f, 1, j);
      if (i === 0) return alongEdge(f, 2, parts - j);
      const key = i * (parts + 1) + j;
      if (!inner.has(key)) {
        const [a, b, c] = [(parts - i - j) / parts, i / parts, j / parts];
        inner.set(key, add(pointOfFace(nodes, a, b, c), corners.map((v, k) => [v, [a, b, c][k]])));
      }
      return inner.get(key);
    };
    for (let i = 0; i < parts; ++i) {
      for (let j = 0; i + j < parts; ++j) {
        index.push(vertexAt(i, j), vertexAt(i + 1, j), vertexAt(i, j + 1));
        if (i + j + 1 < parts) index.push(vertexAt(i + 1, j), vertexAt(i + 1, j + 1), vertexAt(i, j + 1));
      }
    }
  }
  const values = Object.fromEntries(Object.entries(frame.values).map(([name, of]) => [name,
    Float32Array.from(sources, (source) => source.reduce((sum, [v, weight]) => sum + weight * of[v], 0))]));
  const edges = ends.flatMap(([a, b], e) => {
    const way = [a, ...onEdges[e], b];
    return way.slice(1).flatMap((vertex, i) => [way[i], vertex]);
  });
  return { ...frame, index: Uint32Array.from(index), position: Float32Array.from(position), values,
    edges: Uint32Array.from(edges), middles: undefined, faceEdges: undefined };
}

/** The frame as flat faces only: a curved one in pieces. */
export function flatFaces(frame, parts) {
  return frame.middles ? refined(frame, parts) : frame;
}

/** Which surface each vertex belongs to, from 0 on: those that faces join are of one. */
export function surfacesOf(frame) {
  const parent = Array.from({ length: frame.position.length / 3 }, (_, v) => v);
  const rootOf = (v) => {
    while (parent[v] !== v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (let i = 0; i < frame.index.length; i += 3) {
    const root = rootOf(frame.index[i]);
    parent[rootOf(frame.index[i + 1])] = root;
    parent[rootOf(frame.index[i + 2])] = root;
  }
  const numbers = new Map();
  return parent.map((_, v) => {
    const root = rootOf(v);
    if (!numbers.has(root)) numbers.set(root, numbers.size);
    return numbers.get(root);
  });
}
