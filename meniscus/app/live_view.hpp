#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "meniscus/app/run_directory.hpp"
#include "meniscus/app/watch_server.hpp"

namespace meniscus {

/// The page of a run while it goes on. What the server gives out is either in memory or one of the
/// run's tables, under names that are fixed here (docs/report.md); nothing that is asked becomes a
/// path.
class LiveView {
 public:
  /// Begins to listen; who asks before `begin` is told to wait. Throws InvalidInput when it cannot.
  explicit LiveView(const WatchAddress& address);

  [[nodiscard]] std::string url() const;

  /// The folder holds run.json now: makes the page.
  void begin(const std::filesystem::path& folder);
  /// Packs the frames that have been written since the last call.
  void update(const RunDirectory& directory);
  /// Tells how the run ended, and waits for those who look to see it: at most six seconds.
  void end(const std::string& status);

 private:
  using Clock = std::chrono::steady_clock;
  struct Part {
    std::string entry;
    std::shared_ptr<const std::string> bytes;
  };

  [[nodiscard]] WatchServer::Answer answer(std::string_view path,
                                           std::optional<std::int64_t> number);
  [[nodiscard]] std::string state() const;
  [[nodiscard]] WatchServer::Answer table(std::string_view path, std::int64_t from) const;

  mutable std::mutex mutex_;  // of all that follows up to the server
  std::filesystem::path folder_;
  std::shared_ptr<const std::string> page_;
  std::string status_ = "running";
  std::vector<Part> frames_, cuts_;
  Clock::time_point asked_{};  ///< the last time that anybody asked
  bool is_end_known_ = false;  ///< somebody has asked since the status was last set
  std::string address_;
  WatchServer server_;  // last: its thread ends before what it reads
};

}  // namespace meniscus
