// SPDX-License-Identifier: MIT
#include <zstd.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "compression.hpp"

namespace banyan::record {

int possible_level(int wanted) noexcept { return wanted; }
bool reads_zstd() noexcept { return true; }

struct Compressor::Impl {
  ZSTD_CCtx* zstd = ZSTD_createCCtx();
  std::string out;
  ~Impl() { ZSTD_freeCCtx(zstd); }
};

Compressor::Compressor() : impl_(std::make_unique<Impl>()) {
  if (impl_->zstd == nullptr) throw std::bad_alloc();
}
Compressor::~Compressor() = default;

std::string_view Compressor::compress(std::string_view data, int level) {
  std::string& out = impl_->out;
  out.resize(ZSTD_compressBound(data.size()));
  const std::size_t size = ZSTD_compressCCtx(impl_->zstd, out.data(), out.size(), data.data(), data.size(), level);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  return {out.data(), size};
}

struct Decompressor::Impl {
  ZSTD_DCtx* zstd = ZSTD_createDCtx();
  ~Impl() { ZSTD_freeDCtx(zstd); }
};

Decompressor::Decompressor() : impl_(std::make_unique<Impl>()) {
  if (impl_->zstd == nullptr) throw std::bad_alloc();
}
Decompressor::~Decompressor() = default;

// Grows with the actual output, so that a forged size costs no memory.
bool Decompressor::decompress(std::string_view data, std::uint64_t size, std::string& into) {
  ZSTD_DCtx_reset(impl_->zstd, ZSTD_reset_session_only);
  ZSTD_inBuffer in{data.data(), data.size(), 0};
  std::size_t filled = 0;
  into.resize(std::min<std::uint64_t>(size, 4 * data.size() + 4096));
  for (;;) {
    ZSTD_outBuffer out{into.data(), into.size(), filled};
    const std::size_t result = ZSTD_decompressStream(impl_->zstd, &out, &in);
    if (ZSTD_isError(result) != 0) return false;
    const bool progress = out.pos > filled || result == 0;
    filled = out.pos;
    if (result == 0) break;
    if (filled == into.size()) {
      if (filled >= size) return false;
      into.resize(std::min<std::uint64_t>(size, 2 * into.size()));
    } else if (!progress || in.pos == in.size) {
      return false;  // the compressed data end too early
    }
  }
  return filled == size && in.pos == in.size;
}

}  // namespace banyan::record
