// SPDX-License-Identifier: MIT
// SVG as pixels. The only place that knows librsvg and cairo.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace banyan::cli {

// The family in which text becomes pixels: the one that is installed with the program. Others give way
// to whatever a machine has, and the same recording would give other pictures.
inline constexpr std::string_view raster_font = "DejaVu Sans";

struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bgra;  // four bytes a pixel, rows from the top, nothing between them
};

// The whole picture, as large as fits into width x height px, in the middle; what is left over is
// transparent. Width and height in [1, 32767]. May be called from several threads at once. Throws
// CommandError (exit_lost) if librsvg does not understand the text or memory does not suffice.
[[nodiscard]] Pixels rasterize(std::string_view svg, int width, int height);

// The size in px that an SVG asks for (width and height of its root), rounded. Throws as rasterize().
struct PixelSize {
  int width = 0, height = 0;
};
[[nodiscard]] PixelSize size_of(std::string_view svg);

// As a PNG file. Throws CommandError (exit_lost).
[[nodiscard]] std::string png_of(const Pixels& pixels);

}  // namespace banyan::cli
