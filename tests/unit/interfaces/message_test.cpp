// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstring>
#include <type_traits>

#include "builtin_interfaces/msg/time.hpp"
#include "rcl_interfaces/msg/log.hpp"
#include "rcl_interfaces/msg/parameter_type.hpp"
#include "rcl_interfaces/srv/get_parameters.hpp"
#include "std_msgs/msg/color_rgba.hpp"
#include "std_msgs/msg/empty.hpp"
#include "std_msgs/msg/header.hpp"
#include "std_msgs/msg/string.hpp"
#include "test_interfaces/msg/awkward.hpp"
#include "test_interfaces/msg/defaults.hpp"
#include "test_interfaces/msg/nested.hpp"
#include "test_interfaces/msg/primitives.hpp"
#include "test_interfaces/msg/sequences.hpp"
#include "test_interfaces/srv/add_two_ints.hpp"

namespace {

using rosidl_runtime_cpp::MessageInitialization;
using test_interfaces::msg::Defaults;
using test_interfaces::msg::Nested;

TEST(Message, StartsWithDefaultsAndZero) {
  const Defaults message;
  EXPECT_EQ(message.number, -7);
  EXPECT_EQ(message.ratio, 2.0);
  EXPECT_TRUE(message.on);
  EXPECT_EQ(message.name, "a\tb");
  EXPECT_EQ(message.single, "it is");
  EXPECT_EQ(message.wide, u"gr\u00fc\u00df");
  EXPECT_EQ(message.three, (std::array<int32_t, 3>{1, 2, 3}));
  EXPECT_EQ(message.several, (std::vector<float>{0.5f, -1.0f}));
  EXPECT_EQ(message.words, (std::vector<std::string>{"one, two", "three"}));
  EXPECT_EQ(message.plain, 0);
}

// A message in memory full of 0x55 shows which members the constructor sets.
template <typename Message>
struct Constructed {
  explicit Constructed(MessageInitialization initialization) {
    std::memset(memory, 0x55, sizeof memory);
    message = new (memory) Message(initialization);
  }
  ~Constructed() { message->~Message(); }
  Constructed(const Constructed&) = delete;
  Constructed& operator=(const Constructed&) = delete;
  alignas(Message) unsigned char memory[sizeof(Message)];
  Message* message;
};

TEST(Message, WithTheStandardAllocatorIsTheMessage) {
  EXPECT_TRUE((std::is_same_v<std_msgs::msg::String_<std::allocator<void>>, std_msgs::msg::String>));
  EXPECT_TRUE((std::is_same_v<test_interfaces::srv::AddTwoInts_Request_<std::allocator<void>>,
                              test_interfaces::srv::AddTwoInts::Request>));
  EXPECT_TRUE((std::is_same_v<std_msgs::msg::Header::Type, std_msgs::msg::Header>));
  const std::allocator<void> allocator;
  EXPECT_EQ(Defaults(allocator).number, -7);
  EXPECT_EQ(Defaults(allocator, MessageInitialization::ZERO).number, 0);
  EXPECT_EQ(std_msgs::msg::Empty(allocator), std_msgs::msg::Empty());
}

TEST(MessageInitialization, ZeroIgnoresDefaults) {
  const Constructed<Defaults> made(MessageInitialization::ZERO);
  EXPECT_EQ(made.message->number, 0);
  EXPECT_EQ(made.message->ratio, 0.0);
  EXPECT_FALSE(made.message->on);
  EXPECT_EQ(made.message->name, "");
  EXPECT_EQ(made.message->three, (std::array<int32_t, 3>{}));
  EXPECT_TRUE(made.message->words.empty());
  EXPECT_EQ(made.message->plain, 0);
}

TEST(MessageInitialization, ReachesNestedMessages) {
  const Constructed<Nested> zero(MessageInitialization::ZERO);
  EXPECT_EQ(zero.message->defaults[1].number, 0);
  EXPECT_EQ(zero.message->header.stamp.sec, 0);
  const Constructed<Nested> all(MessageInitialization::ALL);
  EXPECT_EQ(all.message->defaults[1].number, -7);
  EXPECT_EQ(all.message->header.stamp.sec, 0);
}

TEST(Message, SettersChain) {
  const auto color = std_msgs::msg::ColorRGBA().set__r(0.5f).set__a(1.0f);
  EXPECT_EQ(color.r, 0.5f);
  EXPECT_EQ(color.g, 0.0f);
  EXPECT_EQ(color.a, 1.0f);
}

TEST(Message, IsBuiltFieldByField) {
  const auto color = std_msgs::build<std_msgs::msg::ColorRGBA>().r(0.5f).g(0.25f).b(0.0f).a(1.0f);
  static_assert(std::is_same_v<decltype(color), const std_msgs::msg::ColorRGBA>);
  EXPECT_EQ(color, std_msgs::msg::ColorRGBA().set__r(0.5f).set__g(0.25f).set__a(1.0f));

  const auto header = std_msgs::build<std_msgs::msg::Header>()
                          .stamp(builtin_interfaces::build<builtin_interfaces::msg::Time>().sec(3).nanosec(4))
                          .frame_id("map");
  EXPECT_EQ(header.stamp.nanosec, 4u);
  EXPECT_EQ(header.frame_id, "map");
  EXPECT_EQ(test_interfaces::build<test_interfaces::srv::AddTwoInts::Request>().a(1).b(2).b, 2);
  EXPECT_EQ(std_msgs::build<std_msgs::msg::Empty>(), std_msgs::msg::Empty());
}

TEST(Message, ConstantsHaveTheTypeOfTheFile) {
  static_assert(Defaults::ANSWER == 42);
  static_assert(std::is_same_v<decltype(Defaults::HALF), const float>);
  static_assert(Defaults::SMALLEST == std::numeric_limits<int64_t>::min());
  static_assert(Defaults::YES);
  static_assert(rcl_interfaces::msg::Log::WARN == 30);
  static_assert(rcl_interfaces::msg::ParameterType::PARAMETER_STRING_ARRAY == 9);
  EXPECT_EQ(Defaults::GREETING, "hello, # \"you\"");
  EXPECT_EQ(Defaults::UNQUOTED, "it's fine");
}

TEST(Message, ComparesMemberByMember) {
  std_msgs::msg::Header a;
  std_msgs::msg::Header b;
  EXPECT_EQ(a, b);
  b.stamp.nanosec = 1;
  EXPECT_NE(a, b);
}

TEST(Message, MayHaveAFieldCalledAsAParameterOfTheGeneratedCode) {
  test_interfaces::msg::Awkward a;
  test_interfaces::msg::Awkward b;
  EXPECT_EQ(a, b);
  b.other = 1;
  EXPECT_NE(a, b);
  EXPECT_EQ(a.words, (std::array<std::string, 2>{"a", "b"}));
}

TEST(Message, HasThePointerAliasesOfRos) {
  using std_msgs::msg::String;
  static_assert(std::is_same_v<String::SharedPtr, std::shared_ptr<String>>);
  static_assert(std::is_same_v<String::ConstSharedPtr, std::shared_ptr<const String>>);
  static_assert(std::is_same_v<String::UniquePtr, std::unique_ptr<String>>);
  static_assert(std::is_same_v<String::_data_type, std::string>);
  const String::UniquePtr message = std::make_unique<String>();
  EXPECT_EQ(message->data, "");
}

TEST(Traits, NameTheType) {
  EXPECT_STREQ(rosidl_generator_traits::name<std_msgs::msg::String>(), "std_msgs/msg/String");
  EXPECT_STREQ(rosidl_generator_traits::data_type<std_msgs::msg::String>(), "std_msgs::msg::String");
  EXPECT_STREQ(rosidl_generator_traits::name<rcl_interfaces::srv::GetParameters>(), "rcl_interfaces/srv/GetParameters");
  EXPECT_STREQ(rosidl_generator_traits::name<rcl_interfaces::srv::GetParameters::Request>(),
               "rcl_interfaces/srv/GetParameters_Request");
}

TEST(Traits, TellMessagesServicesAndSizesApart) {
  using namespace rosidl_generator_traits;
  using test_interfaces::srv::AddTwoInts;
  static_assert(is_message<std_msgs::msg::String>::value && !is_service<std_msgs::msg::String>::value);
  static_assert(is_service<AddTwoInts>::value && !is_message<AddTwoInts>::value && !is_message<int>::value);
  static_assert(is_service_request<AddTwoInts::Request>::value && is_service_response<AddTwoInts::Response>::value);
  static_assert(has_fixed_size<std_msgs::msg::ColorRGBA>::value && has_fixed_size<AddTwoInts::Request>::value);
  static_assert(!has_fixed_size<std_msgs::msg::Header>::value && !has_bounded_size<std_msgs::msg::Header>::value);
  static_assert(has_fixed_size<test_interfaces::msg::Nothing>::value);
}

}  // namespace
