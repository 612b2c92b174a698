#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "meniscus/core/child_process.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/io/vtk_grid.hpp"
#include "meniscus/io/vtk_messages.hpp"

namespace meniscus::io {
namespace {

namespace fs = std::filesystem;

/// A gigabyte takes some ten seconds. Arrays of one value may be packed a hundredfold.
ChildLimits read_limits(std::size_t file_size) {
  constexpr std::size_t kLeast = std::size_t{1} << 30U, kMostPacking = 100;
  return {.seconds = 600, .memory = kLeast + kMostPacking * file_size};
}

/// Whether each array of numbers says of which type it is. VTK 9.1 follows a null pointer where an
/// array among the field data does not.
bool have_arrays_types(std::string_view bytes) {
  static constexpr std::array types = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                       "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  const std::string_view head = bytes.substr(0, bytes.find("<AppendedData"));
  for (std::size_t at = head.find("<DataArray"); at != std::string_view::npos;
       at = head.find("<DataArray", at + 1)) {
    const std::string_view element = head.substr(at, head.find('>', at) - at);
    const bool has_type = std::ranges::any_of(types, [&](std::string_view type) {
      return element.find(fmt::format("type=\"{}\"", type)) != std::string_view::npos;
    });
    if (!has_type) return false;
  }
  return true;
}

[[noreturn]] void reject_foreign(const fs::path& path, const char* kind) {
  reject_input("{}: not a {}, or corrupt", path.string(), kind);
}

/// What one of VTK's readers makes of a file; `kind` serves the message.
template <class Reader>
auto read_data_set(const fs::path& path, const char* kind) {
  const std::string bytes = read_file(path);
  if (!have_arrays_types(bytes)) reject_foreign(path, kind);
  const VtkMessages messages;
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  // VTK 9.1 trusts what a file says of itself. An absurd length asks for more memory than there is,
  // and blocks that are not where they should be end the process.
  const ChildResult read = run_in_child([&] { reader->Update(); }, read_limits(bytes.size()));
  if (!read.failure.empty()) reject_foreign(path, kind);
  if (messages.any() || reader->GetErrorCode() != 0 || reader->GetOutput() == nullptr) {
    reject_foreign(path, kind);
  }
  return vtkSmartPointer(reader->GetOutput());
}

PolygonSoup read_soup(const fs::path& path, vtkPolyData& poly) {
  if (poly.GetNumberOfStrips() + poly.GetNumberOfLines() + poly.GetNumberOfVerts() > 0) {
    reject_input("{}: holds strips, lines or points; only polygons are read", path.string());
  }
  PolygonSoup soup;
  for (vtkIdType i = 0; i < poly.GetNumberOfPoints(); ++i) {
    const double* point = poly.GetPoint(i);
    soup.points.emplace_back(point[0], point[1], point[2]);
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < poly.GetPolys()->GetNumberOfCells(); ++c) {
    poly.GetPolys()->GetCellAtId(c, corners);
    if (corners->GetNumberOfIds() < 3) {
      reject_input("{}: face {} has {} corners; a face has at least 3", path.string(), c,
                   corners->GetNumberOfIds());
    }
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
      soup.corners.push_back(corners->GetId(k));
    }
    soup.end_face();
  }
  return soup;
}

SurfaceMesh triangles_of(const fs::path& path, const PolygonSoup& soup) {
  SurfaceMesh mesh;
  for (const Vec3& x : soup.points) mesh.x.add(x);
  for (std::size_t f = 0; f < soup.num_faces(); ++f) {
    const std::span<const std::int64_t> corners = soup.face(f);
    if (corners.size() != 3) {
      reject_input("{}: face {} has {} corners; only triangles are read", path.string(), f,
                   corners.size());
    }
    FaceVertices face;
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] < 0 || corners[k] >= mesh.num_vertices()) {
        reject_input("{}: face {} has the point {}; the file has {} points", path.string(), f,
                     corners[k], mesh.num_vertices());
      }
      face[k] = VertexId{static_cast<std::int32_t>(corners[k])};
    }
    mesh.faces.add(face);
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> read_poly_data(const fs::path& path) {
  return read_data_set<vtkXMLPolyDataReader>(path, "surface file of VTK (.vtp)");
}

