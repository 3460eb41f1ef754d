// SPDX-License-Identifier: MIT
// A component with m leaves and s hubs has m + s - 1 branches; if their edges add up to n, it has n - (m - 1) relays.
// So n is raised from its lower bound, the length of the Steiner tree, until some topology can be laid out.
#include "full_component.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "discs.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;
using LeafSet = unsigned;

int edges_for(double length) noexcept { return std::max(0, static_cast<int>(std::ceil(length - 1e-8))); }

// Some leaves with whole numbers of edges to a hub of their own, and where that hub can be.
struct Bunch {
  std::vector<int> hops;
  int sum = 0;
  CommonRegion place;
};

class Layouts {
 public:
  Layouts(const std::vector<Vec2>& terminals, const std::vector<double>& lengths, int edges, Tries& tries)
      : leaves_{terminals}, lengths_{lengths}, edges_{edges}, tries_{tries} {}

  // One in which the branches have just that many edges, if there is one, and the tries suffice to find it.
  FullComponent find() {
    const int m = static_cast<int>(leaves_.size());
    const LeafSet all = (1U << m) - 1U;
    if (one_hub(all)) return found_;
    for (LeafSet first = 1; first < all && m >= 4; ++first) {
      const LeafSet rest = all & ~first;
      const int in = std::popcount(first), out = std::popcount(rest);
      if (in == 2 && out >= 2 && (out > 2 || first < rest) && two_hubs(first, rest)) return found_;
    }
    for (int middle = 0; m == 5 && middle < m; ++middle) {
      const LeafSet others = all & ~(1U << middle);
      for (LeafSet first = 1; first < others; ++first) {
        const LeafSet last = others & ~first;
        if ((first & ~others) == 0 && std::popcount(first) == 2 && first < last && three_hubs(first, middle, last))
          return found_;
      }
    }
    return {};
  }

 private:
  bool one_hub(LeafSet all) {
    const std::vector<Bunch> bunches = bunches_of(all, edges_, edges_);
    if (bunches.empty()) return false;
    const Bunch& bunch = bunches.front();
    tie(all, bunch, add_hub(bunch.place.nearest(leaves_.front())));
    return true;
  }

  bool two_hubs(LeafSet first, LeafSet second) {
    const std::vector<Bunch> near = bunches_of(first, 2, edges_ - 1 - needed(second));
    const std::vector<Bunch> far = bunches_of(second, 2, edges_ - 1 - needed(first));
    for (const Bunch& a : near) {
      for (const Bunch& b : far) {
        const int middle = edges_ - a.sum - b.sum;
        if (middle < 1) continue;
        if (--tries_.left < 0) return false;
        const Nearest hubs = nearest(a.place, b.place);
        if (distance(hubs.a, hubs.b) > middle + touch) continue;
        const int one = tie(first, a, add_hub(hubs.a)), other = tie(second, b, add_hub(hubs.b));
        found_.branches.push_back({one, other, middle});
        return true;
      }
    }
    return false;
  }

  bool three_hubs(LeafSet first, int middle, LeafSet last) {
    const std::vector<Bunch> near = bunches_of(first, 2, edges_ - beyond(last | 1U << middle));
    const std::vector<Bunch> far = bunches_of(last, 2, edges_ - beyond(first | 1U << middle));
    const Vec2 leaf = leaves_[static_cast<std::size_t>(middle)];
    for (const Bunch& a : near) {
      const int a_way = edges_for(distance(leaf, a.place.nearest(leaf)));
      for (const Bunch& b : far) {
        if (--tries_.left < 0) return false;
        const int left = edges_ - a.sum - b.sum;
        const int b_way = edges_for(distance(leaf, b.place.nearest(leaf)));
        if (left < 3 || left < std::max(a_way, b_way) + 1) continue;
        const Nearest ends = nearest(a.place, b.place);
        const int apart = edges_for(distance(ends.a, ends.b));
        for (int up = 1; up <= left - std::max(2, apart); ++up)
          for (int to_a = std::max(1, a_way - up); left - up - to_a >= std::max(1, b_way - up); ++to_a)
            if (--tries_.left < 0) return false;
            else if (meet({first, &a, to_a}, middle, up, {last, &b, left - up - to_a})) return true;
      }
    }
    return false;
  }

