// Edges: the values of watched signals from instant to instant.
#include "saltus/simulation/detail/edges.hpp"

#include <algorithm>

namespace saltus {

Edges::Edges(const Machine& machine)
    : machine_(&machine),
      values_(machine.plan().edges.size(), 0),
      carried_(machine.plan().edges.size(), 0) {}

void Edges::begin() {
  for (std::size_t e = 0; e < values_.size(); ++e) values_[e] = machine_->truth(edge(e).node);
}

void Edges::open() {
  values_minus_ = values_;
  std::ranges::fill(carried_, 0);
  fired_.clear();
}

Edges::Look Edges::look(std::size_t e) {
  const bool now = machine_->truth(edge(e).node), before = values_[e] != 0;
  values_[e] = now;
  const Edge wanted = reset_of(e).edge;
  return {.now = now,
          .fires = now != before && (wanted == Edge::either || (wanted == Edge::rising) == now)};
}

bool Edges::has_fired(std::size_t e) const {
  return std::ranges::find(fired_, static_cast<int>(e)) != fired_.end();
}

bool Edges::set_off_by(int node) const {
  return std::ranges::any_of(fired_, [&](int number) {
    const bool up = reset_of(number).edge != Edge::falling;
    return std::ranges::find(edge(number).relations, node) != edge(number).relations.end() &&
           machine_->truth(edge(number).node) == up;
  });
}

void Edges::load(const Continuation& from) {
  std::ranges::transform(from.edges, values_.begin(),
                         [](int value) { return static_cast<char>(value); });
}

}  // namespace saltus
