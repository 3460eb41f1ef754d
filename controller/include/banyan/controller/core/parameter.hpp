// SPDX-License-Identifier: MIT
// The table of parameters: one row per number that a designer may set. It drives scenario keys, error
// messages, `banyan algorithms`, tuning and the documents.
#pragma once

#include <string_view>

namespace banyan {

// What a length is measured in, and what it grows with.
enum class Scaling : unsigned char {
  none,     // a time, a gain, or a length that does not scale
  mission,  // m; times mission.scale, and for algorithms made for any radio times C / 2 m
  range,    // in units of C; in Params in metres
  body,     // likewise; but bodies do not shrink with the radio: it is never shorter than where C is 2 m, for wheels
            // farther apart or nearer in proportion
};

// The radio for which lengths in Params have their defaults. For another radio, lengths
// that grow with it are multiplied by C / nominal_range_m (algorithm_of.hpp).
inline constexpr float nominal_range_m = 2.0F;

struct ParameterInfo {
  std::string_view key;      // as in a scenario: "target_gain"
  std::string_view symbol;   // the paper's, "" if it has none
  std::string_view unit;     // "m", "s", "C" ...
  std::string_view meaning;  // one sentence
  std::string_view advice;   // when to change it, and what it costs
  std::string_view source;   // "Table I", "protocol 9" ...
  float minimum;
  float maximum;
  Scaling scaling = Scaling::none;
};

// A row that knows where its number is.
template <class Params> struct Parameter : ParameterInfo { float Params::*member; };

}  // namespace banyan
