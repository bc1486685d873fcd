// SPDX-License-Identifier: Apache-2.0
// The network of a test with faults of the network: each process that a fault names has a host of its own, with all of
// its name, and all others share one. Nothing else connects them: no shared memory, and packets pass a switch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "launcher/process/isolation/namespaces.hpp"
#include "launcher/process/isolation/packet_switch.hpp"
#include "launcher/process/process_spec.hpp"
#include "launcher/visit/fault_request.hpp"

namespace launch {

// What must be made while there is one thread.
struct TestHosts {
  std::vector<std::string> names;       // of processes, each once
  std::vector<Namespaces::Host> hosts;  // that of the others, and then one for each name

  // Throws std::system_error where the machine does not allow it.
  static TestHosts make(const std::vector<NetworkFault::Member>& members);
};

class TestNetwork {
 public:
  // The loop must outlive it.
  TestNetwork(EventLoop& loop, TestHosts hosts);

  // Where this process runs.
  const Namespaces& host_of(const ProcessSpec& spec);
  // Where processes run that no fault names.
  const Namespaces& common_host() const { return namespaces_.front(); }

  // From now on. Returns a number for the other two functions.
  std::size_t begin(const NetworkFault& fault);
  void end(std::size_t number) { switch_.mend(number); }
  std::uint64_t packets(std::size_t number) const { return switch_.packets(number); }

 private:
  std::vector<std::string> names_;
  std::vector<Namespaces> namespaces_;  // by the port of the switch
  PacketSwitch switch_;
  std::map<std::string, std::set<PacketSwitch::Port>> ports_;  // of the processes of each name
};

}  // namespace launch
