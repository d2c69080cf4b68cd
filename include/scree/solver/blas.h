#pragma once

#include <string>

namespace scree
{
/**
 * The old processor whose kernels OpenBLAS takes because it does not know the present one, "" if it
 * knows it or another BLAS is in use. With the kernels of 2004 the products of dense matrices in
 * direct solvers take several times as long.
 */
std::string outdated_blas_kernels();
} // namespace scree
