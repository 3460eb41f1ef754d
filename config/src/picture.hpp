// SPDX-License-Identifier: MIT
// A picture file as pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace banyan::config {

struct PictureSamples {
  std::size_t width = 0, height = 0;
  std::size_t channels = 0;           // 1: grey, 2: with alpha, 3: red, green, blue, 4: with alpha
  std::vector<std::uint8_t> samples;  // from the top left, row by row, the channels of a pixel side by side
  [[nodiscard]] bool has_alpha() const noexcept { return channels % 2 == 0; }
};

// PNG, BMP, or PGM and PPM of the binary kind, of at most `most_pixels`; or what is wrong with it, for messages.
[[nodiscard]] std::variant<PictureSamples, std::string> read_picture(std::string_view bytes, std::size_t most_pixels);

}  // namespace banyan::config
