// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_PNM
#include <stb/stb_image.h>

namespace banyan::config {

std::variant<PictureSamples, std::string> read_picture(std::string_view bytes, std::size_t most_pixels) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (bytes.size() > (std::size_t{1} << 30) || stbi_info_from_memory(data, size, &width, &height, &channels) == 0)
    return "is no picture that can be read: PNG, BMP, or PGM and PPM of the binary kind (P5, P6)";
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  if (width <= 0 || height <= 0 || w > most_pixels || h > most_pixels / w)
    return "has " + std::to_string(width) + " x " + std::to_string(height) + " pixels; at most " +
           std::to_string(most_pixels) + " are possible, as of 4096 x 4096";
  const std::unique_ptr<stbi_uc, void (*)(void*)> samples(
      stbi_load_from_memory(data, size, &width, &height, &channels, 0), stbi_image_free);
  if (!samples) return "is a damaged picture, or of a kind that cannot be read";
  const auto n = static_cast<std::size_t>(channels);
  return PictureSamples{w, h, n, std::vector<std::uint8_t>(samples.get(), samples.get() + w * h * n)};
}

}  // namespace banyan::config
