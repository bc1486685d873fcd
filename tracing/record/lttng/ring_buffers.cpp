// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/lttng/ring_buffers.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "base/files/unique_fd.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

// The description of a buffer, version 0.0 and 1.0: lttng_crash_abi in LTTng-UST's frontend_types.h.
struct Description {
  std::array<std::uint8_t, 16> magic;
  std::uint64_t length;
  std::uint16_t byte_order;
  std::uint16_t major;
  std::uint16_t minor;
  std::uint8_t word_size;
  std::uint8_t kind;
  struct {
    std::uint32_t produced;
    std::uint32_t consumed;
    std::uint32_t commits;  // the array of the commit counters of the sub-buffers
    std::uint32_t consecutive_commits;
    std::uint32_t writers;  // which memory the writers use for a sub-buffer
    std::uint32_t writer_id;
    std::uint32_t memories;
    std::uint32_t memory;
    std::uint32_t memory_begin;
    std::uint32_t content_size;
    std::uint32_t packet_size;
  } __attribute__((packed)) offset;
  std::array<std::uint8_t, 8> lengths;
  struct {
    std::uint32_t commits;
    std::uint32_t writers;
    std::uint32_t memories;
  } __attribute__((packed)) stride;
  std::uint64_t size;
  std::uint64_t subbuffer_size;
  std::uint64_t subbuffer_count;
  std::uint32_t mode;
} __attribute__((packed));

constexpr std::array<std::uint8_t, 16> kMagic = {0x17, 0x7B, 0xF1, 0x77, 0xBF, 0x17, 0x7B, 0xF1,
                                                 0x77, 0xBF, 0x17, 0x7B, 0xF1, 0x77, 0xBF, 0x17};
constexpr std::uint16_t kByteOrder = 0x1234;

// What LTTng-UST writes at the beginning of each packet of events (CTF 1.8, and the same in CTF 2).
struct PacketHeader {
  std::uint32_t magic;
  std::array<std::uint8_t, 16> uuid;
  std::uint32_t stream;
  std::uint64_t stream_instance;
  std::uint64_t begin;
  std::uint64_t end;
  std::uint64_t content_size;
  std::uint64_t packet_size;
  std::uint64_t sequence_number;
  std::uint64_t discarded_events;
  std::uint32_t processor;
} __attribute__((packed));

constexpr std::uint32_t kPacketMagic = 0xC1FC1FC1;

// A thread needs less than a microsecond for an event, and leaves the processor to another one now and then.
constexpr int kLooks = 50;

std::string as_text(const std::array<std::uint8_t, 16>& uuid) {
  std::string text;
  for (std::size_t i = 0; i < uuid.size(); ++i) {
    text += fmt::format("{}{:02x}", i == 4 || i == 6 || i == 8 || i == 10 ? "-" : "", uuid[i]);
  }
  return text;
}

class RingBuffer {
 public:
  // Nothing if the file is no buffer of events of this machine's word size.
  static std::optional<RingBuffer> open(const fs::path& path);

  std::vector<OpenPacket> open_packets() const;

 private:
  RingBuffer(launch::UniqueFd file, std::uint64_t inode, const Description& about)
      : file_(std::move(file)), inode_(inode), about_(about) {}

  template <typename Value>
  bool read(std::uint64_t at, Value& value) const {
    return pread(file_.get(), &value, sizeof value, static_cast<off_t>(at)) == ssize_t{sizeof value};
  }
  std::uint64_t word(std::uint64_t at) const {
    std::uint64_t value = 0;
    read(at, value);
    return value;
  }
  std::uint64_t index_of(std::uint64_t position) const { return position % about_.size / about_.subbuffer_size; }
  // Whether it has an event that is not complete, or one that was completed while we looked.
  bool may_be_open(std::uint64_t position) const;
  std::optional<PacketHeader> header_of(std::uint64_t position) const;

