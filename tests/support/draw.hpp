// Random numbers of a test, by a seed.
#pragma once

#include <random>

namespace support {

class Draw {
 public:
  explicit Draw(unsigned seed) : numbers_(seed) {}

  /// A number between `from` and `to`, all equally likely.
  double operator()(double from, double to) {
    return std::uniform_real_distribution(from, to)(numbers_);
  }

 private:
  std::mt19937 numbers_;
};

}  // namespace support
