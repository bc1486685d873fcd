// SPDX-License-Identifier: Apache-2.0
#include "graph/entities_layout.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace rmw_fastrtps {
namespace {

using Info = GraphCache::EntitiesInfo;

constexpr std::size_t kEncapsulation = 4;  // bytes; the second one is odd for little endian
constexpr std::size_t kWord = 4;

// Every read says whether there was enough.
class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, GidLength length)
      : bytes_(bytes.subspan(kEncapsulation)),
        swaps_(((bytes[1] & 1) != 0) != (std::endian::native == std::endian::little)),
        gid_(static_cast<std::size_t>(length)) {}

  bool read(std::uint32_t& number) {
    at_ = (at_ + kWord - 1) / kWord * kWord;
    if (left() < kWord) {
      return false;
    }
    std::memcpy(&number, &bytes_[at_], kWord);
    number = swaps_ ? __builtin_bswap32(number) : number;
    at_ += kWord;
    return true;
  }
  bool read(std::string& text) {
    std::uint32_t size = 0;
    if (!read(size) || size == 0 || left() < size || bytes_[at_ + size - 1] != 0) {
      return false;
    }
    text.assign(reinterpret_cast<const char*>(&bytes_[at_]), size - 1);
    at_ += size;
    return true;
  }
  template <typename Gid>
  bool read_gid(Gid& gid) {
    if (left() < gid_) {
      return false;
    }
    std::copy_n(&bytes_[at_], gid.data.size(), gid.data.begin());
    at_ += gid_;
    return true;
  }
  template <typename Gids>
  bool read_gids(Gids& gids) {
    std::uint32_t count = 0;
    if (!read(count) || left() / gid_ < count) {
      return false;
    }
    gids.resize(count);
    for (auto& gid : gids) {
      (void)read_gid(gid);  // there are enough bytes
    }
    return true;
  }
  // But for the bytes that fill the last word.
  bool is_at_end() const { return left() < kWord; }
  std::size_t left() const { return bytes_.size() - std::min(at_, bytes_.size()); }

 private:
  std::span<const std::uint8_t> bytes_;
  bool swaps_;
  std::size_t gid_;
  std::size_t at_ = 0;
};

bool read_all(Reader reader, Info& info) {
  std::uint32_t count = 0;
  if (!reader.read_gid(info.gid) || !reader.read(count) || count > reader.left()) {
    return false;
  }
  info.node_entities_info_seq.resize(count);
  for (auto& node : info.node_entities_info_seq) {
    if (!reader.read(node.node_namespace) || !reader.read(node.node_name) || !reader.read_gids(node.reader_gid_seq) ||
        !reader.read_gids(node.writer_gid_seq)) {
      return false;
    }
  }
  return reader.is_at_end();
}

class Writer {
 public:
  explicit Writer(GidLength length) : gid_(static_cast<std::size_t>(length)) {
    bytes_ = {0, std::endian::native == std::endian::little ? std::uint8_t{1} : std::uint8_t{0}, 0, 0};
  }

  void write(std::size_t number) {
    bytes_.resize((bytes_.size() + kWord - 1) / kWord * kWord);  // the header is a word
    const auto word = static_cast<std::uint32_t>(number);
    std::uint8_t raw[kWord];
    std::memcpy(raw, &word, kWord);
    bytes_.insert(bytes_.end(), raw, raw + kWord);
  }
  void write(const std::string& text) {
    write(text.size() + 1);
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }
  template <typename Gid>
  void write_gid(const Gid& gid) {
    bytes_.insert(bytes_.end(), gid.data.begin(), gid.data.end());
    bytes_.resize(bytes_.size() + gid_ - gid.data.size());
  }
  template <typename Gids>
  void write_gids(const Gids& gids) {
    write(gids.size());
    for (const auto& gid : gids) {
      write_gid(gid);
    }
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::size_t gid_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::optional<ReadEntities> read_entities(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kEncapsulation) {
    return std::nullopt;
  }
  for (const GidLength length : {GidLength::kOfToday, GidLength::kOfHumble}) {
    ReadEntities read;
    read.length = length;
    if (read_all(Reader(bytes, length), read.info)) {
      return read;
    }
  }
  return std::nullopt;
}

std::vector<std::uint8_t> write_entities(const Info& info, GidLength length) {
  Writer writer(length);
  writer.write_gid(info.gid);
  writer.write(info.node_entities_info_seq.size());
  for (const auto& node : info.node_entities_info_seq) {
    writer.write(std::string(node.node_namespace));
    writer.write(std::string(node.node_name));
    writer.write_gids(node.reader_gid_seq);
    writer.write_gids(node.writer_gid_seq);
  }
  return writer.take();
}

}  // namespace rmw_fastrtps
