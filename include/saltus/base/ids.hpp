// Small integer types that do not convert to one another.
#pragma once

#include <compare>
#include <cstddef>
#include <functional>

#include <Eigen/Core>

namespace saltus {

using Index = Eigen::Index;

/// Identifies one system as long as the program runs; every constructed system gets a new id.
struct SystemId {
  int value = -1;
  auto operator<=>(const SystemId&) const = default;
};

/// The place of a declared parameter in `at.p`: `at.p[g_]` for a scalar, `at.parameter(k_)` for a
/// vector.
struct ParameterIndex {
  Index offset = 0;
  Index size = 1;
  constexpr operator Index() const noexcept { return offset; }
};

/// Identifies a relation of a leaf: `at.relation(r)`.
struct RelationIndex {
  int value = -1;
};

}  // namespace saltus

template <>
struct std::hash<saltus::SystemId> {
  std::size_t operator()(saltus::SystemId id) const noexcept { return std::hash<int>{}(id.value); }
};
