// SPDX-License-Identifier: Apache-2.0
// Connects networks that have a TAP device as their only way out, and lets packets between some of them get lost or
// come late.
//
// It does in this process what a bridge and a network emulator do in the kernel, so it needs neither, nor privileges
// beyond those for the devices. What gets lost is drawn from a seed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "launcher/process/event_loop.hpp"

namespace launch {

// A TAP device is a network device whose packets a program carries. Hosts of one network have numbers from 1 to this.
constexpr unsigned kMostTapHosts = 250;

// Makes it in the network namespace of this thread, with an address for this host, and sends all multicast through it.
// Its descriptor reads and writes Ethernet frames and does not block; the device ends with it. Without a value, errno
// says why.
UniqueFd make_tap_device(unsigned host);

class PacketSwitch {
 public:
  using Port = std::size_t;

  // What happens to packets between ports of `one` and ports of `other`, in both directions.
  struct Impairment {
    std::set<Port> one;
    std::set<Port> other;
    double loss = 0;  // the part of the packets that gets lost, from 0 to 1
    Duration delay{0};
    std::uint64_t seed = 0;  // of what gets lost
  };

  // The loop must outlive this object.
  explicit PacketSwitch(EventLoop& loop) : loop_(loop) {}
  PacketSwitch(const PacketSwitch&) = delete;
  PacketSwitch& operator=(const PacketSwitch&) = delete;

  // A descriptor that reads and writes Ethernet frames. Ports count from 0.
  Port add(UniqueFd device);

  // From now on. Several add up. Returns a number for the other two functions.
  std::size_t impair(Impairment impairment);
  void mend(std::size_t impairment);
  // The packets that it has hit so far.
  std::uint64_t packets(std::size_t impairment) const { return impairments_.at(impairment).packets; }

 private:
  using Address = std::array<std::uint8_t, 6>;
  using Frame = std::vector<std::uint8_t>;

  struct Device {
    UniqueFd fd;
    EventLoop::SourcePtr source;
  };
  struct Active {
    Impairment what;
    bool is_over = false;
    std::uint64_t packets = 0;
  };
  struct Late {
    Port to;
    Frame frame;
  };

  void receive(Port from);
  void pass(Port from, const Frame& frame);
  void send(Port from, Port to, const Frame& frame);
  void write(Port to, const Frame& frame) const;
  void send_late();

  EventLoop& loop_;
  std::vector<Device> devices_;
  std::map<Address, Port> known_;  // where an address was seen
  std::vector<Active> impairments_;
  std::multimap<Duration, Late> late_;  // by the time when it is sent
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
