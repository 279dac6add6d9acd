// The residuals of a search for an operating point.
#include "trim_problem.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/analysis/detail/thresholds.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

namespace {

LinearInput& input_called(std::vector<LinearInput>& inputs, const std::string& name) {
  const auto found = std::ranges::find(inputs, name, &LinearInput::name);
  if (found != inputs.end()) return *found;
  return inputs.emplace_back(name, 0.0);
}

bool equal(const std::vector<LinearInput>& a, const std::vector<LinearInput>& b) {
  return std::ranges::equal(a, b, [](const LinearInput& one, const LinearInput& other) {
    return one.name == other.name && one.value == other.value;
  });
}

Index column_of(const AnalysisPlace& place, const Linearization& found) {
  if (place.is_state()) return place.entry->first;
  const auto at = std::ranges::find(found.inputs, place.name);
  return std::ssize(found.states) + (at - found.inputs.begin());
}

/// The derivatives by all states and inputs in one row.
Eigen::RowVectorXd row_of(const TrimTarget& target, const Linearization& found) {
  const Eigen::MatrixXd& by_x = target.is_rate ? found.A : found.C;
  const Eigen::MatrixXd& by_u = target.is_rate ? found.B : found.D;
  Eigen::RowVectorXd row(by_x.cols() + by_u.cols());
  row << by_x.row(target.index), by_u.row(target.index);
  return row;
}

}  // namespace

TrimSetting TrimSetting::put(const std::vector<AnalysisPlace>& places,
                             const Eigen::VectorXd& values) const {
  TrimSetting next = *this;
  for (Index k = 0; k < values.size(); ++k) {
    const AnalysisPlace& place = nth(places, k);
    if (place.entry) {
      write_entry(next.context, *place.entry, {&values[k], 1}, place.name);
    } else if (!place.of_vector) {
      input_called(next.inputs, place.name) = LinearInput(place.name, values[k]);
    } else {
      (*input_called(next.inputs, std::string(split_index(place.name).first))
            .value)[*place.of_vector] = values[k];
    }
  }
  return next;
}

std::optional<TrimReader::Made>& TrimReader::made(const TrimSetting& setting, bool one_sided) {
  std::optional<Made>& known = made_[one_sided ? 1 : 0];
  if (known && equal(known->inputs, setting.inputs)) return known;
  LinearizeOptions options{.inputs = setting.inputs,
                           .outputs = signals_,
                           .one_sided = one_sided,
                           .refinement = refinement_};
  for (const std::string& name : parameters_) options.inputs.emplace_back(name);
  known.reset();
  known.emplace(setting.inputs, Linearizer(*system_, std::move(options)));
  return known;
}

Linearization TrimReader::at(const TrimSetting& setting, bool one_sided) {
  return made(setting, one_sided)->linearizer.at(setting.context);
}

TrimPoint TrimProblem::at(const Eigen::VectorXd& values) {
  ++evaluations;
  TrimPoint point{values, {}, {}, {}, reader.at(setting.put(places, values))};
  const Linearization& found = point.matrices;
  const auto m = static_cast<Index>(targets.size());
  point.residual.resize(m), point.rounding.resize(m), point.jacobian.resize(m, values.size());
  Eigen::VectorXd sizes(found.x.size() + found.u.size());
  sizes << found.x.cwiseAbs(), found.u.cwiseAbs();
  for (Index i = 0; i < m; ++i) {
    const TrimTarget& target = nth(targets, i);
    const Eigen::RowVectorXd row = row_of(target, found);
    for (Index k = 0; k < values.size(); ++k)
      point.jacobian(i, k) = row[column_of(nth(places, k), found)];
    const Eigen::VectorXd& of = target.is_rate ? found.xdot : found.y;
    point.residual[i] = of[target.index] - target.value;
    point.rounding[i] = roundings_of_term * unit_rounding * row.cwiseAbs().dot(sizes);
    if (!std::isfinite(point.residual[i]))
      throw ModelError(text("t = ", found.time, " s: '", target.name, "' is ", point.residual[i],
                            "; expected a finite number"));
  }
  return point;
}

std::optional<TrimPoint> TrimProblem::tried(const Eigen::VectorXd& values) {
  try {
    return at(values);
  } catch (const Error& error) {
    failed = error.what();
    return {};
  }
}

}  // namespace saltus
