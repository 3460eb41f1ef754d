// SPDX-License-Identifier: MIT
// Options and files that change what a file says, as changes of its tree. They know no keys: the reader
// judges the result.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "banyan/config/document.hpp"

namespace banyan::config {

// An option that changes a key: "radio.loss=0.3", named "--set radio.loss=0.3" in messages; or a
// file whose keys are laid over the scenario's, such as tuned parameters.
struct Override {
  std::string assignment;
  std::string origin;
  std::string file = {};  // instead of an assignment
};
// Makes the change. Returns what is wrong with it, if anything; throws DocumentError for its file.
[[nodiscard]] std::vector<Problem> apply(Node& root, const Override& change);

// Puts `value` where `key`, a dotted path, says: "radio.loss", "events[0].time_s". Sections that are
// missing are made. Returns what is wrong with the key, if anything.
[[nodiscard]] std::vector<Problem> assign(Node& root, std::string_view key, Node value);

// The same tree as if it came from an option: where a file's keys contradict it, it wins silently.
// Its places still name the file and line.
[[nodiscard]] Node as_option(Node node);

// Lays `changes` over `root`: tables are merged key by key, anything else is replaced.
void overlay(Node& root, Node changes);

}  // namespace banyan::config
