// Rows: the rows of a step.
#include "saltus/simulation/detail/rows.hpp"

#include "saltus/simulation/detail/tangents.hpp"

namespace saltus {

void Recorder::differentiate(double t, const double* x) { tangents_->record(t, x); }
void Recorder::drop_tangents() { tangents_->drop(); }

void Rows::begin() {
  next_ = 0;
  renew();
}

void Rows::renew() {
  recorder_.reset();
  if (!machine_->plan().taps.empty())
    recorder_.emplace(*machine_, *results_, options_->event_rows ? nullptr : &options_->save_at,
                      tangents_);
}

void Rows::record_rows(double from, double t, int jump, Integration& integration) {
  const auto& wanted = options_->save_at;
  while (next_ < wanted.size() && wanted[next_] < from) ++next_;
  for (; next_ < wanted.size() && wanted[next_] <= t; ++next_) {
    const bool inside = integration.started() && wanted[next_] < t;
    record(wanted[next_], jump,
           (inside ? integration.at(wanted[next_]) : integration.state()).data());
  }
  if (options_->save_steps.value_or(wanted.empty())) record(t, jump, integration.state().data());
}

}  // namespace saltus
