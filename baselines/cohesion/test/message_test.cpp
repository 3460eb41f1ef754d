// SPDX-License-Identifier: MIT
// What robots of cohesive control say.
#include "banyan/baselines/cohesion/cohesion.hpp"
#include "said.hpp"

namespace banyan::baselines::cohesion {
namespace {

struct Sample : Robots {
  static SaidVelocity velocity() { return {static_cast<std::int8_t>(byte()), static_cast<std::int8_t>(byte())}; }
  static void fill(Message& m) {
    m.id = sender();
    for (bool* flag : {&m.candidate, &m.matching}) *flag = *rc::gen::arbitrary<bool>();
    for (SaidSector& s : m.sectors) s = {{word(), word()}, {word(), word()}, {word(), byte()}, {word(), byte()}};
    m.velocity = velocity();
    for (SaidLeader& leader : m.leaders) leader = {robot(), byte(), velocity()};
    for (std::uint8_t* n : {&m.depth, &m.thickness, &m.hops, &m.help, &m.density, &m.root_age}) *n = byte();
    m.root = robot();
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Cohesion, Said, Sample);

}  // namespace
}  // namespace banyan::baselines::cohesion
