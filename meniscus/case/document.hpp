#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "meniscus/case/value.hpp"

namespace meniscus::schema {

/// A value the user gave, and where: "case.toml:7" or "--set drop[0].nodes=200".
struct Given {
  Value value;
  std::string source;
  bool is_override = false;
};

/// A case file whose keys were checked against the schema: each is known, of the right type and in
/// its range. `read_case` checks conditions between keys.
struct Document {
  std::string name;                           ///< name of the file in messages
  std::filesystem::path folder;               ///< folder where relative file names start
  std::map<std::string, Given> values;        ///< by path with indices: "scalar[0].drop[1].source"
  std::map<std::string, std::string> tables;  ///< source of every table: "drop[0]" → "case.toml:5"

  std::set<std::string> added_tables;  ///< tables that only overrides name: "drop[1]"

  /// Number of tables in an array: count("drop"), count("flow.schedule").
  [[nodiscard]] int count(const std::string& array) const;
};

/// Parses and checks a case file. Throws InvalidInput with file and line at the first fault. An
/// override is "key=value" with a TOML value; quotes around words are optional. It replaces the
/// file's value, or begins the next table of an array ("drop[1].radius=1" when there is one drop).
/// The index of an array with one table may be omitted: "drop.nodes=80", "scalar.drop[1].source=2".
[[nodiscard]] Document parse_document(std::string_view text, const std::string& name,
                                      const std::filesystem::path& folder,
                                      std::span<const std::string> overrides);

}  // namespace meniscus::schema
