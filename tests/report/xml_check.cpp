#include "tests/report/xml_check.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace meniscus::test {
namespace {

constexpr std::array<std::string_view, 5> entities = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == ':';
}

/// Whether each `&` begins an entity and there is no control character.
bool is_clean(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_control = static_cast<unsigned char>(text[i]) < ' ' && text[i] != '\n' &&
                            text[i] != '\t' && text[i] != '\r';
    if (is_control) return false;
    if (text[i] != '&') continue;
    const bool is_entity = std::ranges::any_of(
        entities, [&](std::string_view e) { return text.substr(i).starts_with(e); });
    if (!is_entity) return false;
  }
  return true;
}

/// Reads `name="value"` pairs up to the end of a tag; false at anything else.
bool parse_attributes(std::string_view tag, Xml& xml) {
  std::set<std::string> names;
  std::size_t at = 0;
  while (true) {
    while (at < tag.size() && std::isspace(static_cast<unsigned char>(tag[at])) != 0) ++at;
    if (at == tag.size()) return true;
    const std::size_t start = at;
    while (at < tag.size() && is_name(tag[at])) ++at;
    const std::string name(tag.substr(start, at - start));
    if (name.empty() || !tag.substr(at).starts_with("=\"")) return false;
    const std::size_t end = tag.find('"', at + 2);
    if (end == std::string_view::npos || !names.insert(name).second) return false;
    const std::string value(tag.substr(at + 2, end - at - 2));
    if (!is_clean(value)) return false;
    xml.attributes.emplace_back(name, value);
    at = end + 1;
  }
}

/// Opens or closes the element of one tag (without its angle brackets).
std::string take_tag(std::string_view tag, std::vector<std::string>& open, Xml& xml) {
  if (tag.starts_with('?') || tag.starts_with("!DOCTYPE")) return {};
  const bool is_end = tag.starts_with('/'), is_empty = tag.ends_with('/');
  if (is_end) tag.remove_prefix(1);
  if (is_empty) tag.remove_suffix(1);
  const auto name_end = std::ranges::find_if_not(tag, is_name);
  const std::string name(tag.begin(), name_end);
  if (name.empty()) return "a tag without a name";
  if (is_end) {
    if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
    open.pop_back();
    return {};
  }
  xml.elements.push_back(name);
  if (!is_empty) open.push_back(name);
  return parse_attributes(tag.substr(name.size()), xml) ? "" : "attributes of <" + name + ">";
}

}  // namespace

Xml parse_xml(std::string_view text) {
  Xml xml;
  std::vector<std::string> open;
  while (!text.empty() && xml.fault.empty()) {
    const std::size_t begin = std::min(text.find('<'), text.size());
    xml.text += text.substr(0, begin);
    if (!is_clean(text.substr(0, begin))) xml.fault = "a lone & or a control character";
    text.remove_prefix(begin);
    if (text.empty()) break;
    const std::size_t end = text.find('>');
    if (end == std::string_view::npos) {
      xml.fault = "a tag without an end";
      break;
    }
    if (xml.fault.empty()) xml.fault = take_tag(text.substr(1, end - 1), open, xml);
    text.remove_prefix(end + 1);
  }
  if (xml.fault.empty() && !open.empty()) xml.fault = "<" + open.back() + "> is not closed";
  return xml;
}

std::string bad_coordinate(const Xml& xml) {
  static const std::set<std::string> coordinates = {
      "x",  "y", "d",       "width",        "height",    "cx",
      "cy", "r", "viewBox", "stroke-width", "transform", "style"};
  for (const auto& [name, value] : xml.attributes) {
    const bool is_bad = value.find("nan") != std::string::npos ||
                        value.find("inf") != std::string::npos ||
                        value.find("e+") != std::string::npos;
    if (coordinates.contains(name) && is_bad) return name + "=" + value;
  }
  return {};
}

std::string outside_reference(const Xml& xml) {
  static const std::set<std::string> references = {"src", "href", "xlink:href", "action", "data"};
  for (const auto& [name, value] : xml.attributes) {
    if (references.contains(name)) return name + "=" + value;
  }
  static const std::set<std::string> loaders = {"script", "link",   "img",
                                                "iframe", "object", "image"};
  for (const std::string& element : xml.elements) {
    if (loaders.contains(element)) return "<" + element + ">";
  }
  for (const char* rule : {"url(", "@import"}) {
    if (xml.text.find(rule) != std::string::npos) return rule;
  }
  return {};
}

}  // namespace meniscus::test
