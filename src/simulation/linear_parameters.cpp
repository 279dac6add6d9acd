#include "linear_parameters.hpp"

#include <algorithm>
#include <utility>

namespace saltus {

bool LinearParameters::has(const ContextEntry& entry) const {
  return std::ranges::any_of(all_, [&](const One& one) {
    return entry.first < one.entry.first + one.entry.size &&
           one.entry.first < entry.first + entry.size;
  });
}

void LinearParameters::write(Context& context, const LinearInput& input,
                             const ContextEntry& entry) {
  if (!input.value) return;
  write_entry(context, entry, {input.value->data(), static_cast<std::size_t>(input.value->size())},
              input.name);
}

Context LinearParameters::written(Context context) const {
  for (const One& one : all_) write(context, one.input, one.entry);
  return context;
}

ParameterMoves LinearParameters::moves(const Eigen::VectorXd& p) {
  ParameterMoves moves(p.size());
  for (const One& one : all_) {
    for (Index i = 0; i < one.entry.size; ++i) {
      ParameterDirection direction = computed_.by(one.entry.first + i, p);
      if (!direction.obstacle.empty())
        throw ModelError(text("linearize: by '", one.input.name, "': ", direction.obstacle,
                              " at these values; expected values at which the derivative exists"));
      moves.add(one.column + i, std::move(direction.moves));
    }
  }
  return moves;
}

}  // namespace saltus
