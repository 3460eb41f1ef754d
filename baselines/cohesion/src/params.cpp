// SPDX-License-Identifier: MIT
#include "banyan/baselines/cohesion/params.hpp"

namespace banyan::baselines::cohesion {
namespace {

constexpr Parameter<Params> of_cohesion[] = {
    {{"lattice_gain", "", "", "cohesion: gain of the forces that space neighbours evenly",
      "Larger keeps robots farther apart where the boundary presses them together.", "cohesion", 0.0F, 100.0F},
     &Params::lattice_gain},
    {{"boundary_gain", "", "", "cohesion: tension of the boundary",
      "Larger straightens the swarm's arms sooner, and presses it together.", "cohesion", 0.0F, 100.0F},
     &Params::boundary_gain},
    {{"leader_gain", "", "", "cohesion: how much robots inside the swarm move with leaders that are near",
      "Zero: they are drawn by the boundary alone.", "cohesion", 0.0F, 100.0F},
     &Params::leader_gain},
    {{"help_gain", "", "", "cohesion: pull towards a leader with fewer than three neighbours",
      "Larger brings robots sooner to a leader that is about to be lost.", "cohesion", 0.0F, 100.0F},
     &Params::help_gain},
    {{"density_gain", "", "", "cohesion: gain of the forces from dense to sparse places inside the swarm",
      "Larger fills gaps sooner; too large swings.", "cohesion", 0.0F, 100.0F},
     &Params::density_gain},
    {{"desired_density", "", "", "cohesion: robots in a square as wide as the longest link",
      "Less makes the swarm larger, and its links longer.", "cohesion", 0.1F, 15.0F},
     &Params::desired_density},
    {{"thickness_gain", "", "", "cohesion: how much thick places draw the boundary in",
      "Larger gives up width for length sooner.", "cohesion", 0.0F, 100.0F},
     &Params::thickness_gain},
};

}  // namespace

Params defaults() noexcept { return {}; }

std::span<const Parameter<Params>> parameters() noexcept { return of_cohesion; }

std::string_view fault(const Params&) noexcept { return {}; }

}  // namespace banyan::baselines::cohesion
