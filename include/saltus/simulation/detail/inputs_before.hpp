// InputsBefore: the inputs before an instant, moved along the derivatives by parameters.
#pragma once

#include <algorithm>

#include "saltus/plan/detail/machine.hpp"
#include "saltus/simulation/detail/tangent_flow.hpp"
#include "saltus/simulation/detail/tangent_probe.hpp"

namespace saltus {

/// A reset map that reads its inputs as they were before the instant has the derivatives that they had
/// there.
class InputsBefore {
 public:
  /// The instant begins: the values of the machine are those before it. The held signals stay as they
  /// are, and the moving ones follow them.
  void keep(const Machine& machine, const TangentColumns& columns, double t, TangentProbe& probe) {
    x_ = machine.x, z_ = machine.z, y_ = machine.y;
    columns_ = columns;
    for (Index k = 0; k < columns.size(); ++k) {
      const auto read = [&](Machine& moved, double shift, double* out) {
        moved.evaluate_moving(t + shift * columns.t[k], moved.x.data());
        std::copy_n(moved.y.data(), moved.y.size(), out);
      };
      probe.derivative(x_.data(), columns.column(k), y_.size(), read, columns_.y.col(k).data());
    }
  }

  /// The inputs of a leaf, moved by `shift` along column k; a view that lasts until the next call.
  Inputs moved(const Machine& probe, int leaf, Index k, double shift) {
    moved_x_ = x_ + shift * columns_.x.col(k);
    moved_z_ = z_ + shift * columns_.z.col(k);
    moved_y_ = y_ + shift * columns_.y.col(k);
    bases_ = {moved_x_.data(), moved_z_.data(), probe.p.data(), moved_y_.data()};
    const List<Place>& places = probe.plan().leaf(leaf).input_places;
    return {places.data(), static_cast<int>(places.size()), &bases_};
  }

 private:
  Eigen::VectorXd x_, z_, y_, moved_x_, moved_z_, moved_y_;
  TangentColumns columns_;
  Bases bases_ = {};
};

}  // namespace saltus
