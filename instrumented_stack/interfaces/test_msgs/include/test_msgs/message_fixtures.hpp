// SPDX-License-Identifier: Apache-2.0
// Messages of each type of test_msgs, for tests that send, convert or store messages. The values are those of ROS 2, so
// tests that expect them pass. test_msgs/message_fixtures.py has the same messages in Python.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "test_msgs/msg/arrays.hpp"
#include "test_msgs/msg/basic_types.hpp"
#include "test_msgs/msg/bounded_plain_sequences.hpp"
#include "test_msgs/msg/bounded_sequences.hpp"
#include "test_msgs/msg/builtins.hpp"
#include "test_msgs/msg/complex_nested_key.hpp"
#include "test_msgs/msg/constants.hpp"
#include "test_msgs/msg/defaults.hpp"
#include "test_msgs/msg/empty.hpp"
#include "test_msgs/msg/keyed_long.hpp"
#include "test_msgs/msg/keyed_string.hpp"
#include "test_msgs/msg/multi_nested.hpp"
#include "test_msgs/msg/nested.hpp"
#include "test_msgs/msg/non_keyed_with_nested_key.hpp"
#include "test_msgs/msg/strings.hpp"
#include "test_msgs/msg/unbounded_sequences.hpp"
#include "test_msgs/msg/w_strings.hpp"

namespace test_msgs::fixtures {

template <class Message>
using Messages = std::vector<std::shared_ptr<Message>>;

template <class Container, class = void>
constexpr bool kHasResize = false;
template <class Container>
constexpr bool kHasResize<Container, std::void_t<decltype(std::declval<Container&>().resize(1))>> = true;

// Of an array or a sequence; an array keeps the values behind the given ones.
template <class Container>
void set(Container& container, std::initializer_list<typename Container::value_type> values) {
  if constexpr (kHasResize<Container>) {
    container.resize(values.size());
  }
  std::copy(values.begin(), values.end(), container.begin());
}

// The first `count` of the messages, which begin anew behind the last one.
template <class Container, class Message>
void set_messages(Container& container, const Messages<Message>& messages, std::size_t count = 3) {
  if constexpr (kHasResize<Container>) {
    container.resize(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    container[i] = *messages[i % messages.size()];
  }
}

template <class Container>
void set_extremes(Container& container) {
  using Value = typename Container::value_type;
  set(container, {Value{0}, std::numeric_limits<Value>::max(), std::numeric_limits<Value>::min()});
}

template <class Container>
void set_unsigned(Container& container, std::initializer_list<typename Container::value_type> before,
                  std::initializer_list<typename Container::value_type> behind = {}) {
  std::vector<typename Container::value_type> values = before;
  values.push_back(std::numeric_limits<typename Container::value_type>::max());
  values.insert(values.end(), behind);
  if constexpr (kHasResize<Container>) {
    container.resize(values.size());
  }
  std::copy(values.begin(), values.end(), container.begin());
}

template <class Message>
void set_signed_and_floats(Message& message) {
  set(message.float32_values, {0.0F, 1.125F, -2.125F});
  set(message.float64_values, {0.0, 1.125, -2.125});
  set_extremes(message.int8_values);
  set_extremes(message.int16_values);
  set_extremes(message.int32_values);
  set_extremes(message.int64_values);
}

inline std::string digits(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += static_cast<char>('0' + i % 10);
  }
  return text;
}

template <class Message, class BasicTypes>
void set_arrays(Message& message, const Messages<BasicTypes>& basic_types) {
  set(message.bool_values, {false, true, false});
  set(message.byte_values, {0, 0xff, 0});
  set(message.char_values, {0, 0xff, 0});
  set_signed_and_floats(message);
  set_unsigned(message.uint8_values, {0}, {0});
  set_unsigned(message.uint16_values, {0}, {0});
  set_unsigned(message.uint32_values, {0}, {0});
  set_unsigned(message.uint64_values, {0}, {0});
  set(message.string_values, {"", "max value", "min value"});
  set_messages(message.basic_types_values, basic_types);
}

template <class Message, class BasicTypes>
void set_bounded(Message& message, const Messages<BasicTypes>& basic_types) {
  set(message.bool_values, {false, true, false});
  set(message.byte_values, {0, 1, 0xff});
  set(message.char_values, {0, 1, 0xff});
  set_signed_and_floats(message);
  set_unsigned(message.uint8_values, {0, 1});
  set_unsigned(message.uint16_values, {0, 1});
  set_unsigned(message.uint32_values, {0, 1});
  set_unsigned(message.uint64_values, {0, 1});
  set_messages(message.basic_types_values, basic_types);
  message.alignment_check = 2;
}

template <class Message>
void set_basic_types(Message& message, bool flag, int number, double real) {
  message.bool_value = flag;
  message.byte_value = static_cast<unsigned char>(number);
  message.char_value = static_cast<unsigned char>(number);
  message.float32_value = static_cast<float>(real);
  message.float64_value = real;
  message.int8_value = static_cast<int8_t>(number);
  message.uint8_value = static_cast<uint8_t>(number);
  message.int16_value = static_cast<int16_t>(number);
  message.uint16_value = static_cast<uint16_t>(number);
  message.int32_value = number;
  message.uint32_value = static_cast<uint32_t>(number);
  message.int64_value = number;
  message.uint64_value = static_cast<uint64_t>(number);
}

}  // namespace test_msgs::fixtures

