// SPDX-License-Identifier: MIT
// A robot of the tree that runs low advertises a post beside itself and costs more as a parent; so it is relieved like
// any other. What it holds it hands over. A spare that runs low goes to be charged.
#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

constexpr float full = 0.98F;
constexpr float per_c = 0.02F;  // of a full battery, for each C to the place
constexpr float most_way = 0.24F;
constexpr float sooner = 0.35F;  // all have started full, and are not to leave at once
constexpr unsigned turns = 16;

const Token* nearest_place(const State& self) noexcept {
  const Token* best = nullptr;
  for (const Token& t : self.known())
    if (t.charging && t.located && (best == nullptr || norm(t.place) < norm(best->place))) best = &t;
  return best;
}

}  // namespace

void watch_charge(Robot& robot, const Inputs<Heard>& inputs) noexcept {
  State& self = robot.self;
  const Params& p = robot.params;
  if (!inputs.charge()) return;
  self.level = inputs.charge()->level;
  self.was_charged |= inputs.charge()->charging;
  const Token* const place = nearest_place(self);
  bool keeps_place = false;
  for (const Token& t : self.known()) keeps_place |= t.name == self.serves && t.charging;
  if (self.role == Role::spare) {
    self.leaving = self.level < p.charge_below;
    self.seeks_charge = place != nullptr && self.level < (self.seeks_charge ? full : p.charge_below);
    return;
  }
  self.seeks_charge = false;
  const float least = p.relieve_below + (place == nullptr ? 0.0F : std::min(per_c * norm(place->place), most_way));
  const unsigned turn = self.id * 37U % turns;  // so that ids next to each other are far apart
  const float below = self.was_charged ? least
                                       : std::min(least + sooner * static_cast<float>(turn) / turns,
                                                  std::max(least, p.charge_below - 0.05F));
  self.leaving = !keeps_place && self.level < (self.leaving ? full : below);
}

const Token* charging_place(const Robot& robot) noexcept {
  return robot.self.seeks_charge ? nearest_place(robot.self) : nullptr;
}

int heir(const Robot& robot) noexcept {
  constexpr float beside = 0.3F;  // C
  const Table& table = robot.table();
  const Vec2* const target = robot.self.target();
  const Vec2 place = target == nullptr ? Vec2{} : *target;
  return least_of(table.size(), target == nullptr ? beside : robot.params.arrival_distance, [&](int k) {
    const Statement& m = robot.said(k);
    const bool may = table.age(k) == 0 && !m.leaving && m.role == Role::spare;
    return may ? distance(table.position(k), place) : not_counted;
  });
}

}  // namespace banyan::caravan
