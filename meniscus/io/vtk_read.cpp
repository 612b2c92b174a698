#include <algorithm>
#include <array>
#include <string>
#include <string_view>

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
  // VTK 9.1 trusts what a file says of itself: an absurd length asks for more memory than there is,
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

std::vector<std::array<std::int32_t, 4>> read_tetrahedra(const fs::path& path,
                                                         vtkUnstructuredGrid& grid) {
  std::vector<std::array<std::int32_t, 4>> cells;
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    if (grid.GetCellType(c) != VTK_TETRA) {
      reject_input("{}: cell {} is no tetrahedron; only these are read", path.string(), c);
    }
    grid.GetCells()->GetCellAtId(c, corners);
    if (corners->GetNumberOfIds() != 4) {
      reject_input("{}: cell {} has {} corners", path.string(), c, corners->GetNumberOfIds());
    }
    std::array<std::int32_t, 4>& cell = cells.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const vtkIdType corner = corners->GetId(static_cast<vtkIdType>(k));
      if (corner < 0 || corner >= grid.GetNumberOfPoints()) {
        reject_input("{}: cell {} has the point {}; the file has {} points", path.string(), c,
                     corner, grid.GetNumberOfPoints());
      }
      cell[k] = static_cast<std::int32_t>(corner);
    }
  }
  return cells;
}

}  // namespace

SurfaceFrame read_vtp(const fs::path& path) {
  const vtkSmartPointer<vtkPolyData> poly = read_poly_data(path);
  SurfaceFrame frame;
  frame.mesh = triangles_of(path, read_soup(path, *poly));
  frame.data.on_vertices = read_arrays(*poly->GetPointData());
  frame.data.on_cells = read_arrays(*poly->GetCellData());
  return frame;
}

PolygonFrame read_vtp_polygons(const fs::path& path) {
  const vtkSmartPointer<vtkPolyData> poly = read_poly_data(path);
  return {read_soup(path, *poly), read_arrays(*poly->GetCellData())};
}

VolumeFrame read_vtu(const fs::path& path) {
  const auto grid =
      read_data_set<vtkXMLUnstructuredGridReader>(path, "volume mesh file of VTK (.vtu)");
  VolumeFrame frame;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    const double* point = grid->GetPoint(i);
    frame.points.emplace_back(point[0], point[1], point[2]);
  }
  frame.cells = read_tetrahedra(path, *grid);
  frame.data.on_vertices = read_arrays(*grid->GetPointData());
  frame.data.on_cells = read_arrays(*grid->GetCellData());
  return frame;
}

}  // namespace meniscus::io
