// SPDX-License-Identifier: Apache-2.0
#include "launcher/visit/requests.hpp"

namespace launch {

std::size_t Requests::count() const {
  std::size_t count = 0;
  for_each_kind(*this, [&](const auto& kind) { count += kind.size(); });
  return count;
}

}  // namespace launch
