#include "meniscus/app/watch_server.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

#include <arpa/inet.h>
#include <microhttpd.h>
#include <unistd.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

// A page uses one or two connections: enough for a lecture hall, and a bound against misuse.
constexpr unsigned int most_connections = 256;
constexpr std::size_t connection_memory = 16384;  // [byte] for the request line and all headers
constexpr unsigned int longest_silence = 15;      // [s] of a connection
constexpr int niceness = 10;                      // the run comes first

/// The text as a whole number from 0; none when it is not one.
std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && value >= 0;
  return is_number ? std::optional(value) : std::nullopt;
}

const char* header(MHD_Connection* connection, const char* name) {
  return MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
}

WatchServer::Answer refusal(int status, std::string reason) {
  return {status, "text/plain; charset=utf-8", std::move(reason) + "\n", nullptr};
}

/// Leaves escapes in a request as they are: no served name has any, so such a request finds
/// nothing.
std::size_t keep_escapes(void* /*unused*/, MHD_Connection* /*unused*/, char* text) {
  return std::strlen(text);
}

using SharedBody = std::shared_ptr<const std::string>;

void release_shared(void* body) {
  const std::unique_ptr<SharedBody> taken_back(static_cast<SharedBody*>(body));
}

MHD_Response* response_of(const WatchServer::Answer& answer) {
  if (answer.shared == nullptr) {
    return MHD_create_response_from_buffer(
        answer.text.size(), const_cast<char*>(answer.text.data()), MHD_RESPMEM_MUST_COPY);
  }
  // The library owns the body until the slowest reader has it.
  auto held = std::make_unique<SharedBody>(answer.shared);
  MHD_Response* response = MHD_create_response_from_buffer_with_free_callback_cls(
      answer.shared->size(), const_cast<char*>(answer.shared->data()), release_shared, held.get());
  if (response != nullptr) (void)held.release();
  return response;
}

MHD_Result send(MHD_Connection* connection, const WatchServer::Answer& answer) {
  MHD_Response* response = response_of(answer);
  if (response == nullptr) return MHD_NO;
  MHD_add_response_header(response, "Content-Type", answer.type);
  MHD_add_response_header(response, "Cache-Control", "no-store");
  MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
  const MHD_Result result =
      MHD_queue_response(connection, static_cast<unsigned int>(answer.status), response);
  MHD_destroy_response(response);
  return result;
}

}  // namespace

struct WatchServer::Impl {
  Handler handler;
  MHD_Daemon* daemon = nullptr;
  bool is_loopback = true;
  std::string address;
  int port = 0;

  [[nodiscard]] bool is_host_ours(MHD_Connection* connection) const;
  [[nodiscard]] Answer answer(MHD_Connection* connection, const char* url,
                              std::string_view method) const;
  static MHD_Result respond(void* self, MHD_Connection* connection, const char* url,
                            const char* method, const char* version, const char* upload,
                            std::size_t* upload_size, void** state);
};

/// Whether the request names this host: another site whose name was redirected here must not read
/// the run (DNS rebinding). The port may be that of a tunnel that leads here.
bool WatchServer::Impl::is_host_ours(MHD_Connection* connection) const {
  const char* host = header(connection, "Host");
  if (!is_loopback || host == nullptr) return true;
  const std::string_view name = std::string_view(host).substr(0, std::string_view(host).find(':'));
  return name == "127.0.0.1" || name == "localhost" || name == address;
}

WatchServer::Answer WatchServer::Impl::answer(MHD_Connection* connection, const char* url,
                                              std::string_view method) const {
  if (method != "GET" && method != "HEAD") return refusal(405, "only GET and HEAD");
  if (header(connection, "Transfer-Encoding") != nullptr) return refusal(413, "no body");
  const char* length = header(connection, "Content-Length");
  if (length != nullptr && std::string_view(length) != "0") return refusal(413, "no body");
  if (!is_host_ours(connection)) return refusal(403, "another host");
  std::optional<std::int64_t> number;
  for (const char* name : {"from", "number"}) {
    const char* text = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, name);
    if (text == nullptr) continue;
    number = whole_number(text);
    if (!number) return refusal(400, fmt::format("{} is not a whole number from 0", name));
  }
  const char* run = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "run");
  return handler({url, number, run == nullptr ? std::string_view() : run});
}

// NOLINTNEXTLINE(readability-function-size): the library sets the parameters
MHD_Result WatchServer::Impl::respond(void* self, MHD_Connection* connection, const char* url,
                                      const char* method, const char* /*version*/,
                                      const char* /*upload*/, std::size_t* upload_size,
                                      void** /*state*/) {
  thread_local const int is_nice = nice(niceness);
  (void)is_nice;
  *upload_size = 0;
  try {
    return send(connection, static_cast<Impl*>(self)->answer(connection, url, method));
  } catch (const std::exception& error) {
    return send(connection, refusal(500, error.what()));
  }
}

WatchServer::WatchServer(const WatchAddress& address, Handler handler)
    : impl_(std::make_unique<Impl>()) {
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_port = htons(static_cast<std::uint16_t>(address.port));
  if (inet_pton(AF_INET, address.address.c_str(), &where.sin_addr) != 1)
    reject_input("--listen {}: not an IPv4 address such as 127.0.0.1", address.address);
  impl_->handler = std::move(handler);
  impl_->address = address.address;
  impl_->is_loopback = (ntohl(where.sin_addr.s_addr) >> 24) == 127;
  errno = 0;
  impl_->daemon = MHD_start_daemon(
      MHD_USE_EPOLL_INTERNAL_THREAD, 0, nullptr, nullptr, &Impl::respond, impl_.get(),
      MHD_OPTION_SOCK_ADDR, &where, MHD_OPTION_CONNECTION_LIMIT, most_connections,
      MHD_OPTION_CONNECTION_MEMORY_LIMIT, connection_memory, MHD_OPTION_CONNECTION_TIMEOUT,
      longest_silence, MHD_OPTION_UNESCAPE_CALLBACK, keep_escapes, nullptr, MHD_OPTION_END);
  if (impl_->daemon == nullptr) {
    reject_input("--watch: cannot listen at {}:{}: {}; give another --port", address.address,
                 address.port, std::strerror(errno));
  }
  const MHD_DaemonInfo* info = MHD_get_daemon_info(impl_->daemon, MHD_DAEMON_INFO_BIND_PORT);
  impl_->port = info == nullptr ? address.port : info->port;
}

WatchServer::~WatchServer() { MHD_stop_daemon(impl_->daemon); }

int WatchServer::port() const { return impl_->port; }

}  // namespace meniscus
