#pragma once

#include <memory>

namespace meniscus::io {

/// Takes VTK's messages instead of the terminal while it lives, and knows whether there were any.
/// Each part of VTK may be the one that finds a file broken, and some say so in no other way.
class VtkMessages {
 public:
  VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;
  ~VtkMessages();
  [[nodiscard]] bool any() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace meniscus::io
