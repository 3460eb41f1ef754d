// SPDX-License-Identifier: MIT
// From reset to main(): what a program on a Cortex-M needs before its first line.
#include <cstdint>

// Set by sections.ld.
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

int main();

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
__attribute__((section(".vectors"), used))
const void* const vectors[] = {&stack_top, reinterpret_cast<const void*>(&reset)};
