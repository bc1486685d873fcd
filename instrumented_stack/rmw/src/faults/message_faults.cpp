// SPDX-License-Identifier: Apache-2.0
#include "faults/message_faults.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>

namespace rmw_fastrtps {

namespace {

using rmw_message_faults::Fault;
using rmw_message_faults::Side;
using rmw_message_faults::Table;

// The faults of this process. It is never unmapped: delayed messages outlive endpoints.
struct OwnFaults {
  std::vector<Fault*> faults;
  int wake = -1;
};

// A step of SplitMix64: neighbouring seeds give numbers that have nothing in common.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15U;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

// Null with a message if the file is no table.
Table* map_table(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  struct stat status {};
  void* memory = MAP_FAILED;
  if (file >= 0 && ::fstat(file, &status) == 0 && static_cast<std::size_t>(status.st_size) >= sizeof(Table)) {
    memory = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  }
  const int error = errno;
  if (file >= 0) {
    ::close(file);
  }
  if (memory == MAP_FAILED) {
    const bool is_short = file >= 0 && static_cast<std::size_t>(status.st_size) < sizeof(Table);
    std::fprintf(stderr, "[rmw] the faults of $%s cannot be read: '%s': %s\n", variable_of_faults(), path.c_str(),
                 is_short ? "it is too short" : std::strerror(error));
    return nullptr;
  }
  auto* const table = static_cast<Table*>(memory);
  if (table->magic != Table::kMagic || table->size_of_fault != sizeof(Fault) ||
      Table::size_for(table->count) > static_cast<std::size_t>(status.st_size)) {
    std::fprintf(stderr, "[rmw] the faults of $%s cannot be read: '%s' was written by another version\n",
                 variable_of_faults(), path.c_str());
    return nullptr;
  }
  return table;
}

OwnFaults read_own_faults() {
  OwnFaults own;
  const char* const value = std::getenv(variable_of_faults());
  const std::string_view text = value == nullptr ? "" : value;
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) {
    return own;
  }
  const std::string path(text.substr(colon + 1));
  Table* const table = map_table(path);
  if (table == nullptr) {
    return own;
  }
  std::string_view numbers = text.substr(0, colon);
  while (!numbers.empty()) {
    std::size_t number = 0;
    const char* const end = std::from_chars(numbers.data(), numbers.data() + numbers.size(), number).ptr;
    if (number >= 1 && number <= table->count) {
      own.faults.push_back(table->faults() + (number - 1));
    }
    numbers.remove_prefix(std::min(numbers.size(), static_cast<std::size_t>(end - numbers.data()) + 1));
  }
  // Opened for reading, too, the pipe has a reader whatever happens to the launcher.
  own.wake = ::open((path + rmw_message_faults::kWakeSuffix).c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  return own;
}

const OwnFaults& own_faults() {
  static const OwnFaults* const own = new OwnFaults(read_own_faults());
  return *own;
}

// The number of this hit among those of the fault, from 0; nullopt if the message is not hit.
std::optional<std::uint64_t> hit_by(const Fault& fault, std::uint64_t message) {
  if (message < fault.first || (message - fault.first) % fault.every != 0) {
    return std::nullopt;
  }
  const std::uint64_t number = (message - fault.first) / fault.every;
  return fault.count == 0 || number < fault.count ? std::optional(number) : std::nullopt;
}

void note_hit(Fault& fault) {
  timespec now{};
  (void)::clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t time = now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
  std::int64_t none = 0;
  fault.first_time.compare_exchange_strong(none, time);
  fault.latest_time = time;
  ++fault.hit;
  const char byte = 0;
  // A full pipe wakes the launcher as well.
  (void)!::write(own_faults().wake, &byte, 1);
}

}  // namespace

std::unique_ptr<MessageFaults> MessageFaults::of(Side side, const std::string& topic, const std::string& node) {
  std::vector<Fault*> faults;
  for (Fault* const fault : own_faults().faults) {
    if (fault->side == side && fault->topic == topic && (fault->node[0] == '\0' || fault->node == node)) {
      faults.push_back(fault);
    }
  }
  return faults.empty() ? nullptr : std::make_unique<MessageFaults>(std::move(faults));
}

bool MessageFaults::leave_out(rmw_message_faults::Kind kind) {
  return std::erase_if(faults_, [kind](const Fault* fault) { return fault->kind == kind; }) != 0;
}

MessageFate MessageFaults::next() {
  using rmw_message_faults::Kind;
  MessageFate fate;
  for (Fault* const fault : faults_) {
    if (fault->is_armed == 0) {
      continue;
    }
    const std::optional<std::uint64_t> hit = hit_by(*fault, ++fault->seen);
    if (!hit) {
      continue;
    }
    switch (fault->kind) {
      case Kind::kDrop:
        fate.is_dropped = true;
        break;
      case Kind::kDuplicate:
        ++fate.copies;
        break;
      case Kind::kCorrupt:
        fate.corruptions.push_back(mixed(fault->seed + *hit));
        break;
      case Kind::kDelay:
        fate.delay += std::chrono::nanoseconds(fault->delay);
        break;
    }
    note_hit(*fault);
  }
  return fate;
}

void corrupt(std::uint8_t* message, std::size_t size, std::uint64_t seed) {
  constexpr std::size_t kHeader = 4;
  constexpr std::size_t kPart = 64;
  for (std::size_t begin = kHeader; begin < size; begin += kPart) {
    const std::size_t length = std::min(kPart, size - begin);
    seed = mixed(seed);
    constexpr std::uint64_t kOtherValues = 255;
    message[begin + seed % length] ^= static_cast<std::uint8_t>(1 + (seed >> 32U) % kOtherValues);
  }
}

}  // namespace rmw_fastrtps
