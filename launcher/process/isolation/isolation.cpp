// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/isolation/isolation.hpp"

#include <system_error>

namespace launch {

Isolation make_isolation() {
  Isolation isolation;
  try {
    isolation.namespaces.emplace(Namespaces::make());
  } catch (const std::system_error& error) {
    isolation.refused = error.what();
    isolation.domain.emplace();
  }
  return isolation;
}

}  // namespace launch
