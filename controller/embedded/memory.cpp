// SPDX-License-Identifier: MIT
// memcpy and the like. The library's are unrolled for speed, which takes 600 bytes more: too much for what a robot
// moves in a step. (CMakeLists.txt has gcc not take these loops for the calls that they are.)
#include <cstddef>
#include <cstdint>

namespace {

// Wherever they lie: the chip needs no alignment.
struct [[gnu::packed, gnu::may_alias]] Words {
  std::uint32_t first;
  std::uint32_t second;
};

}  // namespace

extern "C" {

void* memcpy(void* to, const void* from, std::size_t bytes) {
  auto* out = static_cast<char*>(to);
  const auto* in = static_cast<const char*>(from);
  for (; bytes >= sizeof(Words); bytes -= sizeof(Words), out += sizeof(Words), in += sizeof(Words))
    *reinterpret_cast<Words*>(out) = *reinterpret_cast<const Words*>(in);
  while (bytes-- > 0) *out++ = *in++;
  return to;
}

// Forwards, memcpy may overlap.
void* memmove(void* to, const void* from, std::size_t bytes) {
  if (to <= from) return memcpy(to, from, bytes);
  while (bytes-- > 0) static_cast<char*>(to)[bytes] = static_cast<const char*>(from)[bytes];
  return to;
}

void* memset(void* to, int value, std::size_t bytes) {
  auto* out = static_cast<char*>(to);
  const std::uint32_t four = 0x01010101U * static_cast<std::uint8_t>(value);
  for (; bytes >= sizeof(Words); bytes -= sizeof(Words), out += sizeof(Words))
    *reinterpret_cast<Words*>(out) = {four, four};
  while (bytes-- > 0) *out++ = static_cast<char>(value);
  return to;
}

}  // extern "C"
