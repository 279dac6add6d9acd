// Buses: signals with names that go together through one wire, a vector.
// BusCreator: an input for each name, scalar or of the given width. bus: a vector of all of them.
// BusSelector: in: the vector of a bus. An output for each chosen name.
// A signal "imu.rates" is part of the bus "imu" within the bus: the creator has one input "imu" for
// all its parts, and a selector takes the part or, by "imu", all of it, with the name "imu_rates"
// for an output. Nothing is computed, and no part of a bus that is not selected counts as read.
#pragma once

#include <string>
#include <vector>

#include "saltus/library/detail/arguments.hpp"

namespace saltus {

struct BusSignal {
  std::string name;
  Shape shape = Shape::scalar();
};

/// The signals of a bus, in their order in its vector.
using BusLayout = std::vector<BusSignal>;

class BusCreator final : public LeafSystem {
 public:
  /// Throws ModelError for no signal, and for a name that is empty or there twice.
  BusCreator(std::string name, const BusLayout& layout);
};

class BusSelector final : public LeafSystem {
 public:
  /// Throws ModelError for a name that is not in the layout, with the nearest one.
  BusSelector(std::string name, const BusLayout& layout, const std::vector<std::string>& names);
};

}  // namespace saltus
