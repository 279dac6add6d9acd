// TangentTrajectory: the derivatives of a run at every time, as polynomials.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "saltus/simulation/detail/tangent_columns.hpp"
#include "saltus/simulation/detail/trajectory.hpp"
#include "saltus/simulation/detail/variation.hpp"

namespace saltus {

class RestingStates;

/// The polynomials by which the tangents were solved, step by step, and what is constant between two
/// instants: the derivatives of the discrete states and of the held signals, those of the time of the
/// last instant, the states at rest. It is empty, and uses no memory, unless the user asked for dense
/// output and for derivatives.
///
/// That of a run by islands has parts, one for each island, and no polynomials of its own.
class TangentTrajectory {
 public:
  /// All that the derivatives of signals at (t, x) follow from.
  struct Moment {
    TangentColumns columns;     ///< at a time that moves by `columns.t`
    const List<char>* rests;    ///< of each state: whether it is at rest
    const TangentSizes* sizes;  ///< as the run knew them
  };

  /// The derivatives of an island, and the number in all of each of its columns.
  struct Part {
    std::shared_ptr<const TangentTrajectory> of;
    std::vector<Index> columns;
  };
  static TangentTrajectory of_parts(std::vector<Part> parts);
  const std::vector<Part>& parts() const noexcept { return parts_; }

  bool empty() const noexcept { return held_.empty() && parts_.empty(); }
  /// At a time within the run.
  Moment at(double t, Side side) const;

  // --- for the engine --------------------------------------------------------------------------
  /// The derivatives with which the run begins, or goes on after its results were taken, at t [s].
  void open(double t, const TangentColumns& at, const RestingStates& resting,
            const TangentSizes& sizes);
  /// An instant is over.
  void instant(const TangentSizes& sizes) { stale_ = true, keep(sizes); }
  /// Adds a step; without pieces the states keep their derivatives.
  void add(double from, double to, const std::vector<Variation::Piece>& pieces,
           const TangentColumns& at, const RestingStates& resting, const TangentSizes& sizes);
  /// Sets the present end; for a run that failed in the middle of an instant, that of the last step.
  void close(double t, const TangentColumns& at, const RestingStates& resting,
             const TangentSizes& sizes, bool whole);

 private:
  struct Held {
    TangentColumns columns;  // x: empty
    List<char> rests;
  };
  struct Piece {
    Variation::Piece s;  // with one matrix: constant
    std::size_t held = 0, sizes_at_begin = 0, sizes = 0;
  };
  std::size_t hold(const TangentColumns& at, const RestingStates& resting);
  std::size_t keep(const TangentSizes& sizes);
  Piece constant(double t, const TangentColumns& at, const RestingStates& resting,
                 const TangentSizes& sizes);
  const Piece& piece(double t, Side side) const;

  std::vector<Piece> pieces_;
  std::vector<Held> held_;
  std::vector<TangentSizes> sizes_;
  std::vector<Part> parts_;
  Piece first_, last_;
  bool stale_ = true;
};

}  // namespace saltus
