// TimeEvent: the number of its ticks, and the errors of a declaration.
#include <algorithm>
#include <cmath>

#include "saltus/model/event.hpp"

namespace saltus {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::int64_t endless = std::numeric_limits<std::int64_t>::max();

/// Within the rounding that the calendar allows, a tick at the end belongs to the event.
double latest(double end) { return end + 4.0 * eps * std::abs(end); }

std::int64_t ticks_until(const TimeEvent& event, double end) {
  if (event.times) return std::ranges::upper_bound(*event.times, end) - event.times->begin();
  if (event.offset > end) return 0;
  if (std::isinf(event.period)) return 1;
  const double periods = std::floor((end - event.offset) / event.period);
  return periods < 0x1p62 ? static_cast<std::int64_t>(periods) + 1 : endless;
}

std::string fault_of_times(const TimeEvent& event) {
  if (std::isfinite(event.period) || event.offset != 0.0)
    return "it has times and a period or an offset; expected one or the other";
  const std::vector<double>& times = *event.times;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) return text("expected finite times [s], found ", times[i]);
    if (i > 0 && !(times[i] > latest(times[i - 1])))
      return text("expected increasing times [s], found ", times[i], " after ", times[i - 1]);
  }
  return {};
}

}  // namespace

std::int64_t TimeEvent::ticks() const {
  return std::min(ticks_until(*this, latest(end)), count.value_or(endless));
}

std::string TimeEvent::fault() const {
  if (std::isnan(end)) return text("expected a time [s] as its end, found ", end);
  if (count && *count < 1) return text("expected a count of 1 or more, found ", *count);
  if (times) return fault_of_times(*this);
  if (inherited) {
    const bool timed = std::isfinite(period) || offset != 0.0 || std::isfinite(end) || count;
    return timed ? "its ticks are inherited; expected no period, offset, end or count" : "";
  }
  if (!(period > 0.0) || !std::isfinite(offset)) {
    return text("period ", period, " s, offset ", offset,
                " s; expected period > 0 and a finite offset");
  }
  return {};
}

}  // namespace saltus
