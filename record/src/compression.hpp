// SPDX-License-Identifier: MIT
// Chunks of a recording made smaller: by zstd, or, where there is no zstd (in the browser, or on a machine without it),
// not at all.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace banyan::record {

// The level that is used when `wanted` is asked for: itself, or 0 (stored as it is) without zstd.
[[nodiscard]] int possible_level(int wanted) noexcept;

// Whether chunks that zstd has compressed can be read.
[[nodiscard]] bool reads_zstd() noexcept;

class Compressor {
 public:
  Compressor();
  ~Compressor();
  // `data` at a level above 0, valid until the next call. Throws std::runtime_error with the reason.
  [[nodiscard]] std::string_view compress(std::string_view data, int level);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class Decompressor {
 public:
  Decompressor();
  ~Decompressor();
  // Replaces `into`; false unless `data` are sound and come to exactly `size` bytes.
  [[nodiscard]] bool decompress(std::string_view data, std::uint64_t size, std::string& into);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::record
