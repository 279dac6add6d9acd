// The arguments of trim, checked, and their names found.
#include "trim_question.hpp"

#include <algorithm>
#include <cmath>

#include "saltus/base/error.hpp"
#include "saltus/base/list.hpp"
#include "saltus/base/model_errors.hpp"
#include "saltus/simulation/evaluate.hpp"
#include "trim_targets.hpp"

namespace saltus {

namespace {

std::string told(const std::exception& error) {
  const std::string message = error.what();
  constexpr std::string_view prefix = "linearize: ";
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

/// Finds the names of trim, and checks them.
class Asking {
 public:
  Asking(std::string where, const System& system, const Context& context,
         const TrimOptions& options)
      : where_(std::move(where)), system_(system), base_(context), options_(options) {}

  TrimQuestion question() {
    require_numbers();
    hold();
    const std::vector<FreeValue> given = options_.free ? *options_.free : all_states();
    for (const FreeValue& free : given)
      places_.push_back(place_of(where_ + ": free", system_, base_, free.name));
    refuse_overlap();
    require_inputs();
    TrimBounds bounds;
    const Eigen::VectorXd start = starts(given, bounds);
    setting_ = setting_.put(places_, start);
    require_motion();
    TrimReader reader = this->reader();
    std::vector<TrimTarget> targets = wanted_rates(where_, system_, base_, options_.derivatives);
    if (!options_.outputs.empty())
      for (TrimTarget& target : wanted_outputs(where_, rows_of(reader), options_.outputs))
        targets.push_back(std::move(target));
    require_equations(targets);
    return {where_,
            {std::move(reader), setting_, places_, std::move(targets)},
            std::move(bounds),
            start,
            options_.tolerance,
            options_.max_nfev};
  }

 private:
  void require_numbers() const {
    if (!(options_.tolerance > 0.0 && options_.tolerance < 1.0))
      throw ModelError(text(where_, ": tolerance: expected a number between 0 and 1, found ",
                            options_.tolerance));
    if (options_.max_nfev && *options_.max_nfev < 1)
      throw ModelError(
          text(where_, ": max_nfev: expected an integer of 1 or more, found ", *options_.max_nfev));
  }

  /// The context with the values of `hold`, and those of open inputs.
  void hold() {
    setting_.context = base_;
    for (const LinearInput& held : options_.hold) {
      if (held.value && !held.value->allFinite())
        throw ModelError(text(where_, ": hold: '", held.name, "': expected finite numbers"));
      if (open_port(system_, held.name) >= 0) {
        fixed_.push_back(place_of(where_ + ": hold", system_, base_, held.name));
        if (held.value) setting_.inputs.push_back(held);
      } else {
        hold_entry(held);
      }
    }
  }

  void hold_entry(const LinearInput& held) {
    try {
      const ContextEntry entry = find_entry(base_.layout(), held.name);
      if (held.value)
        write_entry(setting_.context, entry,
                    {held.value->data(), static_cast<std::size_t>(held.value->size())}, held.name);
      // a vector that is held cannot be free as a whole
      if (entry.size == 1) fixed_.push_back({held.name, entry, -1, {}});
    } catch (const ModelError& error) {
      const std::vector<std::string> ports = system_.input_names();
      throw ModelError(
          text(where_, ": hold: ", error.what(),
               ports.empty() ? std::string() : "; open inputs" + known_names(held.name, ports)));
    }
  }

  std::vector<FreeValue> all_states() const {
    std::vector<FreeValue> all;
    for (const std::string& name : continuous_names(base_)) {
      const AnalysisPlace place = place_of(where_, system_, base_, name);
      if (std::ranges::none_of(fixed_, [&](const auto& held) { return held.same(place); }))
        all.push_back({.name = name});
    }
    return all;
  }

  void refuse_overlap() const {
    for (auto place = places_.begin(); place != places_.end(); ++place) {
      const auto same = [&](const AnalysisPlace& other) { return other.same(*place); };
      if (const auto twice = std::find_if(places_.begin(), place, same); twice != place)
        throw ModelError(
            text(where_, ": free: '", twice->name, "' and '", place->name, "' are one value"));
      if (std::ranges::any_of(fixed_, same))
        throw ModelError(
            text(where_, ": '", place->name, "' is free and held; remove it from one of them"));
    }
  }

  /// The value to which an open input was fixed, or none.
  std::optional<Eigen::VectorXd> fixed_value(int port) const {
    try {
      return evaluate_input(system_, system_.input(port), base_).values;
    } catch (const ModelError&) {
      return {};
    }
  }

  bool is_given(int port, const std::string& name) const {
    const auto frees = [&](const AnalysisPlace& place) { return place.port == port; };
    const auto holds = [&](const LinearInput& input) { return input.name == name; };
    return std::ranges::any_of(places_, frees) || std::ranges::any_of(setting_.inputs, holds);
  }

  /// Each open input has a value: it is free, held or fixed.
  void require_inputs() const {
    const std::vector<std::string> names = system_.input_names();
    for (int port = 0; port < std::ssize(names); ++port) {
      const std::string& name = nth(names, port);
      if (is_given(port, name) || fixed_value(port)) continue;
      throw ModelError(text(where_, ": input '", name, "' of '", system_.name(),
                            "' is open and has no value; expected it in free or as hold = {{\"",
                            name, "\", 0.0}}, or a call of fix_input"));
    }
  }

  Eigen::VectorXd starts(const std::vector<FreeValue>& given, TrimBounds& bounds) const {
    const auto n = static_cast<Index>(given.size());
    Eigen::VectorXd start(n);
    bounds.lower.resize(n), bounds.upper.resize(n);
    for (Index k = 0; k < n; ++k) {
      const FreeValue& free = nth(given, k);
      if (free.log)
        throw ModelError(
            text(where_, ": free: '", free.name, "': log belongs to fit; give bounds"));
      start[k] = *detail::with_start(where_ + ": free", free, value_of(nth(places_, k))).start;
      bounds.lower[k] = free.lower, bounds.upper[k] = free.upper;
    }
    return start;
  }

  double value_of(const AnalysisPlace& place) const {
    if (place.entry) return value_in(setting_.context, *place.entry);
    return place.of_vector ? entry_of_input(place) : scalar_input(place);
  }

  /// The start of an entry of an open input, which has to be held as a vector.
  double entry_of_input(const AnalysisPlace& place) const {
    const std::string_view port = split_index(place.name).first;
    const auto held = std::ranges::find(setting_.inputs, port, &LinearInput::name);
    if (held == setting_.inputs.end() || *place.of_vector >= held->value->size())
      throw ModelError(text(where_, ": free: '", place.name,
                            "': expected the vector of the open input with ", *place.of_vector + 1,
                            " entries or more; give it in hold"));
    return (*held->value)[*place.of_vector];
  }

  double scalar_input(const AnalysisPlace& place) const {
    const auto value = fixed_value(place.port);
    if (value && value->size() != 1)
      throw ModelError(text(where_, ": free: '", place.name,
                            "' is a vector; hold it, and free its entries '", place.name,
                            "[0]', ..."));
    return value ? (*value)[0] : 0.0;
  }

  /// Refuses a context in which a block is at rest: a value written there would release it.
  void require_motion() const {
    const Continuation* saved = base_.continuation();
    if (!saved || !holds_any(*saved)) return;
    try {
      TrimReader(system_, {}, {}, options_.refinement).at({base_, setting_.inputs});
    } catch (const ModelError& error) {
      throw ModelError(text(where_, ": ", told(error)));
    }
  }

  static bool holds_any(const Continuation& saved) {
    return std::ranges::any_of(saved.firings, &Continuation::Firings::holding) ||
           std::ranges::any_of(saved.islands, holds_any);
  }

  TrimReader reader() const {
    std::vector<std::string> parameters;
    for (const AnalysisPlace& place : places_)
      if (place.is_parameter()) parameters.push_back(place.name);
    return {system_, std::move(parameters), wanted_signals(where_, system_, options_.outputs),
            options_.refinement};
  }

  std::vector<std::string> rows_of(TrimReader& reader) const {
    try {
      return reader.at(setting_).outputs;
    } catch (const ModelError& error) {
      throw ModelError(text(where_, ": at the start values: ", told(error)));
    }
  }

  void require_equations(const std::vector<TrimTarget>& targets) const {
    if (!places_.empty() && !targets.empty()) return;
    throw ModelError(text(where_, ": '", system_.name(), "' has ", places_.size(),
                          " free values and ", targets.size(),
                          " equations; expected one of each or more: name what is free, and "
                          "outputs or derivatives"));
  }

  std::string where_;
  const System& system_;
  const Context& base_;
  const TrimOptions& options_;
  TrimSetting setting_;
  std::vector<AnalysisPlace> places_, fixed_;
};

}  // namespace

OperatingPoint TrimQuestion::answer(const Eigen::VectorXd& from) {
  TrimFound found;
  try {
    found = search_point(problem, from, bounds, tolerance, max_nfev);
  } catch (const ModelError& error) {
    throw ModelError(text(where, ": at the start values: ", told(error)));
  }
  return outcome_of(problem, found, bounds);
}

TrimQuestion trim_question(const std::string& where, const System& system, const Context& context,
                           const TrimOptions& options) {
  return Asking(where, system, context, options).question();
}

OperatingPoint trim(const System& system, const Context& context, const TrimOptions& options) {
  TrimQuestion question = trim_question("trim", system, context, options);
  return question.answer(question.start);
}

}  // namespace saltus
