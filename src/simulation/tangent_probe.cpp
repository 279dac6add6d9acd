// TangentProbe: how far a machine is moved, and the derivative of the flow.
#include "saltus/simulation/detail/tangent_probe.hpp"

namespace saltus {

namespace {

/// The two differences of a smooth function agree to some u^2 = 1e-6. Those of a function with a kink
/// or a pole nearby do not.
constexpr double agreement = 1e-4;

/// |d| in units of the size of a value; a value that was zero so far counts as 1.
double in_sizes(double d, double size) {
  return d == 0.0 ? 0.0 : std::abs(d) / (size > 0.0 ? size : 1.0);
}

}  // namespace

void TangentProbe::begin() {
  x_sizes_.setZero(machine_->x.size());
  z_sizes_.setZero(machine_->z.size()), y_sizes_.setZero(machine_->y.size());
  step_ = 0.0;
}

void TangentProbe::note(const double* x, double step) {
  const auto grow = [](Eigen::VectorXd& sizes, const double* now) {
    for (Index i = 0; i < sizes.size(); ++i) sizes[i] = std::max(sizes[i], std::abs(now[i]));
  };
  grow(x_sizes_, x), grow(z_sizes_, machine_->z.data()), grow(y_sizes_, machine_->y.data());
  step_ = std::max(step_, step);
}

/// The shift that moves no value by more than its size; 0 if nothing moves, NaN if
/// the direction is.
double TangentProbe::shift_of(const double* x, const TangentDirection& along) const {
  double most = in_sizes(along.t, step_);  // a short step says nothing: it may end at an event
  const auto look = [&](const double* d, const Eigen::VectorXd& sizes, const double* values) {
    if (d == nullptr) return;
    for (Index i = 0; i < sizes.size(); ++i) {
      const double now = in_sizes(d[i], std::max(std::abs(values[i]), sizes[i]));
      most = std::isnan(now) || std::isnan(most) ? nan : std::max(most, now);
    }
  };
  look(along.x, x_sizes_, x);
  look(along.z, z_sizes_, machine_->z.data());
  look(along.y, y_sizes_, machine_->y.data());
  if (along.parameter >= 0 && !std::isnan(most))
    most = std::max(most, in_sizes(1.0, std::abs(machine_->p[along.parameter])));
  return most > 0.0 ? 1.0 / most : most;
}

bool TangentProbe::agree() const {
  const double size = near_.size() > 0 ? near_.lpNorm<Eigen::Infinity>() : 0.0;
  for (Index i = 0; i < near_.size(); ++i) {
    if (!(std::abs(near_[i] - wide_[i]) <= agreement * std::max(std::abs(near_[i]), 1e-3 * size)))
      return false;
  }
  return true;
}

Machine& TangentProbe::at(const double* x, const TangentDirection& along, double shift) {
  const auto move = [shift](const double* base, const double* d, Eigen::VectorXd& to) {
    for (Index i = 0; i < to.size(); ++i) to[i] = base[i] + (d == nullptr ? 0.0 : shift * d[i]);
  };
  move(x, along.x, probe_.x);
  move(machine_->z.data(), along.z, probe_.z);
  move(machine_->y.data(), along.y, probe_.y);
  move(machine_->p.data(), nullptr, probe_.p);
  if (along.parameter >= 0) probe_.p[along.parameter] += shift;
  if (probe_.modes != machine_->modes) {
    probe_.modes = machine_->modes;
    probe_.select_guards();
  }
  return probe_;
}

void TangentProbe::let_rest(double* xdot) const {
  const RestingStates& resting = machine_->resting();
  if (!resting.any()) return;
  for (Index i = 0; i < x_sizes_.size(); ++i) {
    if (resting.rests(i)) xdot[i] = 0.0;
  }
}

void TangentProbe::flow(double t, const double* x, const TangentDirection& along, double* out) {
  const auto read = [&](Machine& probe, double shift, double* xdot) {
    probe.flow(t + shift * along.t, probe.x.data(), xdot);
  };
  derivative(x, along, x_sizes_.size(), read, out);
  let_rest(out);
}

void TangentProbe::flow(double t, const double* x, double* xdot) {
  Machine& probe = at(x);
  probe.flow(t, probe.x.data(), xdot);
  let_rest(xdot);
}

}  // namespace saltus
