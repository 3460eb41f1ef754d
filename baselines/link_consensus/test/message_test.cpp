// SPDX-License-Identifier: MIT
// What robots of link consensus say.
#include "said.hpp"

#include "banyan/baselines/link_consensus/link_consensus.hpp"

namespace banyan::baselines::link_consensus {
namespace {

struct Sample : Robots {
  static void fill(Message& m) {
    m.id = sender();
    m.root = robot();
    m.beat = word();
    m.way = word();
    m.parent = robot();
    for (RobotId& link : m.links) link = robot();
    m.bid = {robot(), robot(), word(), byte(), byte(), byte()};
    m.agrees = *rc::gen::arbitrary<bool>();
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(LinkConsensus, Said, Sample);

}  // namespace
}  // namespace banyan::baselines::link_consensus