  launch::UniqueFd file_;
  std::uint64_t inode_;
  Description about_;
};

std::optional<RingBuffer> RingBuffer::open(const fs::path& path) {
  launch::UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  Description about{};
  if (!file || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      pread(file.get(), &about, sizeof about, 0) != ssize_t{sizeof about}) {
    return std::nullopt;
  }
  // The counter of all commits stands before that of the consecutive ones.
  const bool known = about.magic == kMagic && about.byte_order == kByteOrder && about.major <= 1 && about.minor == 0 &&
                     about.kind == 0 && about.word_size == sizeof(std::uint64_t) &&
                     about.offset.consecutive_commits == sizeof(std::uint64_t) &&
                     about.offset.content_size == offsetof(PacketHeader, content_size) &&
                     about.offset.packet_size == offsetof(PacketHeader, packet_size) && about.subbuffer_size != 0 &&
                     about.subbuffer_count != 0 && about.size == about.subbuffer_size * about.subbuffer_count;
  if (!known) {
    return std::nullopt;
  }
  return RingBuffer(std::move(file), status.st_ino, about);
}

// The counter of commits of a sub-buffer goes on through all its packets. An event that is committed between our two
// looks makes it seem open, never complete.
bool RingBuffer::may_be_open(std::uint64_t position) const {
  const std::uint64_t committed = word(about_.offset.commits + index_of(position) * about_.stride.commits);
  const std::uint64_t produced = word(about_.offset.produced);
  const std::uint64_t before = position / about_.size * about_.subbuffer_size;
  const std::uint64_t reserved = std::min(produced - position, about_.subbuffer_size);
  return committed < before + reserved;
}

std::optional<PacketHeader> RingBuffer::header_of(std::uint64_t position) const {
  constexpr std::uint64_t kIndex = 0xFFFFFFFF;  // the other half of the word has flags
  const std::uint64_t memory =
      word(about_.offset.writers + index_of(position) * about_.stride.writers + about_.offset.writer_id) & kIndex;
  const std::uint64_t description =
      word(about_.offset.memories + memory * about_.stride.memories + about_.offset.memory);
  PacketHeader header{};
  const bool there = read(word(description + about_.offset.memory_begin), header) && header.magic == kPacketMagic;
  return there ? std::optional(header) : std::nullopt;
}

std::vector<OpenPacket> RingBuffer::open_packets() const {
  std::vector<OpenPacket> open;
  const std::uint64_t produced = word(about_.offset.produced);
  std::uint64_t position = word(about_.offset.consumed) / about_.subbuffer_size * about_.subbuffer_size;
  for (; position < produced && produced - position <= about_.size; position += about_.subbuffer_size) {
    bool is_open = true;
    for (int look = 0; look < kLooks && is_open; ++look) {
      is_open = may_be_open(position);
      if (is_open) {
        sched_yield();
      }
    }
    const std::optional<PacketHeader> header = is_open ? header_of(position) : std::nullopt;
    if (header) {
      open.push_back({.buffer = inode_,
                      .position = position,
                      .trace = as_text(header->uuid),
                      .processor = header->processor,
                      .begin = header->begin});
    }
  }
  return open;
}

}  // namespace

std::vector<OpenPacket> open_packets(const std::vector<pid_t>& consumers) {
  std::vector<OpenPacket> open;
  for (const pid_t consumer : consumers) {
    std::error_code error;
    fs::directory_iterator entry(fmt::format("/proc/{}/fd", consumer), error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      std::error_code gone;
      if (!fs::read_symlink(entry->path(), gone).string().starts_with("/dev/shm/")) {
        continue;
      }
      if (const std::optional<RingBuffer> buffer = RingBuffer::open(entry->path())) {
        const std::vector<OpenPacket> found = buffer->open_packets();
        open.insert(open.end(), found.begin(), found.end());
      }
    }
  }
  return open;
}

}  // namespace tracing
