#pragma once

#include <memory>
#include <utility>

namespace hydrodae {

/// Value on the heap, copied with its owner: std::indirect of C++26. The type may be incomplete
/// where the owner is declared, and is complete where the owner is made, copied and freed.
template <class T> class Indirect {
public:
  Indirect() : value_(std::make_unique<T>()) {}
  ~Indirect() = default;
  Indirect(const Indirect& other) : value_(std::make_unique<T>(*other)) {}
  Indirect(Indirect&& other) noexcept = default;
  Indirect& operator=(const Indirect& other) {
    *value_ = *other;
    return *this;
  }
  Indirect& operator=(Indirect&& other) noexcept {
    value_.swap(other.value_);
    return *this;
  }

  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

private:
  std::unique_ptr<T> value_;
};

} // namespace hydrodae
