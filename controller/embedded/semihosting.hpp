// SPDX-License-Identifier: MIT
// What an emulated (or debugged) chip can ask of the computer that it is run on: ARM semihosting.
#pragma once

#include <cstddef>
#include <cstdint>

namespace banyan::embedded {

inline int ask(int operation, const void* argument) noexcept {
  register int r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

inline void write(const char* text) noexcept { ask(0x04, text); }

// All went well (0x20026), or not (0x20023).
inline void stop(bool well) noexcept { ask(0x18, reinterpret_cast<const void*>(well ? 0x20026 : 0x20023)); }

inline void write_hexadecimal(std::uint64_t value) noexcept {
  char digits[17] = {};
  for (int k = 0; k < 16; ++k) digits[k] = "0123456789abcdef"[value >> (60 - 4 * k) & 0xF];
  write(digits);
}

// The words that the emulator was given for the program. False: none.
inline bool command_line(char* text, std::size_t size) noexcept {
  struct {
    char* text;
    int size;
  } block{text, static_cast<int>(size)};
  return ask(0x15, &block) == 0;
}

}  // namespace banyan::embedded
