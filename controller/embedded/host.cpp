// SPDX-License-Identifier: MIT
// The same exercise on this machine; ./check compares what both print, bit by bit.
#include <cinttypes>
#include <cstdio>

#include "exercise.hpp"

int main() {
  static banyan::embedded::Memory robot;
  banyan::embedded::exercise_all(
      robot, [](const char* name, std::uint64_t digest) noexcept { std::printf("%s %016" PRIx64 "\n", name, digest); });
  return 0;
}
