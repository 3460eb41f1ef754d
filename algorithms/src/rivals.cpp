// SPDX-License-Identifier: MIT
// Algorithms of other authors: their parameters as rows, and one function each.
#include "banyan/algorithms/algorithms.hpp"
#include "banyan/algorithms/tree_algorithm.hpp"
#include "banyan/rivals/fiedler/fiedler.hpp"
#include "banyan/rivals/link_consensus/link_consensus.hpp"
#include "banyan/rivals/mst/mst.hpp"

namespace banyan {
namespace rivals {
namespace {

// Rows of the platform's table that a rival has, too.
float* of_platform(RivalParams& params, std::string_view key) {
  if (key == "communication_range_m") return &params.communication_range_m;
  if (key == "tick_s") return &params.tick_s;
  if (key == "speed_gain_m_s") return &params.speed_gain_m_s;
  if (key == "wheel_limit_m_s") return &params.wheel_limit_m_s;
  return key == "wheel_distance_m" ? &params.wheel_distance_m : nullptr;
}

template <class Params, class Rows>
std::vector<BoundParameter> bind_all(Params& params, const Rows& own) {
  std::vector<BoundParameter> bound;
  for (const auto& row : common_parameters<Params>) bound.push_back({&row, &(params.*row.member)});
  for (const auto& row : own) bound.push_back({&row, &(params.*row.member)});
  for (const auto& row : platform_parameters())
    if (float* value = of_platform(params, row.key)) bound.push_back({&row, value});
  return bound;
}

}  // namespace

namespace link_consensus {
static std::vector<BoundParameter> bind(Params& params) { return bind_all(params, parameters()); }
static std::string_view cross_fault(const Params& params) { return fault(params); }
}  // namespace link_consensus

namespace mst {
static std::vector<BoundParameter> bind(Params& params) { return bind_all(params, parameters()); }
static std::string_view cross_fault(const Params& params) { return fault(params); }
}  // namespace mst

namespace fiedler {
static std::vector<BoundParameter> bind(Params& params) { return bind_all(params, parameters()); }
static std::string_view cross_fault(const Params& params) { return fault(params); }
}  // namespace fiedler

}  // namespace rivals

const Algorithm& link_consensus() noexcept {
  static constexpr TreeAlgorithmOf<rivals::link_consensus::Robots> algorithm(
      "link-consensus", "keeps radio links, and gives one up when its ends agree that a detour remains", rivals::link_consensus::defaults, true);
  return algorithm;
}

const Algorithm& mst() noexcept {
  static constexpr TreeAlgorithmOf<rivals::mst::Robots> algorithm(
      "mst", "keeps a minimum spanning tree of all robots, and builds a new one when an edge gets long", rivals::mst::defaults, true);
  return algorithm;
}

const Algorithm& fiedler() noexcept {
  static constexpr TreeAlgorithmOf<rivals::fiedler::Robots> algorithm(
      "fiedler", "estimates the algebraic connectivity of the network, and moves up its gradient", rivals::fiedler::defaults, true);
  return algorithm;
}

}  // namespace banyan
