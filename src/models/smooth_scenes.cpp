#include "saltus/models/robertson.hpp"
#include "saltus/models/van_der_pol.hpp"
#include "shelf.hpp"

namespace saltus::models::detail {

std::vector<ShelfEntry> smooth_scenes() {
  return {
      {"robertson", "three rates nine decades apart", [] { return robertson(); }},
      {"van-der-pol", "a relaxation oscillator, mu = 1000", [] { return van_der_pol(); }},
  };
}

}  // namespace saltus::models::detail
