// A Factorisation and its matrix behind SUNDIALS's interfaces, of 6.x and 7.x alike.
#pragma once

#include <exception>

#include "../sundials_compat.hpp"
#include "factorisation.hpp"

namespace saltus::sun {

/// The matrix of a layout, which has to outlive it. It can become zero, a copy, and c A + I: all
/// that CVODE asks.
Matrix make_matrix(const MatrixLayout& layout, SUNContext context);
double* values_of(SUNMatrix matrix);

/// Solves with such a matrix. What is thrown meanwhile is kept in `error`.
Linear make_direct(Factorisation& factorisation, std::exception_ptr& error, SUNContext context);

}  // namespace saltus::sun
