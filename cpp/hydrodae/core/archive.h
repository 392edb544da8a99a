#pragma once
/// What a run remembers, as plain numbers. A class that changes from step to step lists its members
/// once, for saving and for restoring:
///
///   void remember(Archive& a) { a(size_, times_); }

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/types.h"

namespace hydrodae {

/// Numbers by the name of the part that they belong to.
using Memory = std::map<std::string, std::vector<double>>;

/// Copies values to the end of a list of numbers, or from it, in the same order. Integers are exact
/// below 2^53. Throws Error where a list to restore from is too short or too long.
class Archive {
public:
  explicit Archive(std::vector<double>& out) : out_(&out) {} ///< saves
  explicit Archive(const std::vector<double>& in)            ///< restores
      : next_(in.data()), end_(in.data() + in.size()) {}

  bool saves() const { return out_ != nullptr; }

  template <class... Values> void operator()(Values&... values) { (take(values), ...); }

  /// To be called after the last value.
  void finish() const {
    if (next_ != end_)
      misfit();
  }

private:
  [[noreturn]] static void misfit() {
    throw Error("a saved state does not fit this run: it was made for another scene or by another "
                "version of hydrodae");
  }

  void number(double& value) {
    if (saves()) {
      out_->push_back(value);
      return;
    }
    if (next_ == end_)
      misfit();
    value = *next_++;
  }

  void numbers(double* values, std::size_t count) {
    if (saves()) {
      out_->insert(out_->end(), values, values + count);
      return;
    }
    if (static_cast<std::size_t>(end_ - next_) < count)
      misfit();
    std::copy_n(next_, count, values);
    next_ += count;
  }

  /// Of a list whose elements take at least `least` numbers each.
  std::size_t size(std::size_t now, std::size_t least = 1) {
    auto value = static_cast<double>(now);
    number(value);
    const double most = saves() ? INFINITY
                                : static_cast<double>(end_ - next_) /
                                      static_cast<double>(std::max<std::size_t>(least, 1));
    if (!(value >= 0.0 && value <= most && value == std::floor(value)))
      misfit();
    return static_cast<std::size_t>(value);
  }

  template <class T> void take(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      auto x = static_cast<double>(value);
      number(x);
      value = static_cast<T>(x);
    } else {
      value.remember(*this);
    }
  }

  void take(VectorX& v) {
    v.resize(static_cast<Eigen::Index>(size(static_cast<std::size_t>(v.size()))));
    numbers(v.data(), static_cast<std::size_t>(v.size()));
  }

  void take(MatrixX& m) {
    const std::size_t columns = size(static_cast<std::size_t>(m.cols()), 0),
                      count = size(static_cast<std::size_t>(m.size()));
    if (!saves())
      m.resize(static_cast<Eigen::Index>(columns > 0 ? count / columns : 0),
               static_cast<Eigen::Index>(columns));
    numbers(m.data(), static_cast<std::size_t>(m.size()));
  }

  void take(std::vector<double>& v) {
    v.resize(size(v.size()));
    numbers(v.data(), v.size());
  }

  template <class T> void take(std::vector<T>& v) {
    v.resize(size(v.size()));
    for (T& x : v)
      take(x);
  }

  template <class T> void take(std::deque<T>& v) {
    v.resize(size(v.size()));
    for (T& x : v)
      take(x);
  }

  template <class T, std::size_t n> void take(std::array<T, n>& v) {
    for (T& x : v)
      take(x);
  }

  template <class A, class B> void take(std::pair<A, B>& v) {
    take(v.first);
    take(v.second);
  }

  template <class T> void take(std::optional<T>& v) {
    bool there = v.has_value();
    take(there);
    if (!there)
      v.reset();
    else if (!v)
      v.emplace();
    if (v)
      take(*v);
  }

  std::vector<double>* out_ = nullptr;
  const double *next_ = nullptr, *end_ = nullptr;
};

/// Saves what `part` remembers under `name`.
template <class Part> void save(Memory& memory, const std::string& name, Part& part) {
  std::vector<double>& numbers = memory[name];
  numbers.clear();
  Archive archive(numbers);
  archive(part);
}

/// Restores it; see Archive.
template <class Part> void restore(const Memory& memory, const std::string& name, Part& part) {
  static const std::vector<double> none;
  const auto found = memory.find(name);
  Archive archive(found == memory.end() ? none : found->second);
  archive(part);
  archive.finish();
}

} // namespace hydrodae
