// SPDX-License-Identifier: MIT
// A link of the page (viewer/src/link.ts) as an experiment: a scenario, changes of its keys, and what was done to it at
// which tick. Only the link's text is read; nothing is fetched.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "banyan/config/config.hpp"

namespace banyan::cli {

// "http://somewhere/page/#scenario=rooms&seed=3", "#rooms": what is before the # does not matter.
[[nodiscard]] bool is_link(std::string_view text);

struct LoadedLink {
  config::Loaded loaded;  // the first of the runs side by side
  std::size_t runs = 1;   // how many the link shows
  std::string fragment;   // from the # on, for the page
};

// Never throws for bad input: what is wrong is among the problems. `more` comes after the link's own changes.
[[nodiscard]] LoadedLink load_link(const std::string& link, const std::vector<config::Override>& more = {});

}  // namespace banyan::cli
