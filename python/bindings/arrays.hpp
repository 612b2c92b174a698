#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::python {

namespace py = pybind11;

/// What keeps the storage of a view alive.
using Owner = std::shared_ptr<const void>;

/// A read-only array over storage that `owner` holds. The array shares the ownership: it stays
/// valid when everything else has let go.
template <class T>
py::array view(const Owner& owner, const T* data, std::vector<py::ssize_t> shape) {
  const py::capsule base(std::make_unique<Owner>(owner).release(),
                         [](void* kept) { delete static_cast<Owner*>(kept); });
  py::array_t<T> array(std::move(shape), data, base);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// The points of a mesh, (n, 3).
template <class IdType>
py::array points_view(const Owner& owner, const Field<IdType, Vec3>& x) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return view(owner, x.empty() ? nullptr : x.begin()->data(), {x.size(), 3});
}

/// The numbers of the vertices of faces or cells, (n, Corners).
template <class ElementId, class VertexIdType, std::size_t Corners>
py::array corners_view(const Owner& owner,
                       const Field<ElementId, std::array<VertexIdType, Corners>>& elements) {
  static_assert(sizeof(std::array<VertexIdType, Corners>) == Corners * sizeof(std::int32_t));
  return view(owner, elements.empty() ? nullptr : &elements.begin()->front().value,
              {elements.size(), static_cast<py::ssize_t>(Corners)});
}

/// Elements `first` to `first + count` of named arrays, as a dict: (count,) of numbers, (count, 3)
/// of vectors. Of cell corners, four to an element, `per_element` is 4: (count, 4).
inline py::dict arrays_view(const Owner& owner, std::span<const io::NamedArray> arrays,
                            std::size_t first, std::size_t count, std::size_t per_element = 1) {
  py::dict result;
  for (const io::NamedArray& array : arrays) {
    const std::size_t width = per_element * static_cast<std::size_t>(array.components);
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count)};
    if (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
    result[py::str(array.name)] = view(owner, array.values.data() + first * width, shape);
  }
  return result;
}

/// A surface from checked arrays of shapes (n, 3) and (m, 3).
SurfaceMesh surface_of(const py::array_t<double>& points, const py::array_t<std::int32_t>& faces);

void bind_case(py::module_& m);
void bind_simulation(py::module_& m);
void bind_meshes(py::module_& m);

}  // namespace meniscus::python
