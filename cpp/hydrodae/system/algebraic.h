#pragma once
/// Algebraic unknowns of elements.

#include "hydrodae/system/jacobian.h"

namespace hydrodae::system {

/// Takes the algebraic unknowns of elements to where 0 = h(x, v, z), law by law, from where they
/// are in y by Newton's method; all else of y stays.
/// @param ws  follows angles over turns
/// @returns false where there is no solution near
bool solve_algebraic(const Regime& system, JacobianWorkspace& ws, double t, VectorX& y);

} // namespace hydrodae::system
