// The linear solvers for the Newton iteration of a stiff method.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "saltus/model/event.hpp"

namespace saltus {

enum class LinearSolver { automatic, dense, band, sparse, gmres };

inline constexpr std::array<std::pair<std::string_view, LinearSolver>, 5> linear_solver_names{{
    {"auto", LinearSolver::automatic},
    {"dense", LinearSolver::dense},
    {"band", LinearSolver::band},
    {"sparse", LinearSolver::sparse},
    {"gmres", LinearSolver::gmres},
}};

/// The linear solver of that name. Throws a ModelError with the nearest name if there is none.
inline LinearSolver linear_solver_from(std::string_view name) {
  return detail::value_of(linear_solver_names, "linear_solver", name);
}

}  // namespace saltus
