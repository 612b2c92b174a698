#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/rasterize.hpp"
#include "meniscus/report/report.hpp"
#include "meniscus/report/run_data.hpp"
#include "meniscus/report/stills.hpp"

namespace meniscus {
namespace {

using namespace report;
namespace fs = std::filesystem;

constexpr int frames_per_second = 20;

/// A pipe into the standard input of a program.
class Pipe {
 public:
  /// Starts the program. Throws InvalidInput when it is not installed.
  explicit Pipe(std::vector<std::string> command) : name_(command.front()) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw RunFailure(fmt::format("no pipe: {}", std::strerror(errno)));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int error =
        posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    input_ = ends[1];
    if (error == 0) return;
    close(input_);
    reject_input("--movie: the program {} cannot be started: {} (Debian: apt install ffmpeg)",
                 name_, std::strerror(error));
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    if (input_ >= 0) (void)wait();
  }

  /// Returns false when the program no longer reads.
  [[nodiscard]] bool write(const std::vector<std::uint8_t>& bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(input_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno != EINTR) return false;
      if (count > 0) done += static_cast<std::size_t>(count);
    }
    return true;
  }
  /// Closes the pipe and returns the program's exit status.
  int wait() {
    close(std::exchange(input_, -1));
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }

 private:
  std::string name_;
  pid_t process_ = 0;
  int input_ = -1;
};

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
  const std::vector<SurfaceFrame> frames = load_surfaces(run, run.frames);
  if (frames.empty())
    reject_input("{}: no frame of the surface can be read", run_directory.string());
  const MoviePicture picture = movie_picture(frames);
  const auto to_px = [](double length) { return static_cast<int>(length); };
  // The film has another name until it is complete.
  const fs::path unfinished = out.string() + ".tmp" + out.extension().string();
  Pipe ffmpeg(ffmpeg_command(to_px(picture.width), to_px(picture.height), unfinished));
  for (const SurfaceFrame& frame : frames) {
    if (!ffmpeg.write(pixels_of(movie_svg(frame, picture), 1.0).bytes)) break;
  }
  if (const int status = ffmpeg.wait(); status != 0) {
    fs::remove(unfinished);
    throw RunFailure(fmt::format("ffmpeg ended with status {}; no film was made", status));
  }
  fs::rename(unfinished, out);
}

}  // namespace meniscus
