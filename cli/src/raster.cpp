// SPDX-License-Identifier: MIT
#include "raster.hpp"

#include <cairo.h>
#include <dlfcn.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "terminal.hpp"

namespace banyan::cli {

namespace {

[[noreturn]] void fail(const std::string& why) {
  throw CommandError(exit_lost, "the picture cannot be turned into pixels: " + why);
}

// A function of librsvg or cairo. They bring forty libraries along, which take longer to load than most commands take:
// so the first picture does that.
template <class Function> Function* loaded(const char* name) {
  void* const library = ::dlopen("librsvg-2.so.2", RTLD_LAZY);
  void* const function = library == nullptr ? nullptr : ::dlsym(library, name);
  if (function == nullptr) fail(::dlerror());
  return reinterpret_cast<Function*>(function);
}

struct Unref {
  void operator()(RsvgHandle* handle) const { loaded<decltype(g_object_unref)>("g_object_unref")(handle); }
  void operator()(cairo_surface_t* surface) const {
    loaded<decltype(cairo_surface_destroy)>("cairo_surface_destroy")(surface);
  }
  void operator()(cairo_t* context) const { loaded<decltype(cairo_destroy)>("cairo_destroy")(context); }
  void operator()(GError* error) const { loaded<decltype(g_error_free)>("g_error_free")(error); }
};
using Handle = std::unique_ptr<RsvgHandle, Unref>;
using Surface = std::unique_ptr<cairo_surface_t, Unref>;
using Context = std::unique_ptr<cairo_t, Unref>;

std::string words_of(GError* error) {
  const std::unique_ptr<GError, Unref> owned(error);
  return owned ? owned->message : "unknown reason";
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) fail(loaded<decltype(cairo_status_to_string)>("cairo_status_to_string")(status));
}

Handle parse(std::string_view svg) {
  GError* error = nullptr;
  Handle handle(loaded<decltype(rsvg_handle_new_from_data)>("rsvg_handle_new_from_data")(
      reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (!handle) fail(words_of(error));
  return handle;
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Pixels rasterize(std::string_view svg, int width, int height) {
  const Handle handle = parse(svg);
  Pixels pixels{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
  // A row of 32-bit pixels has no padding, and on the little-endian machines that we know their bytes
  // are blue, green, red, alpha.
  const Surface surface(loaded<decltype(cairo_image_surface_create_for_data)>("cairo_image_surface_create_for_data")(
      pixels.bgra.data(), CAIRO_FORMAT_ARGB32, width, height, 4 * width));
  check(loaded<decltype(cairo_surface_status)>("cairo_surface_status")(surface.get()));
  const Context context(loaded<decltype(cairo_create)>("cairo_create")(surface.get()));
  check(loaded<decltype(cairo_status)>("cairo_status")(context.get()));
  const RsvgRectangle whole{0.0, 0.0, static_cast<double>(width), static_cast<double>(height)};
  GError* error = nullptr;
  if (loaded<decltype(rsvg_handle_render_document)>("rsvg_handle_render_document")(handle.get(), context.get(), &whole,
                                                                                   &error) == 0)
    fail(words_of(error));
  loaded<decltype(cairo_surface_flush)>("cairo_surface_flush")(surface.get());
  check(loaded<decltype(cairo_status)>("cairo_status")(context.get()));
  return pixels;
}

PixelSize size_of(std::string_view svg) {
  const Handle handle = parse(svg);
  double width = 0.0, height = 0.0;
  if (loaded<decltype(rsvg_handle_get_intrinsic_size_in_pixels)>("rsvg_handle_get_intrinsic_size_in_pixels")(
          handle.get(), &width, &height) == 0)
    fail("it has no size");
  return {static_cast<int>(std::lround(width)), static_cast<int>(std::lround(height))};
}

std::string png_of(const Pixels& pixels) {
  // cairo only reads them, but has no way to say so.
  auto* bytes = const_cast<std::uint8_t*>(pixels.bgra.data());
  const Surface surface(loaded<decltype(cairo_image_surface_create_for_data)>("cairo_image_surface_create_for_data")(
      bytes, CAIRO_FORMAT_ARGB32, pixels.width, pixels.height, 4 * pixels.width));
  check(loaded<decltype(cairo_surface_status)>("cairo_surface_status")(surface.get()));
  std::string png;
  check(loaded<decltype(cairo_surface_write_to_png_stream)>("cairo_surface_write_to_png_stream")(surface.get(), append,
                                                                                                 &png));
  return png;
}

}  // namespace banyan::cli
