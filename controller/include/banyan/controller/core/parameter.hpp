// SPDX-License-Identifier: MIT
// The table of parameters: one row per number that a designer may set. It drives scenario keys, error messages,
// `banyan algorithms`, tuning and the documents. Lengths are in C, speeds in v_max, times in rounds or drives
// (platform.hpp), so that a number that suits one robot suits any other.
#pragma once

#include <string_view>

namespace banyan {

struct ParameterInfo {
  std::string_view key;      // as in a scenario: "target_gain"
  std::string_view symbol;   // the paper's, "" if it has none
  std::string_view unit;     // "C", "rounds", "drives" ...
  std::string_view meaning;  // one sentence
  std::string_view advice;   // when to change it, and what it costs
  std::string_view source;   // "Table I", "protocol 9" ...
  float minimum;
  float maximum;
  // A length that bodies must fit into: for robots larger than a Khepera IV at 2 m, compared with C, it grows with
  // them.
  bool grows_with_body = false;
};

// A row that knows where its number is.
template <class Params> struct Parameter : ParameterInfo { float Params::*member; };

}  // namespace banyan
