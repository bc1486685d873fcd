// SPDX-License-Identifier: Apache-2.0
// Network, IPC and mount namespaces of a launch's own, for `launch --isolate`; or of some of its processes, for tests
// with faults of the network.
//
// Only the processes enter them, through launch-exec. The launcher stays outside: so its control socket,
// the session daemon that it starts and the commands of its launch file are where they always are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/environment/domain_lease.hpp"
#include "base/files/unique_fd.hpp"
#include "base/processes/spawn.hpp"

namespace launch {

// lo is the only network, unless they are those of a host; multicast works on it. /dev/shm is empty, but for the files
// by which LTTng's session daemon wakes the processes that wait for it; they are made if there are none yet. All other
// files are those of the machine. The namespaces exist as long as this object or a process inside.
class Namespaces {
 public:
  // Makes them, in a user namespace of their own if that is necessary. Must be called while there is one thread.
  // Throws std::system_error where the machine does not allow it.
  static Namespaces make();

  // Each host of a network has namespaces of its own. Their network ends in this descriptor (packet_switch.hpp).
  struct Host;
  // With the number of the host, as make_tap_device() takes it. Otherwise as make().
  static Host make_host(unsigned host);

  // The step of launch-exec that enters them, and the descriptors that the step needs.
  std::string step() const;
  std::vector<ChildDescriptor> descriptors() const;

  // Lets launch-exec start `child` inside. If that fails, the child ends with exit code 127.
  void put_in(ChildProgram& child) const;

 private:
  explicit Namespaces(std::vector<UniqueFd> files) : files_(std::move(files)) {}

  std::vector<UniqueFd> files_;  // in the order in which they have to be entered
};

struct Namespaces::Host {
  Namespaces namespaces;
  UniqueFd device;
};

// What keeps one launch apart from the others of the machine, although all have the same topics: one of both.
struct Isolation {
  std::optional<Namespaces> namespaces;
  std::optional<DomainLease> domain;
  std::string refused;  // why there are no namespaces, of a launch with a domain
};

// Makes namespaces, or leases a ROS domain where they are not allowed. Must be called while there is one thread. Throws
// std::runtime_error when all domains are taken.
Isolation make_isolation();

}  // namespace launch
