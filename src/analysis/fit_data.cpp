// The data of one experiment.
#include "fit_data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "places.hpp"
#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "saltus/simulation/evaluate.hpp"

namespace saltus {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Finds the names of one experiment, and checks its data.
class Binding {
 public:
  Binding(const System& system, const Experiment& experiment, const FitOptions& options,
          BoundExperiment& out)
      : system_(system), experiment_(experiment), options_(options), out_(out) {}

  void bind() {
    require_times();
    out_.span = span();
    require_within();
    for (const NamedValue& value : experiment_.values) set(value);
    if (out_.context.time() != out_.span.begin)
      out_.context = out_.context.with_time(out_.span.begin);
    for (const MeasuredSignal& signal : experiment_.signals) add_signal(signal);
    for (const MeasuredEvents& events : experiment_.events) add_events(events);
    require_names();
  }

 private:
  template <class... Pieces>
  [[noreturn]] void refuse(const Pieces&... pieces) const {
    throw ModelError(text(out_.where, ": ", pieces...));
  }

  void require_times() {
    if (experiment_.signals.empty() && experiment_.events.empty())
      refuse("the data have no signal and no event");
    for (const double t : experiment_.time)
      if (!std::isfinite(t)) refuse("time: expected finite times [s], found ", t);
    for (const MeasuredEvents& events : experiment_.events) require_increasing(events);
    out_.times = experiment_.time;
    std::ranges::sort(out_.times);
    out_.times.erase(std::unique(out_.times.begin(), out_.times.end()), out_.times.end());
  }

  void require_increasing(const MeasuredEvents& events) const {
    double last = -std::numeric_limits<double>::infinity();
    for (const double t : events.times) {
      if (std::isnan(t)) continue;
      if (std::isinf(t))
        refuse("'", events.name, "': found an infinite time; write NaN for a missing one");
      if (t < last) refuse("'", events.name, "': expected increasing times; sort them");
      last = t;
    }
  }

  /// [s] The last time of an event that was seen; the begin if there is none.
  double last_event(double begin) const {
    double last = begin;
    for (const MeasuredEvents& events : experiment_.events)
      for (const double t : events.times)
        if (t > last) last = t;
    return last;
  }

  /// The span of the run: as it is given, or as long as the data need it. An event of the run may be
  /// later than the measured one: the span is then twice as long.
  TimeSpan span() const {
    const auto given = experiment_.t_span ? experiment_.t_span : options_.t_span;
    if (given) {
      if (!(given->end >= given->begin) || !std::isfinite(given->end - given->begin))
        refuse("t_span: expected a begin and a later end, found ", given->begin, " s and ",
               given->end, " s");
      return *given;
    }
    const double begin = out_.context.time();
    const double last = out_.times.empty() ? begin : out_.times.back();
    return {begin, std::max({begin, last, 2.0 * last_event(begin) - begin})};
  }

  void require_within() const {
    std::vector<double> all = experiment_.time;
    for (const MeasuredEvents& events : experiment_.events)
      all.insert(all.end(), events.times.begin(), events.times.end());
    for (const double t : all)
      if (t < out_.span.begin || t > out_.span.end)
        refuse("a value at t = ", t, " s is outside of the run, which goes from ", out_.span.begin,
               " s to ", out_.span.end, " s; change the data, t_span or the time of the context");
  }

  void set(const NamedValue& value) const {
    const ContextEntry entry = number_in(out_.where + ": values", out_.context, value.name);
    out_.context = with_number(out_.context, entry, value.value, value.name);
  }

  /// The name without its entry "[1]" or "[0,1]", if the whole is no output.
  std::string base_of(const MeasuredSignal& signal) const {
    const std::vector<std::string> outputs = system_.output_names();
    const bool known =
        !signal.port.system && std::ranges::find(outputs, signal.name) != outputs.end();
    const auto open = signal.name.rfind('[');
    if (known || open == std::string::npos || !signal.name.ends_with(']')) return signal.name;
    return signal.name.substr(0, open);
  }

  OutputPort port_of(const MeasuredSignal& signal, const std::string& base) const {
    if (signal.port.system) return signal.port;
    const std::vector<std::string> outputs = system_.output_names();
    if (std::ranges::find(outputs, base) == outputs.end())
      refuse("the data name an unknown signal '", signal.name, "'", known_names(base, outputs),
             "; an output of a block needs its port");
    return system_.output(base);
  }

  void add_signal(const MeasuredSignal& signal) {
    const std::string base = base_of(signal);
    const OutputPort port = port_of(signal, base);
    const auto same = std::ranges::find(out_.recorded, base, &RecordedSignals::value_type::first);
    if (same == out_.recorded.end())
      out_.recorded.push_back({base, port});
    else if (same->second.system != port.system || same->second.index != port.index)
      refuse("'", base, "' names two outputs; give one of them another name");
    const Shape shape = evaluate_output(system_, port, out_.context).shape;
    const bool single = base != signal.name;
    const Index first = single ? entry_of(signal.name, base, shape) : 0;
    const Index wanted = single ? 1 : shape.size;
    const auto rows = static_cast<Index>(experiment_.time.size());
    if (signal.values.rows() != rows || signal.values.cols() != wanted)
      refuse("'", signal.name, "': expected ", wanted, " numbers for each of ", rows,
             " times, found ", signal.values.rows(), " rows of ", signal.values.cols(),
             "; an entry of a vector is called 'name[0]', of a matrix 'name[0,0]'");
    add_values(signal, base, first, sigma_of(signal));
  }

