// SPDX-License-Identifier: MIT
// A rule handed to a room as an argument: what to call, without owning it and without heap. It must not
// outlive what it refers to, so it is only ever a parameter.
#pragma once

#include <type_traits>
#include <utility>

namespace banyan {

template <class Signature> class FunctionRef;

// Aligned as BasicVec2 is (vec2.hpp).
template <class Result, class... Arguments> class alignas(2 * sizeof(void*)) FunctionRef<Result(Arguments...)> {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef> && std::is_invocable_r_v<Result, F&, Arguments...>)
      // A lambda is passed where a rule is asked for.
      // NOLINTNEXTLINE(google-explicit-constructor,bugprone-forwarding-reference-overload)
      FunctionRef(F&& f)
  noexcept
      : object_(const_cast<void*>(static_cast<const void*>(&f))),
        call_([](void* object, Arguments... arguments) -> Result {
          return (*static_cast<std::remove_reference_t<F>*>(object))(std::forward<Arguments>(arguments)...);
        }) {}

  Result operator()(Arguments... arguments) const { return call_(object_, std::forward<Arguments>(arguments)...); }

 private:
  void* object_;
  Result (*call_)(void*, Arguments...);
};

}  // namespace banyan
