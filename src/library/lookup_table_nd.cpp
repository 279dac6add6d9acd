// y = the value of a table at (u_0, u_1, ...), linear along each input in each cell, elementwise.
#include "saltus/library/lookup_table_nd.hpp"

#include "saltus/library/detail/axis.hpp"
#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/pieces.hpp"

namespace saltus {

namespace {

/// One axis, and how far apart two neighbours along it are in the table.
struct Along {
  detail::Axis axis;
  RelationIndex even;
  Index stride;
};

/// The value at entry i of the inputs: along axis k the two ends of the cell, each found so along
/// the axes behind it.
double value(const std::vector<Along>& all, const At& at, const double* table, Index i,
             std::size_t k) {
  if (k == all.size()) return *table;
  const Along& along = all[k];
  const VectorView u = at.u[static_cast<int>(k)];
  const auto [first, part] =
      along.axis.place(detail::entry(u, i), at.relation(along.even, u.size() == 1 ? 0 : i));
  const double* from = table + first * along.stride;
  return (1.0 - part) * value(all, at, from, i, k + 1) +
         part * value(all, at, from + along.stride, i, k + 1);
}

/// Refuses axes that do not increase, and a table of another size.
void require_table(const std::string& block, const std::vector<Eigen::VectorXd>& axes, Index found,
                   std::string_view extrapolation) {
  detail::require_count(block, "axis", static_cast<int>(axes.size()), 1);
  Index expected = 1;
  for (const Eigen::VectorXd& axis : axes) {
    detail::Pieces(block, {axis.begin(), axis.end()}, "linear", extrapolation);
    expected *= axis.size();
  }
  detail::insist(found == expected, block, "output_table has ", found, " values; expected ",
                 expected, ", the product of the numbers of points of the axes");
}

}  // namespace

LookupTableNd::LookupTableNd(std::string name, const std::vector<Eigen::VectorXd>& input_axes,
                             const Eigen::VectorXd& output_table, const Options& options)
    : LeafSystem(std::move(name)) {
  require_table(this->name(), input_axes, output_table.size(), options.extrapolation);
  const ParameterIndex values = declare_dynamic_parameter("output_table", output_table);
  std::vector<Along> all;
  Index stride = output_table.size();
  for (const Eigen::VectorXd& points : input_axes) {
    const detail::Axis axis(points, options.extrapolation);
    const int k = declare_input_port();
    const auto guard = [knots = axis.knots, k](const At& at, VectorRef out) {
      for (Index i = 0; i < out.size(); ++i) out[i] = knots.guard(detail::entry(at.u[k], i));
    };
    const RelationIndex even = declare_relation({.name = text("even_", k),
                                                 .guard = guard,
                                                 .size = std::nullopt,
                                                 .reads = Reads::inputs,
                                                 .inputs = std::vector{k}});
    stride /= points.size();
    all.push_back({axis, even, stride});
  }
  declare_output_port({.name = "out",
                       .calc =
                           [all, values](const At& at, VectorRef out) {
                             const double* table = at.parameter(values).data();
                             for (Index i = 0; i < out.size(); ++i)
                               out[i] = value(all, at, table, i, 0);
                           },
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry});
}

}  // namespace saltus
