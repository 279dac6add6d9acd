// y = the values of a table over the time, from values at increasing times.
#include "saltus/library/data_source.hpp"

#include <algorithm>
#include <memory>

#include "saltus/library/detail/knots.hpp"
#include "saltus/library/detail/schedule.hpp"

namespace saltus {

namespace {

/// Row i is the value at time i. Piece s of the times begins at time s - 1; the outer rows continue
/// beyond the table.
struct TimeTable {
  detail::Knots times;
  Index width;
  ParameterIndex values;
  bool linear, zero;

  Index piece(double t) const { return times.piece(detail::since(t, 0.0)); }

  double value(const At& at, Index row, Index column) const {
    return at.parameter(values)[std::clamp<Index>(row, 0, times.size() - 1) * width + column];
  }
  /// The value of a piece, which is continued beyond its ends.
  double in(const At& at, Index piece, Index column) const {
    const bool outside = piece <= 0 || piece >= times.size();
    if (outside && zero) return 0.0;
    const double a = value(at, piece - 1, column);
    if (outside || !linear) return a;
    const double start = times[piece - 1], length = times[piece] - start;
    return a + (value(at, piece, column) - a) * ((at.time - start) / length);
  }
};

void require_table(const std::string& block, const Eigen::VectorXd& times,
                   const Eigen::MatrixXd& values) {
  detail::require_count(block, "times", static_cast<int>(times.size()), 1);
  detail::insist(times.allFinite(), block, "a time is not finite; expected finite times");
  detail::insist(values.rows() == times.size() && values.cols() > 0, block, "times has ",
                 times.size(), " values, values has ", values.rows(), " rows of ", values.cols(),
                 "; expected a row for each time");
  for (Index i = 1; i < times.size(); ++i) {
    detail::insist(times[i - 1] < times[i], block, "time ", i, " is ", times[i], " s after ",
                   times[i - 1], " s; expected times that increase");
  }
}

}  // namespace

/// A linear table holds whether the number of the piece is even, so a solver step that ends at a
/// time, or an ulp past it, sees one line.
DataSource::DataSource(std::string name, const Eigen::VectorXd& times,
                       const Eigen::MatrixXd& values, const Options& options)
    : LeafSystem(std::move(name)) {
  require_table(this->name(), times, values);
  detail::require_known(this->name(), "interpolation", options.interpolation,
                        {"linear", "zero_order_hold"});
  detail::require_known(this->name(), "extrapolation", options.extrapolation, {"hold", "zero"});
  const Eigen::MatrixXd transposed = values.transpose();
  const Index width = values.cols();
  // Shared, because a table may be large.
  const auto table = std::make_shared<const TimeTable>(TimeTable{
      .times = detail::Knots({times.begin(), times.end()}),
      .width = width,
      .values = declare_dynamic_parameter("values", Eigen::VectorXd(transposed.reshaped())),
      .linear = options.interpolation == "linear",
      .zero = options.extrapolation == "zero"});
  const auto write = [table](const At& at, Index piece, VectorRef out) {
    for (Index i = 0; i < out.size(); ++i) out[i] = table->in(at, piece, i);
  };
  const Shape shape = width == 1 ? Shape::scalar() : Shape::of(width);
  if (table->linear) {
    const RelationIndex even = declare_relation(
        {.name = "even_piece",
         .guard = [table](const At& at) { return table->piece(at.time) % 2 == 0 ? 1.0 : -1.0; },
         .reads = Reads::schedule});
    declare_output_port({.name = "out",
                         .calc =
                             [=](const At& at, VectorRef out) {
                               write(at, table->times.held(at.time, at.relation(even)), out);
                             },
                         .shape = shape,
                         .reads = Reads::time | Reads::relations});
  } else {
    declare_output_port(
        {.name = "out",
         .calc = [=](const At& at, VectorRef out) { write(at, table->piece(at.time), out); },
         .shape = shape,
         .reads = Reads::schedule});
  }
  declare_time_event({.name = "time", .times = std::vector<double>(times.begin(), times.end())});
}

}  // namespace saltus
