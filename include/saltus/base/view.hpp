// The argument of a callback (At), and the object through which a reset map or update writes
// (Next): maps over the machine's flat memory.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>

#include <Eigen/Core>

#include "saltus/base/error.hpp"
#include "saltus/base/ids.hpp"
#include "saltus/base/list.hpp"

namespace saltus {

class LeafSystem;

using VectorView = Eigen::Map<const Eigen::VectorXd>;  ///< read-only column over memory of another
                                                       ///< object
using VectorRef = Eigen::Map<Eigen::VectorXd>;         ///< writable column over memory of another
                                                       ///< object
using MatrixRef = Eigen::Map<Eigen::MatrixXd>;         ///< writable matrix, column major

/// A matrix stored row by row, as signals are.
using MatrixByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixView = Eigen::Map<const MatrixByRows>;  ///< read-only signal as a matrix

/// An output as a matrix to write: `by_rows(out, 3) = ...` for one of 3 columns.
inline Eigen::Map<MatrixByRows> by_rows(VectorRef out, Index columns) {
  return {out.data(), out.size() / columns, columns};
}

/// The machine's array that contains a signal. State outputs are views, never copies.
enum class Space : int { x, z, p, y };

/// The place of one signal.
struct Place {
  constexpr Place() = default;
  constexpr Place(Space in, Index first, Index n, Index columns_of_matrix = 0)
      : space(in), columns(static_cast<int>(columns_of_matrix)), offset(first), size(n) {}

  Space space = Space::y;
  int columns = 0;  ///< of a matrix; 0 for a scalar and a vector
  Index offset = 0;
  Index size = 0;
};

/// The machine's arrays at the moment of a call. `x` changes from call to call, the others do not.
using Bases = std::array<const double*, 4>;

/// The inputs of a leaf. `u[i]` is input i as a vector; `u(i)` is its first entry, for scalars;
/// `u.matrix(i)` is a matrix.
class Inputs {
 public:
  Inputs(const Place* places, int count, const Bases* bases)
      : places_(places), count_(count), bases_(bases) {}

  VectorView operator[](int i) const { return {data(i), places_[i].size}; }
  double operator()(int i) const { return *data(i); }
  /// Input i as a matrix; a vector is a matrix of one column.
  MatrixView matrix(int i) const {
    const Index n = std::max(places_[i].columns, 1);
    return {data(i), places_[i].size / n, n};
  }
  /// The columns of input i if it is a matrix, otherwise 0.
  Index columns(int i) const { return places_[i].columns; }
  int size() const noexcept { return count_; }

 private:
  const double* data(int i) const { return nth(*bases_, places_[i].space) + places_[i].offset; }
  const Place* places_;
  int count_;
  const Bases* bases_;
};

/// The arguments of a leaf's callback at one time: read-only views, no copies.
class At {
 public:
  At(double t, VectorView state, VectorView discrete, VectorView parameters, int m, Inputs inputs,
     const double* const* relations)
      : time(t), x(state), z(discrete), p(parameters), u(inputs), mode(m), relations_(relations) {}

  double time;   ///< [s]
  VectorView x;  ///< continuous state of this leaf
  VectorView z;  ///< discrete state of this leaf
  VectorView p;  ///< parameters of this leaf, in the order of declaration
  Inputs u;      ///< inputs of this leaf
  int mode;      ///< mode of this leaf
  /// In a reset map: the index of the guard that fired, in a vector of guards; in that of an event
  /// input the entry of the input that the wire leads to.
  Index entry = 0;

  /// A vector parameter.
  VectorView parameter(ParameterIndex k) const { return {p.data() + k.offset, k.size}; }

  /// The truth of entry i of a relation. It is held between instants if it reaches a derivative,
  /// otherwise it has its present value.
  bool relation(RelationIndex r, Index i = 0) const { return relation_values(r)[i] != 0.0; }
  /// The truths of all entries of a relation, 0 or 1.
  const double* relation_values(RelationIndex r) const { return relations_[r.value]; }

 private:
  const double* const* relations_;
};

/// The result of a reset map or update. It starts as the present state. A write counts as a reset
/// even if the new value equals the old one.
class Next {
 public:
  Next(VectorRef x, VectorRef z, int& mode, const std::string& path)
      : x_(x), z_(z), mode_(&mode), path_(&path) {}

  void set_continuous_state(const Eigen::Ref<const Eigen::VectorXd>& x) {
    set(x_, x.data(), x.size(), "continuous", wrote_x_);
  }
  void set_continuous_state(std::initializer_list<double> x) {
    set(x_, x.begin(), static_cast<Index>(x.size()), "continuous", wrote_x_);
  }
  void set_discrete_state(const Eigen::Ref<const Eigen::VectorXd>& z) {
    set(z_, z.data(), z.size(), "discrete", wrote_z_);
  }
  void set_discrete_state(std::initializer_list<double> z) {
    set(z_, z.begin(), static_cast<Index>(z.size()), "discrete", wrote_z_);
  }
  void set_mode(int mode) {
    *mode_ = mode;
    wrote_mode_ = true;
  }
  /// Notes that the function has written a value outside of the system, which other functions read.
  /// It counts as a write of the continuous state, with the same values: the signals are computed
  /// again, and the solver begins anew.
  void note_write_outside() noexcept { wrote_x_ = true; }

  bool wrote_continuous_state() const noexcept { return wrote_x_; }
  bool wrote_discrete_state() const noexcept { return wrote_z_; }
  bool wrote_mode() const noexcept { return wrote_mode_; }

 private:
  void set(VectorRef& target, const double* values, Index size, const char* what,
           bool& wrote) const {
    if (size != target.size()) {
      throw ModelError(text("block '", *path_, "': expected ", target.size(), " values for the ",
                            what, " state, found ", size, "; set all of it at once"));
    }
    std::copy_n(values, size, target.data());
    wrote = true;
  }

  VectorRef x_, z_;
  int* mode_;
  const std::string* path_;
  bool wrote_x_ = false, wrote_z_ = false, wrote_mode_ = false;
};

/// The result of the reset map of an event input, and the weight of the wire that delivers.
class Delivery final : public Next {
 public:
  Delivery(VectorRef x, VectorRef z, int& mode, const std::string& path, double weight)
      : Next(x, z, mode, path), weight_(weight) {}

  double weight() const noexcept { return weight_; }

 private:
  double weight_;
};

}  // namespace saltus
