#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/drawer.hpp"
#include "meniscus/report/program.hpp"
#include "meniscus/report/rasterize.hpp"
#include "meniscus/report/report.hpp"
#include "meniscus/report/run_data.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

constexpr int frames_per_second = 20;

std::vector<std::string> ffmpeg_command(int width, int height, const fs::path& out) {
  return {"ffmpeg",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "bgra",
          "-s",
          fmt::format("{}x{}", width, height),
          "-r",
          fmt::format("{}", frames_per_second),
          "-i",
          "-",
          "-pix_fmt",
          "yuv420p",  // readable by every player and browser
          "-crf",
          "18",  // no visible loss
          "-movflags",
          "+faststart",
          fs::absolute(out).string()};
}

}  // namespace

void write_movie(const fs::path& run_directory, const fs::path& out) {
  RunData run = load_run(run_directory);
  PageRun page = picture_run(run, run.frames, {});
  if (page.frames.empty())
    reject_input("{}: no frame of the surface can be read", run_directory.string());
  const DrawingData data =
      drawing_data("report", std::span(&run, 1), std::span(&page, 1), whole_tables);
  Drawer drawer("--movie", data, {"film"});
  // The film has another name until it is complete.
  const fs::path unfinished = out.string() + ".tmp" + out.extension().string();
  std::optional<Program> ffmpeg;
  while (const auto picture = drawer.next()) {
    const Pixels pixels = pixels_of(picture->svg, 1.0);
    if (!ffmpeg)
      ffmpeg.emplace("--movie", "ffmpeg", ffmpeg_command(pixels.width, pixels.height, unfinished));
    const auto* bytes = reinterpret_cast<const char*>(pixels.bytes.data());
    if (!ffmpeg->write({bytes, pixels.bytes.size()})) break;
  }
  const int status = ffmpeg ? ffmpeg->wait() : 1;
  if (status != 0) {
    fs::remove(unfinished);
    throw RunFailure(fmt::format("ffmpeg ended with status {}; no film was made", status));
  }
  fs::rename(unfinished, out);
}

}  // namespace meniscus
