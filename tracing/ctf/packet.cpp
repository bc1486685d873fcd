// SPDX-License-Identifier: Apache-2.0
#include "tracing/ctf/packet.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "tracing/ctf/structure_decoder.hpp"

namespace tracing::ctf {
namespace {

constexpr std::uint32_t kMagic = 0xC1FC1FC1;
constexpr std::uint64_t kByte = 8;  // bits

const Field* member(const Field& structure, std::string_view name) {
  for (std::size_t i = 0; i < structure.type->members.size(); ++i) {
    if (structure.type->members[i].name == name) return &structure.children[i];
  }
  return nullptr;
}

std::optional<std::uint64_t> number(const Field& structure, std::string_view name) {
  const Field* const field = member(structure, name);
  if (field == nullptr || field->type->kind != FieldKind::kInteger) return std::nullopt;
  return field->raw();
}

bool sizes_contradict(const Packet& packet) {
  return packet.size_bits < packet.content_bits || packet.content_bits < packet.events_bit ||
         packet.size_bits % kByte != 0;
}

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat status {};
    if (file_ < 0 || fstat(file_, &status) != 0) {
      const int error = errno;
      if (file_ >= 0) close(file_);
      throw std::system_error(error, std::generic_category(), path.string());
    }
    size_ = static_cast<std::size_t>(status.st_size);
    posix_fadvise(file_, 0, 0, POSIX_FADV_RANDOM);  // what is between the headers is not needed
  }
  ~OpenFile() { close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::size_t size() const { return size_; }
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
  std::size_t size_ = 0;
};

// The end of the header, in bits. Where the packet does not tell its sizes, they stay as they are.
std::uint64_t read_header(const TraceClass& trace, Packet& packet, std::uint64_t limit, FieldArena& arena) {
  std::uint64_t at = 0;
  std::vector<FieldScope> scopes;
  Field header;
  if (trace.packet_header) {
    header = decode_structure(*trace.packet_header, packet.begin, 0, limit, scopes, arena, at);
    if (number(header, "magic").value_or(kMagic) != kMagic) throw DamagedPacket("it has no magic number");
    packet.stream_id = number(header, "stream_id").value_or(0);
    packet.stream_instance_id = number(header, "stream_instance_id");
    scopes.push_back({"trace.packet.header", &header});
  }
  const auto stream = trace.streams.find(packet.stream_id);
  if (stream == trace.streams.end()) throw DamagedPacket(fmt::format("it has the unknown stream {}", packet.stream_id));
  if (!stream->second.packet_context) return at;
  const Field context = decode_structure(*stream->second.packet_context, packet.begin, at, limit, scopes, arena, at);
  packet.content_bits = number(context, "content_size").value_or(packet.content_bits);
  packet.size_bits = number(context, "packet_size").value_or(packet.content_bits);
  packet.time_begin = number(context, "timestamp_begin");
  packet.time_end = number(context, "timestamp_end");
  packet.sequence_number = number(context, "packet_seq_num");
  packet.discarded_events = number(context, "events_discarded");
  if (const Field* const cpu = member(context, "cpu_id")) packet.cpu_id = cpu->integer();
  return at;
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw std::system_error(errno, std::generic_category(), path.string());
  struct stat status {};
  void* mapped = nullptr;
  const bool known = fstat(file, &status) == 0;
  if (known && status.st_size > 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    mapped = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
  }
  const int error = errno;
  close(file);
  if (!known || mapped == MAP_FAILED) throw std::system_error(error, std::generic_category(), path.string());
  begin_ = static_cast<const std::uint8_t*>(mapped);
  if (mapped != nullptr) madvise(mapped, size_, MADV_SEQUENTIAL);
}

MappedFile::~MappedFile() {
  if (begin_ != nullptr) munmap(const_cast<std::uint8_t*>(begin_), size_);
}

void MappedFile::forget(const std::uint8_t* begin, const std::uint8_t* end) const {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t first = (static_cast<std::size_t>(begin - begin_) + page - 1) / page * page;
  const std::size_t last = static_cast<std::size_t>(end - begin_) / page * page;
  if (first < last) madvise(const_cast<std::uint8_t*>(begin_) + first, last - first, MADV_DONTNEED);
}

PacketList find_packets(const TraceClass& trace, const MappedFile& file) {
  constexpr std::size_t kForget = 1 << 20;  // bytes; touching a header also reads the pages around it
  PacketList list;
  FieldArena arena;
  std::size_t forgotten = 0;
  for (std::size_t at = 0; at < file.size();) {
    Packet packet;
    packet.file = &file;
    packet.begin = file.begin() + at;
    const std::uint64_t limit = (file.size() - at) * kByte;
    arena.reset();
    try {
      packet.content_bits = packet.size_bits = limit;
      packet.events_bit = read_header(trace, packet, limit, arena);
    } catch (const DamagedPacket& damage) {
      list.problem = fmt::format("the packet at byte {}: {}", at, damage.what());
      return list;
    }
    if (sizes_contradict(packet)) {
      list.problem = fmt::format("the packet at byte {}: its sizes contradict each other", at);
      return list;
    }
    if (packet.size_bits > limit) {
      packet.is_cut = packet.content_bits > limit;
      packet.content_bits = std::min(packet.content_bits, limit);
      list.problem = fmt::format("the packet at byte {} ends behind the end of the file", at);
      list.packets.push_back(packet);
      return list;
    }
    list.packets.push_back(packet);
    at += packet.size_bits / kByte;
    if (at - forgotten >= kForget) {
      file.forget(file.begin() + forgotten, file.begin() + at);
      forgotten = at;
    }
  }
  return list;
}

PacketList find_packet_headers(const TraceClass& trace, const std::filesystem::path& path,
                               const std::function<bool()>& give_up) {
  constexpr std::size_t kMostBytes = 4096;  // of a header
  const OpenFile file(path);
  PacketList list;
  FieldArena arena;
  std::vector<std::uint8_t> header(kMostBytes + sizeof(std::uint64_t));  // numbers are read as whole words
  for (std::size_t at = 0; at < file.size();) {
    if (give_up && give_up()) {
      list.problem = "the reading was given up";
      return list;
    }
    Packet packet;
    packet.begin = header.data();
    packet.content_bits = packet.size_bits = (file.size() - at) * kByte;
    const std::uint64_t limit = packet.size_bits;
    const ssize_t got = file.read(header.data(), std::min(kMostBytes, file.size() - at), at);
    if (got <= 0) {
      list.problem =
          fmt::format("the packet at byte {}: {}", at, got < 0 ? std::strerror(errno) : "the file has ended");
      return list;
    }
    arena.reset();
    try {
      packet.events_bit = read_header(trace, packet, static_cast<std::uint64_t>(got) * kByte, arena);
    } catch (const DamagedPacket& damage) {
      list.problem = fmt::format("the packet at byte {}: {}", at, damage.what());
      return list;
    }
    packet.begin = nullptr;
    if (sizes_contradict(packet)) {
      list.problem = fmt::format("the packet at byte {}: its sizes contradict each other", at);
      return list;
    }
    if (packet.size_bits > limit) {
      list.problem = fmt::format("the packet at byte {} ends behind the end of the file", at);
      return list;
    }
    list.packets.push_back(packet);
    at += packet.size_bits / kByte;
  }
  return list;
}

}  // namespace tracing::ctf
