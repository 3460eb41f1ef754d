// SPDX-License-Identifier: MIT
// Row by row, as in T. A. Davis, "Algorithm 849: A concise sparse Cholesky factorization package" (2005): the pattern
// of a row of L is what the elimination tree reaches from the entries of that row.
#include "ldlt.hpp"

#include <Eigen/OrderingMethods>
#include <utility>

namespace banyan::measure {
namespace {

constexpr std::size_t work_between_pauses = 1'000'000;

}  // namespace

// The upper triangle of the matrix in an order that leaves L sparse (minimum degree).
SparseMatrix Ldlt::ordered(const SparseMatrix& lower) {
  Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), back_);
  order_ = back_.inverse();
  SparseMatrix upper(lower.rows(), lower.cols());
  upper.selfadjointView<Eigen::Upper>() = lower.selfadjointView<Eigen::Lower>().twistedBy(order_);
  return upper;
}

// The elimination tree and the number of entries in each column of L, by walking up from every entry.
void Ldlt::count_columns(const SparseMatrix& upper) {
  const auto n = static_cast<std::size_t>(upper.cols());
  parent_.assign(n, -1);
  tag_.assign(n, -1);
  size_.assign(n, 0);
  for (int k = 0; k < static_cast<int>(n); ++k) {
    tag_[static_cast<std::size_t>(k)] = k;
    for (SparseMatrix::InnerIterator entry(upper, k); entry; ++entry) {
      if (entry.row() > k) continue;
      for (auto i = static_cast<std::size_t>(entry.row()); tag_[i] != k; i = static_cast<std::size_t>(parent_[i])) {
        if (parent_[i] == -1) parent_[i] = k;
        ++size_[i];
        tag_[i] = k;
      }
    }
  }
  begin_.assign(n + 1, 0);
  for (std::size_t k = 0; k < n; ++k) begin_[k + 1] = begin_[k] + size_[k];
  row_.resize(begin_[n]);
  value_.resize(begin_[n]);
}

// Row k of the matrix into rest_, and the pattern of row k of L into pattern_, from the place that is returned on.
std::size_t Ldlt::spread_row(const SparseMatrix& upper, Eigen::Index k) {
  std::size_t top = pattern_.size();
  tag_[static_cast<std::size_t>(k)] = static_cast<int>(k);
  for (SparseMatrix::InnerIterator entry(upper, k); entry; ++entry) {
    if (entry.row() > k) continue;
    rest_[static_cast<std::size_t>(entry.row())] += entry.value();
    std::size_t length = 0;
    for (auto i = static_cast<std::size_t>(entry.row()); tag_[i] != k; i = static_cast<std::size_t>(parent_[i])) {
      pattern_[length++] = static_cast<int>(i);
      tag_[i] = static_cast<int>(k);
    }
    while (length > 0) pattern_[--top] = pattern_[--length];
  }
  return top;
}

// Row k of L; returns its pivot.
double Ldlt::eliminate_row(const SparseMatrix& upper, Eigen::Index k) {
  std::size_t top = spread_row(upper, k);
  double pivot = std::exchange(rest_[static_cast<std::size_t>(k)], 0.0);
  const auto append = [&](std::size_t i, double y) {
    rest_[i] = 0.0;
    const double factor = y / pivots_[static_cast<Eigen::Index>(i)];
    pivot -= factor * y;
    const std::size_t end = begin_[i] + size_[i];
    row_[end] = static_cast<int>(k);
    value_[end] = factor;
    work_ += ++size_[i];
  };
  while (top < pattern_.size()) {
    const auto i = static_cast<std::size_t>(pattern_[top++]);
    const auto up = static_cast<std::size_t>(parent_[i]);
    const double* const value = value_.data() + begin_[i];
    const double y = rest_[i];
    // Where L is dense the next column is the parent's and has the same rows but its own: both are taken off at once.
    if (top < pattern_.size() && pattern_[top] == parent_[i] && size_[i] == size_[up] + 1) {
      ++top;
      const double* const value_up = value_.data() + begin_[up];
      const double y_up = rest_[up] - value[0] * y;
      for (std::size_t p = 0; p < size_[up]; ++p) {
        double& rest = rest_[static_cast<std::size_t>(row_[begin_[up] + p])];
        rest = rest - value[p + 1] * y - value_up[p] * y_up;
      }
      append(i, y);
      append(up, y_up);
    } else {
      for (std::size_t p = 0; p < size_[i]; ++p) rest_[static_cast<std::size_t>(row_[begin_[i] + p])] -= value[p] * y;
      append(i, y);
    }
  }
  return pivot;
}

bool Ldlt::compute(const SparseMatrix& lower, const std::function<void()>& pause) {
  const auto rest = [&] {
    work_ = 0;
    if (pause) pause();
  };
  rest();
  const SparseMatrix upper = ordered(lower);
  rest();
  count_columns(upper);
  const auto n = static_cast<std::size_t>(upper.cols());
  size_.assign(n, 0);
  tag_.assign(n, -1);
  rest_.assign(n, 0.0);
  pattern_.assign(n, 0);
  pivots_.resize(upper.cols());
  for (Eigen::Index k = 0; k < upper.cols(); ++k) {
    if (work_ > work_between_pauses) rest();
    pivots_[k] = eliminate_row(upper, k);
    if (pivots_[k] == 0.0) return false;
  }
  return true;
}

Vector Ldlt::solve(const Vector& right_side) const {
  Vector x = order_ * right_side;
  const auto n = static_cast<std::size_t>(x.size());
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t p = begin_[k]; p < begin_[k + 1]; ++p) x[row_[p]] -= value_[p] * x[static_cast<Eigen::Index>(k)];
  x.array() /= pivots_.array();
  for (std::size_t k = n; k-- > 0;)
    for (std::size_t p = begin_[k]; p < begin_[k + 1]; ++p) x[static_cast<Eigen::Index>(k)] -= value_[p] * x[row_[p]];
  return back_ * x;
}

}  // namespace banyan::measure
