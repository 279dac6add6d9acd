// Options that are words, each with a meaning.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "saltus/library/detail/arguments.hpp"

namespace saltus::detail {

/// The meaning of `word` in a table of words. Throws ModelError with the nearest known word if the
/// table does not have it.
template <class Table>
auto meaning(const std::string& block, std::string_view what, std::string_view word,
             const Table& table) {
  std::vector<std::string> known;
  for (const auto& [text_form, value] : table) {
    if (text_form == word) return value;
    known.emplace_back(text_form);
  }
  require_known(block, what, word, known);
  return std::begin(table)->second;  // not reached: the line above throws
}

}  // namespace saltus::detail