  struct End {
    LeafSet leaves;
    const Bunch* bunch;
    int hops;
  };
  bool meet(const End& a, int middle, int up, const End& b) {
    const RangeDisc about{leaves_[static_cast<std::size_t>(middle)], static_cast<double>(up)};
    const auto hub = between(about, a.bunch->place, a.hops, b.bunch->place, b.hops);
    if (!hub) return false;
    const int center = add_hub(*hub);
    found_.branches.push_back({middle, center, up});
    for (const End& end : {a, b}) {
      const int outer = tie(end.leaves, *end.bunch, add_hub(end.bunch->place.nearest(*hub)));
      found_.branches.push_back({center, outer, end.hops});
    }
    return true;
  }

  int add_hub(Vec2 at) {
    found_.hubs.push_back(at);
    return static_cast<int>(leaves_.size() + found_.hubs.size()) - 1;
  }
  int tie(LeafSet leaves, const Bunch& bunch, int hub) {
    auto hops = bunch.hops.begin();
    for (int i = 0; i < static_cast<int>(leaves_.size()); ++i)
      if ((leaves >> i & 1U) != 0) found_.branches.push_back({i, hub, *hops++});
    return hub;
  }

  // Edges without which these leaves are not joined.
  [[nodiscard]] int needed(LeafSet leaves) const noexcept {
    return std::max(std::popcount(leaves), edges_for(lengths_[leaves]));
  }
  // The same for the middle leaf and those at the far end of three hubs, with the branches that join the hubs.
  [[nodiscard]] int beyond(LeafSet leaves) const noexcept {
    return std::max(std::popcount(leaves) + 2, edges_for(lengths_[leaves]) + 1);
  }

  // All with a sum in this range whose hub has a place.
  [[nodiscard]] std::vector<Bunch> bunches_of(LeafSet leaves, int least, int most) const {
    std::vector<Bunch> found;
    std::vector<int> hops;
    extend(leaves, hops, 0, {least, most}, found);
    return found;
  }
  struct Sums {
    int least, most;
  };
  void extend(LeafSet left, std::vector<int>& hops, int sum, Sums wanted, std::vector<Bunch>& found) const {
    if (left == 0) {
      if (sum < wanted.least || --tries_.left < 0) return;
      std::vector<RangeDisc> discs;
      for (std::size_t k = 0; k < hops.size(); ++k) discs.push_back({chosen_[k], static_cast<double>(hops[k])});
      CommonRegion place(std::move(discs));
      if (!place.empty()) found.push_back({hops, sum, std::move(place)});
      return;
    }
    const int leaf = std::countr_zero(left);
    const LeafSet all = (1U << leaves_.size()) - 1U, rest = left & (left - 1);
    chosen_[hops.size()] = leaves_[static_cast<std::size_t>(leaf)];
    // Without the leaf and its branch the others are still joined.
    const int most =
        std::min(edges_ - edges_for(lengths_[all & ~(1U << leaf)]), wanted.most - sum - std::popcount(rest));
    for (int n = rest == 0 ? std::max(1, wanted.least - sum) : 1; n <= most && !tries_.used_up(); ++n) {
      if (!meets_others(hops, n)) continue;
      hops.push_back(n);
      extend(rest, hops, sum + n, wanted, found);
      hops.pop_back();
    }
  }
  [[nodiscard]] bool meets_others(const std::vector<int>& hops, int n) const noexcept {
    for (std::size_t k = 0; k < hops.size(); ++k)
      if (distance(chosen_[k], chosen_[hops.size()]) > hops[k] + n + touch) return false;
    return true;
  }

  const std::vector<Vec2>& leaves_;
  const std::vector<double>& lengths_;
  int edges_;
  Tries& tries_;
  FullComponent found_;
  mutable std::array<Vec2, most_leaves> chosen_{};
};

}  // namespace

int relays_between(Vec2 a, Vec2 b) noexcept { return std::max(0, edges_for(distance(a, b)) - 1); }

FullComponent full_component(const std::vector<Vec2>& terminals, const std::vector<double>& lengths, int most_relays,
                             Tries& tries) {
  const int m = static_cast<int>(terminals.size());
  if (m == 2) {
    const int relays = relays_between(terminals[0], terminals[1]);
    return relays > most_relays ? FullComponent{} : FullComponent{{}, {{0, 1, relays + 1}}, relays};
  }
  for (int edges = std::max(m, edges_for(lengths.back())); edges - (m - 1) <= most_relays && !tries.used_up();
       ++edges) {
    FullComponent found = Layouts(terminals, lengths, edges, tries).find();
    if (found.branches.empty()) continue;
    found.relays = edges - (m - 1);
    return found;
  }
  return {};
}

}  // namespace banyan::measure
