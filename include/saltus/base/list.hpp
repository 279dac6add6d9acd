// List: a std::vector whose entries have numbers of any integer type.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace saltus {

/// Blocks, nodes and guards have numbers of type int, of which -1 means none. Places in the state
/// are Eigen's signed Index. A std::vector counts with std::size_t. A List takes all of them, for
/// its entries and for its size, so that the one conversion is here. A negative number is an error
/// of the caller, as it is with a std::vector.
template <class T>
class List : public std::vector<T> {
 public:
  using Base = std::vector<T>;
  using Base::Base;
  using Base::operator=;
  List() = default;
  List(Base&& all) noexcept : Base(std::move(all)) {}
  explicit List(const Base& all) : Base(all) {}
  explicit List(std::integral auto size) : Base(static_cast<std::size_t>(size)) {}
  List(std::integral auto size, const T& value) : Base(static_cast<std::size_t>(size), value) {}

  decltype(auto) operator[](std::integral auto i) {
    return Base::operator[](static_cast<std::size_t>(i));
  }
  decltype(auto) operator[](std::integral auto i) const {
    return Base::operator[](static_cast<std::size_t>(i));
  }
  void resize(std::integral auto size) { Base::resize(static_cast<std::size_t>(size)); }
  void resize(std::integral auto size, const T& value) {
    Base::resize(static_cast<std::size_t>(size), value);
  }
  using Base::assign;
  void assign(std::integral auto size, const T& value) {
    Base::assign(static_cast<std::size_t>(size), value);
  }
};

/// Entry `i` of an array, a span or a pointer. The number has any integer type, or is a value of an
/// enum.
template <class Number>
  requires std::integral<Number> || std::is_enum_v<Number>
constexpr decltype(auto) nth(auto&& all, Number number) {
  return all[static_cast<std::size_t>(number)];
}

}  // namespace saltus
