// SPDX-License-Identifier: MIT
// What robots of MST preservation say.
#include "said.hpp"

#include "banyan/baselines/mst/mst.hpp"

namespace banyan::baselines::mst {
namespace {

struct Sample : Robots {
  static void fill(Message& m) {
    m.id = sender();
    m.epoch = word();
    m.next = word();
    m.countdown = byte();
    m.level = byte();
    m.fragment = robot();
    m.up = robot();
    for (bool* flag : {&m.ready, &m.decided, &m.done, &m.full}) *flag = *rc::gen::arbitrary<bool>();
    m.best = {robot(), robot(), word()};
    m.choice = {robot(), robot(), word()};
    m.root = robot();
    for (RobotId& branch : m.branches) branch = robot();
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Mst, Said, Sample);

}  // namespace
}  // namespace banyan::baselines::mst
