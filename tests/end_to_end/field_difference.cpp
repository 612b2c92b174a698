// field_difference A B: by how much the carried fields of two checkpoints differ, the largest
// difference over the largest value. Status 1 when they do not have the same fields or sizes.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "meniscus/io/archive_file.hpp"

namespace {

using namespace meniscus;

std::map<std::string, std::vector<double>> field_values(const char* file) {
  std::map<std::string, std::vector<double>> fields;
  for (const auto& [name, values] : io::read_archive(file).reals)
    if (name.find("/fields/") != std::string::npos && name.ends_with("/values"))
      fields[name] = values;
  return fields;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto a = field_values(argv[1]), b = field_values(argv[2]);
  double difference = 0.0;
  for (const auto& [name, values] : a) {
    const auto other = b.find(name);
    if (other == b.end() || other->second.size() != values.size()) return 1;
    double largest = 0.0, apart = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      largest = std::max(largest, std::abs(values[i]));
      apart = std::max(apart, std::abs(values[i] - other->second[i]));
    }
    difference = std::max(difference, apart / largest);
  }
  std::printf("%zu fields, %.3e\n", a.size(), difference);
  return a.empty() || a.size() != b.size() ? 1 : 0;
}
