// SPDX-License-Identifier: MIT
// The smallest firmware around the controller: one static robot per drive and algorithm, and the loop
// (startup.cpp). It exists to prove that the controller links without heap, exceptions or an
// operating system and to measure its size; a real robot replaces exercise() by its radio.
// semihosting.cpp adds the output with which an emulated chip reports to the tests.
#include <cstdint>

#include "exercise.hpp"

// What is done with the results: nothing, unless semihosting.cpp is linked, too.
namespace banyan::embedded {
[[gnu::weak]] void report(const char*, std::uint64_t) noexcept {}
[[gnu::weak]] void finish() noexcept {}
}  // namespace banyan::embedded

namespace {
constinit banyan::embedded::Memory robot;  // in RAM from the start: a robot's memory is known when it is built
}  // namespace

int main() {
  banyan::embedded::exercise_all(robot, banyan::embedded::report);
  banyan::embedded::finish();
  return 0;
}
