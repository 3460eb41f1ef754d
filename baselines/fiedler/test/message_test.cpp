// SPDX-License-Identifier: MIT
// What robots of Fiedler control say.
#include "said.hpp"

#include "banyan/baselines/fiedler/fiedler.hpp"

namespace banyan::baselines::fiedler {
namespace {

struct Sample : Robots {
  static void fill(Message& m) {
    m.id = sender();
    for (float* real : {&m.component, &m.mean.value, &m.mean.integral, &m.square.value, &m.square.integral,
                        &m.product.value, &m.product.integral, &m.lambda})
      *real = largest_real * (static_cast<float>(word()) / 32767.5F - 1.0F);
    m.links = byte();
    m.largest_degree = word();
    m.degree_age = byte();
    m.root = robot();
    m.root_age = byte();
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Fiedler, Said, Sample);

}  // namespace
}  // namespace banyan::baselines::fiedler
