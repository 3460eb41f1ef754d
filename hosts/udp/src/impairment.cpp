// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/impairment.hpp"

#include <cmath>

namespace banyan::udp {

Impairment per_hop(const Impairment& way) noexcept {
  Impairment hop = way;
  hop.loss = 1.0 - std::sqrt(1.0 - way.loss);
  hop.duplicate = 1.0 - std::sqrt(1.0 - way.duplicate);
  hop.delay_s = way.delay_s / 2.0;
  hop.jitter_s = way.jitter_s / 2.0;
  return hop;
}

}  // namespace banyan::udp
