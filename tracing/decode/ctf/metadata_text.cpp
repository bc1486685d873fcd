// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/metadata_text.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "tracing/decode/ctf/ctf2_metadata.hpp"
#include "tracing/decode/ctf/trace_class.hpp"

namespace tracing::ctf {
namespace {

constexpr std::uint32_t kMagic = 0x75D11D57;
constexpr std::size_t kHeaderSize = 37;        // bytes
constexpr std::size_t kContentSizePlace = 24;  // of the header, in bits, with the header itself
constexpr std::size_t kPacketSizePlace = 28;   // likewise, with padding
constexpr std::size_t kCompressionPlace = 32;  // this and the two bytes that follow: 0
constexpr std::size_t kVersionPlace = 35;      // major, minor

std::uint32_t word(const std::string& bytes, std::size_t place, bool swapped) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return swapped ? __builtin_bswap32(value) : value;
}

MetadataText translated(const std::string& json, bool is_cut) {
  Ctf2Metadata read = translate_ctf2(json);
  return {std::move(read.text), is_cut || read.is_cut};
}

}  // namespace

MetadataText read_metadata_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw UnsupportedTrace(fmt::format("'{}' can't be opened", file.string()));
  }
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (is_ctf2_metadata(bytes)) {
    return translated(bytes, false);
  }
  if (bytes.size() < sizeof kMagic) {
    return {bytes, true};
  }
  const bool swapped = word(bytes, 0, true) == kMagic;
  if (!swapped && word(bytes, 0, false) != kMagic) {
    return {bytes};
  }

  MetadataText read;
  std::size_t begin = 0;
  while (begin + kHeaderSize <= bytes.size()) {
    if (word(bytes, begin, swapped) != kMagic) {
      throw UnsupportedTrace("a packet of the metadata has no magic number");
    }
    const int major = bytes[begin + kVersionPlace];
    if (major != 2 && (major != 1 || bytes[begin + kVersionPlace + 1] != 8)) {
      throw UnsupportedTrace("the metadata are not CTF 1.8 or 2");
    }
    if (bytes.substr(begin + kCompressionPlace, 3) != std::string(3, '\0')) {
      throw UnsupportedTrace("the metadata are compressed or encrypted");
    }
    const std::size_t content = word(bytes, begin + kContentSizePlace, swapped) / 8;
    const std::size_t size = word(bytes, begin + kPacketSizePlace, swapped) / 8;
    if (content < kHeaderSize || size < content || begin + content > bytes.size()) {
      break;
    }
    read.text.append(bytes, begin + kHeaderSize, content - kHeaderSize);
    begin += size;
  }
  read.is_cut = begin < bytes.size();
  return is_ctf2_metadata(read.text) ? translated(read.text, read.is_cut) : read;
}

std::string read_metadata(const std::filesystem::path& file) {
  return read_metadata_text(file).text;
}

}  // namespace tracing::ctf
