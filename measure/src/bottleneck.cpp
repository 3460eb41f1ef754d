// SPDX-License-Identifier: MIT
#include "banyan/measure/bottleneck.hpp"

#include <algorithm>
#include <utility>

namespace banyan::measure {
namespace {

using world::Vec2;

constexpr std::size_t most_drives = 20'000'000;  // places times robots: some seconds, 320 MB

// Whether each place can have a robot of its own that is no farther than some distance (Kuhn's algorithm). Whoever has
// a place within a distance that is too short for all has one within a longer one, too: the search goes on from there.
class Matching {
 public:
  Matching(const std::vector<double>& drives, std::size_t robots, std::size_t places)
      : drives_{drives}, robots_{robots}, places_{places}, seated_(robots, places) {}

  bool within(double most) {
    most_ = most;
    place_of_ = seated_;
    for (std::size_t place = count_; place < places_; ++place) {
      asked_.assign(robots_, 0);
      if (seat(place)) continue;
      seated_ = place_of_;
      count_ = place;
      return false;
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
  std::vector<std::size_t> seated_;    // the same, of the first count_ places within the longest distance too short
  std::size_t count_ = 0;
  std::vector<char> asked_;
};

// Those that are among the nearest of some place, as many for each as there are places: no place needs another one,
// since the other places leave it one of these.
std::vector<Vec2> worth_asking(const std::vector<Vec2>& robots, const std::vector<Vec2>& places) {
  std::vector<std::pair<double, std::size_t>> by_drive(robots.size());
  std::vector<char> asked(robots.size(), 0);
  for (const Vec2 place : places) {
    for (std::size_t robot = 0; robot < robots.size(); ++robot)
      by_drive[robot] = {squared_norm(robots[robot] - place), robot};
    const auto end = by_drive.begin() + static_cast<std::ptrdiff_t>(places.size());
    std::nth_element(by_drive.begin(), end - 1, by_drive.end());
    std::for_each(by_drive.begin(), end, [&](const auto& near) { asked[near.second] = 1; });
  }
  std::vector<Vec2> list;
  for (std::size_t robot = 0; robot < robots.size(); ++robot)
    if (asked[robot] != 0) list.push_back(robots[robot]);
  return list;
}

}  // namespace

double bottleneck_m(const std::vector<Vec2>& all_robots, const std::vector<Vec2>& places) {
  if (places.empty()) return 0.0;
  if (all_robots.size() < places.size()) return -1.0;
  if (places.size() > most_drives / all_robots.size()) return -1.0;
  const std::vector<Vec2> robots = worth_asking(all_robots, places);
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