  Index entry_of(const std::string& name, const std::string& base, const Shape& shape) const {
    for (Index i = 0; i < shape.size; ++i)
      if (base + entry_place(shape, i) == name) return i;
    if (shape.size == 1 && name == base + "[0]") return 0;
    refuse("'", name, "': the signal has ", shape.size, " entries, the first is ", base,
           entry_place(shape, 0));
  }

  /// The standard deviations, in the shape of the values.
  MatrixXd sigma_of(const MeasuredSignal& signal) {
    const Index rows = signal.values.rows(), columns = signal.values.cols();
    const MatrixXd& given = signal.sigma;
    if (given.size() == 0) {
      if (!options_.sigma) out_.without_sigma.push_back(signal.name);
      return MatrixXd::Constant(rows, columns, options_.sigma.value_or(1.0));
    }
    if (given.size() == 1) return MatrixXd::Constant(rows, columns, given(0, 0));
    if (given.rows() == rows && given.cols() == columns) return given;
    if (given.rows() == rows && given.cols() == 1) return given.replicate(1, columns);
    refuse("sigma of '", signal.name,
           "': expected a number, one for each time, or the shape of the "
           "data, found ",
           given.rows(), " rows of ", given.cols());
  }

  void require_deviation(const std::string& name, double sigma) const {
    if (std::isfinite(sigma) && sigma > 0.0) return;
    refuse("sigma of '", name, "': expected standard deviations above 0, found ", sigma,
           "; a value that should not count is NaN in the data");
  }

  void add_values(const MeasuredSignal& signal, const std::string& base, Index first,
                  const MatrixXd& sigma) {
    Observed seen{.name = signal.name, .recorded = base, .time = {}, .data = {}, .sigma = {}};
    std::vector<double> time, data, deviation;
    for (Index i = 0; i < signal.values.rows(); ++i)
      for (Index k = 0; k < signal.values.cols(); ++k) {
        const double value = signal.values(i, k), t = nth(experiment_.time, i);
        if (std::isinf(value))
          refuse("'", signal.name, "' is infinite at t = ", t, " s; write NaN for a missing value");
        if (std::isnan(value)) {
          ++out_.missing;
          continue;
        }
        require_deviation(signal.name, sigma(i, k));
        time.push_back(t), data.push_back(value), deviation.push_back(sigma(i, k));
        seen.row.push_back(std::ranges::lower_bound(out_.times, t) - out_.times.begin());
        seen.entry.push_back(first + k);
      }
    add(std::move(seen), time, data, deviation);
  }

  void add(Observed seen, const std::vector<double>& time, const std::vector<double>& data,
           const std::vector<double>& deviation) {
    const auto vector = [](const std::vector<double>& of) {
      return VectorXd(Eigen::Map<const VectorXd>(of.data(), static_cast<Index>(of.size())));
    };
    seen.time = vector(time), seen.data = vector(data), seen.sigma = vector(deviation);
    out_.observed.push_back(std::move(seen));
  }

  void add_events(const MeasuredEvents& events) {
    Observed seen{.name = events.name,
                  .is_event = true,
                  .kind = events.kind,
                  .time = {},
                  .data = {},
                  .sigma = {},
                  .end = out_.span.end};
    if (events.sigma.empty()) out_.without_sigma.push_back(events.name);
    if (events.sigma.size() > 1 && events.sigma.size() != events.times.size())
      refuse("sigma of '", events.name, "': expected a number, or one for each of ",
             events.times.size(), " times, found ", events.sigma.size());
    std::vector<double> data, deviation;
    for (std::size_t k = 0; k < events.times.size(); ++k) {
      if (std::isnan(events.times[k])) {
        ++out_.missing;
        continue;
      }
      const std::size_t which = events.sigma.size() == 1 ? 0 : k;
      const double sigma = events.sigma.empty() ? 1.0 : events.sigma[which];
      require_deviation(events.name, sigma);
      data.push_back(events.times[k]), deviation.push_back(sigma);
      seen.entry.push_back(static_cast<Index>(k));
    }
    add(std::move(seen), data, data, deviation);
  }

  void require_names() const {
    for (auto one = out_.observed.begin(); one != out_.observed.end(); ++one)
      for (auto other = out_.observed.begin(); other != one; ++other)
        if (other->name == one->name) refuse("the data have '", one->name, "' twice");
  }

  const System& system_;
  const Experiment& experiment_;
  const FitOptions& options_;
  BoundExperiment& out_;
};

}  // namespace

BoundExperiment bound_experiment(const System& system, const Experiment& experiment,
                                 const std::string& name, const Context& context,
                                 const FitOptions& options) {
  BoundExperiment bound;
  bound.where = "fit: " + name, bound.name = name;
  bound.context = experiment.context.value_or(context);
  Binding(system, experiment, options, bound).bind();
  return bound;
}

}  // namespace saltus
