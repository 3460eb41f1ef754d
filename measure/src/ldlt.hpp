// SPDX-License-Identifier: MIT
// The factors L D L' of a sparse symmetric matrix: as by Eigen's SimplicialLDLT, to the last bit, but a computation
// can be stopped, which matters with 65,000 robots, where one may take a minute.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <cstddef>
#include <functional>
#include <vector>

namespace banyan::measure {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

class Ldlt {
 public:
  // Factorises the matrix with this lower triangle. `pause` is called every few milliseconds of work; an exception of
  // its own ends the work. False if a pivot is zero.
  bool compute(const SparseMatrix& lower, const std::function<void()>& pause);
  [[nodiscard]] const Vector& pivots() const noexcept { return pivots_; }
  [[nodiscard]] Vector solve(const Vector& right_side) const;  // after a compute() that was true

 private:
  SparseMatrix ordered(const SparseMatrix& lower);
  void count_columns(const SparseMatrix& upper);
  std::size_t spread_row(const SparseMatrix& upper, Eigen::Index k);
  double eliminate_row(const SparseMatrix& upper, Eigen::Index k);

  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_, back_;
  std::vector<int> parent_;                // elimination tree; -1: a root
  std::vector<std::size_t> begin_, size_;  // of the columns of L, without its diagonal of ones
  std::vector<int> row_;
  std::vector<double> value_;
  Vector pivots_;
  // Of the row that is eliminated.
  std::vector<double> rest_;
  std::vector<int> pattern_, tag_;
  std::size_t work_ = 0;  // multiplications since the last pause
};

}  // namespace banyan::measure
