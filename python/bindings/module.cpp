// The compiled part of the Python package; python/meniscus/ holds what users call.
#include <exception>

#include "meniscus/case/explain.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/core/version.hpp"
#include "python/bindings/arrays.hpp"

namespace meniscus::python {
namespace {

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InvalidInput& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}

void set_log_level(const std::string& level) {
  using enum log::Level;
  if (level == "error") return log::set_level(error);
  if (level == "warning") return log::set_level(warning);
  if (level == "info") return log::set_level(info);
  if (level == "debug") return log::set_level(debug);
  if (level == "off") return log::set_level(off);
  reject_input("level = \"{}\" must be one of \"off\", \"error\", \"warning\", \"info\", \"debug\"",
               level);
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled part of meniscus.";
  py::register_exception_translator(translate);
  m.attr("version") = version_string;
  m.attr("commit") = commit_string;
  m.def(
      "explain", [](const std::string& key) { return key.empty() ? explain() : explain(key); },
      py::arg("key"));
  m.def("set_log_level", set_log_level, py::arg("level"),
        "What the library writes to standard error: \"off\", \"error\", \"warning\" (as at first), "
        "\"info\" or \"debug\".");
  bind_case(m);
  bind_simulation(m);
  bind_meshes(m);
}

}  // namespace meniscus::python
