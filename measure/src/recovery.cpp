// SPDX-License-Identifier: MIT
#include "banyan/measure/recovery.hpp"

#include <cmath>

namespace banyan::measure {

Recovery::Recovery(double tick_s)
    : tick_s_{tick_s},
      limit_ticks_{static_cast<std::uint64_t>(std::llround(recovery_limit_s / tick_s))},
      hold_ticks_{static_cast<std::uint64_t>(std::llround(recovery_hold_s / tick_s))} {}

void Recovery::observe(std::uint64_t deaths, bool whole) {
  if (deaths != deaths_) {
    deaths_ = deaths;
    whole_.clear();
    recovered_ = false;
  }
  if (settled()) return;
  whole_.push_back(whole ? 1 : 0);
  if (!whole || whole_.size() <= hold_ticks_) return;
  const std::uint64_t then = whole_.size() - 1 - hold_ticks_;
  if (whole_[then] == 0) return;
  recovered_ = true;
  recovery_ticks_ = then;
}

double Recovery::time_s() const noexcept {
  return recovered_ ? static_cast<double>(recovery_ticks_) * tick_s_ : -1.0;
}

bool Recovery::settled() const noexcept {
  return deaths_ == 0 || recovered_ || whole_.size() > limit_ticks_ + hold_ticks_;
}

}  // namespace banyan::measure
