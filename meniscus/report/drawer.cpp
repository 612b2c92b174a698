#include "meniscus/report/drawer.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meniscus/core/error.hpp"
#include "meniscus/report/page_bundle.hpp"

namespace meniscus::report {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> node_command(std::string_view purpose) {
  if (drawer_script().empty())
    reject_input("{}: this program was built without node and npm; install both and build again",
                 purpose);
  return {"node", "-e", std::string(drawer_script())};
}

std::string request(const DrawingData& data, const std::vector<std::string>& pictures) {
  Json texts = Json::object();
  for (const auto& [id, text] : data.texts) texts[id] = text;
  return Json{{"page", Json::parse(data.page)}, {"texts", texts}, {"pictures", pictures}}.dump();
}

}  // namespace

Drawer::Drawer(std::string_view purpose, const DrawingData& data,
               const std::vector<std::string>& pictures)
    : node_(purpose, "nodejs", node_command(purpose)) {
  // It reads all before it writes anything. Where it no longer reads, `next` tells of its failure.
  (void)node_.write(request(data, pictures));
  node_.close_input();
}

std::optional<Picture> Drawer::next() {
  const std::optional<std::string> line = node_.read_line();
  if (!line) {
    if (const int status = node_.wait(); status != 0)
      throw RunFailure(fmt::format("node ended with status {}; pictures are missing", status));
    return std::nullopt;
  }
  const Json head = Json::parse(*line);
  const auto size = head.at("bytes").get<std::size_t>();
  Picture picture{head.at("name").get<std::string>(), node_.read(size)};
  if (picture.svg.size() != size) throw RunFailure("node ended within a picture");
  return picture;
}

}  // namespace meniscus::report
