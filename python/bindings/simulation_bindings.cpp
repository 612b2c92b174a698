#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <unistd.h>

#include "meniscus/app/ranks.hpp"
#include "meniscus/core/error.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/driven_run.hpp"

namespace meniscus::python {
namespace {

namespace fs = std::filesystem;

/// Raises what a signal asks for, such as KeyboardInterrupt, on all ranks where it came to one.
void raise_signals() {
  const bool is_raised = PyErr_CheckSignals() != 0;
  if (!any_rank(is_raised)) return;
  if (!is_raised) PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

/// What computes while other threads of Python go on. Of all simulations one computes at a time, as
/// PETSc and HDF5 bear no more; others wait. When Python ends, threads that compute come to the end
/// of what they do, and begin nothing else.
class Computing {
 public:
  Computing() {
    if (getpid() != owner_)
      reject_input("simulations compute in the process that imported meniscus");
    if (is_ending_ && std::this_thread::get_id() != ending_thread_)
      reject_input("Python is ending");
    ++num_threads_;
    others_go_on_.emplace();
    turn_ = std::unique_lock(one_at_a_time_);
  }
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;
  ~Computing() {
    turn_.unlock();
    others_go_on_.reset();  // Python's lock is held again
    --num_threads_;
  }
  /// Waits until no other thread computes; none begins after that.
  static void end_others() {
    is_ending_ = true;
    ending_thread_ = std::this_thread::get_id();
    while (num_threads_ > 0) {
      const py::gil_scoped_release they_end;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

 private:
  // A process that is forked off has no thread that would ever unlock it.
  static inline const pid_t owner_ = getpid();
  // Read and written under Python's lock.
  static inline int num_threads_ = 0;
  static inline bool is_ending_ = false;
  static inline std::thread::id ending_thread_;
  static inline std::mutex one_at_a_time_;

  std::optional<py::gil_scoped_release> others_go_on_;
  std::unique_lock<std::mutex> turn_;
};

/// A simulation as Python holds it: closed or open, and computing in one thread at a time while
/// other threads of Python go on.
class Handle {
 public:
  explicit Handle(std::unique_ptr<DrivenRun> run) : run_(std::move(run)) {}

  [[nodiscard]] bool is_closed() const { return run_ == nullptr; }
  [[nodiscard]] DrivenRun& run() {
    if (is_closed()) reject_input("this simulation is closed");
    if (is_busy_) reject_input("this simulation computes in another thread");
    return *run_;
  }
  template <class Work>
  void compute(const Work& work) {
    DrivenRun& open = run();
    const Busy busy(is_busy_);
    const Computing computing;
    work(open);
  }
  void close() {
    if (is_closed()) return;
    compute([](DrivenRun& open) { open.stop(); });
    let_go();
  }
  /// Lets go of the folder, which keeps its last checkpoint.
  void abandon() {
    if (!is_closed() && !is_busy_) let_go();
  }
  /// Leaves all to the process from which this one was forked off.
  void forget() { static_cast<void>(run_.release()); }

 private:
  /// Its matrices and files are freed in turn as well.
  void let_go() {
    std::unique_ptr<DrivenRun> run = std::move(run_);
    const Computing computing;
    run.reset();
  }
  struct Busy {
    explicit Busy(bool& busy) : flag(busy) { flag = true; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    ~Busy() { flag = false; }
    bool& flag;
  };
  std::unique_ptr<DrivenRun> run_;
  bool is_busy_ = false;  // read and written under Python's lock
};

/// Makes a run while other threads of Python go on. Ranks fail together or end together. A signal
/// that comes meanwhile stops the run, which can be resumed.
template <class Make>
Handle made_run(const Make& make) {
  std::unique_ptr<DrivenRun> run;
  {
    const Computing computing;
    try {
      run = make();
    } catch (const std::exception& failure) {
      require_all_failed(failure);
      throw;
    }
  }
  Handle made(std::move(run));
  try {
    raise_signals();
  } catch (const py::error_already_set&) {
    made.close();
    throw;
  }
  return made;
}

// The case is a copy: other threads may change the one they hold.
Handle begin(PythonCase c, const std::optional<fs::path>& output, bool is_overwrite) {
  return made_run([&] { return DrivenRun::begin(std::move(c), output, is_overwrite); });
}

Handle resume(const fs::path& source, const std::optional<fs::path>& output,
              const std::vector<std::string>& settings) {
  return made_run([&] { return DrivenRun::resume(source, output, settings); });
}

void step(Handle& self) {
  self.compute([](DrivenRun& run) { run.step(); });
  raise_signals();
}

/// What a time and a rate are multiplied by to be in the case's own units.
std::pair<double, double> case_units(const PythonCase& c) {
  const Settings& settings = c.parsed().settings;
  return {settings.unit(schema::Dimension::time), settings.unit(schema::Dimension::rate)};
}

/// t in the case's own unit, as a setting that is read back to t or just before.
std::string time_setting(const PythonCase& c, double t) {
  const double unit = case_units(c).first;
  double own = t * unit;
  while (own / unit > t) own = std::nextafter(own, 0.0);
  return schema::to_toml(own);
}

/// Adds an entry to the schedule of the flow, from the present time on.
void set_flow(Handle& self, const std::vector<std::string>& keys) {
  DrivenRun& run = self.run();
  const auto entries = run.given().parsed().flow.schedule().size();
  const bool is_again = run.num_settings_at_step() > 0;  // replaces the entry of this step
  const std::string entry = fmt::format("flow.schedule[{}].", is_again ? entries - 1 : entries);
  std::vector<std::string> settings{entry +
                                    "time=" + time_setting(run.given(), run.evolution().t())};
  for (const std::string& key : keys) settings.push_back(entry + key);
  self.compute([&](DrivenRun& open) { open.set_flow(settings); });
  raise_signals();
}

py::object cell(const io::Cell& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return py::int_(*whole);
  if (const auto* real = std::get_if<double>(&value)) return py::float_(*real);
  if (const auto* text = std::get_if<std::string>(&value)) return py::str(*text);
  return py::str();
}

py::tuple table(const RunTable& given) {
  py::list rows;
  for (const std::vector<io::Cell>& row : given.rows) {
    py::list cells;
    for (const io::Cell& value : row) cells.append(cell(value));
    rows.append(std::move(cells));
  }
  return py::make_tuple(given.columns, rows);
}

/// One interface of a snapshot.
struct InterfaceView {
  std::shared_ptr<const SurfaceSnapshot> snapshot;
  std::size_t index;
  [[nodiscard]] const SurfaceSnapshot::Part& part() const { return snapshot->parts[index]; }
};

std::vector<InterfaceView> interfaces(Handle& self) {
  const auto snapshot = self.run().surfaces();
  std::vector<InterfaceView> views;
  for (std::size_t i = 0; i < snapshot->parts.size(); ++i) views.push_back({snapshot, i});
  return views;
}

py::dict vertex_fields(const InterfaceView& self) {
  return arrays_view(self.snapshot, self.snapshot->data.on_vertices, self.part().first_vertex,
                     static_cast<std::size_t>(self.part().mesh.num_vertices()));
}

py::dict face_fields(const InterfaceView& self) {
  return arrays_view(self.snapshot, self.snapshot->data.on_cells, self.part().first_face,
                     static_cast<std::size_t>(self.part().mesh.num_faces()));
}

using VolumeView = std::shared_ptr<const VolumeSnapshot>;

py::dict volume_vertex_fields(const VolumeView& self) {
  return arrays_view(self, self->arrays.data.on_vertices, 0,
                     static_cast<std::size_t>(self->mesh.num_vertices()));
}

py::dict volume_corner_fields(const VolumeView& self) {
  return arrays_view(self, self->arrays.on_corners, 0,
                     static_cast<std::size_t>(self->mesh.num_cells()), 4);
}

/// None where a dict has no such entry.
py::object entry(const py::dict& fields, const char* name) {
  return fields.contains(name) ? py::object(fields[name]) : py::none();
}

void bind_interface(py::module_& m) {
  py::class_<InterfaceView>(
      m, "Interface",
      "The interface of one drop at one time. Arrays are read-only views that "
      "stay valid.")
      .def_property_readonly(
          "drop", [](const InterfaceView& self) { return self.part().drop; },
          "The number of the drop in drops.csv; never used again.")
      .def_property_readonly(
          "parent", [](const InterfaceView& self) { return self.part().parent; },
          "The drop it came from in a breakup or coalescence; -1 for a drop of the case.")
      .def_property_readonly(
          "points",
          [](const InterfaceView& self) { return points_view(self.snapshot, self.part().mesh.x); },
          "Vertices, (n, 3) [R0].")
      .def_property_readonly(
          "triangles",
          [](const InterfaceView& self) {
            return corners_view(self.snapshot, self.part().mesh.faces);
          },
          "Faces, (m, 3) numbers of vertices, counter-clockwise seen from outside.")
      .def_property_readonly(
          "fields", vertex_fields,
          "What is known at the vertices, a dict of arrays (n,) or (n, 3): curvature [1/R0], "
          "velocity and normal_velocity [G R0], node_density [1/R0^2], pressure_jump [mu_out G] by "
          "finite elements, carried fields such as surfactant, bulk scalars.")
      .def_property_readonly("face_fields", face_fields,
                             "What is known on the faces, a dict of arrays (m,).");
}

/// The volume mesh of a state.
struct VolumeMeshView {
  VolumeView snapshot;
};

void bind_volume_mesh(py::module_& m) {
  py::class_<VolumeMeshView>(
      m, "VolumeMesh",
      "The tetrahedra at one time and the flow in them. Arrays are read-only "
      "views that stay valid.")
      .def_property_readonly(
          "points",
          [](const VolumeMeshView& self) {
            return points_view(self.snapshot, self.snapshot->mesh.x);
          },
          "Vertices, (n, 3) [R0]: of the interfaces, of the outer boundary, then those between.")
      .def_property_readonly(
          "tetrahedra",
          [](const VolumeMeshView& self) {
            return corners_view(self.snapshot, self.snapshot->mesh.cells);
          },
          "Cells, (k, 4) numbers of vertices, of positive volume.")
      .def_property_readonly(
          "region",
          [](const VolumeMeshView& self) {
            const auto& region = self.snapshot->mesh.region;
            return view(self.snapshot, region.empty() ? nullptr : &region.begin()->value,
                        {region.size()});
          },
          "The liquid of each cell, (k,): 0 the matrix, i + 1 what interface i encloses.")
      .def_property_readonly(
          "velocity",
          [](const VolumeMeshView& self) {
            return entry(volume_vertex_fields(self.snapshot), "velocity");
          },
          "Velocity at the vertices, (n, 3) [G R0].")
      .def_property_readonly(
          "pressure",
          [](const VolumeMeshView& self) {
            return entry(volume_corner_fields(self.snapshot), "pressure");
          },
          "Pressure at the corners of the cells, (k, 4) [mu_out G]: it jumps across interfaces.")
      .def_property_readonly(
          "fields", [](const VolumeMeshView& self) { return volume_vertex_fields(self.snapshot); },
          "What is known at the vertices, a dict of arrays (n,) or (n, 3).")
      .def_property_readonly(
          "cell_fields",
          [](const VolumeMeshView& self) {
            return arrays_view(self.snapshot, self.snapshot->arrays.data.on_cells, 0,
                               static_cast<std::size_t>(self.snapshot->mesh.num_cells()));
          },
          "What is known in the cells, a dict of arrays (k,).")
      .def_property_readonly(
          "corner_fields",
          [](const VolumeMeshView& self) { return volume_corner_fields(self.snapshot); },
          "What is double valued on interfaces, by cell corner, a dict of arrays (k, 4).");
}

std::optional<VolumeMeshView> volume_mesh(Handle& self) {
  VolumeView snapshot = self.run().volume();
  if (!snapshot) return std::nullopt;
  return VolumeMeshView{std::move(snapshot)};
}

}  // namespace

void bind_simulation(py::module_& m) {
  bind_interface(m);
  bind_volume_mesh(m);
  py::class_<Handle>(m, "Simulation")
      .def_static("begin", begin, py::arg("case"), py::arg("output"), py::arg("overwrite"))
      .def_static("resume", resume, py::arg("source"), py::arg("output"), py::arg("settings"))
      .def("step", step)
      .def("set_flow", set_flow, py::arg("keys"))
      .def("stop", [](Handle& self) { self.compute([](DrivenRun& run) { run.stop(); }); })
      .def("close", &Handle::close)
      .def("abandon", &Handle::abandon)
      .def("forget", &Handle::forget)
      .def(
          "write_checkpoint",
          [](Handle& self, const fs::path& file) {
            self.compute([&](DrivenRun& run) { run.write_checkpoint(file); });
          },
          py::arg("file"))
      .def_property_readonly("is_closed", &Handle::is_closed)
      .def_property_readonly("t", [](Handle& self) { return self.run().evolution().t(); })
      .def_property_readonly("dt", [](Handle& self) { return self.run().evolution().state().dt; })
      .def_property_readonly("step_number",
                             [](Handle& self) { return self.run().evolution().step(); })
      .def_property_readonly("is_finished", [](Handle& self) { return self.run().has_ended(); })
      .def_property_readonly("has_failed", [](Handle& self) { return self.run().has_failed(); })
      .def_property_readonly("end",
                             [](Handle& self) { return self.run().given().parsed().evolution.end; })
      .def_property_readonly("case_units",
                             [](Handle& self) { return case_units(self.run().given()); })
      .def_property_readonly("output", [](Handle& self) { return self.run().folder(); })
      .def_property_readonly("case", [](Handle& self) { return self.run().given(); })
      .def_property_readonly("interfaces", interfaces)
      .def_property_readonly("volume_mesh", volume_mesh)
      .def_property_readonly("history",
                             [](Handle& self) { return table(self.run().tables().history); })
      .def_property_readonly("drops", [](Handle& self) { return table(self.run().tables().drops); })
      .def_property_readonly("events",
                             [](Handle& self) { return table(self.run().tables().events); })
      .def_property_readonly("seconds", [](Handle& self) {
        py::dict seconds;
        for (const auto& [phase, spent] : self.run().seconds()) seconds[py::str(phase)] = spent;
        return seconds;
      });
  m.def("end_other_threads", Computing::end_others);
  m.def("any_rank", any_rank, py::arg("local"));
  m.def("num_ranks", num_ranks);
  m.def("is_first_rank", is_first_rank);
}

}  // namespace meniscus::python
