// SPDX-License-Identifier: MIT
// lambda_2 by the cheapest method that answers the question. Iterative solvers miss repeated zeros,
// so none is used before the graph is known to be connected.
#include "banyan/measure/fiedler.hpp"

#include <Spectra/SymEigsShiftSolver.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Factors = Eigen::SimplicialLDLT<SparseMatrix>;

constexpr std::size_t dense_limit = 150;
constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();

// The Laplacian plus `shift` on the diagonal, lower triangle only.
SparseMatrix shifted_laplacian(const Graph& graph, double shift) {
  const auto n = static_cast<Eigen::Index>(graph.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(graph.neighbors.size() / 2 + graph.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = graph.of(static_cast<std::size_t>(i));
    entries.emplace_back(i, i, static_cast<double>(row.size()) + shift);
    for (const std::uint32_t j : row)
      if (static_cast<Eigen::Index>(j) < i) entries.emplace_back(i, j, -1.0);
  }
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// x -> P (L - sigma)^-1 P x, P the projection off the constant vector: what is left has 1 /
// (lambda_2 - sigma) as its largest eigenvalue. sigma < 0 keeps L - sigma positive definite.
class InverseOffConstants {
 public:
  using Scalar = double;
  InverseOffConstants(const Graph& graph, const std::function<void()>& pause)
      : graph_{graph}, pause_{pause}, n_{static_cast<Eigen::Index>(graph.size())} {}
  [[nodiscard]] Eigen::Index rows() const { return n_; }
  [[nodiscard]] Eigen::Index cols() const { return n_; }
  void set_shift(double sigma) {
    if (pause_) pause_();
    factors_.compute(shifted_laplacian(graph_, -sigma));
  }
  void perform_op(const double* in, double* out) const {
    if (pause_) pause_();
    const Eigen::Map<const Vector> x(in, n_);
    Eigen::Map<Vector> y(out, n_);
    y = factors_.solve((x.array() - x.mean()).matrix());
    y.array() -= y.mean();
  }

 private:
  const Graph& graph_;
  const std::function<void()>& pause_;
  Eigen::Index n_;
  Factors factors_;
};

// x' L x / x' x off the constant vector: an upper bound of lambda_2, close to it when x is close
// to its eigenvector. Infinite for a constant x.
template <class T> double rayleigh_quotient(const Graph& graph, const std::vector<T>& x) {
  double sum = 0.0;
  for (const T v : x) sum += static_cast<double>(v);
  const double mean = sum / static_cast<double>(x.size());
  double energy = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double xi = static_cast<double>(x[i]);
    size += (xi - mean) * (xi - mean);
    for (const std::uint32_t j : graph.of(i)) {
      const double d = xi - static_cast<double>(x[j]);
      energy += d * d;  // every edge occurs twice
    }
  }
  return size > 0.0 ? 0.5 * energy / size : std::numeric_limits<double>::infinity();
}

// In [-1, 1), the same every time.
double noise(std::uint64_t i) { return 2.0 * world::to_uniform(world::mix(i)) - 1.0; }

// Mohar 1991: lambda_2 >= 4 / (n diameter).
double lower_bound(std::size_t n, std::uint32_t eccentricity) {
  const double diameter = std::min(2.0 * eccentricity, static_cast<double>(n - 1));
  return 4.0 / (static_cast<double>(n) * diameter);
}

}  // namespace

// Marks everything connected to `start`; returns the largest number of hops.
std::uint32_t Fiedler::visit(const Graph& graph, std::uint32_t start) {
  queue_.clear();
  queue_.push_back(start);
  level_[start] = 0;
  for (std::size_t k = 0; k < queue_.size(); ++k) {
    const std::uint32_t i = queue_[k];
    for (const std::uint32_t j : graph.of(i)) {
      if (level_[j] != unseen) continue;
      level_[j] = level_[i] + 1;
      queue_.push_back(j);
    }
  }
  return level_[queue_.back()];
}

Fiedler::Components Fiedler::components(const Graph& graph) {
  const std::size_t n = graph.size();
  queue_.reserve(n);
  level_.assign(n, unseen);
  Components result;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (level_[i] != unseen) continue;
    const std::uint32_t hops = visit(graph, i);
    if (result.count++ == 0) result.eccentricity = hops;
  }
  if (result.count != 1) result.eccentricity = 0;
  return result;
}

bool Fiedler::below(const Graph& graph, double threshold) {
  const std::size_t n = graph.size();
  if (!(threshold > 0.0)) return false;
  const Components parts = components(graph);
  if (parts.count != 1) return true;
  if (n == 1) return 1.0 < threshold;
  if (lower_bound(n, parts.eccentricity) >= threshold) return false;
  if (flow_bound(graph) >= 1.000001 * threshold) return false;
  if (rayleigh_quotient(graph, level_) < threshold) return true;
  if (eigenvector_.size() == n && rayleigh_quotient(graph, eigenvector_) < threshold) return true;
  if (settled_threshold_ == threshold && settled_ == graph) return settled_answer_;
  settled_answer_ = below_by_factorisation(graph, threshold);
  settled_threshold_ = threshold;
  settled_ = graph;
  return settled_answer_;
}

