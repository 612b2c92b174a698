#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus::test {

/// An XML text taken apart without looking at its meaning.
struct Xml {
  std::string fault;  ///< what is not well-formed; empty if nothing
  std::vector<std::pair<std::string, std::string>> attributes;  ///< of all elements, in order
  std::vector<std::string> elements;                            ///< names, in order
  std::string text;                                             ///< between the elements
};

/// Tags that close each other in turn, attributes with quotes and each once, no lone `&` or `<`.
[[nodiscard]] Xml parse_xml(std::string_view text);

/// The first number in the attributes that hold coordinates (x, y, d, width, transform, …) that is
/// not finite; empty if there is none.
[[nodiscard]] std::string bad_coordinate(const Xml& xml);

/// The first attribute or style rule that would load something from elsewhere; empty if there is
/// none.
[[nodiscard]] std::string outside_reference(const Xml& xml);

}  // namespace meniscus::test
