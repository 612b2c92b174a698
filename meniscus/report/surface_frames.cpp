#include "meniscus/report/surface_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::report {
namespace {

const io::NamedArray* find_scalar(const std::vector<io::NamedArray>& arrays, const char* name,
                                  std::int32_t size) {
  const auto found = std::ranges::find(arrays, name, &io::NamedArray::name);
  const bool is_usable = found != arrays.end() && found->components == 1 &&
                         found->values.size() == static_cast<std::size_t>(size);
  return is_usable ? &*found : nullptr;
}

bool are_finite(const FaceField<std::array<Vec3, 3>>& middles) {
  return std::ranges::all_of(middles, [](const std::array<Vec3, 3>& of_face) {
    return std::ranges::all_of(of_face, [](const Vec3& x) { return x.allFinite(); });
  });
}

}  // namespace

std::vector<const io::NamedArray*> one_value_arrays(const std::vector<io::NamedArray>& arrays,
                                                    std::size_t size) {
  std::vector<const io::NamedArray*> scalars;
  for (const io::NamedArray& array : arrays)
    if (array.components == 1 && array.values.size() == size) scalars.push_back(&array);
  return scalars;
}

SurfaceFrame load_surface(const std::filesystem::path& path, double t) {
  io::SurfaceFrame file = io::read_surface_frame(path);
  if (!is_finite(file.mesh) || !are_finite(file.middles))
    reject_input("{}: a coordinate is not finite", path.string());
  SurfaceFrame frame{.t = t, .mesh = file.mesh, .drop = {}};
  frame.middles = std::move(file.middles);
  for (const io::NamedArray* array :
       one_value_arrays(file.data.on_vertices, frame.mesh.x.span().size()))
    frame.fields.push_back({array->name, VertexField<double>(array->values)});
  frame.drop = FaceField<int>(frame.mesh.num_faces(), 0);
  if (const auto* drop = find_scalar(file.data.on_cells, "drop", frame.mesh.num_faces())) {
    std::ranges::transform(drop->values, frame.drop.begin(),
                           [](double id) { return static_cast<int>(std::lround(id)); });
  }
  return frame;
}

std::vector<io::PvdEntry> nearest_frames(std::span<const io::PvdEntry> frames,
                                         std::span<const double> times) {
  std::vector<std::size_t> chosen;
  for (const double time : times) {
    const auto nearest = std::ranges::min_element(
        frames, {}, [&](const io::PvdEntry& frame) { return std::abs(frame.t - time); });
    if (nearest != frames.end())
      chosen.push_back(static_cast<std::size_t>(nearest - frames.begin()));
  }
  std::ranges::sort(chosen);
  const auto repeated = std::ranges::unique(chosen);
  chosen.erase(repeated.begin(), repeated.end());
  std::vector<io::PvdEntry> result;
  result.reserve(chosen.size());
  for (const std::size_t i : chosen) result.push_back(frames[i]);
  return result;
}

std::vector<std::size_t> evenly_spaced_numbers(std::size_t size, std::size_t count) {
  MENISCUS_ASSERT(count > 1 && size > count, "{} of {} cannot be spread", count, size);
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < count; ++k)  // k (size − 1)/(count − 1), rounded
    numbers.push_back((2 * k * (size - 1) + count - 1) / (2 * (count - 1)));
  return numbers;
}

std::vector<io::PvdEntry> evenly_spaced_frames(std::span<const io::PvdEntry> frames, int count) {
  const auto most = static_cast<std::size_t>(count);
  if (frames.size() <= most) return {frames.begin(), frames.end()};
  std::vector<io::PvdEntry> result;
  for (const std::size_t k : evenly_spaced_numbers(frames.size(), most))
    result.push_back(frames[k]);
  return result;
}

std::vector<SurfaceFrame> load_surfaces(RunData& run, std::span<const io::PvdEntry> frames) {
  std::vector<SurfaceFrame> surfaces;
  for (const io::PvdEntry& frame : frames) {
    try {
      surfaces.push_back(load_surface(run.folder / frame.file, frame.t));
    } catch (const InvalidInput& error) {
      run.faults.emplace_back(error.what());
    }
  }
  return surfaces;
}

namespace {

/// The mean of the values of the vertices that each coarse vertex replaces.
VertexField<double> cluster_means(const VertexField<double>& values,
                                  const VertexField<VertexId>& to_coarse,
                                  const VertexField<double>& count) {
  MENISCUS_ASSERT(values.empty() || values.size() == to_coarse.size(), "{} values of {} vertices",
                  values.size(), to_coarse.size());
  VertexField<double> means(values.empty() ? 0 : count.size(), 0.0);
  for (const VertexId v : values.ids()) {
    const VertexId coarse = to_coarse[v];
    means[coarse] += values[v] / count[coarse];
  }
  return means;
}

}  // namespace

SurfaceFrame coarse_frame(const SurfaceFrame& frame, int num_faces) {
  if (frame.mesh.num_faces() <= num_faces) return frame;
  MENISCUS_ASSERT(frame.drop.size() == frame.mesh.num_faces(), "{} drops of {} faces",
                  frame.drop.size(), frame.mesh.num_faces());
  // A surface of area S crosses about 1.5 S/h² cells of edge h, each with two faces around it.
  const double h = std::sqrt(3.0 * surface_area(frame.mesh) / num_faces);
  SurfaceFrame result{.t = frame.t, .mesh = {}, .drop = {}};
  std::map<std::array<long, 3>, VertexId> cell_to_vertex;
  VertexField<VertexId> to_coarse(frame.mesh.num_vertices());
  VertexField<double> count;
  for (const VertexId v : frame.mesh.x.ids()) {
    const Vec3& x = frame.mesh.x[v];
    const std::array<long, 3> cell = {std::lround(x[0] / h), std::lround(x[1] / h),
                                      std::lround(x[2] / h)};
    const auto [found, is_new] = cell_to_vertex.try_emplace(cell, VertexId{count.size()});
    to_coarse[v] = found->second;
    if (is_new) {
      count.add(0.0);
      result.mesh.x.add(Vec3::Zero());
    }
    const double n = ++count[to_coarse[v]];
    Vec3& mean = result.mesh.x[to_coarse[v]];
    mean += (x - mean) / n;
  }
  for (const SurfaceField& field : frame.fields) {
    result.fields.push_back({field.name, cluster_means(field.values, to_coarse, count)});
  }
  for (const FaceId f : frame.mesh.faces.ids()) {
    FaceVertices face;
    std::ranges::transform(frame.mesh.faces[f], face.begin(),
                           [&](VertexId v) { return to_coarse[v]; });
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    result.mesh.faces.add(face);
    result.drop.add(frame.drop[f]);
  }
  return result;
}

}  // namespace meniscus::report
