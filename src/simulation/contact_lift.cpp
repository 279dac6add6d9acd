// Contacts: how far the free flow leads off a surface, and whether the surface or its force moves.
#include <algorithm>
#include <cmath>

#include "saltus/simulation/detail/contact.hpp"
#include "saltus/simulation/detail/thresholds.hpp"

namespace saltus {

/// The guard after a time d on the free flow f_ at (t, x). It is positive off the surface.
double Contacts::guard_after(const SurfaceContact& contact, double t, const double* x, double d) {
  const VectorView now(x, f_.size());
  trial_ = now + d * f_;
  machine_->flow(t + d, trial_.data(), f1_.data());
  trial_ = now + 0.5 * d * (f_ + f1_);
  machine_->guards_at(t + d, trial_.data(), g_.data());
  return -contact.pressed * g_[contact.slot];
}

double Contacts::lift(const SurfaceContact& contact, double t, const double* x) {
  free(contact, true);
  machine_->guards_at(t, x, g_.data());
  const double g = -contact.pressed * g_[contact.slot], d = contact.look_ahead;
  machine_->flow(t, x, f_.data());
  const double far = guard_after(contact, t, x, d);
  const double lifted =
      contact.opaque ? far : 8.0 * (guard_after(contact, t, x, 0.5 * d) - g) - (far - g);
  free(contact, false);
  return lifted;
}

void Contacts::choose_look_ahead(SurfaceContact& contact, double t, const double* x,
                                 double longest) {
  using namespace thresholds;
  const double brief = std::max(brief_of_run * longest, brief_roundings * eps * std::abs(t));
  free(contact, true);
  machine_->flow(t, x, f_.data());
  trial_ = VectorView(x, f_.size()) + brief * f_;
  machine_->flow(t + brief, trial_.data(), f1_.data());
  free(contact, false);
  // A movement of 1e9 eps of a state has nine digits, less its rounding, which is enough to know
  // its sign. The time is as small as the square root of that movement.
  double d = look_ahead_of_run * longest;
  for (const Index i : contact.states) {
    const double bend = std::abs(f1_[i] - f_[i]) / brief, size = std::abs(x[i]) + absolute_[i];
    if (bend > 0.0) d = std::min(d, std::sqrt(visible_lift * size / bend));
  }
  contact.look_ahead = std::max(d, brief);
}

bool Contacts::moves(const SurfaceContact& contact, double t, const double* x, double longest) {
  using namespace thresholds;
  const double lifted = lift(contact, t, x);
  machine_->flow(t, x, slow_.data());
  double d = contact.look_ahead;
  for (int probe = 0; probe < probes && d <= longest; ++probe, d *= probe_growth) {
    stood_ = later_ = VectorView(x, slow_.size()) + d * slow_;
    settle_on_surface(contact, t + d, later_.data());
    for (const Index i : contact.states) {
      if (std::abs(later_[i] - stood_[i]) >
          moved_roundings * eps * (std::abs(stood_[i]) + absolute_[i]))
        return true;
    }
    const double change = std::abs(lift(contact, t + d, later_.data()) - lifted);
    if (!contact.opaque && change > changed_force * std::abs(lifted)) return true;
  }
  return false;
}

}  // namespace saltus
