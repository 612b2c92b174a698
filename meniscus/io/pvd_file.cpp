#include <charconv>
#include <cmath>

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/io/vtk_messages.hpp"

namespace meniscus::io {
namespace {

namespace fs = std::filesystem;

std::string escaped_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

void write_pvd(const fs::path& path, std::span<const PvdEntry> entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const PvdEntry& entry : entries) {
    MENISCUS_ASSERT(std::isfinite(entry.t), "t = {} of {}", entry.t, entry.file);
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.t,
                        escaped_text(entry.file));
  }
  write_file(path, text + "  </Collection>\n</VTKFile>\n");
}

std::vector<PvdEntry> read_pvd(const fs::path& path) {
  const std::string text = read_file(path);
  const VtkMessages silenced;
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromString(text.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (collection == nullptr) {
    reject_input("{}: not a time series of VTK (.pvd), or corrupt", path.string());
  }
  std::vector<PvdEntry> entries;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* set = collection->GetNestedElement(i);
    const char* file = set->GetAttribute("file");
    double t = 0.0;
    if (file == nullptr || set->GetScalarAttribute("timestep", t) == 0) {
      reject_input("{}: entry {} has no file or no time", path.string(), i);
    }
    entries.push_back({t, file});
  }
  return entries;
}

}  // namespace meniscus::io
