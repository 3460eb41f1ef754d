// SPDX-License-Identifier: MIT
// SVG as pixels: the right colours at the right places, also from several threads.
#include "raster.hpp"

#include <gtest/gtest.h>

#include <future>

#include "banyan/record/draw.hpp"
#include "banyan/record/palette.hpp"
#include "sample.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

std::uint32_t rgb(const Pixels& pixels, int x, int y) {
  const std::uint8_t* p = &pixels.bgra[4 * (static_cast<std::size_t>(y) * pixels.width + x)];
  return static_cast<std::uint32_t>(p[2] << 16 | p[1] << 8 | p[0]);
}

constexpr const char* halves =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"10\">"
    "<rect width=\"10\" height=\"10\" fill=\"#d55e00\"/><rect x=\"10\" width=\"10\" height=\"10\" "
    "fill=\"#0072b2\"/></svg>";

TEST(Raster, ColoursAreWhereTheyWereDrawn) {
  EXPECT_EQ(size_of(halves).width, 20);
  EXPECT_EQ(size_of(halves).height, 10);
  const Pixels pixels = rasterize(halves, 40, 20);
  EXPECT_EQ(pixels.bgra.size(), 40U * 20U * 4U);
  EXPECT_EQ(rgb(pixels, 5, 10), 0xD55E00U);
  EXPECT_EQ(rgb(pixels, 35, 10), 0x0072B2U);
  EXPECT_EQ(pixels.bgra[3], 255);
  // Of another shape: in the middle, and nothing around it.
  const Pixels tall = rasterize(halves, 20, 40);
  EXPECT_EQ(tall.bgra[3], 0);
  EXPECT_EQ(rgb(tall, 5, 20), 0xD55E00U);
}

TEST(Raster, APngHasItsSizeInItsHeader) {
  const std::string png = png_of(rasterize(halves, 300, 150));
  ASSERT_GT(png.size(), 33U);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1A\n");
  const auto number = [&](std::size_t at) {
    return static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
  };
  EXPECT_EQ(number(16), 300);
  EXPECT_EQ(number(20), 150);
}

TEST(Raster, WhatIsNoPictureIsSaidInWords) {
  for (const char* text : {"", "no picture", "<svg xmlns=\"http://www.w3.org/2000/svg\"><rect", "<html/>"}) {
    try {
      (void)rasterize(text, 10, 10);
      ADD_FAILURE() << text;
    } catch (const CommandError& error) {
      EXPECT_EQ(error.exit_code, exit_lost);
      EXPECT_NE(std::string(error.what()).find("cannot be turned into pixels: "), std::string::npos);
    }
  }
}

// The picture of a frame, text included, is the same from any thread at any time.
TEST(Raster, ThreadsGiveTheSamePixels) {
  record::PictureOptions look;
  look.font = raster_font;
  look.width_px = 400.0;
  look.height_px = 300.0;
  const std::string svg =
      record::draw_svg(record::test::sample_setting(), record::test::sample_frame(30, 3.0, 300), {}, look);
  const Pixels first = rasterize(svg, 400, 300);
  std::vector<std::future<Pixels>> others;
  others.reserve(8);
  for (int k = 0; k < 8; ++k)
    others.push_back(std::async(std::launch::async, [&svg] { return rasterize(svg, 400, 300); }));
  for (auto& other : others) EXPECT_EQ(other.get().bgra, first.bgra);
  // There is text, not empty boxes of a missing font: ink where the title stands.
  int dark = 0;
  for (int y = 12; y < 32; ++y) {
    for (int x = 24; x < 120; ++x) dark += (rgb(first, x, y) & 0xFFU) < 0x80U ? 1 : 0;
  }
  EXPECT_GT(dark, 100);
  EXPECT_LT(dark, 1200);
}

}  // namespace
}  // namespace banyan::cli
