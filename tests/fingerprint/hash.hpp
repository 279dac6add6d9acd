// Hash: one number for a sequence of values, to the last bit of each.
#pragma once

#include <concepts>
#include <cstdint>
#include <cstdio>
#include <ranges>
#include <string>
#include <string_view>

namespace fingerprint {

/// FNV-1a with 64 bits (http://www.isthe.com/chongo/tech/comp/fnv). A text and a list begin with
/// their length, so that what is next to each other cannot be taken for something else.
class Hash {
 public:
  void add(double value) { add_bytes(&value, sizeof value); }
  void add(std::integral auto value) {
    const auto wide = static_cast<std::int64_t>(value);
    add_bytes(&wide, sizeof wide);
  }
  void add(std::string_view value) {
    add(value.size());
    add_bytes(value.data(), value.size());
  }
  template <class List>
    requires(std::ranges::range<List> && !std::convertible_to<List, std::string_view>)
  void add(const List& list) {
    add(list.size());
    for (const auto& value : list) add(value);
  }

  /// Twelve hexadecimal digits.
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value_));
    return std::string(digits, 12);
  }

 private:
  void add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3u;
  }

  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace fingerprint
