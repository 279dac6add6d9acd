#include "saltus/simulation/detail/declared_derivatives.hpp"

#include <cmath>

namespace saltus {

std::string name_of_column(const PlanLeaf& leaf, Index column) {
  const auto entry = [&](std::string_view what, Index size) {
    const Index i = std::exchange(column, column - size);
    return 0 <= i && i < size ? (size == 1 ? std::string(what) : text(what, "[", i, "]"))
                              : std::string();
  };
  if (column < leaf.nx) return text("x[", column, "]");
  column -= leaf.nx;
  if (column < leaf.nz) return text("z[", column, "]");
  column -= leaf.nz;
  for (const Layout::Parameter& parameter : leaf.declared().parameters)
    if (const std::string name = entry(parameter.name, parameter.size); !name.empty()) return name;
  for (std::size_t i = 0; i < leaf.input_places.size(); ++i) {
    const std::string input = text("input ", i);
    if (const std::string name = entry(input, leaf.input_places[i].size); !name.empty())
      return name;
  }
  return "time";
}

Eigen::MatrixXd declared_derivatives(const PlanLeaf& leaf, const DerivativesFunction& function,
                                     const At& at, Index rows, const std::string& what) {
  Eigen::MatrixXd values(rows, Derivatives::columns(at));
  Derivatives derivatives(values.data(), rows, at);
  function(*leaf.system, at, derivatives);
  for (Index k = 0; k < values.cols(); ++k) {
    for (Index i = 0; i < rows; ++i) {
      if (std::isfinite(values(i, k))) continue;
      throw SimulationError(
          text("t = ", at.time, " s: block '", leaf.path, "': the declared derivatives of ", what,
               ": expected finite numbers, found ", values(i, k), " in row ", i, ", by ",
               name_of_column(leaf, k), "; check them with check_derivatives at this state"),
          at.time, leaf.path);
    }
  }
  return values;
}

}  // namespace saltus
