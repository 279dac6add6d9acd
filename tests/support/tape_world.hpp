// Arrays for a tape to read, and short ways to run it.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "saltus/tape/tape.hpp"

namespace support {

/// Time, states, parameters and inputs that an At shows.
struct World {
  double time = 0.0;
  std::vector<double> x = {}, z = {}, p = {};
  std::vector<std::vector<double>> u = {};
  int mode = 0;
  saltus::Index entry = 0;

  /// Calls `act(at)`.
  template <class Act>
  auto show(Act act) const {
    std::vector<double> values;
    std::vector<saltus::Place> places;
    for (const auto& input : u) {
      places.push_back({saltus::Space::y, static_cast<saltus::Index>(values.size()),
                        static_cast<saltus::Index>(input.size())});
      values.insert(values.end(), input.begin(), input.end());
    }
    const saltus::Bases bases{x.data(), z.data(), p.data(), values.data()};
    const auto view = [](const std::vector<double>& all) {
      return saltus::VectorView(all.data(), static_cast<saltus::Index>(all.size()));
    };
    const saltus::Inputs shown(places.data(), static_cast<int>(places.size()), &bases);
    saltus::At at{time, view(x), view(z), view(p), mode, shown, nullptr};
    at.entry = entry;
    return act(at);
  }
};

/// The values of a tape.
inline std::vector<double> values_of(const saltus::tape::Tape& tape, const World& world) {
  std::vector<double> out(static_cast<std::size_t>(tape.size()), -99.0);
  world.show([&](const saltus::At& at) { tape.evaluate(at, out.data()); });
  return out;
}

inline saltus::tape::Tape tape_of(const saltus::tape::Graph& graph,
                                  std::initializer_list<saltus::tape::Node> outputs) {
  return {graph, std::span(outputs.begin(), outputs.size())};
}

/// Equal to the last bit, the sign of zero included; one NaN is as good as another.
inline bool same_bits(double a, double b) {
  std::uint64_t of_a = 0, of_b = 0;
  std::memcpy(&of_a, &a, sizeof a);
  std::memcpy(&of_b, &b, sizeof b);
  return of_a == of_b || (a != a && b != b);
}

}  // namespace support
