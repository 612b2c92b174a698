#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "meniscus/case/case.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus::test {

/// A fresh folder under gtest's temporary one, removed with all it holds.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::string_view text) const;
  /// An ascii STL with one solid per tag, in rising order of the tags.
  std::filesystem::path write_stl(const std::string& name, const SurfaceMesh& mesh,
                                  const FaceField<int>& tag) const;
  std::filesystem::path write_stl(const std::string& name, const SurfaceMesh& mesh) const {
    return write_stl(name, mesh, FaceField<int>(mesh.num_faces(), 0));
  }

 private:
  std::filesystem::path path_;
};

/// The least a case needs: lines 1 to 5 of "case.toml"; what follows begins on line 6.
inline constexpr std::string_view kShear =
    "[flow]\n"
    "kind = \"simple-shear\"\n"
    "capillary-number = 0.3\n"
    "[[drop]]\n"
    "radius = 1.0\n";

/// kShear and more, read under the name case.toml.
[[nodiscard]] Case shear_case(std::string_view more = "",
                              const std::vector<std::string>& overrides = {},
                              const std::filesystem::path& folder = {});

/// The message of the InvalidInput that a case causes when it is read and its scene built; "no
/// error" when there is none.
[[nodiscard]] std::string message_of(std::string_view text,
                                     const std::vector<std::string>& overrides = {},
                                     const std::filesystem::path& folder = {});

}  // namespace meniscus::test