/// All arrays of numbers, whatever their type in the file.
std::vector<NamedArray> read_arrays(vtkFieldData& fields) {
  std::vector<NamedArray> arrays;
  for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
    vtkDataArray* source = fields.GetArray(i);
    if (source == nullptr || source->GetName() == nullptr) continue;
    NamedArray& array = arrays.emplace_back();
    array.name = source->GetName();
    array.components = source->GetNumberOfComponents();
    for (vtkIdType tuple = 0; tuple < source->GetNumberOfTuples(); ++tuple) {
      for (int k = 0; k < array.components; ++k) {
        array.values.push_back(source->GetComponent(tuple, k));
      }
    }
  }
  return arrays;
}

/// The nodes of a cell, as many as its type has.
template <std::size_t Nodes>
std::array<std::int32_t, Nodes> read_nodes(const fs::path& path, vtkUnstructuredGrid& grid,
                                           vtkIdType cell) {
  vtkNew<vtkIdList> ids;
  grid.GetCells()->GetCellAtId(cell, ids);
  if (ids->GetNumberOfIds() != static_cast<vtkIdType>(Nodes)) {
    reject_input("{}: cell {} has {} points; its type has {}", path.string(), cell,
                 ids->GetNumberOfIds(), Nodes);
  }
  std::array<std::int32_t, Nodes> nodes;
  for (std::size_t k = 0; k < Nodes; ++k) {
    const vtkIdType node = ids->GetId(static_cast<vtkIdType>(k));
    if (node < 0 || node >= grid.GetNumberOfPoints()) {
      reject_input("{}: cell {} has the point {}; the file has {} points", path.string(), cell,
                   node, grid.GetNumberOfPoints());
    }
    nodes[k] = static_cast<std::int32_t>(node);
  }
  return nodes;
}

void read_cells(const fs::path& path, vtkUnstructuredGrid& grid, VolumeFrame& frame) {
  constexpr std::array<std::int32_t, 6> kFlat{-1, -1, -1, -1, -1, -1};
  bool is_any_curved = false;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    const int type = grid.GetCellType(c);
    if (type != VtkCell<4>::flat && type != VtkCell<4>::quadratic) {
      reject_input("{}: cell {} is no tetrahedron; only these are read", path.string(), c);
    }
    frame.middles.push_back(kFlat);
    if (type == VtkCell<4>::flat) {
      frame.cells.push_back(read_nodes<4>(path, grid, c));
      continue;
    }
    const auto nodes = read_nodes<10>(path, grid, c);
    std::copy_n(nodes.begin(), 4, frame.cells.emplace_back().begin());
    std::copy_n(nodes.begin() + 4, 6, frame.middles.back().begin());
    is_any_curved = true;
  }
  if (!is_any_curved) frame.middles.clear();
}

/// The faces of a grid by their corners, and the points over the middles of those that are curved.
struct GridFaces {
  PolygonSoup soup;                        ///< of the points that are corners
  std::vector<std::int32_t> sources;       ///< the number of each such point in the file
  FaceField<std::array<Vec3, 3>> middles;  ///< as in SurfaceFrame, of triangles
};

Vec3 point_of(vtkUnstructuredGrid& grid, vtkIdType i) { return Vec3(grid.GetPoint(i)); }

/// The middles of a triangle's edges, which are straight.
std::array<Vec3, 3> straight_middles(const std::array<Vec3, 3>& x) {
  return {0.5 * (x[0] + x[1]), 0.5 * (x[1] + x[2]), 0.5 * (x[2] + x[0])};
}

/// Appends a face to the soup and, if it has three corners, to the middles; returns whether it is
/// curved.
bool read_face(const fs::path& path, vtkUnstructuredGrid& grid, vtkIdType cell, GridFaces& faces) {
  std::vector<std::int32_t> corners;
  std::array<Vec3, 3> x, middles;
  bool is_curved = false;
  switch (grid.GetCellType(cell)) {
    case VTK_QUADRATIC_TRIANGLE: {
      const auto nodes = read_nodes<6>(path, grid, cell);
      corners.assign(nodes.begin(), nodes.begin() + 3);
      for (std::size_t k = 0; k < 3; ++k) middles[k] = point_of(grid, nodes[3 + k]);
      is_curved = true;
      break;
    }
    case VTK_TRIANGLE: {
      const auto nodes = read_nodes<3>(path, grid, cell);
      corners.assign(nodes.begin(), nodes.end());
      for (std::size_t k = 0; k < 3; ++k) x[k] = point_of(grid, nodes[k]);
      middles = straight_middles(x);
      break;
    }
    case VTK_QUAD: {
      const auto nodes = read_nodes<4>(path, grid, cell);
      corners.assign(nodes.begin(), nodes.end());
      break;
    }
    default:
      reject_input("{}: cell {} is neither a triangle nor a quadrangle; only these are read",
                   path.string(), cell);
  }
  faces.soup.corners.insert(faces.soup.corners.end(), corners.begin(), corners.end());
  faces.soup.end_face();
  if (corners.size() == 3) faces.middles.add(middles);
  return is_curved;
}

