#pragma once
/// Common part of reading and writing HDF5: handles that close themselves, checked calls.

#include <hdf5.h>

#include <string>
#include <utility>

#include "hydrodae/core/error.h"

namespace hydrodae::io::hdf5 {

/// An identifier that is closed with the function of its kind.
class Handle {
public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() { reset(); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }

  /// Closes now; returns what the closing function returns, 0 if there was nothing to close.
  herr_t reset() {
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id >= 0 ? close_(id) : 0;
  }

private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Keeps HDF5 from printing its error stack in this thread while it lives: errors become
/// exceptions.
class Quiet {
public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Innermost entry of HDF5's error stack, such as "unable to open file: ... No such file".
std::string reason();

/// Passes a result on; a negative one becomes CaseError "<what>: <reason()>".
template <class Result> Result checked(Result result, const std::string& what) {
  if (result < 0)
    throw CaseError(what + ": " + reason());
  return result;
}

/// Passes an identifier on; a negative one becomes CaseError.
inline Handle checked(hid_t id, Handle::Close close, const std::string& what) {
  return {checked(id, what), close};
}

/// Variable-length UTF-8 text, what Python writes for a str.
Handle text_type();

} // namespace hydrodae::io::hdf5
