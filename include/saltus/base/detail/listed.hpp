// Vectors in messages.
#pragma once

#include <algorithm>
#include <string>

#include <Eigen/Core>

#include "saltus/base/error.hpp"

namespace saltus {

/// "[10, -3]", cut after six numbers.
inline std::string listed(const Eigen::Ref<const Eigen::VectorXd>& values) {
  constexpr Eigen::Index most = 6;
  std::string out;
  for (Eigen::Index i = 0; i < std::min(values.size(), most); ++i)
    out += text(i == 0 ? "" : ", ", values[i]);
  return text("[", out, values.size() > most ? ", ..." : "", "]");
}

}  // namespace saltus
