// A Factorisation and its matrix, with the interfaces of SUNDIALS 6.x and 7.x.
#pragma once

#include <exception>

#include "../sundials_compat.hpp"
#include "factorisation.hpp"

namespace saltus::sun {

/// The matrix of a layout, which has to outlive it. It can become zero, a copy, and c A + I; CVODE
/// needs no more.
Matrix make_matrix(const MatrixLayout& layout, SUNContext context);
double* values_of(SUNMatrix matrix);

/// A linear solver for such a matrix. It keeps an exception in `error`.
Linear make_direct(Factorisation& factorisation, std::exception_ptr& error, SUNContext context);

}  // namespace saltus::sun
