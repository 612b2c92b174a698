#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

/// Dense rows, made sparse.
inline CsrMatrix sparse(const std::vector<std::vector<double>>& rows) {
  CsrMatrix matrix;
  matrix.num_columns = static_cast<std::int32_t>(rows.front().size());
  matrix.row_start.push_back(0);
  for (const auto& row : rows) {
    for (std::size_t j = 0; j < row.size(); ++j)
      if (row[j] != 0.0) {
        matrix.columns.push_back(static_cast<std::int32_t>(j));
        matrix.values.push_back(row[j]);
      }
    matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
  }
  return matrix;
}

using Dense = std::vector<std::vector<double>>;
inline Dense zeros(int rows, int columns) {
  return Dense(std::size_t(rows), std::vector<double>(std::size_t(columns), 0.0));
}

/// A chain of n nodes: Laplacians with fixed ends per component, the first two coupled; pressures
/// on nodes with the divergence of the first component.
struct Chain {
  CsrMatrix A, B, C, laplacian;
  std::vector<double> mass;
  SaddleSystem system;

  explicit Chain(int n, bool is_closed) {
    Dense a = zeros(3 * n, 3 * n), b = zeros(n, 3 * n), c = zeros(n, n), l = zeros(n, n);
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    for (int i = 0; i < n; ++i) {
      l[at(i)][at(i)] = 2.0;
      if (i > 0) l[at(i)][at(i - 1)] = l[at(i - 1)][at(i)] = -1.0;
      c[at(i)][at(i)] = 0.1 * (i > 0) + 0.1 * (i + 1 < n);
      if (i > 0) c[at(i)][at(i - 1)] = c[at(i - 1)][at(i)] = -0.1;
    }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < 3; ++k) a[at(3 * i + k)][at(3 * j + k)] = (1.0 + k) * l[at(i)][at(j)];
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        a[at(3 * i)][at(3 * j + 1)] = a[at(3 * j + 1)][at(3 * i)] = 0.5 * l[at(i)][at(j)];
    // Central differences; their columns sum to zero where the ends are closed.
    for (int i = 0; i + 1 < n; ++i) {
      b[at(i)][at(3 * i)] += 0.5;
      b[at(i)][at(3 * i + 3)] += 0.5;
      b[at(i + 1)][at(3 * i)] -= 0.5;
      b[at(i + 1)][at(3 * i + 3)] -= 0.5;
    }
    if (!is_closed) b[0][0] += 1.0;
    A = sparse(a), B = sparse(b), C = sparse(c), laplacian = sparse(l);
    mass.assign(at(n), 1.0);
    system = {A.view(), B.view(), C.view(), {laplacian.view()}, {0, 0, 0}, mass, is_closed};
  }
};

inline std::vector<double> product(const CsrView& matrix, std::span<const double> x) {
  std::vector<double> y(std::size_t(matrix.num_rows), 0.0);
  for (std::size_t i = 0; i < y.size(); ++i)
    for (auto k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
      y[i] += matrix.values[std::size_t(k)] * x[std::size_t(matrix.columns[std::size_t(k)])];
  return y;
}

inline std::vector<double> random_solution(const SaddleSystem& system, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> u(std::size_t(system.size()));
  for (double& value : u) value = uniform(random);
  if (!system.constant_pressure_is_null) return u;
  const auto p = std::span(u).subspan(std::size_t(system.num_velocities()));
  const double mean = std::accumulate(p.begin(), p.end(), 0.0) / double(p.size());
  for (double& value : p) value -= mean;
  return u;
}

inline double distance(std::span<const double> a, std::span<const double> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace meniscus::linear