// Send one unit from every node to node 0, hop by hop, in equal parts to all neighbours that are one hop nearer.
// If no edge from level l to l - 1 carries more than c_l, then lambda_2 >= 1 / (c_1 + c_2 + ...): for any x and
// any way from a node u to node 0, (x_u - x_0)^2 <= (sum of c_l) (sum along it of (x_i - x_j)^2 / c_l), by Cauchy
// and Schwarz; so, weighted with the parts that go each way and added up over all u, sum of (x_u - x_0)^2 <=
// (sum of c_l) x' L x, and no other point than the mean of x makes the left side less than it is for x_0.
double Fiedler::flow_bound(const Graph& graph) {
  flow_.assign(graph.size(), 1.0);
  widest_.assign(level_[queue_.back()] + 1, 0.0);
  for (std::size_t k = queue_.size(); k-- > 1;) {
    const std::uint32_t i = queue_[k];
    const auto nearer = [&](std::uint32_t j) { return level_[j] < level_[i]; };
    const auto row = graph.of(i);
    const double part = flow_[i] / static_cast<double>(std::count_if(row.begin(), row.end(), nearer));
    for (const std::uint32_t j : row)
      if (nearer(j)) flow_[j] += part;
    widest_[level_[i]] = std::max(widest_[level_[i]], part);
  }
  double sum = 0.0;
  for (const double widest : widest_) sum += widest;
  return 1.0 / sum;
}

// Sylvester: L - threshold has as many negative eigenvalues as its factorisation has negative
// pivots. One of them belongs to the constant vector. A pivot near zero makes the signs
// unreliable: then the eigenvalue itself decides.
bool Fiedler::below_by_factorisation(const Graph& graph, double threshold) {
  if (pause_) pause_();
  const Factors factors(shifted_laplacian(graph, -threshold));
  if (factors.info() != Eigen::Success || factors.vectorD().cwiseAbs().minCoeff() < 1e-6 * threshold)
    return value(graph) < threshold;
  return (factors.vectorD().array() < 0.0).count() >= 2;
}

double Fiedler::value(const Graph& graph) {
  const std::size_t n = graph.size();
  const Components parts = components(graph);
  if (parts.count != 1) return 0.0;
  if (n == 1) return 1.0;
  return n <= dense_limit ? dense(graph) : sparse(graph, lower_bound(n, parts.eccentricity));
}

double Fiedler::dense(const Graph& graph) {
  const auto n = static_cast<Eigen::Index>(graph.size());
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = graph.of(static_cast<std::size_t>(i));
    laplacian(i, i) = static_cast<double>(row.size());
    for (const std::uint32_t j : row) laplacian(i, j) = -1.0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(laplacian);
  const Vector vector = solver.eigenvectors().col(1);
  eigenvector_.assign(vector.data(), vector.data() + n);
  return std::max(0.0, solver.eigenvalues()(1));
}

double Fiedler::sparse(const Graph& graph, double lower_bound) {
  const auto n = static_cast<Eigen::Index>(graph.size());
  if (eigenvector_.size() != graph.size()) eigenvector_.assign(level_.begin(), level_.end());
  Vector start = Eigen::Map<const Vector>(eigenvector_.data(), n);
  start.array() -= start.mean();
  // A remembered vector can be orthogonal to the one sought; with some noise it never is.
  const double grain = 0.01 * start.norm() / std::sqrt(static_cast<double>(n));
  for (Eigen::Index i = 0; i < n; ++i) start(i) += grain * noise(static_cast<std::uint64_t>(i));
  InverseOffConstants inverse(graph, pause_);
  // A second attempt with a wider basis and no memory, in case the start was unlucky.
  for (const Eigen::Index basis : {Eigen::Index{20}, Eigen::Index{100}}) {
    Spectra::SymEigsShiftSolver<InverseOffConstants> solver(inverse, 1, basis, -lower_bound);
    if (basis == 20 && start.norm() > 0.0) solver.init(start.data());
    else solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-10);
    if (solver.info() != Spectra::CompInfo::Successful) continue;
    const Vector vector = solver.eigenvectors(1).col(0);
    eigenvector_.assign(vector.data(), vector.data() + n);
    return solver.eigenvalues()(0);
  }
  throw std::runtime_error("lambda_2 of a graph of " + std::to_string(n) + " nodes: the solver did not converge");
}

}  // namespace banyan::measure
