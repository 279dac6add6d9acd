// The time of an instant: the first cause, and those that move apart from it.
#include "saltus/simulation/detail/instant_time.hpp"

#include <cmath>
#include <utility>

namespace saltus {

void InstantTime::take(const MovedTime& moved) {
  const bool first = std::exchange(first_, false);
  if (first) cause_ = moved.event;
  const auto lose = [&](Index k, const std::string& reason) {
    gaps_->lose(t_, k, moved.event, reason);
  };
  for (Index k = 0; k < columns_->size(); ++k) {
    if (!moved.obstacle.empty()) {
      lose(k, moved.obstacle);
    } else if (first) {
      columns_->t[k] = moved.by[k];
      if (std::isnan(moved.by[k])) lose(k, moved.doubt);
    } else if (std::isnan(moved.by[k]) && !gaps_->lost(k)) {
      lose(k, moved.doubt);
    } else if (moves_apart(columns_->t[k], moved.by[k])) {
      lose(k, "another event happens at the same time, and their order would change");
    }
  }
}

void InstantTime::settle() {
  if (!first_) return;
  cause_.reset();
  columns_->t.setZero();
}

}  // namespace saltus
