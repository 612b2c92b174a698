#include "meniscus/app/output_file.hpp"

#include <unistd.h>

#include "meniscus/core/error.hpp"

namespace meniscus {

void require_writable(const std::filesystem::path& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder) || access(folder.c_str(), W_OK) != 0)
    reject_input("-o {}: {} is no folder one can write to", file.string(), folder.string());
  if (std::filesystem::is_directory(file)) reject_input("-o {}: is a folder", file.string());
}

}  // namespace meniscus
