#include "meniscus/app/case_inputs.hpp"

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/checksum.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus {
namespace {

using Inputs = std::map<std::string, std::string>;

void add(Inputs& inputs, const std::string& key, const std::filesystem::path& file) {
  try {
    inputs[key] = fmt::format("{:016x}", io::checksum(io::read_file(file)));
  } catch (const InvalidInput&) {  // a resumed run does without
  }
}

}  // namespace

Inputs case_inputs(const Case& c) {
  Inputs inputs;
  for (std::size_t i = 0; i < c.drops.size(); ++i) {
    if (const auto* shape = std::get_if<FileShape>(&c.drops[i].shape))
      add(inputs, fmt::format("drop[{}].surface", i), shape->file);
    if (const auto* shape = std::get_if<RunShape>(&c.drops[i].shape))
      if (const auto all = io::checkpoints(shape->folder); !all.empty())
        add(inputs, fmt::format("drop[{}].from-run", i), all.back().second);
  }
  if (c.domain.shape == DomainCase::Shape::file) add(inputs, "domain.surface", c.domain.file);
  return inputs;
}

}  // namespace meniscus
