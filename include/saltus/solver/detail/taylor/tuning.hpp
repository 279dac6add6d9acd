// The tuning numbers of the Taylor method: name, unit, and derivation or source. The test that is
// named fails if the number is a hundred times as large, or as small.
#pragma once

namespace saltus::taylor::tuning {

// --- what a series may hide: see `may_hide` of tape/series.hpp

/// [points] inside a step at which such a derivative is compared with the series. A step of dop853
/// has eleven such points. tests/unit/taylor_test.cpp (as small)
inline constexpr int hidden_looks = 8;
/// [of the longest step before] The most by which such a step may be longer, as one of dop853.
/// tests/unit/taylor_test.cpp (as large)
inline constexpr double hidden_growth = 6.0;

// --- length of a step: step_rule.hpp

/// [1] Part of the length that the error allows, and the least part of a step to try next (the
/// codes DOPRI5 and DOP853). tests/unit/taylor_test.cpp
inline constexpr double safety = 0.9, shortest_retry = 0.1;

// --- separation of roots: root_separation.hpp

/// [of a guard's range] The upper half of the terms may have this part at most. With more, terms
/// that are left out may move its roots, or hold others. Half of the terms, because those of even
/// functions, or of functions of t^4, are zero between others. tests/unit/root_separation_test.cpp
inline constexpr double poor = 1e-3;
/// [eps for each term] The rounding of a coefficient, after a conversion and the cuts.
/// tests/unit/root_separation_test.cpp (as large)
inline constexpr double term_roundings = 2.0;
/// [cuts] at most: a polynomial of degree 30 with simple roots needs far fewer.
/// tests/unit/root_separation_test.cpp (as small)
inline constexpr int most_cuts = 400;
/// [of the step] A double root cannot be told from a pair within the root of the rounding.
/// tests/unit/root_separation_test.cpp (ten thousand times as large)
inline constexpr double shortest_part = 1e-9;

}  // namespace saltus::taylor::tuning
