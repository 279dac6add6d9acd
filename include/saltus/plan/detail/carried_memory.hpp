// CarriedMemory: the memory of a run in which surfaces may carry blocks.
#pragma once

#include <Eigen/Core>

#include "saltus/plan/detail/memory.hpp"

namespace saltus {

/// Moves the states of blocks that rest on a moving surface with that surface.
class Carrier {
 public:
  virtual ~Carrier() = default;
  /// Sets the states it carries, from t and all other states.
  virtual void carry(double t, double* x) = 0;
  /// The derivatives of these states with their surface, for the control of the step size.
  virtual void rates(double t, const double* x, double* xdot) = 0;
  /// Replaces the guards of the carried blocks by guards that are below zero while a block presses
  /// on its surface.
  virtual void lift(double t, const double* x, double* g) = 0;
};

/// The memory of a run, and who moves the states that rest on a moving surface, if there are any.
class CarriedMemory : public Memory {
 public:
  explicit CarriedMemory(std::shared_ptr<const Plan> plan) : Memory(std::move(plan)) {}

  /// Sets the carrier, which keeps blocks on their moving surfaces; null while no block is carried.
  void carry_by(Carrier* carrier) noexcept { carrier_ = carrier; }
  bool carries() const noexcept { return carrier_ != nullptr; }
  /// Moves the carried blocks to the place of their surfaces at t.
  void put_carried(double t, double* state) {
    if (carrier_ != nullptr) carrier_->carry(t, state);
  }

  /// The state with all carried entries moved to their surface.
  const double* carried(double t, const double* state) {
    if (carrier_ == nullptr) return state;
    carried_x_ = VectorView(state, x.size());
    carrier_->carry(t, carried_x_.data());
    return carried_x_.data();
  }

 protected:
  Carrier* carrier_ = nullptr;  // while a block rests on a surface that moves

 private:
  Eigen::VectorXd carried_x_;
};

}  // namespace saltus
