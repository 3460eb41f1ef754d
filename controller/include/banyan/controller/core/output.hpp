// SPDX-License-Identifier: MIT
#pragma once

#include "banyan/controller/core/inputs.hpp"

namespace banyan {

template <class Message> struct Output {
  Message message;  // to broadcast
  Motion motion;
};

}  // namespace banyan
