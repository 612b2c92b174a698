#pragma once

#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

namespace meniscus {

/// The strong 32-bit name of an element; a vertex id never converts to a face id.
template <class Tag>
struct Id {
  std::int32_t value = -1;
  friend auto operator<=>(Id, Id) = default;
  [[nodiscard]] bool is_valid() const { return value >= 0; }
};

/// 0, 1, …, count − 1 as ids of one kind.
template <class IdType>
[[nodiscard]] auto ids(std::int32_t count) {
  return std::views::iota(std::int32_t{0}, count) |
         std::views::transform([](std::int32_t i) { return IdType{i}; });
}

/// One value of type T per element of kind IdType, stored in the order of the ids.
template <class IdType, class T>
class Field {
 public:
  Field() = default;
  explicit Field(std::int32_t size) : values_(static_cast<std::size_t>(size)) {}
  Field(std::int32_t size, const T& value) : values_(static_cast<std::size_t>(size), value) {}
  explicit Field(std::vector<T> values) : values_(std::move(values)) {}

  [[nodiscard]] T& operator[](IdType id) {
    assert(id.value >= 0 && id.value < size());
    return values_[static_cast<std::size_t>(id.value)];
  }
  [[nodiscard]] const T& operator[](IdType id) const {
    assert(id.value >= 0 && id.value < size());
    return values_[static_cast<std::size_t>(id.value)];
  }

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(values_.size()); }
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] auto ids() const { return meniscus::ids<IdType>(size()); }
  /// Appends a value and returns the id of its new element.
  IdType add(T value) {
    values_.push_back(std::move(value));
    return IdType{size() - 1};
  }
  void resize(std::int32_t size) { values_.resize(static_cast<std::size_t>(size)); }
  void reserve(std::int32_t size) { values_.reserve(static_cast<std::size_t>(size)); }

  [[nodiscard]] std::span<T> span() { return values_; }
  [[nodiscard]] std::span<const T> span() const { return values_; }
  [[nodiscard]] auto begin() { return values_.begin(); }
  [[nodiscard]] auto end() { return values_.end(); }
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }

  friend bool operator==(const Field&, const Field&) = default;

 private:
  std::vector<T> values_;
};

}  // namespace meniscus

template <class Tag>
struct std::hash<meniscus::Id<Tag>> {
  std::size_t operator()(meniscus::Id<Tag> id) const noexcept {
    return std::hash<std::int32_t>{}(id.value);
  }
};
