#include "meniscus/app/run_json.hpp"

#include <fstream>

#include "meniscus/io/run_files.hpp"

namespace meniscus {

using Json = nlohmann::ordered_json;

Json read_run_json(const std::filesystem::path& folder) {
  std::ifstream file(folder / io::RunFiles::record);
  Json json = Json::parse(file, nullptr, false);
  return json.is_object() ? json : Json::object();
}

std::string file_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace meniscus
