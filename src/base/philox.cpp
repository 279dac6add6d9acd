// Random numbers by a counter.
#include "saltus/base/philox.hpp"

#include <bit>
#include <cmath>
#include <numbers>

namespace saltus::detail {

namespace {

constexpr std::uint32_t low(std::uint64_t wide) { return static_cast<std::uint32_t>(wide); }
constexpr std::uint32_t high(std::uint64_t wide) { return static_cast<std::uint32_t>(wide >> 32); }

/// 53 bits of two words, between 0 and 1 without either.
double fraction(std::uint32_t first, std::uint32_t second) {
  const std::uint64_t bits = (std::uint64_t{first} << 21) ^ (std::uint64_t{second} >> 11);
  return (static_cast<double>(bits) + 0.5) * 0x1p-53;
}

}  // namespace

Words philox(Words c, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53} * c[0], b = std::uint64_t{0xCD9E8D57} * c[2];
    c = {high(b) ^ c[1] ^ key[0], low(b), high(a) ^ c[3] ^ key[1], low(a)};
    key = {key[0] + 0x9E3779B9, key[1] + 0xBB67AE85};
  }
  return c;
}

Words random_words(double seed, double tick, std::int64_t entry) {
  const auto key = std::bit_cast<std::uint64_t>(seed + 0.0);  // -0.0 is the seed 0.0
  const auto k = static_cast<std::uint64_t>(static_cast<std::int64_t>(tick));
  const auto i = static_cast<std::uint64_t>(entry);
  return philox({low(k), high(k), low(i), high(i)}, {low(key), high(key)});
}

double uniform(const Words& words) { return fraction(words[0], words[1]); }

double normal(const Words& words) {
  const double radius = std::sqrt(-2.0 * std::log(fraction(words[0], words[1])));
  return radius * std::cos(2.0 * std::numbers::pi * fraction(words[2], words[3]));
}

}  // namespace saltus::detail
