#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meniscus/case/case.hpp"

namespace meniscus::python {

/// A case with the text it was read from, so that keys can be set later. A value.
class PythonCase {
 public:
  /// Messages call the text `name`; `file` is what run.json names, empty where there is none.
  PythonCase(std::string text, std::string name, std::filesystem::path folder,
             std::vector<std::string> overrides, std::string file = {});

  /// Sets keys as --set does, all or none: each is "key=value". Throws InvalidInput.
  void set(const std::vector<std::string>& settings);
  /// As above, without the last `count` settings made before.
  void replace_last(std::size_t count, const std::vector<std::string>& settings);

  [[nodiscard]] const Case& parsed() const { return parsed_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::string text_, name_, file_;
  std::filesystem::path folder_;
  std::vector<std::string> overrides_;
  Case parsed_;
};

}  // namespace meniscus::python
