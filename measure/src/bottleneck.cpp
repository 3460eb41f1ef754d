// SPDX-License-Identifier: MIT
#include "banyan/measure/bottleneck.hpp"

#include <algorithm>

namespace banyan::measure {
namespace {

using world::Vec2;

// Whether each place can have a robot of its own that is no farther than some distance (Kuhn's algorithm).
class Matching {
 public:
  Matching(const std::vector<double>& drives, std::size_t robots, std::size_t places)
      : drives_{drives}, robots_{robots}, places_{places} {}

  bool within(double most) {
    most_ = most;
    place_of_.assign(robots_, places_);
    for (std::size_t place = 0; place < places_; ++place) {
      asked_.assign(robots_, 0);
      if (!seat(place)) return false;
    }
    return true;
  }

 private:
  // Depth at most the number of places.
  bool seat(std::size_t place) {
    for (std::size_t robot = 0; robot < robots_; ++robot) {
      if (asked_[robot] != 0 || drives_[place * robots_ + robot] > most_) continue;
      asked_[robot] = 1;
      if (place_of_[robot] != places_ && !seat(place_of_[robot])) continue;
      place_of_[robot] = place;
      return true;
    }
    return false;
  }

  const std::vector<double>& drives_;
  std::size_t robots_, places_;
  double most_ = 0.0;
  std::vector<std::size_t> place_of_;  // by robot; places_: none
  std::vector<char> asked_;
};

}  // namespace

double bottleneck_m(const std::vector<Vec2>& robots, const std::vector<Vec2>& places) {
  if (places.empty()) return 0.0;
  if (robots.size() < places.size()) return -1.0;
  std::vector<double> drives;
  drives.reserve(robots.size() * places.size());
  for (const Vec2 place : places)
    for (const Vec2 robot : robots) drives.push_back(distance(place, robot));
  std::vector<double> steps = drives;
  std::sort(steps.begin(), steps.end());
  Matching matching(drives, robots.size(), places.size());
  return *std::partition_point(steps.begin(), steps.end(), [&](double most) { return !matching.within(most); });
}

}  // namespace banyan::measure
