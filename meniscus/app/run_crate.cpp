#include "meniscus/app/run_crate.hpp"

#include <string>

#include <nlohmann/json.hpp>

#include "meniscus/app/run_json.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/run_files.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using io::RunFiles;

struct Described {
  const char *name, *format, *holds;
};
constexpr Described kFiles[] = {
    {RunFiles::record, "application/json",
     "Case with all defaults, version, commit, status, seconds by phase, warnings"},
    {RunFiles::history, "text/csv", "One row a step: time, meshes, energy balance, stress"},
    {RunFiles::drops, "text/csv", "One row a step and drop: volume, shape, deformation"},
    {RunFiles::events, "text/csv", "One row for each breakup and coalescence"},
    {RunFiles::timing, "text/csv", "Seconds of each step by phase"},
    {RunFiles::reference, "text/csv", "Curves that the run is compared with"},
    {RunFiles::page, "text/html", "Page of plots and of the interface in 3-D"},
    {RunFiles::surface_frames, "application/xml",
     "Times and files of the interfaces, for ParaView"},
    {RunFiles::volume_frames, "application/xml",
     "Times and files of the volume meshes, for ParaView"},
};
constexpr Described kFolders[] = {
    {RunFiles::surface_folder, "", "Interfaces with their fields, one VTK file a time"},
    {RunFiles::volume_folder, "", "Volume meshes with velocity and pressure, one VTK file a time"},
};

Json reference_to(const std::string& id) { return {{"@id", id}}; }

/// What the folder holds, each an entity of its own.
Json data_entities(const fs::path& folder) {
  Json entities = Json::array();
  for (const Described& file : kFiles)
    if (fs::is_regular_file(folder / file.name))
      entities.push_back({{"@id", file.name},
                          {"@type", "File"},
                          {"name", file.name},
                          {"description", file.holds},
                          {"encodingFormat", file.format}});
  for (const Described& below : kFolders)
    if (fs::is_directory(folder / below.name))
      entities.push_back({{"@id", std::string(below.name) + "/"},
                          {"@type", "Dataset"},
                          {"name", below.name},
                          {"description", below.holds}});
  for (const auto& [step, path] : io::checkpoints(folder))
    entities.push_back(
        {{"@id", path.filename().string()},
         {"@type", "File"},
         {"name", path.filename().string()},
         {"description", "State at step " + std::to_string(step) + ", to go on from"},
         {"encodingFormat", "application/x-hdf5"}});
  return entities;
}

Json references_to(const Json& entities) {
  Json list = Json::array();
  for (const Json& entity : entities) list.push_back(reference_to(entity["@id"]));
  return list;
}

/// schema.org's word for the `status` of run.json.
std::string action_status(const std::string& status) {
  const std::string words = "http://schema.org/";
  if (status == "done") return words + "CompletedActionStatus";
  return words + (status.starts_with("failed") ? "FailedActionStatus" : "PotentialActionStatus");
}

}  // namespace

void write_run_crate(const fs::path& folder) {
  const Json run = Json::parse(io::read_file(folder / RunFiles::record));
  const Json files = data_entities(folder);
  const std::string none, title = member(run, "title", none), status = member(run, "status", none),
                          started = member(run, "started", none),
                          finished = member(run, "finished", none);
  Json graph = Json::array();
  graph.push_back({{"@id", RunFiles::crate},
                   {"@type", "CreativeWork"},
                   {"conformsTo", reference_to("https://w3id.org/ro/crate/1.1")},
                   {"about", reference_to("./")}});
  graph.push_back({{"@id", "./"},
                   {"@type", "Dataset"},
                   {"name", title.empty() ? "A run of Meniscus" : title},
                   {"description", "What a run of the program Meniscus left; " +
                                       std::string(RunFiles::record) + " has its case."},
                   {"datePublished", finished},
                   {"hasPart", references_to(files)},
                   {"mentions", reference_to("#run")}});
  for (const Json& file : files) graph.push_back(file);
  graph.push_back({{"@id", "#run"},
                   {"@type", "CreateAction"},
                   {"name", "Simulation"},
                   {"instrument", reference_to("#meniscus")},
                   {"object", reference_to(RunFiles::record)},
                   {"result", reference_to("./")},
                   {"startTime", started},
                   {"endTime", finished},
                   {"actionStatus", reference_to(action_status(status))},
                   {"description", status}});
  graph.push_back({{"@id", "#meniscus"},
                   {"@type", "SoftwareApplication"},
                   {"name", "Meniscus"},
                   {"version", member(run, "version", none)},
                   {"identifier", member(run, "commit", none)}});
  const Json crate{{"@context", "https://w3id.org/ro/crate/1.1/context"}, {"@graph", graph}};
  io::write_file(folder / RunFiles::crate, file_text(crate));
}

}  // namespace meniscus
