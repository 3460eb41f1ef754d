// SPDX-License-Identifier: MIT
#include "banyan/measure/recovery.hpp"

#include <algorithm>
#include <cmath>

namespace banyan::measure {

Recovery::Recovery(double tick_s, double drive_s, double settle_s)
    : tick_s_{tick_s},
      limit_ticks_{static_cast<std::uint64_t>(std::llround(recovery_limit_drives * drive_s / tick_s))},
      hold_ticks_{
          static_cast<std::uint64_t>(std::llround(std::max(recovery_hold_drives * drive_s, settle_s) / tick_s))} {}

void Recovery::observe(std::uint64_t deaths, bool whole) {
  if (deaths != deaths_) {
    deaths_ = deaths;
    ticks_ = whole_since_ = 0;
    recovered_ = false;
  }
  if (settled()) return;
  ++ticks_;
  if (!whole) whole_since_ = ticks_;
  recovered_ = whole_since_ <= limit_ticks_ && ticks_ > whole_since_ + hold_ticks_;
}

double Recovery::time_s() const noexcept { return recovered_ ? static_cast<double>(whole_since_) * tick_s_ : -1.0; }

bool Recovery::settled() const noexcept { return deaths_ == 0 || recovered_ || whole_since_ > limit_ticks_; }

}  // namespace banyan::measure
