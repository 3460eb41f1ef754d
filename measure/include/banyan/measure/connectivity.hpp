// SPDX-License-Identifier: MIT
// Whether data could flow between the nodes that the mission names: for what share of the time, and over how many hops.
// With stations these are all stations and targets, unless mission.connect names pairs; without either nothing is
// measured, and the columns are empty.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "banyan/measure/moment.hpp"

namespace banyan::measure {

class Connectivity {
 public:
  struct Row {
    double connected_time_ratio = -1.0;        // all pairs; -1: nothing is asked, here and below
    double least_connected_time_ratio = -1.0;  // of the pair with the least
    std::string least_connected;               // that pair
    std::int64_t disconnections = -1;
    double longest_disconnection_s = -1.0;
    double first_disconnection_s = -1.0;  // -1 as well: there was none
    double last_disconnection_s = -1.0;
    double hops = -1.0;
    double longest_hop_m = -1.0;
  };
  [[nodiscard]] static std::span<const Column<Row>> columns() noexcept;

  Connectivity(const world::World& start, Row& row);
  void observe(const Moment& now, Row& row);
  void sum_up(const Moment& end, Row& row) const;

 private:
  // A station by its robot's index, or a target by its own.
  struct Node {
    std::string name;
    bool target = false;
    std::size_t index = 0;
  };
  struct Pair {
    std::size_t a = 0, b = 0;  // nodes
    std::uint64_t ticks = 0;   // connected
  };
  [[nodiscard]] static std::size_t robot_at(const Node& node, const Moment& now) noexcept;
  void search(const world::World& world, std::size_t from);

  double tick_s_;
  std::vector<Node> nodes_;
  std::vector<Pair> pairs_;  // ascending by the first
  std::uint64_t ticks_ = 0, connected_ = 0, apart_now_ = 0, apart_longest_ = 0;
  double hops_ = 0.0, longest_hops_m_ = 0.0;
  std::uint64_t paths_ = 0;
  // Of the search from one node: the hops to each robot, and the longest link of the best path of so few hops, squared.
  std::vector<std::uint32_t> hops_to_, queue_;
  std::vector<double> longest2_to_;
};

}  // namespace banyan::measure
