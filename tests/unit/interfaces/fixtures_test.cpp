// SPDX-License-Identifier: Apache-2.0
// The messages and services that packages take for their tests.
#include <gtest/gtest.h>

#include <rcpputils/compile_warnings.hpp>
#include <test_msgs/message_fixtures.hpp>
#include <test_msgs/service_fixtures.hpp>

namespace {

using test_msgs::msg::UnboundedSequences;

TEST(Fixtures, HaveAMessageOfEachKindOfValue) {
  EXPECT_EQ(get_messages_empty().size(), 1U);
  EXPECT_TRUE(get_messages_defaults().at(0)->bool_value);
  EXPECT_EQ(get_messages_constants().size(), 1U);
  const auto basic_types = get_messages_basic_types();
  ASSERT_EQ(basic_types.size(), 4U);
  EXPECT_EQ(basic_types[0]->uint64_value, 0U);
  EXPECT_EQ(basic_types[1]->char_value, 255);
  EXPECT_EQ(basic_types[1]->int64_value, INT64_MAX);
  EXPECT_EQ(basic_types[1]->uint16_value, UINT16_MAX);
  EXPECT_EQ(basic_types[2]->int8_value, INT8_MIN);
  EXPECT_EQ(basic_types[2]->float32_value, -2.125F);
  EXPECT_EQ(basic_types[3]->float64_value, 1.0);
  EXPECT_EQ(get_messages_nested().at(1)->basic_types_value, *basic_types[1]);
  EXPECT_EQ(get_messages_builtins().at(0)->time_value.nanosec, 987654321U);
}

TEST(Fixtures, HaveTexts) {
  const auto strings = get_messages_strings();
  ASSERT_EQ(strings.size(), 4U);
  EXPECT_EQ(strings[2]->string_value, "Hell\u00F6 W\u00F6rld!");
  EXPECT_EQ(strings[3]->string_value.size(), 20000U);
  EXPECT_EQ(strings[3]->bounded_string_value, "0123456789012345678901");
  const auto wide = get_messages_wstrings();
  ASSERT_EQ(wide.size(), 4U);
  EXPECT_EQ(wide[0]->unbounded_sequence_of_wstrings.size(), 4U);
  EXPECT_EQ(wide[3]->wstring_value.size(), 7U);
}

TEST(Fixtures, HaveArraysAndSequences) {
  const auto arrays = get_messages_arrays();
  ASSERT_EQ(arrays.size(), 1U);
  EXPECT_EQ(arrays[0]->int32_values, (std::array<int32_t, 3>{0, INT32_MAX, INT32_MIN}));
  EXPECT_EQ(arrays[0]->uint8_values, (std::array<uint8_t, 3>{0, 255, 0}));
  const auto sequences = get_messages_unbounded_sequences();
  ASSERT_EQ(sequences.size(), 5U);
  EXPECT_TRUE(sequences[0]->string_values.empty());
  EXPECT_EQ(sequences[1]->uint64_values, (std::vector<uint64_t>{UINT64_MAX}));
  EXPECT_EQ(sequences[2]->uint64_values, (std::vector<uint64_t>{0, UINT64_MAX}));
  EXPECT_EQ(sequences[2]->string_values, (std::vector<std::string>{"", "max value", "optional min value"}));
  EXPECT_EQ(sequences[3]->basic_types_values.size(), 1000U);
  EXPECT_EQ(sequences[3]->int8_values[200], -56);
  UnboundedSequences defaults;
  defaults.alignment_check = 4;
  EXPECT_EQ(*sequences[4], defaults);
  EXPECT_EQ(get_messages_bounded_sequences().at(0)->uint16_values.at(2), UINT16_MAX);
  EXPECT_EQ(get_messages_bounded_plain_sequences().at(1)->alignment_check, 4);
  const auto nested = get_messages_multi_nested();
  EXPECT_EQ(nested.at(0)->bounded_sequence_of_unbounded_sequences.at(2), *sequences[2]);
  EXPECT_EQ(nested.at(0)->array_of_bounded_sequences.at(2), *get_messages_bounded_sequences()[0]);
}

TEST(Fixtures, HaveKeys) {
  EXPECT_EQ(get_messages_keyed_long().at(1)->key, 2);
  const auto complex = get_messages_complex_nested_key();
  ASSERT_EQ(complex.size(), 2U);
  EXPECT_EQ(complex[1]->nested_keys.nested_data.key, "key_2");
  EXPECT_EQ(complex[1]->uint32_key, 3U);
}

TEST(Fixtures, HaveServices) {
  EXPECT_EQ(get_services_empty().size(), 1U);
  const auto basic_types = get_services_basic_types();
  ASSERT_EQ(basic_types.size(), 2U);
  EXPECT_EQ(basic_types[0].second->string_value, "reply");
  EXPECT_EQ(basic_types[1].first->float64_value, 1.11);
  EXPECT_EQ(basic_types[1].second->float32_value, 11.125F);
  EXPECT_EQ(basic_types[1].second->uint64_value, 88U);
  const auto arrays = get_services_arrays();
  EXPECT_EQ(arrays.at(0).first->string_values.at(1), "max value");
  EXPECT_EQ(arrays.at(0).second->int8_values, (std::array<int8_t, 3>{INT8_MAX, 0, INT8_MIN}));
  EXPECT_EQ(arrays.at(0).second->basic_types_values.at(0), *get_messages_basic_types()[1]);
}

}  // namespace
