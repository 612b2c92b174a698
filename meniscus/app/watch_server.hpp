#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace meniscus {

/// Where the live view of a run is served.
struct WatchAddress {
  std::string address = "127.0.0.1";  ///< IPv4; no other machine reaches the default
  int port = 8642;                    ///< 0: any that is free
};

/// A small HTTP server on a thread of its own. It answers GET and HEAD for the paths that its
/// handler knows, and refuses everything else, also requests with a body. One thread serves all
/// connections without blocking on slow ones. Their number, memory and idle time are limited.
class WatchServer {
 public:
  struct Answer {
    int status = 404;
    const char* type = "text/plain; charset=utf-8";
    std::string text = {};                                ///< the body, unless `shared` is set
    std::shared_ptr<const std::string> shared = nullptr;  ///< a body shared by many answers
  };
  struct Request {
    std::string_view path;               ///< never a file name
    std::optional<std::int64_t> number;  ///< the whole number given as `from` or `number`, if any
    std::string_view run;                ///< what is given as `run`; empty: nothing
  };
  /// Called on the server's thread.
  using Handler = std::function<Answer(const Request&)>;

  /// Throws InvalidInput when the address is invalid or cannot be listened at.
  WatchServer(const WatchAddress& address, Handler handler);
  WatchServer(const WatchServer&) = delete;
  WatchServer& operator=(const WatchServer&) = delete;
  ~WatchServer();

  [[nodiscard]] int port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace meniscus
