// SPDX-License-Identifier: MIT
// For the browser, which has no files.
#include "picture.hpp"

namespace banyan::config {

std::variant<PictureSamples, std::string> read_picture(std::string_view /*bytes*/, std::size_t /*most_pixels*/) {
  return "cannot be read in the browser: `banyan validate --show toml` writes a scenario with the cells in it";
}

}  // namespace banyan::config
