// Random numbers by a counter: the numbers of (seed, tick, entry) are a function of these three, so
// a run that is resumed, or repeated in another thread, has them to the bit.
#pragma once

#include <array>
#include <cstdint>

namespace saltus::detail {

using Words = std::array<std::uint32_t, 4>;

/// Philox 4x32-10: ten rounds that mix a counter of four words with a key of two. J. K. Salmon, M.
/// A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC '11.
Words philox(Words counter, std::array<std::uint32_t, 2> key);

/// The words of a tick and an entry. The seed is any finite number; 1 and 2 are as independent as 1
/// and 1e9.
Words random_words(double seed, double tick, std::int64_t entry);

/// Evenly distributed in (0, 1), with 53 random bits.
double uniform(const Words& words);

/// Normally distributed with mean 0 and variance 1: G. E. P. Box, M. E. Muller, Ann. Math. Statist.
/// 29 (1958) 610.
double normal(const Words& words);

}  // namespace saltus::detail
