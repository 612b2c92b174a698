#include "meniscus/io/atomic_file.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "meniscus/core/error.hpp"

namespace meniscus::io {
namespace {

namespace fs = std::filesystem;

/// A file open for writing; closed when it goes.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : value_(::open(path.c_str(), flags, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  [[nodiscard]] bool is_open() const { return value_ >= 0; }
  [[nodiscard]] int get() const { return value_; }
  [[nodiscard]] int close() {
    const int status = ::close(value_);
    value_ = -1;
    return status;
  }

 private:
  int value_;
};

/// 0, or the error number of the first system call that failed.
int write_all(int descriptor, std::string_view bytes) {
  MENISCUS_ASSERT(descriptor >= 0, "descriptor {}", descriptor);
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// As `write_all`, to a new file; the bytes have reached the disk when it returns 0.
int write_and_sync(const fs::path& path, std::string_view bytes) {
  Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW);
  if (!file.is_open()) return errno;
  if (const int error = write_all(file.get(), bytes); error != 0) return error;
  // Some file systems (pipes, some network mounts) cannot sync and say EINVAL.
  if (::fsync(file.get()) != 0 && errno != EINVAL) return errno;
  return file.close() == 0 ? 0 : errno;
}

/// Makes a rename last through a power cut; 0, or the error number.
int sync_folder(const fs::path& folder) {
  const Descriptor handle(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_CLOEXEC);
  // A folder that may not be read can be written all the same.
  if (!handle.is_open() || ::fsync(handle.get()) == 0 || errno == EINVAL) return 0;
  return errno;
}

bool is_device(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::is_character_file(status) || fs::is_fifo(status);
}

void write_in_place(const fs::path& path, std::string_view bytes) {
  const Descriptor device(path, O_WRONLY | O_CLOEXEC);
  if (!device.is_open()) fail_writing(path, errno);
  if (const int error = write_all(device.get(), bytes); error != 0) fail_writing(path, error);
}

}  // namespace

void fail_writing(const fs::path& path, int error_number) {
  MENISCUS_ASSERT(error_number != 0, "no failure of {}", path.string());
  throw RunFailure(fmt::format("{}: cannot be written: {}", path.string(),
                               std::generic_category().message(error_number)));
}

void write_file(const fs::path& path, std::string_view bytes) {
  if (is_device(path)) return write_in_place(path, bytes);
  // One fixed name: what a killed program left behind is overwritten by the next attempt.
  const fs::path temporary = path.string() + ".partial";
  int error = write_and_sync(temporary, bytes);
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail_writing(path, error);
  }
  if (const int failed = sync_folder(path.parent_path()); failed != 0) fail_writing(path, failed);
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) reject_input("{}: no such file", path.string());
  if (!fs::is_regular_file(status)) reject_input("{}: not a file", path.string());
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), {});
  if (!file) {
    reject_input("{}: cannot be read: {}", path.string(),
                 std::generic_category().message(errno != 0 ? errno : EIO));
  }
  return bytes;
}

}  // namespace meniscus::io
