// SPDX-License-Identifier: MIT
#include "banyan/baselines/fiedler/params.hpp"

namespace banyan::baselines::fiedler {
namespace {

constexpr Parameter<Params> of_fiedler[] = {
    {{"weight_width", "sigma", "C", "fiedler: a link of length d weighs exp(-d^2 / (2 sigma^2))",
      "Smaller gives way sooner where links get long; larger leaves more weight on the longest link, which goes all at "
      "once when the link breaks.",
      "fiedler", 0.1F, 1.0F},
     &Params::weight_width},
    {{"least_connectivity", "epsilon", "", "fiedler: lambda_2 is to stay above this",
      "Larger is safer and holds the network together more closely; a chain of N robots has about (pi / N)^2 times the "
      "weight of its links.",
      "fiedler", 0.0F, 100.0F},
     &Params::least_connectivity},
    {{"connectivity_gain", "", "", "fiedler: gain of the gradient of coth(lambda_2 - epsilon)",
      "Larger gives way sooner, and lets targets pull less far.", "fiedler", 0.0F, 100.0F},
     &Params::connectivity_gain},
    {{"settling_rounds", "", "rounds", "fiedler: workers wait this long for the first estimate",
      "The sources begin with an estimate that has converged.", "fiedler", 0.0F, 36000.0F},
     &Params::settling_rounds},
    {{"iteration_rate", "", "",
      "fiedler: step of the power iteration, divided by the largest weighted degree of any robot",
      "If it is faster than the averages that it needs, it oscillates.", "fiedler", 0.001F, 0.5F},
     &Params::iteration_rate},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_fiedler; }

std::string_view fault(const Params&) noexcept { return {}; }

}  // namespace banyan::baselines::fiedler
