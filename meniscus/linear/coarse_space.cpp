#include "meniscus/linear/coarse_space.hpp"

#include <algorithm>

#include <Eigen/QR>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::linear {
namespace {

double row_product(const CsrView& matrix, std::int32_t row, std::span<const double> x) {
  double product = 0.0;
  for (auto n = matrix.row_start[std::size_t(row)]; n < matrix.row_start[std::size_t(row) + 1]; ++n)
    product += matrix.values[std::size_t(n)] * x[std::size_t(matrix.columns[std::size_t(n)])];
  return product;
}

/// Adds s times a row to x.
void add_row(const CsrView& matrix, std::int32_t row, double s, std::span<double> x) {
  for (auto n = matrix.row_start[std::size_t(row)]; n < matrix.row_start[std::size_t(row) + 1]; ++n)
    x[std::size_t(matrix.columns[std::size_t(n)])] += s * matrix.values[std::size_t(n)];
}

}  // namespace

CoarseSpace::CoarseSpace(Communicator communicator, const CsrView& functions,
                         const LinearOperator& K)
    : communicator_(communicator),
      functions_{functions.num_columns,
                 {functions.row_start.begin(), functions.row_start.end()},
                 {functions.columns.begin(), functions.columns.end()},
                 {functions.values.begin(), functions.values.end()}} {
  // Functions that depend on each other within rounding count as one.
  constexpr double kDependent = 1e-10;
  Eigen::MatrixXd coarse(functions.num_rows, functions.num_rows);
  std::vector<double> z(static_cast<std::size_t>(functions.num_columns)), Kz(z.size());
  for (std::int32_t row = 0; row < functions.num_rows; ++row) {
    std::ranges::fill(z, 0.0);
    add_row(functions, row, 1.0, z);
    K(z, Kz);
    coarse.col(row) = products_with(Kz);
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(kDependent);
  inverse_ = decomposition.compute(0.5 * (coarse + coarse.transpose())).pseudoInverse();
}

void CoarseSpace::add(std::span<const double> r, double s, std::span<double> z) const {
  const Eigen::VectorXd weights = s * inverse_ * products_with(r);
  for (std::int32_t row = 0; row < weights.size(); ++row)
    add_row(functions_.view(), row, weights[row], z);
}

Eigen::VectorXd CoarseSpace::products_with(std::span<const double> r) const {
  const CsrView functions = functions_.view();
  MENISCUS_ASSERT(r.size() == std::size_t(functions.num_columns), "{} entries, not {}", r.size(),
                  functions.num_columns);
  Eigen::VectorXd products(functions.num_rows);
  for (std::int32_t row = 0; row < functions.num_rows; ++row)
    products[row] = row_product(functions, row, r);
  sum(communicator_, std::span(products.data(), static_cast<std::size_t>(products.size())));
  return products;
}

}  // namespace meniscus::linear
