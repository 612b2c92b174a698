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
 * How the points of a surface are numbered whose edges are in `parts` pieces: the vertices, those on
 * edges, those in faces. `onEdge` and `inFace` are their places in barycentric coordinates.
 */
function refinement(frame, parts) {
  const { faceEdges, ends } = edgesOfFaces(frame.index);
  const [onEdge, inFace, inFaceNumbers] = [[], [], new Map()];
  for (let i = 1; i < parts; ++i) onEdge.push([1 - i / parts, i / parts, 0]);
  for (let i = 1; i < parts; ++i) {
    for (let j = 1; i + j < parts; ++j) {
      inFaceNumbers.set(i * parts + j, inFace.length);
      inFace.push([(parts - i - j) / parts, i / parts, j / parts]);
    }
  }
  const numVertices = frame.position.length / 3;
  const firstInFaces = numVertices + ends.length * onEdge.length;
  return {
    parts, index: frame.index, faceEdges, ends, onEdge, inFace, numVertices,
    numPoints: firstInFaces + numFaces(frame) * inFace.length,
    /** The i-th point of edge e from its lower end on. */
    pointOnEdge: (e, i) => (i === 0 ? ends[e][0] : i === parts ? ends[e][1] : numVertices + e * onEdge.length + i - 1),
    /** The point of face f that is i steps from corner 0 toward 1 and j toward 2, on none of its edges. */
    pointInFace: (f, i, j) => firstInFaces + f * inFace.length + inFaceNumbers.get(i * parts + j),
  };
}

/** The small triangles of all faces. */
function piecesOfFaces({ parts, index, faceEdges, ends, pointOnEdge, pointInFace }) {
  const pieces = new Uint32Array(parts * parts * index.length);
  let at = 0;
  const add = (a, b, c) => {
    pieces[at++] = a;
    pieces[at++] = b;
    pieces[at++] = c;
  };
  for (let f = 0; 3 * f < index.length; ++f) {
    const alongEdge = (k, i) => { // the i-th point from corner k on
      const e = faceEdges[3 * f + k];
      return pointOnEdge(e, ends[e][0] === index[3 * f + k] ? i : parts - i);
    };
    const point = (i, j) => {
      if (j === 0) return alongEdge(0, i);
      if (i + j === parts) return alongEdge(1, j);
      if (i === 0) return alongEdge(2, parts - j);
      return pointInFace(f, i, j);
    };
    for (let i = 0; i < parts; ++i) {
      for (let j = 0; i + j < parts; ++j) {
        add(point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < parts) add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
    }
  }
  return pieces;
}

/** Pairs of points along all edges. */
function piecesOfEdges({ parts, ends, pointOnEdge }) {
  const pieces = new Uint32Array(2 * parts * ends.length);
  for (let e = 0, at = 0; e < ends.length; ++e) {
    for (let i = 0; i < parts; ++i) {
      pieces[at++] = pointOnEdge(e, i);
      pieces[at++] = pointOnEdge(e, i + 1);
    }
  }
  return pieces;
}

/**
 * An array of `size` numbers a vertex at all points: parabolic where `middles` gives the numbers at the
 * middles of edges, else linear.
 */
function atAllPoints(array, size, middles, { index, faceEdges, ends, onEdge, inFace, numVertices, numPoints }) {
  const weights = ([a, b, c]) => (middles ? weightsAt(a, b, c) : [a, b, c, 0, 0, 0]);
  const [edgeWeights, faceWeights] = [onEdge.map(weights), inFace.map(weights)];
  const middle = (e, k) => (middles ? middles[size * e + k] : 0);
  const all = new Float32Array(size * numPoints);
  all.set(array);
  let at = size * numVertices;
  ends.forEach(([a, b], e) => {
    for (const w of edgeWeights) {
      for (let k = 0; k < size; ++k) all[at++] = w[0] * array[size * a + k] + w[1] * array[size * b + k] + w[3] * middle(e, k);
    }
  });
  for (let f = 0; f < index.length; f += 3) {
    for (const w of faceWeights) {
      for (let k = 0; k < size; ++k) {
        let sum = 0;
        for (let i = 0; i < 3; ++i) sum += w[i] * array[size * index[f + i] + k] + w[3 + i] * middle(faceEdges[f + i], k);
        all[at++] = sum;
      }
    }
  }
  return all;
}

/**
 * The surface with every edge in `parts` pieces and every face in `parts`² flat ones: {index, position,
 * values, edges}; `edges` are pairs of vertices along the edges of the faces. Values are linear on faces.
 */
export function refined(frame, parts) {
  const points = refinement(frame, parts);
  const values = Object.entries(frame.values).map(([name, of]) => [name, atAllPoints(of, 1, undefined, points)]);
  return {
    ...frame, index: piecesOfFaces(points), position: atAllPoints(frame.position, 3, frame.middles, points),
    values: Object.fromEntries(values), edges: piecesOfEdges(points), middles: undefined, faceEdges: undefined,
  };
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
