// How a step looks for what its series may hide, see `may_hide` of tape/series.hpp.
#pragma once

namespace saltus::taylor {

/// Points inside a step at which such a derivative is compared with the series, and the most by
/// which a step may be longer than the longest before. A step of dop853 has eleven such points, and
/// is at most six times as long as the one before.
inline constexpr int hidden_looks = 8;
inline constexpr double hidden_growth = 6.0;

}  // namespace saltus::taylor
