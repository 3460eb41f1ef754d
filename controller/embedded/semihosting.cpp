// SPDX-License-Identifier: MIT
// Output of an emulated (or debugged) chip: ARM semihosting, `name digest` per line.
#include <cstdint>

namespace {

// ARM semihosting, operations 0x04 (write a string) and 0x18 (stop; 0x20026: all went well).
void call(int operation, const void* argument) noexcept {
  register int r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void write(const char* text) noexcept { call(0x04, text); }

}  // namespace

namespace banyan::embedded {

void report(const char* name, std::uint64_t digest) noexcept {
  char digits[18];
  for (int k = 0; k < 16; ++k) digits[k] = "0123456789abcdef"[digest >> (60 - 4 * k) & 0xF];
  digits[16] = '\n';
  digits[17] = '\0';
  write(name);
  write(" ");
  write(digits);
}

void finish() noexcept { call(0x18, reinterpret_cast<const void*>(0x20026)); }

}  // namespace banyan::embedded
