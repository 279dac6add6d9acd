// Errors, and the small text helper their messages are built with.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace saltus {

struct Results;  // simulation/results.hpp

/// Base of every error that Saltus itself throws. An exception that a user's function throws is
/// rethrown unchanged.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The model, the context or an option is wrong. It is thrown before the run starts.
class ModelError : public Error {
 public:
  using Error::Error;

  const char* what() const noexcept override { return longer_ ? longer_->c_str() : Error::what(); }
  /// What a function of the user threw, if that is behind this error; otherwise null.
  const std::exception_ptr& cause() const noexcept { return cause_; }
  /// Adds a sentence to the message, and the exception behind this error.
  void explain(const std::string& more, std::exception_ptr cause);

 private:
  std::shared_ptr<const std::string> longer_;  // shared: a copy does not throw
  std::exception_ptr cause_;
};

/// The run could not continue. Carries the time reached, the block path and the partial results.
class SimulationError : public Error {
 public:
  SimulationError(const std::string& message, double time, std::string block = {})
      : Error(message), time_(time), block_(std::move(block)) {}

  /// [s] The time that the run had reached.
  double time() const noexcept { return time_; }
  /// Path of the block at fault, or empty.
  const std::string& block() const noexcept { return block_; }
  /// Everything computed until then.
  const std::shared_ptr<const Results>& results() const noexcept { return results_; }
  void attach(std::shared_ptr<const Results> results) { results_ = std::move(results); }

 private:
  double time_;
  std::string block_;
  std::shared_ptr<const Results> results_;
};

/// A second base of every exception that is thrown to end the run, such as Ctrl-C in a user's
/// function. Code that only tries a function out must not catch it.
class Interruption {
 public:
  virtual ~Interruption() = default;
};

namespace detail {

inline void append(std::string& out, std::string_view piece) { out += piece; }
template <std::same_as<bool> Truth>  // a template: a string literal would convert to bool
void append(std::string& out, Truth piece) {
  out += piece ? "true" : "false";
}

template <class Number>
  requires((std::integral<Number> && !std::same_as<Number, bool>) || std::floating_point<Number>)
void append(std::string& out, Number piece) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), piece).ptr;
  out.append(buffer.data(), end);
}

/// Levenshtein distance, for "did you mean".
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace detail

/// Concatenates its arguments; numbers in their shortest exact form. (g++ 12 has no <format>.)
template <class... Pieces>
std::string text(const Pieces&... pieces) {
  std::string out;
  (detail::append(out, pieces), ...);
  return out;
}

/// "'a', 'b', 'c'", cut after twelve names.
std::string quoted_list(const std::vector<std::string>& names);

/// The end of a message about an unknown name: "; did you mean 'gain'? Known: 'gain', 'floor'".
std::string known_names(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace saltus
