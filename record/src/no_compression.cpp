// SPDX-License-Identifier: MIT
// Stands in for zstd_compression.cpp where there is no zstd.
#include <stdexcept>

#include "compression.hpp"

namespace banyan::record {

int possible_level(int) noexcept { return 0; }
bool reads_zstd() noexcept { return false; }

struct Compressor::Impl {};
Compressor::Compressor() = default;
Compressor::~Compressor() = default;
std::string_view Compressor::compress(std::string_view, int) { throw std::logic_error("built without zstd"); }

struct Decompressor::Impl {};
Decompressor::Decompressor() = default;
Decompressor::~Decompressor() = default;
bool Decompressor::decompress(std::string_view, std::uint64_t, std::string&) { return false; }

}  // namespace banyan::record
