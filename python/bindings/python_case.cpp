#include "python/bindings/python_case.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "python/bindings/arrays.hpp"

namespace meniscus::python {

PythonCase::PythonCase(std::string text, std::string name, std::filesystem::path folder,
                       std::vector<std::string> overrides, std::string file)
    : text_(std::move(text)),
      name_(std::move(name)),
      file_(std::move(file)),
      folder_(std::move(folder)),
      overrides_(std::move(overrides)),
      parsed_(parse_case(text_, name_, folder_, overrides_)) {}

void PythonCase::set(const std::vector<std::string>& settings) { replace_last(0, settings); }

void PythonCase::replace_last(std::size_t count, const std::vector<std::string>& settings) {
  MENISCUS_ASSERT(count <= overrides_.size(), "{} of {}", count, overrides_.size());
  std::vector<std::string> all = overrides_;
  all.resize(all.size() - count);
  all.insert(all.end(), settings.begin(), settings.end());
  parsed_ = parse_case(text_, name_, folder_, all);
  overrides_ = std::move(all);
}

namespace {

PythonCase case_of_file(const std::string& file, const std::vector<std::string>& settings) {
  static_cast<void>(read_case(file, settings));  // its messages name what cannot be read
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return {io::read_file(file), file, std::filesystem::absolute(folder / "."), settings, file};
}

}  // namespace

void bind_case(py::module_& m) {
  py::class_<PythonCase>(m, "Case")
      .def(py::init<std::string, std::string, std::filesystem::path, std::vector<std::string>>(),
           py::arg("text"), py::arg("name"), py::arg("folder"), py::arg("settings"))
      .def(py::init<const PythonCase&>(), py::arg("other"))
      .def_static("from_file", case_of_file, py::arg("file"), py::arg("settings"))
      .def_property_readonly("folder", &PythonCase::folder)
      .def("set", &PythonCase::set, py::arg("settings"))
      .def("to_toml", [](const PythonCase& self) { return case_toml(self.parsed()); });
}

}  // namespace meniscus::python
