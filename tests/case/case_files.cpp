#include "tests/case/case_files.hpp"

#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <unistd.h>

#include "meniscus/core/error.hpp"

namespace meniscus::test {

TemporaryFolder::TemporaryFolder() {
  static int count = 0;
  path_ = std::filesystem::path(::testing::TempDir()) /
          fmt::format("meniscus_case_{}_{}", ::getpid(), count++);
  std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, std::string_view text) const {
  std::ofstream(path_ / name) << text;
  return path_ / name;
}

std::filesystem::path TemporaryFolder::write_stl(const std::string& name, const SurfaceMesh& mesh,
                                                 const FaceField<int>& tag) const {
  std::string text;
  for (const int solid : std::set<int>(tag.begin(), tag.end())) {
    text += fmt::format("solid patch{}\n", solid);
    for (const FaceId f : mesh.faces.ids()) {
      if (tag[f] != solid) continue;
      text += "facet normal 0 0 0\nouter loop\n";
      for (const VertexId v : mesh.faces[f])
        text += fmt::format("vertex {} {} {}\n", mesh.x[v].x(), mesh.x[v].y(), mesh.x[v].z());
      text += "endloop\nendfacet\n";
    }
    text += fmt::format("endsolid patch{}\n", solid);
  }
  return write(name, text);
}

Case shear_case(std::string_view more, const std::vector<std::string>& overrides,
                const std::filesystem::path& folder) {
  return parse_case(std::string(kShear) + std::string(more), "case.toml", folder, overrides);
}

std::string message_of(std::string_view text, const std::vector<std::string>& overrides,
                       const std::filesystem::path& folder) {
  try {
    (void)build_scene(parse_case(text, "case.toml", folder, overrides));
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace meniscus::test
