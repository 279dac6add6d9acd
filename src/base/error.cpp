// Lists of names in messages, and the name that was probably meant.
#include "saltus/base/error.hpp"

#include <algorithm>
#include <numeric>

namespace saltus {

namespace detail {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row.back();
}

}  // namespace detail

std::string quoted_list(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size() && i < 12; ++i) {
    out += text(i == 0 ? "'" : ", '", names[i], "'");
  }
  return names.size() > 12 ? out + ", ..." : out;
}

void ModelError::explain(const std::string& more, std::exception_ptr cause) {
  longer_ = std::make_shared<const std::string>(what() + more);
  cause_ = std::move(cause);
}

std::string known_names(std::string_view wrong, const std::vector<std::string>& names) {
  if (names.empty()) return "; there are none";
  const auto nearest = std::ranges::min_element(
      names, {}, [&](const std::string& name) { return detail::edit_distance(wrong, name); });
  const bool close = detail::edit_distance(wrong, *nearest) <= 1 + wrong.size() / 3;
  return text(close ? text("; did you mean '", *nearest, "'?") : std::string(";"),
              " Known: ", quoted_list(names));
}

}  // namespace saltus
