// y = the value of a table at (u_0, u_1), bilinear in each cell, elementwise.
#include "saltus/library/lookup_table_2d.hpp"

#include "saltus/library/detail/axis.hpp"
#include "saltus/library/detail/elementwise.hpp"
#include "saltus/library/detail/pieces.hpp"
#include "saltus/library/lti_system.hpp"

namespace saltus {

namespace {

void require_cells(const std::string& block, const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                   const Eigen::MatrixXd& table, std::string_view extrapolation) {
  for (const Eigen::VectorXd* axis : {&x, &y})
    detail::Pieces(block, {axis->begin(), axis->end()}, "linear", extrapolation);
  detail::insist(table.rows() == x.size() && table.cols() == y.size(), block, "output_table is ",
                 table.rows(), " x ", table.cols(), "; expected ", x.size(), " x ", y.size(),
                 ", as input_x and input_y say");
}

}  // namespace

LookupTable2d::LookupTable2d(std::string name, const Eigen::VectorXd& input_x,
                             const Eigen::VectorXd& input_y, const Eigen::MatrixXd& output_table,
                             const Options& options)
    : LeafSystem(std::move(name)) {
  require_cells(this->name(), input_x, input_y, output_table, options.extrapolation);
  const detail::Axis x(input_x, options.extrapolation), y(input_y, options.extrapolation);
  const ParameterIndex values =
      declare_dynamic_parameter("output_table", detail::by_rows(output_table));
  const auto axis = [this](const char* relation, const detail::Axis& along) {
    const int k = declare_input_port();
    const auto guard = [knots = along.knots, k](const At& at, VectorRef out) {
      for (Index i = 0; i < out.size(); ++i) out[i] = knots.guard(detail::entry(at.u[k], i));
    };
    return declare_relation({.name = relation,
                             .guard = guard,
                             .size = std::nullopt,
                             .reads = Reads::inputs,
                             .inputs = std::vector{k}});
  };
  const RelationIndex even_x = axis("even_x", x), even_y = axis("even_y", y);
  const auto bilinear = [=, columns = input_y.size()](const At& at, VectorRef out) {
    for (Index i = 0; i < out.size(); ++i) {
      const auto of = [&](int k, const detail::Axis& along, RelationIndex even) {
        const bool one = at.u[k].size() == 1;
        return along.place(detail::entry(at.u[k], i), at.relation(even, one ? 0 : i));
      };
      const auto [r, a] = of(0, x, even_x);
      const auto [c, b] = of(1, y, even_y);
      const double* row = at.parameter(values).data() + r * columns + c;
      const double* next = row + columns;
      out[i] =
          (1.0 - a) * ((1.0 - b) * row[0] + b * row[1]) + a * ((1.0 - b) * next[0] + b * next[1]);
    }
  };
  declare_output_port({.name = "out",
                       .calc = bilinear,
                       .shape = {},
                       .shape_rule = detail::stretch(this->name()),
                       .reads = Reads::inputs | Reads::relations,
                       .entries = entry_by_entry});
}

}  // namespace saltus