inline test_msgs::fixtures::Messages<test_msgs::msg::Empty> get_messages_empty() {
  return {std::make_shared<test_msgs::msg::Empty>()};
}

inline test_msgs::fixtures::Messages<test_msgs::msg::Constants> get_messages_constants() {
  return {std::make_shared<test_msgs::msg::Constants>()};
}

inline test_msgs::fixtures::Messages<test_msgs::msg::Defaults> get_messages_defaults() {
  return {std::make_shared<test_msgs::msg::Defaults>()};
}

// All zero, the largest values, the smallest ones, all one.
inline test_msgs::fixtures::Messages<test_msgs::msg::BasicTypes> get_messages_basic_types() {
  test_msgs::fixtures::Messages<test_msgs::msg::BasicTypes> messages;
  for (int i = 0; i < 4; ++i) {
    messages.push_back(std::make_shared<test_msgs::msg::BasicTypes>());
  }
  test_msgs::fixtures::set_basic_types(*messages[0], false, 0, 0.0);
  test_msgs::fixtures::set_basic_types(*messages[1], true, 0xff, 1.125);
  test_msgs::fixtures::set_basic_types(*messages[2], false, 0, -2.125);
  test_msgs::fixtures::set_basic_types(*messages[3], true, 1, 1.0);
  auto& largest = *messages[1];
  largest.int8_value = std::numeric_limits<int8_t>::max();
  largest.int16_value = std::numeric_limits<int16_t>::max();
  largest.uint16_value = std::numeric_limits<uint16_t>::max();
  largest.int32_value = std::numeric_limits<int32_t>::max();
  largest.uint32_value = std::numeric_limits<uint32_t>::max();
  largest.int64_value = std::numeric_limits<int64_t>::max();
  largest.uint64_value = std::numeric_limits<uint64_t>::max();
  auto& smallest = *messages[2];
  smallest.int8_value = std::numeric_limits<int8_t>::min();
  smallest.int16_value = std::numeric_limits<int16_t>::min();
  smallest.int32_value = std::numeric_limits<int32_t>::min();
  smallest.int64_value = std::numeric_limits<int64_t>::min();
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::Strings> get_messages_strings() {
  test_msgs::fixtures::Messages<test_msgs::msg::Strings> messages;
  const auto add = [&messages](const std::string& text, const std::string& bounded) {
    messages.push_back(std::make_shared<test_msgs::msg::Strings>());
    messages.back()->string_value = text;
    messages.back()->bounded_string_value = bounded;
  };
  add("", "");
  add("Hello world!", "Hello world!");
  add("Hell\xc3\xb6 W\xc3\xb6rld!", "Hell\xc3\xb6 W\xc3\xb6rld!");
  add(test_msgs::fixtures::digits(20000), test_msgs::fixtures::digits(22));
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::Arrays> get_messages_arrays() {
  auto message = std::make_shared<test_msgs::msg::Arrays>();
  test_msgs::fixtures::set_arrays(*message, get_messages_basic_types());
  return {message};
}

// Empty, with one element, with two or three, with 1000, and with the default of each field.
inline test_msgs::fixtures::Messages<test_msgs::msg::UnboundedSequences> get_messages_unbounded_sequences() {
  using test_msgs::fixtures::set;
  using test_msgs::fixtures::set_unsigned;
  const auto basic_types = get_messages_basic_types();
  test_msgs::fixtures::Messages<test_msgs::msg::UnboundedSequences> messages;
  for (int i = 0; i < 5; ++i) {
    messages.push_back(std::make_shared<test_msgs::msg::UnboundedSequences>());
    messages.back()->alignment_check = i;
  }

  auto& one = *messages[1];
  one.bool_values = {true};
  one.byte_values = {0xff};
  one.char_values = {0xff};
  one.float32_values = {1.125F};
  one.float64_values = {1.125};
  one.int8_values = {std::numeric_limits<int8_t>::max()};
  one.int16_values = {std::numeric_limits<int16_t>::max()};
  one.int32_values = {std::numeric_limits<int32_t>::max()};
  one.int64_values = {std::numeric_limits<int64_t>::max()};
  set_unsigned(one.uint8_values, {});
  set_unsigned(one.uint16_values, {});
  set_unsigned(one.uint32_values, {});
  set_unsigned(one.uint64_values, {});
  set(one.string_values, {"max value"});
  test_msgs::fixtures::set_messages(one.basic_types_values, basic_types, 1);

  auto& few = *messages[2];
  few.bool_values = {false, true};
  few.byte_values = {0, 0xff};
  few.char_values = {0, 0xff};
  test_msgs::fixtures::set_signed_and_floats(few);
  set_unsigned(few.uint8_values, {0});
  set_unsigned(few.uint16_values, {0});
  set_unsigned(few.uint32_values, {0});
  set_unsigned(few.uint64_values, {0});
  set(few.string_values, {"", "max value", "optional min value"});
  test_msgs::fixtures::set_messages(few.basic_types_values, basic_types);

  auto& many = *messages[3];
  constexpr std::size_t kMany = 1000;
  for (std::size_t i = 0; i < kMany; ++i) {
    many.bool_values.push_back(i % 2 != 0);
    many.byte_values.push_back(static_cast<unsigned char>(i));
    many.char_values.push_back(static_cast<unsigned char>(i));
    many.float32_values.push_back(1.125F * static_cast<float>(i));
    many.float64_values.push_back(1.125 * static_cast<double>(i));
    many.int8_values.push_back(static_cast<int8_t>(i));
    many.uint8_values.push_back(static_cast<uint8_t>(i));
    many.int16_values.push_back(static_cast<int16_t>(i));
    many.uint16_values.push_back(static_cast<uint16_t>(i));
    many.int32_values.push_back(static_cast<int32_t>(i));
    many.uint32_values.push_back(static_cast<uint32_t>(i));
    many.int64_values.push_back(static_cast<int64_t>(i));
    many.uint64_values.push_back(i);
    many.string_values.push_back(std::to_string(i));
  }
  test_msgs::fixtures::set_messages(many.basic_types_values, basic_types, kMany);
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::BoundedPlainSequences> get_messages_bounded_plain_sequences() {
  auto message = std::make_shared<test_msgs::msg::BoundedPlainSequences>();
  test_msgs::fixtures::set_bounded(*message, get_messages_basic_types());
  auto defaults = std::make_shared<test_msgs::msg::BoundedPlainSequences>();
  defaults->alignment_check = 4;
  return {message, defaults};
}

inline test_msgs::fixtures::Messages<test_msgs::msg::BoundedSequences> get_messages_bounded_sequences() {
  auto message = std::make_shared<test_msgs::msg::BoundedSequences>();
  test_msgs::fixtures::set_bounded(*message, get_messages_basic_types());
  test_msgs::fixtures::set(message->string_values, {"", "max value", "optional min value"});
  auto defaults = std::make_shared<test_msgs::msg::BoundedSequences>();
  defaults->alignment_check = 4;
  return {message, defaults};
}

inline test_msgs::fixtures::Messages<test_msgs::msg::MultiNested> get_messages_multi_nested() {
  using test_msgs::fixtures::set_messages;
  auto message = std::make_shared<test_msgs::msg::MultiNested>();
  const auto arrays = get_messages_arrays();
  const auto bounded = get_messages_bounded_sequences();
  const auto unbounded = get_messages_unbounded_sequences();
  set_messages(message->array_of_arrays, arrays);
  set_messages(message->array_of_bounded_sequences, bounded);
  set_messages(message->array_of_unbounded_sequences, unbounded);
  set_messages(message->bounded_sequence_of_arrays, arrays);
  set_messages(message->bounded_sequence_of_bounded_sequences, bounded);
  set_messages(message->bounded_sequence_of_unbounded_sequences, unbounded);
  set_messages(message->unbounded_sequence_of_arrays, arrays);
  set_messages(message->unbounded_sequence_of_bounded_sequences, bounded);
  set_messages(message->unbounded_sequence_of_unbounded_sequences, unbounded);
  return {message};
}

inline test_msgs::fixtures::Messages<test_msgs::msg::Nested> get_messages_nested() {
  test_msgs::fixtures::Messages<test_msgs::msg::Nested> messages;
  for (const auto& basic_types : get_messages_basic_types()) {
    messages.push_back(std::make_shared<test_msgs::msg::Nested>());
    messages.back()->basic_types_value = *basic_types;
  }
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::Builtins> get_messages_builtins() {
  auto message = std::make_shared<test_msgs::msg::Builtins>();
  message->duration_value.sec = -1234567890;
  message->duration_value.nanosec = 123456789;
  message->time_value.sec = -1234567890;
  message->time_value.nanosec = 987654321;
  return {message};
}

// The words for one, two and four in Japanese, an umlaut, and a text in Katakana are in them.
inline test_msgs::fixtures::Messages<test_msgs::msg::WStrings> get_messages_wstrings() {
  using test_msgs::fixtures::set;
  test_msgs::fixtures::Messages<test_msgs::msg::WStrings> messages;
  for (const char16_t* text :
       {u"", u"ascii", u"Hell\u00F6 W\u00F6rld!", u"\u30CF\u30ED\u30FC\u30EF\u30FC\u30EB\u30C9"}) {
    messages.push_back(std::make_shared<test_msgs::msg::WStrings>());
    messages.back()->wstring_value = text;
  }
  set(messages[0]->array_of_wstrings, {u"1", u"two", u"\u4E09"});
  set(messages[0]->bounded_sequence_of_wstrings, {u"one", u"\u4E8C"});
  set(messages[0]->unbounded_sequence_of_wstrings, {u".", u"..", u"...", u"\u56DB"});
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::KeyedLong> get_messages_keyed_long() {
  test_msgs::fixtures::Messages<test_msgs::msg::KeyedLong> messages;
  for (int i = 1; i <= 2; ++i) {
    messages.push_back(std::make_shared<test_msgs::msg::KeyedLong>());
    messages.back()->key = i;
    messages.back()->value = i;
  }
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::KeyedString> get_messages_keyed_string() {
  test_msgs::fixtures::Messages<test_msgs::msg::KeyedString> messages;
  for (int i = 1; i <= 2; ++i) {
    messages.push_back(std::make_shared<test_msgs::msg::KeyedString>());
    messages.back()->key = "key_" + std::to_string(i);
    messages.back()->value = "value_" + std::to_string(i);
  }
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::NonKeyedWithNestedKey> get_messages_non_keyed_with_nested_key() {
  test_msgs::fixtures::Messages<test_msgs::msg::NonKeyedWithNestedKey> messages;
  for (const auto& keyed : get_messages_keyed_string()) {
    messages.push_back(std::make_shared<test_msgs::msg::NonKeyedWithNestedKey>());
    messages.back()->nested_data = *keyed;
    messages.back()->some_int = -1;
  }
  return messages;
}

inline test_msgs::fixtures::Messages<test_msgs::msg::ComplexNestedKey> get_messages_complex_nested_key() {
  test_msgs::fixtures::Messages<test_msgs::msg::ComplexNestedKey> messages;
  for (const auto& nested : get_messages_non_keyed_with_nested_key()) {
    messages.push_back(std::make_shared<test_msgs::msg::ComplexNestedKey>());
    messages.back()->nested_keys = *nested;
    messages.back()->uint32_key = 3;
    messages.back()->float64_value = 1.125;
  }
  return messages;
}
