// The methods by name.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "saltus/base/list.hpp"
#include "saltus/model/event.hpp"

namespace saltus {

/// The methods that advance x between instants. `automatic` chooses among the others: dopri5 or
/// dop853 by tolerance, bdf while the scene is stiff.
enum class Method { automatic, dopri5, dop853, adams, bdf, radau, taylor };

/// The names of the methods. The first seven are in the order of the enum; synonyms follow.
inline constexpr std::array<std::pair<std::string_view, Method>, 16> method_names{{
    {"auto", Method::automatic},
    {"dopri5", Method::dopri5},
    {"dop853", Method::dop853},
    {"adams", Method::adams},
    {"bdf", Method::bdf},
    {"radau", Method::radau},
    {"taylor", Method::taylor},
    {"rk45", Method::dopri5},
    {"RK45", Method::dopri5},
    {"DOP853", Method::dop853},
    {"non-stiff", Method::dopri5},
    {"stiff", Method::bdf},
    {"BDF", Method::bdf},
    {"Radau", Method::radau},
    {"RadauIIA5", Method::radau},
    {"RadauIIA9", Method::radau},
}};

/// The method of that name. Throws a ModelError with the nearest name if there is none.
inline Method method_from(std::string_view name) {
  return detail::value_of(method_names, "ode_solver_method", name);
}

/// The name of the method: "auto", "dopri5", "dop853", "adams", "bdf", "radau" or "taylor".
constexpr std::string_view to_string(Method method) { return nth(method_names, method).first; }

}  // namespace saltus
