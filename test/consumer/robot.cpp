// SPDX-License-Identifier: MIT
// A robot of its own: one step of the installed controller without the rest of the house.
#include <banyan/controller/controller.hpp>

int main() {
  const banyan::Policy* policy = banyan::find_policy("outwards");
  if (policy == nullptr) return 1;
  const banyan::Params params = policy->defaults(banyan::Reading::corrected);
  banyan::State state = banyan::initial_state(7, false, true);
  const banyan::Output output = banyan::step(params, *policy, state, {}, {}, nullptr);
  return output.message.id == 7 && banyan::decode(banyan::encode(output.message)) == output.message ? 0 : 2;
}
