// SPDX-License-Identifier: MIT
// What robots of branch repositioning say.
#include "banyan/baselines/branches/branches.hpp"
#include "said.hpp"

namespace banyan::baselines::branches {
namespace {

struct Sample : Robots {
  static void fill(Message& m) {
    m.id = sender();
    for (RobotId* id : {&m.parent, &m.leaves, &m.joins, &m.held_by, &m.calls, &m.team, &m.needy, &m.sends, &m.root})
      *id = robot();
    for (std::uint8_t* n : {&m.joined_age, &m.stage, &m.team_age, &m.needed, &m.needy_age, &m.root_age}) *n = byte();
    m.leader = *rc::gen::arbitrary<bool>();
    m.connector = *rc::gen::arbitrary<bool>();
    for (RobotId& id : m.links) id = robot();
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Branches, Said, Sample);

}  // namespace
}  // namespace banyan::baselines::branches
