// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/page/column_buffer.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>
#include <random>

namespace tracing {
namespace {

std::string decoded_base64(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') {
      break;
    }
    value = value << 6 | static_cast<unsigned>(kDigits.find(c));
    if ((bits += 6) >= 8) {
      bytes += static_cast<char>(value >> (bits -= 8));
    }
  }
  return bytes;
}

std::string decompressed(const std::string& bytes) {
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);
  std::string result(1 << 22, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  inflateEnd(&stream);
  return result;
}

// A buffer, and the bytes that its text stands for.
class Written {
 public:
  ColumnBuffer buffer{[this](std::string_view part) { text_ += part; }};

  std::string bytes() {
    buffer.finish();
    EXPECT_EQ(text_.size() % 4, 0u);
    return decompressed(decoded_base64(text_));
  }

 private:
  std::string text_;
};

TEST(ColumnBuffer, WritesNumbersInAsFewBytesAsTheyNeed) {
  Written numbers;
  for (const std::uint64_t number : {0ULL, 127ULL, 128ULL, 300ULL}) {
    numbers.buffer.add(number);
  }
  EXPECT_EQ(numbers.bytes(), std::string("\0\x7f\x80\x01\xac\x02", 6));
  Written largest;
  largest.buffer.add(std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(largest.bytes(), "\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01");
}

TEST(ColumnBuffer, WritesSmallNegativeNumbersShort) {
  Written numbers;
  for (const std::int64_t number : {0, -1, 1, -2, -64}) {
    numbers.buffer.add_signed(number);
  }
  EXPECT_EQ(numbers.bytes(), std::string("\0\x01\x02\x03\x7f", 5));
}

TEST(ColumnBuffer, KeepsAnyNumberOfBytes) {
  std::mt19937_64 random(1);
  for (const std::size_t count : {0U, 1U, 2U, 3U, 65'533U, 65'536U, 1'000'000U}) {
    Written numbers;
    std::string expected;
    for (std::size_t i = 0; i < count; ++i) {
      const auto byte = static_cast<char>(random() & 0x7f);
      numbers.buffer.add(static_cast<std::uint64_t>(byte));
      expected += byte;
    }
    EXPECT_TRUE(numbers.bytes() == expected) << count;
  }
}

}  // namespace
}  // namespace tracing
