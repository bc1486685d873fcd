// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/isolation/packet_switch.hpp"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "base/environment/network_device.hpp"

namespace launch {

namespace {

// 10.77.0.HOST/24. Nothing else is in the namespace, so no other network can have these addresses.
constexpr in_addr_t kNetwork = 0x0a4d0000;
constexpr in_addr_t kMask = 0xffffff00;

bool configure(ifreq& device, unsigned host) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket) {
    return false;
  }
  device.ifr_addr = ipv4_address(kNetwork + host);
  if (::ioctl(socket.get(), SIOCSIFADDR, &device) != 0) {
    return false;
  }
  device.ifr_netmask = ipv4_address(kMask);
  return ::ioctl(socket.get(), SIOCSIFNETMASK, &device) == 0 && bring_up(socket.get(), device) &&
         take_multicast(socket.get(), device);
}

}  // namespace

UniqueFd make_tap_device(unsigned host) {
  UniqueFd file(::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC));
  ifreq device{};
  ::strcpy(device.ifr_name, "net0");
  device.ifr_flags = IFF_TAP | IFF_NO_PI;
  if (!file || ::ioctl(file.get(), TUNSETIFF, &device) != 0 || !configure(device, host)) {
    const int error = errno;
    file.reset();
    errno = error;
  }
  return file;
}

namespace {

constexpr std::size_t kAddressSize = 6;
constexpr std::size_t kHeader = 14;  // of a frame: to, from, type
constexpr std::size_t kLargestFrame = 65536;
constexpr int kFramesPerTurn = 64;  // so that timers and output have their turn

// A step of SplitMix64.
std::uint64_t mixed_bits(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

// From 0 to less than 1.
double share_of(std::uint64_t seed, std::uint64_t packet) {
  constexpr unsigned kBitsOfDouble = 53;
  return std::ldexp(static_cast<double>(mixed_bits(mixed_bits(seed) + packet) >> (64U - kBitsOfDouble)),
                    -static_cast<int>(kBitsOfDouble));
}

}  // namespace

PacketSwitch::Port PacketSwitch::add(UniqueFd device) {
  const Port port = devices_.size();
  EventLoop::SourcePtr source = loop_.on_readable(device.get(), [this, port] { receive(port); });
  devices_.push_back({std::move(device), std::move(source)});
  return port;
}

std::size_t PacketSwitch::impair(Impairment impairment) {
  impairments_.push_back({std::move(impairment)});
  return impairments_.size() - 1;
}

void PacketSwitch::mend(std::size_t impairment) {
  impairments_.at(impairment).is_over = true;
}

void PacketSwitch::receive(Port from) {
  std::array<std::uint8_t, kLargestFrame> buffer;
  for (int i = 0; i < kFramesPerTurn; ++i) {
    const ssize_t size = ::read(devices_[from].fd.get(), buffer.data(), buffer.size());
    if (size <= 0) {
      return;
    }
    if (size >= static_cast<ssize_t>(kHeader)) {
      pass(from, Frame(buffer.begin(), buffer.begin() + size));
    }
  }
}

void PacketSwitch::pass(Port from, const Frame& frame) {
  Address to{};
  Address source{};
  std::copy_n(frame.begin(), kAddressSize, to.begin());
  std::copy_n(frame.begin() + kAddressSize, kAddressSize, source.begin());
  known_[source] = from;
  const bool is_for_many = (to[0] & 1U) != 0;
  if (const auto known = known_.find(to); !is_for_many && known != known_.end()) {
    if (known->second != from) {
      send(from, known->second, frame);
    }
    return;
  }
  for (Port port = 0; port < devices_.size(); ++port) {
    if (port != from) {
      send(from, port, frame);
    }
  }
}

void PacketSwitch::send(Port from, Port to, const Frame& frame) {
  Duration delay{0};
  bool is_lost = false;
  for (Active& active : impairments_) {
    const Impairment& what = active.what;
    const bool is_hit =
        (what.one.contains(from) && what.other.contains(to)) || (what.one.contains(to) && what.other.contains(from));
    if (active.is_over || !is_hit) {
      continue;
    }
    ++active.packets;
    is_lost = is_lost || share_of(what.seed, active.packets) < what.loss;
    delay += what.delay;
  }
  if (is_lost) {
    return;
  }
  if (delay == Duration(0)) {
    write(to, frame);
    return;
  }
  const Duration due = loop_.now() + delay;
  const bool is_next = late_.empty() || due < late_.begin()->first;
  late_.emplace(due, Late{to, frame});
  if (is_next) {
    timer_ = loop_.after(delay, [this] { send_late(); });
  }
}

void PacketSwitch::write(Port to, const Frame& frame) const {
  // A device whose queue is full loses packets, as every network does.
  static_cast<void>(!::write(devices_[to].fd.get(), frame.data(), frame.size()));
}

void PacketSwitch::send_late() {
  while (!late_.empty() && late_.begin()->first <= loop_.now()) {
    const auto next = late_.extract(late_.begin());
    write(next.mapped().to, next.mapped().frame);
  }
  timer_.reset();
  if (!late_.empty()) {
    timer_ = loop_.after(late_.begin()->first - loop_.now(), [this] { send_late(); });
  }
}

}  // namespace launch
