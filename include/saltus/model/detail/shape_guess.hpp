// Shape guesses: why the shape of an output is a guess, asked for when the shapes do not fit.
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "saltus/base/error.hpp"

namespace saltus::detail {

/// While one exists, a shape rule that calls a function of the user throws a ShapeGuess where it
/// would have to guess, because the function threw each time.
class RefuseGuesses {
 public:
  RefuseGuesses() : before_(active_) { active_ = true; }
  ~RefuseGuesses() { active_ = before_; }
  RefuseGuesses(const RefuseGuesses&) = delete;
  RefuseGuesses& operator=(const RefuseGuesses&) = delete;
  static bool active() { return active_; }

 private:
  inline static thread_local bool active_ = false;
  bool before_;
};

/// Says which function threw, and why it was called; `cause` is what it threw.
class ShapeGuess : public ModelError {
 public:
  ShapeGuess(const std::string& message, std::exception_ptr cause) : ModelError(message) {
    explain({}, std::move(cause));
  }
};

/// Runs `ask`, which may throw a ShapeGuess, and adds that to the error. Returns whether it did.
template <class Ask>
bool explain_by_guess(ModelError& error, const Ask& ask) {
  const RefuseGuesses refuse;
  try {
    ask();
  } catch (const ShapeGuess& guess) {
    error.explain(text(". ", guess.what()), guess.cause());
    return true;
  } catch (const Interruption&) {
    throw;
  } catch (const std::exception&) {  // another rule, whose operands do not fit
  }
  return false;
}

}  // namespace saltus::detail
