// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/packet.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "tracing/decode/ctf/structure_decoder.hpp"

namespace tracing::ctf {
namespace {

constexpr std::uint32_t kMagic = 0xC1FC1FC1;
constexpr std::uint64_t kByte = 8;           // bits
constexpr std::size_t kReadAhead = 1 << 18;  // bytes

const Field* member(const Field& structure, std::string_view name) {
  for (std::size_t i = 0; i < structure.type->members.size(); ++i) {
    if (structure.type->members[i].name == name) {
      return &structure.children[i];
    }
  }
  return nullptr;
}

std::optional<std::uint64_t> number(const Field& structure, std::string_view name) {
  const Field* const field = member(structure, name);
  if (field == nullptr || field->type->kind != FieldKind::kInteger) {
    return std::nullopt;
  }
  return field->raw();
}

bool sizes_contradict(const Packet& packet) {
  return packet.size_bits < packet.content_bits || packet.content_bits < packet.events_bit ||
         packet.size_bits % kByte != 0;
}

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ >= 0 && fstat(file_, &status_) == 0) {
      return;
    }
    const int error = errno;
    if (file_ >= 0) {
      close(file_);
    }
    throw std::system_error(error, std::generic_category(), path.string());
  }
  ~OpenFile() { close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  const struct stat& status() const { return status_; }
  void advise(std::size_t at, std::size_t count, int advice) const {
    posix_fadvise(file_, static_cast<off_t>(at), static_cast<off_t>(count), advice);
  }
  // How many bytes were read; 0 or less at the end and after an error.
  ssize_t read(std::uint8_t* to, std::size_t count, std::size_t at) const {
    ssize_t got = 0;
    do {
      got = pread(file_, to, count, static_cast<off_t>(at));
    } while (got < 0 && errno == EINTR);
    return got;
  }

 private:
  int file_;
  struct stat status_ {};
};

// The end of the header, in bits. Where the packet does not tell its sizes, they stay as they are.
std::uint64_t read_header(const TraceClass& trace, const std::uint8_t* begin, std::uint64_t limit, FieldArena& arena,
                          Packet& packet) {
  std::uint64_t at = 0;
  std::vector<FieldScope> scopes;
  Field header;
  if (trace.packet_header) {
    header = decode_structure(*trace.packet_header, begin, 0, limit, scopes, arena, at);
    if (number(header, "magic").value_or(kMagic) != kMagic) {
      throw DamagedPacket("it has no magic number");
    }
    packet.stream_id = number(header, "stream_id").value_or(0);
    packet.stream_instance_id = number(header, "stream_instance_id");
    scopes.push_back({"trace.packet.header", &header});
  }
  const auto stream = trace.streams.find(packet.stream_id);
  if (stream == trace.streams.end()) {
    throw UndescribedPacket(fmt::format("it has the unknown stream {}", packet.stream_id));
  }
  if (!stream->second.packet_context) {
    return at;
  }
  const Field context = decode_structure(*stream->second.packet_context, begin, at, limit, scopes, arena, at);
  packet.content_bits = number(context, "content_size").value_or(packet.content_bits);
  packet.size_bits = number(context, "packet_size").value_or(packet.content_bits);
  packet.time_begin = number(context, "timestamp_begin");
  packet.time_end = number(context, "timestamp_end");
  packet.sequence_number = number(context, "packet_seq_num");
  packet.discarded_events = number(context, "events_discarded");
  if (const Field* const cpu = member(context, "cpu_id")) {
    packet.cpu_id = cpu->integer();
  }
  return at;
}

}  // namespace

StreamFile::StreamFile(std::filesystem::path path) : path_(std::move(path)) {
  const OpenFile file(path_);
  size_ = static_cast<std::size_t>(file.status().st_size);
  device_ = file.status().st_dev;
  inode_ = file.status().st_ino;
}

void StreamFile::read(std::uint8_t* to, std::size_t count, std::size_t at) const {
  try {
    const OpenFile file(path_);
    if (file.status().st_dev != device_ || file.status().st_ino != inode_) {
      throw DamagedPacket("another file has taken the place of this file");
    }
    const std::size_t begin = at;
    while (count > 0) {
      const ssize_t got = file.read(to, count, at);
      if (got < 0) {
        throw DamagedPacket(std::strerror(errno));
      }
      if (got == 0) {
        throw DamagedPacket("the file has become shorter meanwhile");
      }
      to += got;
      at += static_cast<std::size_t>(got);
      count -= static_cast<std::size_t>(got);
    }
    if (begin == 0 || begin / kReadAhead != at / kReadAhead) {
      file.advise(at, 2 * kReadAhead, POSIX_FADV_WILLNEED);
    }
  } catch (const std::system_error& error) {
    throw DamagedPacket(error.code().message());
  }
}

PacketList find_packets(const TraceClass& trace, const StreamFile& file, const std::function<bool()>& give_up) {
  constexpr std::size_t kMostBytes = 4096;  // of a header
  const OpenFile open_file(file.path());
  open_file.advise(0, 0, POSIX_FADV_RANDOM);  // what is between the headers is not needed
  PacketList list;
  FieldArena arena;
  std::vector<std::uint8_t> header(kMostBytes + sizeof(std::uint64_t));  // numbers are read as whole words
  const auto stop = [&](std::size_t at, const std::string& problem) {
    list.problem = fmt::format("the packet at byte {}{}", at, problem);
  };
  for (std::size_t at = 0; at < file.size();) {
    if (give_up && give_up()) {
      list.problem = "the reading was given up";
      return list;
    }
    const std::uint64_t limit = (file.size() - at) * kByte;
    const ssize_t got = open_file.read(header.data(), std::min(kMostBytes, file.size() - at), at);
    if (got <= 0) {
      stop(at, fmt::format(": {}", got < 0 ? std::strerror(errno) : "the file has become shorter meanwhile"));
      return list;
    }
    Packet packet;
    packet.file = &file;
    packet.offset = at;
    packet.content_bits = packet.size_bits = limit;
    arena.reset();
    try {
      packet.events_bit = read_header(trace, header.data(), static_cast<std::uint64_t>(got) * kByte, arena, packet);
    } catch (const UndescribedPacket& damage) {
      list.is_undescribed = true;
      stop(at, fmt::format(": {}", damage.what()));
      return list;
    } catch (const DamagedPacket& damage) {
      list.is_short = file.size() - at < kMostBytes;
      stop(at, fmt::format(": {}", damage.what()));
      return list;
    }
    if (sizes_contradict(packet)) {
      stop(at, ": its sizes contradict each other");
      return list;
    }
    if (packet.size_bits > limit) {
      packet.is_cut = packet.content_bits > limit;
      packet.content_bits = std::min(packet.content_bits, limit);
      list.packets.push_back(packet);
      list.ends_early = list.is_short = true;
      stop(at, " ends behind the end of the file");
      return list;
    }
    list.packets.push_back(packet);
    at += packet.size_bits / kByte;
  }
  return list;
}

}  // namespace tracing::ctf
