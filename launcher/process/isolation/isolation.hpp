// SPDX-License-Identifier: Apache-2.0
// What keeps one launch apart from the others of the machine, although all have the same topics.
#pragma once

#include <optional>
#include <string>

#include "base/environment/domain_lease.hpp"
#include "launcher/process/isolation/namespaces.hpp"

namespace launch {

// One of both.
struct Isolation {
  std::optional<Namespaces> namespaces;
  std::optional<DomainLease> domain;
  std::string refused;  // why there are no namespaces, of a launch with a domain
};

// Makes namespaces, or leases a ROS domain where they are not allowed. Must be called while there is one thread. Throws
// std::runtime_error when all domains are taken.
Isolation make_isolation();

}  // namespace launch
