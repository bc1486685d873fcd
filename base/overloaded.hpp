// SPDX-License-Identifier: Apache-2.0
// One function object of several lambdas, for std::visit.
#pragma once

namespace launch {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace launch
