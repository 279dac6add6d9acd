// y = u_0 operator u_1, elementwise, 0 or 1; operators <  <=  >  >=  ==  !=.
// in_0, in_1: scalars and vectors of one width. out: boolean, that width.
// The first four operators have a relation with the smooth guard u_0 - u_1, located and held if it
// reaches a derivative, a guard or a reset. Equality has no sign to change, so it is an opaque
// boolean, meant for held signals such as modes.
#pragma once

#include "saltus/model/leaf_system.hpp"

namespace saltus {

class Comparator final : public LeafSystem {
 public:
  Comparator(std::string name, std::string_view operation);

 private:
  void declare_truth(VectorFunction calc, Reads reads);
  void held_truth(const At& at, VectorRef out) const;
  void equality(const At& at, VectorRef out) const;

  bool equal_ = true;
  RelationIndex relation_;
};

}  // namespace saltus
