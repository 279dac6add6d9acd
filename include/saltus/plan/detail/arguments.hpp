// Arguments: the values that the functions of the leaves see, at a state that the caller names.
#pragma once

#include <new>
#include <vector>

#include "saltus/plan/detail/calls.hpp"
#include "saltus/plan/detail/memory.hpp"

namespace saltus {

/// The arguments of the functions of a plan on one memory. The continuous state differs from call
/// to call: it is that of the machine, or a state inside a step. So a caller names the state first,
/// with `of`.
class Arguments {
 public:
  explicit Arguments(Memory& memory);
  Arguments(const Arguments&) = delete;  // views point into it
  Arguments& operator=(const Arguments&) = delete;

  /// The arguments at one state; a view that lasts until the next call of `of`.
  class OfState {
   public:
    /// The arguments of one call at t [s]. Only the values that change from call to call are set.
    At& at(const Call& call, double t) const {
      At& at = *call.at;
      at.time = t;
      new (&at.x) VectorView(all_->bases_[0] + call.x, call.size);
      at.mode = all_->memory_->modes[call.leaf];
      return at;
    }
    Values values() const { return Values(all_->bases_); }

   private:
    friend class Arguments;
    explicit OfState(Arguments& all) : all_(&all) {}
    Arguments* all_;
  };
  OfState of(const double* state) {
    bases_[0] = state;
    return OfState(*this);
  }

  /// The views of each leaf, and a view of the whole machine for fused functions: see fuse.hpp.
  std::vector<At>& views() noexcept { return views_; }

 private:
  Memory* memory_;
  Bases bases_;
  Place place_of_z_;  // all of z, for fused functions
  std::vector<At> views_;
  std::vector<const double*> relation_values_;
};

}  // namespace saltus
