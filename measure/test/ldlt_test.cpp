// SPDX-License-Identifier: MIT
// Factors against Eigen's, and a stop at any moment.
#include "ldlt.hpp"

#include <gtest/gtest.h>

#include <exception>

#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

// A symmetric matrix with some entries in each row, positive definite or not.
SparseMatrix random_matrix(std::uint64_t seed, int n, double diagonal) {
  const auto draw = [&](int i, int k) {
    return world::to_uniform(
        world::bits(seed, world::Purpose::loss, static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(k)));
  };
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, diagonal + draw(i, 0));
    for (int k = 1; k < 4 && i > 0; ++k)
      entries.emplace_back(i, static_cast<int>(draw(i, k) * i), draw(i, k + 4) - 0.5);
  }
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(Ldlt, IsEigensToTheLastBit) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const int n = 1 + static_cast<int>(seed * seed);
    const SparseMatrix lower = random_matrix(seed, n, seed % 2 == 0 ? 4.0 : -0.3);
    const Eigen::SimplicialLDLT<SparseMatrix> wanted(lower);
    Ldlt factors;
    ASSERT_TRUE(factors.compute(lower, {}));
    EXPECT_TRUE((factors.pivots().array() == wanted.vectorD().array()).all()) << seed;
    const Vector right = Vector::LinSpaced(n, -1.0, 2.0);
    const Vector x = factors.solve(right), y = wanted.solve(right);
    EXPECT_LE((x - y).norm(), 1e-9 * y.norm()) << seed;
  }
}

TEST(Ldlt, APivotOfZeroIsSaid) {
  SparseMatrix singular(2, 2);
  singular.insert(0, 0) = 1.0;
  singular.insert(1, 0) = 1.0;
  singular.insert(1, 1) = 1.0;
  EXPECT_FALSE(Ldlt{}.compute(singular, {}));
}

TEST(Ldlt, CanBeStoppedAndUsedAgain) {
  constexpr int n = 400;
  const Eigen::MatrixXd full = 4.0 * Eigen::MatrixXd::Identity(n, n) + 0.01 * Eigen::MatrixXd::Ones(n, n);
  const SparseMatrix lower = full.sparseView();
  struct Enough : std::exception {};
  int pauses = 0;
  Ldlt factors;
  ASSERT_TRUE(factors.compute(lower, [&] { ++pauses; }));
  EXPECT_GT(pauses, 2);
  const Vector whole = factors.pivots();
  for (const int at : {1, 2, 3, pauses}) {
    int count = 0;
    EXPECT_THROW(factors.compute(lower,
                                 [&] {
                                   if (++count == at) throw Enough{};
                                 }),
                 Enough);
    ASSERT_TRUE(factors.compute(lower, {}));
    EXPECT_TRUE((factors.pivots().array() == whole.array()).all()) << at;
  }
}

}  // namespace
}  // namespace banyan::measure
