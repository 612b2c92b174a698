#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace meniscus {

/// What a child process may use.
struct ChildLimits {
  unsigned seconds;        ///< of processor time
  std::size_t memory = 0;  ///< bytes of addresses beyond those in use; 0: no limit of its own
};

/// The outcome of work in a child process.
struct [[nodiscard]] ChildResult {
  std::string failure;  ///< why the work was not done, in one line; empty when it was
  int signal = 0;       ///< the signal that ended the child, if one did
};

/// Does `work` in a child process that shares the memory of this one, while the calling thread
/// waits. An assertion that does not hold, an invalid access or an endless loop there ends the
/// child and is a failure here. The first line that it wrote to standard error tells of it; what it
/// had allocated is lost then. An exception is a failure as well.
///
/// Nothing is copied, so that the cost does not grow with the memory. A `fork` would cost some 0.25
/// ms per MB: page tables, and a fault for each page that is written afterwards. As after `vfork`,
/// signal handlers, files and limits are the child's own: standard output goes nowhere there.
/// `work` must not hold locks where it may be ended. It ends at its limits, and when the calling
/// thread does.
ChildResult run_in_child(const std::function<void()>& work, const ChildLimits& limits);

/// Tries `work` in a child process that has a copy of the memory of this one. What it leaves broken
/// there, such as a library's own state, is lost. Otherwise as `run_in_child`.
ChildResult try_in_child(const std::function<void()>& work, const ChildLimits& limits);

}  // namespace meniscus
