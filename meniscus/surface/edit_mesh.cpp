#include "meniscus/surface/edit_mesh.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

HalfedgeId halfedge_from(const SurfaceMesh& mesh, FaceId f, VertexId a) {
  const FaceVertices& v = mesh.faces[f];
  const std::int32_t k = v[0] == a ? 0 : (v[1] == a ? 1 : 2);
  return {3 * f.value + k};
}

}  // namespace

EditMesh::EditMesh(const SurfaceMesh& mesh, const SurfaceTopology& topology)
    : from_(3 * mesh.num_faces()),
      twin_(3 * mesh.num_faces()),
      out_(mesh.num_vertices()),
      valence_(mesh.num_vertices(), 0) {
  for (const FaceId f : mesh.faces.ids())
    for (std::int32_t k = 0; k < 3; ++k) {
      const VertexId v = mesh.faces[f][static_cast<std::size_t>(k)];
      from_[HalfedgeId{3 * f.value + k}] = v;
      if (!out_[v].is_valid()) ++num_alive_;
      out_[v] = {3 * f.value + k};
      ++valence_[v];
    }
  MENISCUS_ASSERT(2 * topology.edges().size() == static_cast<std::size_t>(from_.size()), "{} {}",
                  topology.edges().size(), from_.size());
  for (const SurfaceEdge& e : topology.edges())
    pair(halfedge_from(mesh, e.left, e.a), halfedge_from(mesh, e.right, e.b));
}

bool EditMesh::are_joined(VertexId a, VertexId b) const {
  bool found = false;
  for_each_out(a, [&](HalfedgeId h) { found = found || to(h) == b; });
  return found;
}

VertexId EditMesh::split(HalfedgeId h) {
  MENISCUS_ASSERT(is_alive(h) && is_alive(twin_[h]), "half-edge {}", h.value);
  const HalfedgeId t = twin_[h];
  const HalfedgeId h1 = next(h), t2 = previous(t);
  const VertexId b = to(h), c = opposite(h), d = opposite(t);
  const HalfedgeId across_h1 = twin_[h1], across_t2 = twin_[t2];
  // Faces (a, b, c) and (b, a, d) become (a, m, c) and (m, a, d); new: (m, b, c) and (b, m, d).
  const HalfedgeId mb = from_.add(VertexId{out_.size()});
  const VertexId m = from_[mb];
  const HalfedgeId bc = from_.add(b), cm = from_.add(c);
  const HalfedgeId bm = from_.add(b), md = from_.add(m), db = from_.add(d);
  twin_.resize(from_.size());
  from_[h1] = m;
  from_[t] = m;
  pair(h1, cm);
  pair(bc, across_h1);
  pair(mb, bm);
  pair(md, t2);
  pair(db, across_t2);
  out_.add(mb);
  out_[b] = bc;
  valence_.add(4);
  ++valence_[c];
  ++valence_[d];
  ++num_alive_;
  return m;
}

void EditMesh::flip(HalfedgeId h) {
  MENISCUS_ASSERT(is_alive(h) && is_alive(twin_[h]), "half-edge {}", h.value);
  MENISCUS_ASSERT(!are_joined(opposite(h), opposite(twin_[h])), "half-edge {}", h.value);
  const HalfedgeId t = twin_[h];
  const HalfedgeId h1 = next(h), h2 = previous(h), t1 = next(t), t2 = previous(t);
  const VertexId a = from(h), b = from(t), c = from(h2), d = from(t2);
  const HalfedgeId across_h1 = twin_[h1], across_h2 = twin_[h2], across_t1 = twin_[t1],
                   across_t2 = twin_[t2];
  // Faces (a, b, c) and (b, a, d) become (d, c, a) and (c, d, b).
  from_[h] = d;
  from_[h1] = c;
  from_[h2] = a;
  from_[t] = c;
  from_[t1] = d;
  from_[t2] = b;
  pair(h1, across_h2);
  pair(h2, across_t1);
  pair(t1, across_t2);
  pair(t2, across_h1);
  out_[a] = h2;
  out_[b] = t2;
  out_[c] = h1;
  out_[d] = t1;
  --valence_[a];
  --valence_[b];
  ++valence_[c];
  ++valence_[d];
  MENISCUS_ASSERT(valence_[a] >= 3 && valence_[b] >= 3, "{} {}", valence_[a], valence_[b]);
}

bool EditMesh::can_collapse(HalfedgeId h) const {
  const VertexId a = from(h), b = to(h), c = opposite(h), d = opposite(twin_[h]);
  if (c == d || valence(c) <= 3 || valence(d) <= 3) return false;
  bool is_manifold = true;
  for_each_out(a, [&](HalfedgeId g) {
    const VertexId w = to(g);
    if (w != b && w != c && w != d && are_joined(w, b)) is_manifold = false;
  });
  return is_manifold;
}

void EditMesh::collapse(HalfedgeId h) {
  MENISCUS_ASSERT(is_alive(h) && can_collapse(h), "half-edge {}", h.value);
  const HalfedgeId t = twin_[h];
  const VertexId a = from(h), b = to(h), c = opposite(h), d = opposite(t);
  const HalfedgeId cb = twin_[next(h)], ac = twin_[previous(h)], da = twin_[next(t)],
                   bd = twin_[previous(t)];
  std::vector<HalfedgeId> leaving;
  for_each_out(a, [&](HalfedgeId g) { leaving.push_back(g); });
  for (const HalfedgeId g : leaving) from_[g] = b;
  for (const HalfedgeId g : {h, t})
    for (const HalfedgeId dead : {g, next(g), previous(g)}) from_[dead] = VertexId{};
  pair(cb, ac);
  pair(da, bd);
  out_[a] = HalfedgeId{};
  out_[b] = ac;
  out_[c] = cb;
  out_[d] = da;
  valence_[b] += valence_[a] - 4;
  --valence_[c];
  --valence_[d];
  --num_alive_;
  MENISCUS_ASSERT(valence_[b] >= 3 && num_alive_ >= 4, "{} {}", valence_[b], num_alive_);
}

EditMesh::CompactMesh EditMesh::compact_mesh() const {
  CompactMesh result;
  VertexField<VertexId> old_to_new(out_.size());
  for (const VertexId v : out_.ids()) {
    if (!is_alive(v)) continue;
    old_to_new[v] = {static_cast<std::int32_t>(result.vertices.size())};
    result.vertices.push_back(v);
  }
  MENISCUS_ASSERT(static_cast<std::int32_t>(result.vertices.size()) == num_alive_, "{} {}",
                  result.vertices.size(), num_alive_);
  for (std::int32_t i = 0; i < from_.size(); i += 3) {
    if (!is_alive(HalfedgeId{i})) continue;
    MENISCUS_ASSERT(is_alive(from_[HalfedgeId{i}]), "a face with dead vertex {}",
                    from_[HalfedgeId{i}].value);
    result.faces.add({old_to_new[from_[HalfedgeId{i}]], old_to_new[from_[HalfedgeId{i + 1}]],
                      old_to_new[from_[HalfedgeId{i + 2}]]});
  }
  return result;
}

}  // namespace meniscus
