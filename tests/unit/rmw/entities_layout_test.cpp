// SPDX-License-Identifier: Apache-2.0
#include "graph/entities_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace rmw_fastrtps {
namespace {

GraphCache::EntitiesInfo two_nodes() {
  GraphCache::EntitiesInfo info;
  info.gid.data[0] = 1;
  info.gid.data[15] = 0xc1;
  info.node_entities_info_seq.resize(2);
  info.node_entities_info_seq[0].node_namespace = "/";
  info.node_entities_info_seq[0].node_name = "talker";
  info.node_entities_info_seq[0].reader_gid_seq.resize(1);
  info.node_entities_info_seq[0].reader_gid_seq[0].data[3] = 7;
  info.node_entities_info_seq[0].writer_gid_seq.resize(3);
  info.node_entities_info_seq[0].writer_gid_seq[2].data[15] = 9;
  info.node_entities_info_seq[1].node_namespace = "/a/b";
  info.node_entities_info_seq[1].node_name = "x";
  return info;
}

class EntitiesLayout : public testing::TestWithParam<GidLength> {};

TEST_P(EntitiesLayout, IsKnownByItsLength) {
  for (const GraphCache::EntitiesInfo& info : {two_nodes(), GraphCache::EntitiesInfo()}) {
    const auto read = read_entities(write_entities(info, GetParam()));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->length, GetParam());
    EXPECT_EQ(read->info, info);
  }
}

TEST_P(EntitiesLayout, MayEndWithBytesThatFillAWord) {
  std::vector<std::uint8_t> bytes = write_entities(two_nodes(), GetParam());
  bytes.resize(bytes.size() + 3);
  const auto read = read_entities(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->info, two_nodes());
}

TEST_P(EntitiesLayout, IsReadInTheOtherByteOrder) {
  GraphCache::EntitiesInfo info;
  info.gid.data[0] = 5;
  info.node_entities_info_seq.resize(1);
  info.node_entities_info_seq[0].node_namespace = "/ab";
  info.node_entities_info_seq[0].node_name = "n12";
  std::vector<std::uint8_t> bytes = write_entities(info, GetParam());
  bytes[1] ^= 1;
  const std::size_t gid = static_cast<std::size_t>(GetParam());
  // The count, two texts of four bytes each behind their lengths, two counts.
  for (const std::size_t at : {gid, gid + 4, gid + 12, gid + 20, gid + 24}) {
    std::reverse(bytes.begin() + 4 + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + 8 + static_cast<std::ptrdiff_t>(at));
  }
  const auto read = read_entities(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->info, info);
}

// The zeros at the end of a long identity may be taken for "no nodes".
TEST_P(EntitiesLayout, IsNothingWhenItIsCutOrWrong) {
  const std::vector<std::uint8_t> bytes = write_entities(two_nodes(), GetParam());
  for (std::size_t size = 0; size + 4 < bytes.size(); ++size) {
    const auto read = read_entities({bytes.data(), size});
    EXPECT_TRUE(!read || read->info.node_entities_info_seq.empty()) << size;
  }
  std::vector<std::uint8_t> wrong = bytes;
  const std::size_t count = 4 + static_cast<std::size_t>(GetParam());
  std::fill_n(wrong.begin() + static_cast<std::ptrdiff_t>(count), 4, std::uint8_t{0xff});
  EXPECT_FALSE(read_entities(wrong));
}

INSTANTIATE_TEST_SUITE_P(Both, EntitiesLayout, testing::Values(GidLength::kOfToday, GidLength::kOfHumble));

}  // namespace
}  // namespace rmw_fastrtps
