#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

#include "meniscus/io/binary.hpp"
#include "meniscus/io/surface_formats.hpp"
#include "meniscus/io/text_scanner.hpp"

namespace meniscus::io {
namespace {

enum class Encoding { ascii, little_endian, big_endian };

/// A number as one of PLY's types.
struct Scalar {
  std::size_t size = 0;
  double (*load)(std::string_view bytes, std::endian order) = nullptr;
};

struct Property {
  std::string name;
  Scalar value;
  std::optional<Scalar> count;  ///< of a list: the type of its length
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

template <class T>
constexpr Scalar scalar = {sizeof(T), [](std::string_view bytes, std::endian order) {
                             return static_cast<double>(load<T>(bytes, order));
                           }};

Scalar parse_type(const TextScanner& scanner, std::string_view name) {
  static const std::map<std::string_view, Scalar> types = {
      {"char", scalar<std::int8_t>},     {"int8", scalar<std::int8_t>},
      {"uchar", scalar<std::uint8_t>},   {"uint8", scalar<std::uint8_t>},
      {"short", scalar<std::int16_t>},   {"int16", scalar<std::int16_t>},
      {"ushort", scalar<std::uint16_t>}, {"uint16", scalar<std::uint16_t>},
      {"int", scalar<std::int32_t>},     {"int32", scalar<std::int32_t>},
      {"uint", scalar<std::uint32_t>},   {"uint32", scalar<std::uint32_t>},
      {"float", scalar<float>},          {"float32", scalar<float>},
      {"double", scalar<double>},        {"float64", scalar<double>}};
  const auto found = types.find(name);
  if (found == types.end()) scanner.fail("`{}` is no type of PLY", printable(name));
  return found->second;
}

Encoding parse_encoding(const TextScanner& scanner) {
  const std::vector<std::string_view>& words = scanner.words();
  if (words.size() > 1 && words[1] == "ascii") return Encoding::ascii;
  if (words.size() > 1 && words[1] == "binary_little_endian") return Encoding::little_endian;
  if (words.size() > 1 && words[1] == "binary_big_endian") return Encoding::big_endian;
  scanner.fail("unknown format of PLY");
}

Property parse_property(const TextScanner& scanner) {
  const std::vector<std::string_view>& words = scanner.words();
  if (words.size() == 3) return {std::string(words[2]), parse_type(scanner, words[1]), {}};
  if (words.size() != 5 || words[1] != "list") scanner.fail("a property that is not of PLY");
  return {std::string(words[4]), parse_type(scanner, words[3]), parse_type(scanner, words[2])};
}

Header parse_header(TextScanner& scanner) {
  Header header;
  scanner.require_line("`ply`");
  if (scanner.words()[0] != "ply") scanner.fail("not a PLY file");
  scanner.require_line("the header");
  while (scanner.words()[0] != "end_header") {
    const std::vector<std::string_view>& words = scanner.words();
    if (words[0] == "format") header.encoding = parse_encoding(scanner);
    if (words[0] == "element") {
      if (words.size() != 3) scanner.fail("an element that is not of PLY");
      header.elements.push_back({std::string(words[1]), scanner.integer(2), {}});
    }
    if (words[0] == "property") {
      if (header.elements.empty()) scanner.fail("a property without an element");
      header.elements.back().properties.push_back(parse_property(scanner));
    }
    scanner.require_line("`end_header`");
  }
  return header;
}

/// The numbers of the body one after the other, whatever their encoding.
class Body {
 public:
  Body(TextScanner scanner, Encoding encoding)
      : scanner_(std::move(scanner)),
        bytes_(scanner_.rest()),
        is_ascii_(encoding == Encoding::ascii),
        order_(encoding == Encoding::big_endian ? std::endian::big : std::endian::little) {}

  double next(const Scalar& type) {
    if (is_ascii_) return next_word();
    if (bytes_.size() < type.size) scanner_.fail("the file is cut short after its header");
    const double value = type.load(bytes_, order_);
    bytes_.remove_prefix(type.size);
    return value;
  }
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    scanner_.fail(format, std::forward<Args>(args)...);
  }

 private:
  double next_word() {
    if (word_ == 0 || word_ == scanner_.words().size()) {
      scanner_.require_line("a number");
      word_ = 0;
    }
    return scanner_.real(word_++);
  }

  TextScanner scanner_;
  std::string_view bytes_;
  bool is_ascii_;
  std::endian order_;
  std::size_t word_ = 0;
};

bool is_corner_list(const Property& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

void read_vertex(Body& body, const Element& element, PolygonSoup& soup) {
  Vec3 x = Vec3::Zero();
  for (const Property& property : element.properties) {
    if (property.count) body.fail("the vertices have a list `{}`", printable(property.name));
    const double value = body.next(property.value);
    if (property.name == "x") x[0] = value;
    if (property.name == "y") x[1] = value;
    if (property.name == "z") x[2] = value;
  }
  soup.points.push_back(x);
}

void read_list(Body& body, const Property& property, PolygonSoup* soup) {
  const double length = body.next(*property.count);
  // 2³¹: above it no list of a mesh is meant
  if (!(length >= 0.0 && length < 0x1p31)) body.fail("a list of {} numbers", length);
  const auto count = static_cast<std::int64_t>(length);
  if (soup == nullptr) {
    for (std::int64_t i = 0; i < count; ++i) body.next(property.value);
    return;
  }
  require_corners(body, count);
  for (std::int64_t i = 0; i < count; ++i) {
    // −1, which no file may name, stands for what no integer holds.
    const double value = body.next(property.value);
    soup->corners.push_back(value >= 0.0 && value < 0x1p32 ? static_cast<std::int64_t>(value) : -1);
  }
  soup->end_face();
}

/// Reads one instance of an element that is not a vertex; the corners of faces are kept.
void read_other(Body& body, const Element& element, PolygonSoup& soup) {
  for (const Property& property : element.properties) {
    const bool is_kept = element.name == "face" && is_corner_list(property);
    if (property.count) read_list(body, property, is_kept ? &soup : nullptr);
    if (!property.count) body.next(property.value);
  }
}

}  // namespace

PolygonSoup parse_ply(const std::filesystem::path& path, std::string_view bytes) {
  TextScanner scanner(path, bytes);
  const Header header = parse_header(scanner);
  PolygonSoup soup;
  Body body(scanner, header.encoding);
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") read_vertex(body, element, soup);
      if (element.name != "vertex") read_other(body, element, soup);
    }
  }
  return soup;
}

std::string format_ply(const SurfaceMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment written by Meniscus\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.num_vertices(), mesh.num_faces());
  for (const Vec3& x : mesh.x) {
    for (const double coordinate : x) store(bytes, coordinate);
  }
  for (const FaceVertices& f : mesh.faces) {
    store(bytes, std::uint8_t{3});
    for (const VertexId v : f) store(bytes, v.value);
  }
  return bytes;
}

}  // namespace meniscus::io
