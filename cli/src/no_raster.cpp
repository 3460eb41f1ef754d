// SPDX-License-Identifier: MIT
// Stands in for raster.cpp where there is no librsvg.
#include "beside.hpp"
#include "raster.hpp"

namespace banyan::cli {
namespace {

[[noreturn]] void refuse() { throw built_without("a picture in pixels", "librsvg", "librsvg2-dev and pkgconf"); }

}  // namespace

Pixels rasterize(std::string_view /*svg*/, int /*width*/, int /*height*/) { refuse(); }
PixelSize size_of(std::string_view /*svg*/) { refuse(); }
std::string png_of(const Pixels& /*pixels*/) { refuse(); }

}  // namespace banyan::cli
