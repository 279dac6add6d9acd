// OperatingPoint: what its values say.
#include <cmath>
#include <ostream>

#include "saltus/analysis/trim.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "saltus/model/detail/names.hpp"

namespace saltus {

std::string_view to_string(Stability stability) {
  constexpr std::string_view names[] = {"stable", "unstable", "undecided", "no states"};
  return nth(names, stability);
}

double OperatingPoint::value(std::string_view name) const {
  for (const NamedValue& one : values)
    if (one.name == name) return one.value;
  throw ModelError(text("the point has no free value '", name, "'",
                        known_names(name, detail::names_of(values))));
}

Stability OperatingPoint::stability() const {
  if (linearization.states.empty()) return Stability::no_states;
  const double largest = poles().real().maxCoeff();
  if (!success() || !smooth || !(std::abs(largest) > margin)) return Stability::undecided;
  return largest < 0.0 ? Stability::stable : Stability::unstable;
}

std::ostream& operator<<(std::ostream& out, const OperatingPoint& point) {
  out << "operating point at t = " << point.context.time() << " s: " << to_string(point.status)
      << ", " << to_string(point.stability()) << "\n";
  for (const NamedValue& one : point.values) out << "  " << one.name << " = " << one.value << "\n";
  const NamedValue* worst = nullptr;
  for (const NamedValue& one : point.residuals)
    if (!worst || std::abs(one.value) > std::abs(worst->value)) worst = &one;
  if (worst) out << "  largest residual: " << worst->name << ", " << worst->value << "\n";
  for (const auto& pole : point.poles()) out << "  pole " << pole << "\n";
  if (!point.message.empty()) out << "  " << point.message << "\n";
  for (const std::string& note : point.notes) out << "  " << note << "\n";
  return out;
}

}  // namespace saltus