/// Leaves out the points that are no corners, and numbers the others anew.
void keep_corner_points(vtkUnstructuredGrid& grid, GridFaces& faces) {
  std::vector<std::int64_t> number(static_cast<std::size_t>(grid.GetNumberOfPoints()), -1);
  for (const std::int64_t corner : faces.soup.corners) number[static_cast<std::size_t>(corner)] = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<std::int64_t>(faces.sources.size());
    faces.sources.push_back(static_cast<std::int32_t>(i));
    faces.soup.points.push_back(point_of(grid, static_cast<vtkIdType>(i)));
  }
  for (std::int64_t& corner : faces.soup.corners) corner = number[static_cast<std::size_t>(corner)];
}

GridFaces read_faces(const fs::path& path, vtkUnstructuredGrid& grid) {
  GridFaces faces;
  bool is_any_curved = false;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
    is_any_curved = read_face(path, grid, c, faces) || is_any_curved;
  if (!is_any_curved) faces.middles = {};
  keep_corner_points(grid, faces);
  return faces;
}

vtkSmartPointer<vtkUnstructuredGrid> read_surface_grid(const fs::path& path) {
  return read_data_set<vtkXMLUnstructuredGridReader>(path, "surface file of VTK (.vtu)");
}

/// The values of an array at some of its elements.
NamedArray selected(const NamedArray& array, std::span<const std::int32_t> elements) {
  NamedArray result{.name = array.name, .components = array.components, .values = {}};
  for (const std::int32_t element : elements) {
    const auto first = array.values.begin() + std::ptrdiff_t{element} * array.components;
    result.values.insert(result.values.end(), first, first + array.components);
  }
  return result;
}

SurfaceFrame read_vtp(const fs::path& path) {
  const vtkSmartPointer<vtkPolyData> poly = read_poly_data(path);
  SurfaceFrame frame;
  frame.mesh = triangles_of(path, read_soup(path, *poly));
  frame.data.on_vertices = read_arrays(*poly->GetPointData());
  frame.data.on_cells = read_arrays(*poly->GetCellData());
  return frame;
}

SurfaceFrame read_surface_vtu(const fs::path& path) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_surface_grid(path);
  GridFaces faces = read_faces(path, *grid);
  SurfaceFrame frame;
  frame.mesh = triangles_of(path, faces.soup);
  const auto num_points = static_cast<std::size_t>(grid->GetNumberOfPoints());
  for (const NamedArray& array : read_arrays(*grid->GetPointData()))
    if (array.values.size() == num_points * static_cast<std::size_t>(array.components))
      frame.data.on_vertices.push_back(selected(array, faces.sources));
  frame.data.on_cells = read_arrays(*grid->GetCellData());
  frame.middles = std::move(faces.middles);
  return frame;
}

}  // namespace

SurfaceFrame read_surface_frame(const fs::path& path) {
  return path.extension() == ".vtu" ? read_surface_vtu(path) : read_vtp(path);
}

PolygonFrame read_vtp_polygons(const fs::path& path) {
  const vtkSmartPointer<vtkPolyData> poly = read_poly_data(path);
  return {read_soup(path, *poly), read_arrays(*poly->GetCellData())};
}

PolygonFrame read_vtu_polygons(const fs::path& path) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_surface_grid(path);
  return {read_faces(path, *grid).soup, read_arrays(*grid->GetCellData())};
}

VolumeFrame read_vtu(const fs::path& path) {
  const auto grid =
      read_data_set<vtkXMLUnstructuredGridReader>(path, "volume mesh file of VTK (.vtu)");
  VolumeFrame frame;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    const double* point = grid->GetPoint(i);
    frame.points.emplace_back(point[0], point[1], point[2]);
  }
  read_cells(path, *grid, frame);
  frame.data.on_vertices = read_arrays(*grid->GetPointData());
  frame.data.on_cells = read_arrays(*grid->GetCellData());
  return frame;
}

}  // namespace meniscus::io
