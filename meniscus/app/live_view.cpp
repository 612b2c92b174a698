#include "meniscus/app/live_view.hpp"

#include <algorithm>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/report/report.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* json_type = "application/json";
constexpr const char* binary_type = "application/octet-stream";
constexpr std::int64_t most_table_bytes = 1
                                          << 22;  // per answer; a page that lags behind asks again

// A page asks every second, less often on a busy machine or in a background tab.
constexpr auto longest_pause = 5s;
// After the end is known, a page still fetches the last tables and frames one by one.
constexpr auto settling_time = 1s;
constexpr auto longest_farewell = 6s;

std::int64_t size_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error ? 0 : static_cast<std::int64_t>(size);
}

template <class Part>
WatchServer::Answer entries_from(const std::vector<Part>& parts, std::int64_t from) {
  std::string list;
  for (std::size_t k = static_cast<std::size_t>(from); k < parts.size(); ++k)
    list += (list.empty() ? "" : ",") + parts[k].entry;
  return {200, json_type, "[" + list + "]", nullptr};
}

template <class Part>
WatchServer::Answer bytes_of(const std::vector<Part>& parts, std::int64_t number) {
  if (static_cast<std::size_t>(number) >= parts.size()) return {};
  return {200, binary_type, {}, parts[static_cast<std::size_t>(number)].bytes};
}

/// Of two processes with one number, one begins later.
std::string new_id() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return fmt::format("{}-{}", getpid(),
                     std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

}  // namespace

LiveView::LiveView(const WatchAddress& address)
    : address_(address.address),
      id_(new_id()),
      server_(address, [this](const WatchServer::Request& request) { return answer(request); }) {}

std::string LiveView::url() const { return fmt::format("http://{}:{}/", address_, server_.port()); }

void LiveView::begin(const fs::path& folder) {
  auto page = std::make_shared<const std::string>(live_page(folder, id_));
  const std::lock_guard lock(mutex_);
  folder_ = folder;
  page_ = std::move(page);
}

void LiveView::update(const RunDirectory& directory) {
  // Only this thread adds to the lists, so it may read their sizes without the lock.
  const auto add_new = [&](Parts& parts, const std::vector<io::PvdEntry>& entries,
                           LivePart (*pack)(const fs::path&, double)) {
    while (parts.num_tried < entries.size()) {
      const io::PvdEntry& entry = entries[parts.num_tried++];
      try {
        LivePart part = pack(directory.path() / entry.file, entry.t);
        const std::lock_guard lock(mutex_);
        parts.packed.push_back(
            {std::move(part.entry), std::make_shared<const std::string>(std::move(part.bytes))});
      } catch (const InvalidInput& error) {  // a frame missing from the view must not end the run
        log::warning("live view: {}", error.what());
      }
    }
  };
  add_new(frames_, directory.surface_frames(), live_surface);
  add_new(cuts_, directory.volume_frames(), live_cuts);
}

void LiveView::end(const std::string& status) {
  const Clock::time_point now = Clock::now();
  const auto under_lock = [&](const auto& read) {
    const std::lock_guard lock(mutex_);
    return read();
  };
  under_lock([&] {
    status_ = status;
    is_end_known_ = false;
    return 0;
  });
  const auto is_anybody_waiting = [&] {
    if (now - asked_ > longest_pause) return false;
    return !is_end_known_ || Clock::now() - asked_ < settling_time;
  };
  while (Clock::now() - now < longest_farewell && under_lock(is_anybody_waiting))
    std::this_thread::sleep_for(50ms);
}

WatchServer::Answer LiveView::answer(const WatchServer::Request& request) {
  const auto& [path, number, run] = request;
  const std::lock_guard lock(mutex_);
  if (path == "/favicon.ico") return {204, "text/plain", {}, nullptr};
  if (page_ == nullptr) return {503, "text/plain", "the run is about to begin\n", nullptr};
  if (!run.empty() && run != id_) return {409, "text/plain", "another run\n", nullptr};
  asked_ = Clock::now();
  if (path == "/") return {200, "text/html; charset=utf-8", {}, page_};
  if (path == "/state") {
    is_end_known_ = true;
    return {200, json_type, state(), nullptr};
  }
  if (path == "/frames") return entries_from(frames_.packed, number.value_or(0));
  if (path == "/cuts") return entries_from(cuts_.packed, number.value_or(0));
  if (path == "/frame" && number) return bytes_of(frames_.packed, *number);
  if (path == "/cut" && number) return bytes_of(cuts_.packed, *number);
  return table(path, number.value_or(0));
}

std::string LiveView::state() const {
  nlohmann::ordered_json tables = nlohmann::ordered_json::object();
  for (const auto& [name, file] : io::RunFiles::tables) tables[name] = size_of(folder_ / file);
  return nlohmann::ordered_json{{"run", id_},
                                {"status", status_},
                                {"frames", frames_.packed.size()},
                                {"cuts", cuts_.packed.size()},
                                {"tables", tables}}
      .dump();
}

WatchServer::Answer LiveView::table(std::string_view path, std::int64_t from) const {
  const auto found = std::ranges::find_if(io::RunFiles::tables, [&](const io::RunTableFile& table) {
    return path.starts_with('/') && path.substr(1) == table.file;
  });
  if (found == io::RunFiles::tables.end()) return {404, "text/plain", "not here\n", nullptr};
  const fs::path file = folder_ / found->file;
  const std::int64_t length = std::clamp<std::int64_t>(size_of(file) - from, 0, most_table_bytes);
  std::string rows(static_cast<std::size_t>(length), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(from);
  stream.read(rows.data(), length);
  rows.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return {200, "text/csv; charset=utf-8", std::move(rows), nullptr};
}

}  // namespace meniscus
