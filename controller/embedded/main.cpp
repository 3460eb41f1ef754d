// SPDX-License-Identifier: MIT
// The smallest firmware around the controller: reset, one static robot per drive and algorithm,
// and the loop. It exists to prove that the controller links without heap, exceptions or an
// operating system and to measure its size; a real robot replaces exercise() by its radio.
// semihosting.cpp adds the output with which an emulated chip reports to the tests.
#include <cstdint>

#include "exercise.hpp"

// Set by cortex-m4.ld.
extern "C" {
extern std::uint32_t data_load, data_begin, data_end, bss_begin, bss_end, stack_top;
using Constructor = void (*)();
extern Constructor constructors_begin, constructors_end;

// A pure virtual call cannot be recovered from; the library's version would pull in the unwinder.
void __cxa_pure_virtual() {
  for (;;) {}
}
[[noreturn]] void reset();
}

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

void reset() {
  // Full access to the floating-point unit (ARMv7-M, CPACR), before the first float.
  auto& cpacr = *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88);
  cpacr = cpacr | 0xFU << 20;
  asm volatile("dsb\n isb");
  const std::uint32_t* from = &data_load;
  for (std::uint32_t* to = &data_begin; to != &data_end;) *to++ = *from++;
  for (std::uint32_t* to = &bss_begin; to != &bss_end;) *to++ = 0;
  for (Constructor* c = &constructors_begin; c != &constructors_end; ++c) (*c)();
  main();
  for (;;) {}
}

// The first two vectors of a Cortex-M: initial stack, reset.
__attribute__((section(".vectors"), used)) const void* const vectors[] = {&stack_top,
                                                                         reinterpret_cast<const void*>(&reset)};
