#include "meniscus/app/shipped_docs.hpp"

#include <system_error>

namespace meniscus {

std::filesystem::path shipped_docs() {
  std::error_code unreadable;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  return (program.parent_path() / MENISCUS_DOCS_FROM_PROGRAM).lexically_normal();
}

}  // namespace meniscus
