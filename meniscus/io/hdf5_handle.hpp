#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <hdf5.h>

namespace meniscus::io {

/// A call of HDF5 failed; callers turn it into InvalidInput or RunFailure with the file's name.
class Hdf5Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The value of a call of HDF5; throws Hdf5Failure when it is negative.
template <class T>
T hdf5_check(T value, const char* call) {
  if (value < 0) throw Hdf5Failure(std::string(call) + " failed");
  return value;
}

/// Owns an HDF5 identifier.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close, const char* call) : id_(hdf5_check(id, call)), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: stands for the identifier in every call

 private:
  hid_t id_;
  Close close_;
};

/// Silences HDF5's printing of its error stack while it lives.
class Hdf5Silence {
 public:
  Hdf5Silence() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;
  ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace meniscus::io
