// SPDX-License-Identifier: Apache-2.0
#include "launcher/run/system_test/test_network.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "launcher/process/isolation/packet_switch.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

TestHosts TestHosts::make(const std::vector<NetworkFault::Member>& members) {
  TestHosts made;
  for (const NetworkFault::Member& member : members) {
    if (std::find(made.names.begin(), made.names.end(), member.name) == made.names.end()) {
      made.names.push_back(member.name);
    }
  }
  if (made.names.size() >= kMostTapHosts) {
    throw std::system_error(E2BIG, std::system_category(), "the processes that faults of the network name");
  }
  for (unsigned host = 1; host <= made.names.size() + 1; ++host) {
    made.hosts.push_back(Namespaces::make_host(host));
  }
  return made;
}

TestNetwork::TestNetwork(EventLoop& loop, TestHosts hosts) : names_(std::move(hosts.names)), switch_(loop) {
  for (Namespaces::Host& host : hosts.hosts) {
    namespaces_.push_back(std::move(host.namespaces));
    switch_.add(std::move(host.device));
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    ports_[names_[i]].insert(i + 1);
  }
}

const Namespaces& TestNetwork::host_of(const ProcessSpec& spec) {
  const std::vector<std::string> names = names_of(spec);
  const auto is_of_process = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto first = std::find_if(names_.begin(), names_.end(), is_of_process);
  if (first == names_.end()) {
    return common_host();
  }
  const PacketSwitch::Port port = static_cast<PacketSwitch::Port>(first - names_.begin()) + 1;
  // A fault may name it by another of its names.
  for (auto other = first; other != names_.end(); other = std::find_if(std::next(other), names_.end(), is_of_process)) {
    ports_[*other].insert(port);
  }
  return namespaces_[port];
}

std::size_t TestNetwork::begin(const NetworkFault& fault) {
  const auto ports_of = [&](const std::vector<NetworkFault::Member>& members) {
    std::set<PacketSwitch::Port> ports;
    for (const NetworkFault::Member& member : members) {
      const auto found = ports_.find(member.name);
      if (found != ports_.end()) {
        ports.insert(found->second.begin(), found->second.end());
      }
    }
    return ports;
  };
  PacketSwitch::Impairment impairment;
  impairment.one = ports_of(fault.group);
  impairment.other = ports_of(fault.from);
  for (PacketSwitch::Port port = 0; fault.from.empty() && port < namespaces_.size(); ++port) {
    if (!impairment.one.contains(port)) {
      impairment.other.insert(port);
    }
  }
  impairment.loss = fault.kind == NetworkFault::Kind::kDelay ? 0 : fault.share;
  impairment.delay = fault.by;
  impairment.seed = fault.seed;
  return switch_.impair(std::move(impairment));
}

}  // namespace launch
