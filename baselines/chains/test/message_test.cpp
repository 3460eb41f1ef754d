// SPDX-License-Identifier: MIT
// What robots of chains from a base say.
#include "banyan/baselines/chains/chains.hpp"
#include "said.hpp"

namespace banyan::baselines::chains {
namespace {

struct Sample : Robots {
  static void fill(Message& m) {
    m.id = sender();
    for (RobotId* id : {&m.worker, &m.asks, &m.root}) *id = robot();
    for (std::uint16_t* n : {&m.beyond, &m.path}) *n = word();
    for (std::uint8_t* n : {&m.chain, &m.links, &m.root_age}) *n = byte();
    m.whole = *rc::gen::arbitrary<bool>();
    for (Ids* ids : {&m.above, &m.below})
      for (RobotId& id : *ids) id = robot();
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Chains, Said, Sample);

}  // namespace
}  // namespace banyan::baselines::chains
