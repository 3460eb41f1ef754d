// SPDX-License-Identifier: MIT
// How regular the robots' clocks are: a histogram of the time between their steps, of a size that does not grow.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace banyan::udp {

class Periods {
 public:
  void add(std::uint32_t period_us) {
    ++bins_[std::min<std::size_t>(period_us / bin_us, bins_.size() - 1)];
    ++count_;
    longest_us_ = std::max(longest_us_, period_us);
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  // The period that this share of them does not exceed, ms, to 0.1 ms; those of a second and longer count as the
  // longest. 0 without any.
  [[nodiscard]] double quantile_ms(double share) const noexcept {
    const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(count_));
    std::uint64_t below = 0;
    for (std::size_t k = 0; k + 1 < bins_.size(); ++k) {
      below += bins_[k];
      if (below > wanted || (below == count_ && count_ > 0))
        return std::min((static_cast<double>(k) + 0.5) * bin_us, static_cast<double>(longest_us_)) / 1000.0;
    }
    return longest_us_ / 1000.0;
  }
  [[nodiscard]] double longest_ms() const noexcept { return longest_us_ / 1000.0; }

 private:
  static constexpr std::uint32_t bin_us = 100;
  std::vector<std::uint64_t> bins_ = std::vector<std::uint64_t>(10'001);  // the last: a second and longer
  std::uint64_t count_ = 0;
  std::uint32_t longest_us_ = 0;
};

}  // namespace banyan::udp
