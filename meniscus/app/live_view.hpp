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

/// Serves the page of a run while it computes. The server answers from memory or from the run's
/// tables, under a fixed list of names (docs/report.md); no request becomes a file path.
class LiveView {
 public:
  /// Begins to listen; requests before `begin` are told to wait. Throws InvalidInput when the
  /// address cannot be listened at.
  explicit LiveView(const WatchAddress& address);

  [[nodiscard]] std::string url() const;

  /// Makes the page. The folder must hold run.json.
  void begin(const std::filesystem::path& folder);
  /// Packs the frames that have been written since the last call.
  void update(const RunDirectory& directory);
  /// Publishes how the run ended, and waits at most six seconds for open pages to fetch it.
  void end(const std::string& status);

 private:
  using Clock = std::chrono::steady_clock;
  struct Part {
    std::string entry;
    std::shared_ptr<const std::string> bytes;
  };
  /// Frames or cuts; those that cannot be read are left out.
  struct Parts {
    std::vector<Part> packed;
    std::size_t num_tried = 0;  ///< files of the run read so far, with success or without
  };

  [[nodiscard]] WatchServer::Answer answer(const WatchServer::Request& request);
  [[nodiscard]] std::string state() const;
  [[nodiscard]] WatchServer::Answer table(std::string_view path, std::int64_t from) const;

  mutable std::mutex mutex_;  // guards the members from here to `server_`
  std::filesystem::path folder_;
  std::shared_ptr<const std::string> page_;
  std::string status_ = "running";
  Parts frames_, cuts_;
  Clock::time_point asked_{};  ///< time of the latest request
  bool is_end_known_ = false;  ///< a page has asked since the status was set
  std::string address_;
  std::string id_;      ///< of this view: pages notice that another run answers in its place
  WatchServer server_;  // last: its thread ends before what it reads
};

}  // namespace meniscus
