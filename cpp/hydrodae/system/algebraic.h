#pragma once
/// Algebraic unknowns of elements.

#include "hydrodae/system/jacobian.h"

namespace hydrodae::system {

/// Solves 0 = h(x, v, z) for the algebraic unknowns of elements, law by law, by Newton's method.
/// The iteration starts from their values in y and changes nothing else in y.
/// @param ws  its `turns` fix the turn of each angle
/// @returns false if the iteration finds no solution near the start
bool solve_algebraic(const Regime& system, JacobianWorkspace& ws, double t, VectorX& y);

} // namespace hydrodae::system
