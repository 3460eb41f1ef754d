// SPDX-License-Identifier: MIT
// How often the program has taken something from the heap. It counts in programs one source of which includes
// heap_counter.hpp.
#pragma once

#include <atomic>

namespace banyan::test {

inline std::atomic<long> allocations{0};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

}  // namespace banyan::test
