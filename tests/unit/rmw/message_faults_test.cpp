// SPDX-License-Identifier: Apache-2.0
// Faults of messages, as a test asks for them: what publishers send and what subscriptions take, and what the table
// says afterwards.
#include "faults/message_faults.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "fault_table.hpp"
#include "faults/delayed_calls.hpp"
#include "rmw_test.hpp"
#include "std_msgs/msg/string.hpp"
#include "std_msgs/msg/u_int64.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rmw_test::Asked;
using rmw_test::Context;
using rmw_test::Fault;
using rmw_test::FaultTable;
using rmw_test::Kind;
using rmw_test::Node;
using rmw_test::Publisher;
using rmw_test::Side;
using rmw_test::Subscription;
using rmw_test::Table;
using std_msgs::msg::String;
using std_msgs::msg::UInt64;
using testing::ElementsAre;

// A process reads its faults once, so those of all tests are in one table. Each test has topics of its own.
const std::vector<Asked> kAsked = {
    {"/drop", Kind::kDrop, Side::kPublish, 2, 1, 2},
    {"/every", Kind::kDrop, Side::kPublish, 2, 3, 2},
    {"/no_end", Kind::kDrop, Side::kPublish, 3, 1, 0},
    {"/drop_take", Kind::kDrop, Side::kTake, 2, 1, 1},
    {"/twice", Kind::kDuplicate, Side::kPublish, 2, 1, 1},
    {"/twice_take", Kind::kDuplicate, Side::kTake, 2, 1, 1},
    {"/late", Kind::kDelay, Side::kPublish, 1, 1, 1, std::chrono::milliseconds(50)},
    {"/late_take", Kind::kDelay, Side::kTake, 1, 1, 1, std::chrono::milliseconds(50)},
    {"/never", Kind::kDelay, Side::kPublish, 1, 1, 1, std::chrono::hours(1)},
    {"/never_take", Kind::kDelay, Side::kTake, 1, 1, 1, std::chrono::hours(1)},
    {"/corrupt", Kind::kCorrupt, Side::kPublish, 1, 1, 0},
    {"/corrupt_take", Kind::kCorrupt, Side::kTake, 1, 1, 0},
    {"/number", Kind::kCorrupt, Side::kPublish, 2, 1, 1},
    {"/node", Kind::kDrop, Side::kPublish, 1, 1, 0, {}, "/inner/second"},
    {"/unarmed", Kind::kDrop, Side::kPublish, 1, 1, 1},
    {"/other_process", Kind::kDrop, Side::kPublish, 1, 1, 0},
};

const auto* const kTable = testing::AddGlobalTestEnvironment(new FaultTable(kAsked));

class MessageFaultsTest : public testing::Test {
 protected:
  template <typename Message>
  static void wait_for_match(const Publisher<Message>& publisher, const Subscription<Message>& subscription) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(rmw_test::kPatience.sec);
    while (publisher.matched() == 0 || subscription.matched() == 0) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the endpoints do not match";
      std::this_thread::yield();
    }
  }

  // Publishes the numbers from 1 on, and takes `expected` messages.
  std::vector<std::uint64_t> carry(const char* topic, std::uint64_t published, std::size_t expected) {
    rmw_qos_profile_t qos = rmw_qos_profile_default;
    qos.history = RMW_QOS_POLICY_HISTORY_KEEP_ALL;
    Publisher<UInt64> publisher(sender_, topic, qos);
    Subscription<UInt64> subscription(receiver_, topic, qos);
    wait_for_match(publisher, subscription);
    UInt64 message;
    for (message.data = 1; message.data <= published; ++message.data) {
      publisher.publish(message);
    }
    std::vector<std::uint64_t> taken;
    while (taken.size() < expected) {
      rmw_message_info_t info;
      taken.push_back(subscription.next(&info).data);
      sources_.push_back(info.source_timestamp);
    }
    EXPECT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
    EXPECT_FALSE(subscription.take(message)) << message.data;
    return taken;
  }

  test_support::Sandbox sandbox_;
  Context sending_context_;
  Context receiving_context_;
  Node sender_{sending_context_, "sender"};
  Node receiver_{receiving_context_, "receiver"};
  std::vector<std::int64_t> sources_;
};

TEST_F(MessageFaultsTest, DropsMessagesThatArePublished) {
  EXPECT_THAT(carry("/drop", 5, 3), ElementsAre(1, 4, 5));
  const Fault& fault = FaultTable::of("/drop");
  EXPECT_EQ(fault.seen, 5U);
  EXPECT_EQ(fault.hit, 2U);
  EXPECT_GT(fault.first_time, 0);
  EXPECT_GE(fault.latest_time, fault.first_time);
  char byte = 1;
  EXPECT_GT(::read(FaultTable::wake, &byte, 1), 0) << "the launcher is not woken";
}

TEST_F(MessageFaultsTest, DropsOneOfSoMany) {
  EXPECT_THAT(carry("/every", 8, 6), ElementsAre(1, 3, 4, 6, 7, 8));
}

TEST_F(MessageFaultsTest, DropsAllFromOneOn) {
  EXPECT_THAT(carry("/no_end", 5, 2), ElementsAre(1, 2));
  EXPECT_EQ(FaultTable::of("/no_end").hit, 3U);
}

TEST_F(MessageFaultsTest, DropsMessagesThatAreTaken) {
  EXPECT_THAT(carry("/drop_take", 3, 2), ElementsAre(1, 3));
}

// The layer gives a message to the middleware again, which takes the time once more. So it does for late ones.
TEST_F(MessageFaultsTest, SendsMessagesTwice) {
  EXPECT_THAT(carry("/twice", 3, 4), ElementsAre(1, 2, 2, 3));
  EXPECT_EQ(sources_.at(1) == sources_.at(2), !rmw_test::kIsLayer);
}

TEST_F(MessageFaultsTest, TakesMessagesTwice) {
  EXPECT_THAT(carry("/twice_take", 3, 4), ElementsAre(1, 2, 2, 3));
  EXPECT_EQ(sources_.at(1), sources_.at(2));
}

TEST_F(MessageFaultsTest, SendsMessagesLateWithTheirTime) {
  EXPECT_THAT(carry("/late", 2, 2), ElementsAre(2, 1));
  EXPECT_EQ(sources_.at(1) < sources_.at(0), !rmw_test::kIsLayer);
}

TEST_F(MessageFaultsTest, TakesMessagesLateWithTheirTime) {
  EXPECT_THAT(carry("/late_take", 2, 2), ElementsAre(2, 1));
  EXPECT_LT(sources_.at(1), sources_.at(0));
}

TEST_F(MessageFaultsTest, AMessageThatIsLateEndsWithItsEndpoint) {
  EXPECT_THAT(carry("/never", 2, 1), ElementsAre(2));
  EXPECT_THAT(carry("/never_take", 2, 1), ElementsAre(2));
}

TEST_F(MessageFaultsTest, ChangesBytesOfANumber) {
  const std::vector<std::uint64_t> taken = carry("/number", 3, 3);
  EXPECT_EQ(taken.at(0), 1U);
  EXPECT_NE(taken.at(1), 2U);
  EXPECT_EQ(taken.at(2), 3U);
}

// The length of a text may be among the bytes. Whatever comes of it, the subscriber lives and gets the next message.
TEST_F(MessageFaultsTest, ChangedBytesDoNotEndASubscriber) {
  constexpr std::size_t kMessages = 300;
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  qos.history = RMW_QOS_POLICY_HISTORY_KEEP_ALL;
  for (const char* const topic : {"/corrupt", "/corrupt_take"}) {
    Publisher<String> publisher(sender_, topic, qos);
    Subscription<String> subscription(receiver_, topic, qos);
    wait_for_match(publisher, subscription);
    String message;
    for (std::size_t i = 0; i < kMessages; ++i) {
      message.data.assign(i % 7, 'x');
      publisher.publish(message);
    }
    ASSERT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
    std::size_t unchanged = 0;
    String taken;
    while (subscription.take(taken)) {
      unchanged += taken.data.find_first_not_of('x') == std::string::npos ? 1 : 0;
    }
    Fault& fault = FaultTable::of(topic);
    EXPECT_EQ(fault.hit, kMessages) << topic;
    EXPECT_LT(unchanged, kMessages / 2) << topic;  // the padding of a short text may be hit
    fault.is_armed = 0;
    message.data = "whole";
    publisher.publish(message);
    EXPECT_EQ(subscription.next().data, "whole");
  }
}

TEST_F(MessageFaultsTest, HitsTheNodeThatItNamesOnly) {
  Node first(sending_context_, "first", "/inner");
  Node second(sending_context_, "second", "/inner");
  Publisher<UInt64> other(first, "/node");
  Publisher<UInt64> hit(second, "/node");
  other.publish(UInt64());
  hit.publish(UInt64());
  hit.publish(UInt64());
  EXPECT_EQ(FaultTable::of("/node").seen, 2U);
}

TEST_F(MessageFaultsTest, CountsFromItsBeginOn) {
  Publisher<UInt64> publisher(sender_, "/unarmed");
  publisher.publish(UInt64());
  EXPECT_EQ(FaultTable::of("/unarmed").seen, 0U);
  FaultTable::of("/unarmed").is_armed = 1;
  publisher.publish(UInt64());
  EXPECT_EQ(FaultTable::of("/unarmed").hit, 1U);
}

TEST_F(MessageFaultsTest, LeavesOtherProcessesAlone) {
  EXPECT_THAT(carry("/other_process", 2, 2), ElementsAre(1, 2));
  EXPECT_EQ(FaultTable::of("/other_process").seen, 0U);
}

#ifndef RMW_FAULT_LAYER_UNDER_TEST
TEST_F(MessageFaultsTest, WithFaultsNothingIsOnLoan) {
  Publisher<UInt64> with(sender_, "/no_end");
  Publisher<UInt64> without(sender_, "/clean");
  EXPECT_FALSE(with.handle->can_loan_messages);
  EXPECT_TRUE(without.handle->can_loan_messages);
  Subscription<UInt64> subscription(receiver_, "/drop_take");
  EXPECT_FALSE(subscription.handle->can_loan_messages);
}

TEST(Corrupt, ChangesAByteInEach64BehindTheHeader) {
  std::vector<std::uint8_t> bytes(4 + 64 + 64 + 1);
  std::vector<std::size_t> changed;
  rmw_fastrtps::corrupt(bytes.data(), bytes.size(), 7);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] != 0) {
      changed.push_back(i);
    }
  }
  ASSERT_EQ(changed.size(), 3U);
  EXPECT_GE(changed[0], 4U);
  EXPECT_EQ((changed[0] - 4) / 64, 0U);
  EXPECT_EQ((changed[1] - 4) / 64, 1U);
  EXPECT_EQ(changed[2], bytes.size() - 1);
  std::vector<std::uint8_t> again(bytes.size());
  rmw_fastrtps::corrupt(again.data(), again.size(), 7);
  EXPECT_EQ(again, bytes);
  std::vector<std::uint8_t> header(4);
  rmw_fastrtps::corrupt(header.data(), header.size(), 7);
  EXPECT_EQ(header, std::vector<std::uint8_t>(4));
}

// A process reads its faults once, so each of these is one of its own.
void ask_for_faults(const std::string& variable) {
  ::setenv("RMW_MESSAGE_FAULTS", variable.c_str(), 1);
  const bool none = rmw_fastrtps::MessageFaults::of(Side::kPublish, "/drop", "/node") == nullptr;
  ::_exit(none ? 0 : 1);
}

TEST(TableOfFaults, IsToldWhenItCannotBeRead) {
  EXPECT_EXIT(ask_for_faults("1:/nowhere/table"), testing::ExitedWithCode(0),
              "^\\[rmw\\] the faults of \\$RMW_MESSAGE_FAULTS cannot be read: '/nowhere/table': No such file or "
              "directory\n$");
  EXPECT_EXIT(ask_for_faults("1:/"), testing::ExitedWithCode(0),
              "^\\[rmw\\] the faults of \\$RMW_MESSAGE_FAULTS cannot be read: '/': Is a directory\n$");
  EXPECT_EXIT(ask_for_faults("no colon"), testing::ExitedWithCode(0), "^$");
}

TEST(TableOfFaults, IsOfOneVersion) {
  char path[] = "/tmp/table_of_faults.XXXXXX";
  const int file = ::mkstemp(path);
  const Table other{Table::kMagic, sizeof(Fault) + 8, 1};
  ASSERT_EQ(::write(file, &other, sizeof other), static_cast<ssize_t>(sizeof other));
  ::close(file);
  EXPECT_EXIT(ask_for_faults(std::string("1:") + path), testing::ExitedWithCode(0),
              "' was written by another version\n$");
  ::unlink(path);
}

TEST(DelayedCalls, ComeInTheOrderOfTheirTimesUnlessTheyAreForgotten) {
  rmw_fastrtps::DelayedCalls calls;
  const auto now = rmw_fastrtps::DelayedCalls::Clock::now();
  const int kept = 0;
  const int forgotten = 0;
  std::mutex mutex;
  std::condition_variable changed;
  std::string order;
  const auto note = [&](char name) {
    return [&, name] {
      const std::lock_guard lock(mutex);
      order += name;
      changed.notify_all();
    };
  };
  calls.add(&forgotten, now + std::chrono::hours(1), note('x'));
  calls.add(&kept, now + std::chrono::milliseconds(20), note('b'));
  calls.add(&kept, now + std::chrono::milliseconds(10), note('a'));
  calls.forget(&forgotten);
  std::unique_lock lock(mutex);
  EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(10), [&] { return order.size() == 2; }));
  EXPECT_EQ(order, "ab");
}

#else
TEST_F(MessageFaultsTest, MessagesOnLoanArePublishedAndGivenBack) {
  Publisher<UInt64> publisher(sender_, "/drop");
  Subscription<UInt64> subscription(receiver_, "/drop");
  wait_for_match(publisher, subscription);
  FaultTable::of("/drop").seen = 0;
  const auto* const type = rosidl_typesupport_cpp::get_message_type_support_handle<UInt64>();
  for (std::uint64_t number = 1; number <= 4; ++number) {
    void* loan = nullptr;
    ASSERT_EQ(rmw_borrow_loaned_message(publisher.handle, type, &loan), RMW_RET_OK);
    static_cast<UInt64*>(loan)->data = number;
    EXPECT_EQ(rmw_publish_loaned_message(publisher.handle, loan, nullptr), RMW_RET_OK);
  }
  EXPECT_EQ(subscription.next().data, 1U);
  EXPECT_EQ(subscription.next().data, 4U);
}

TEST_F(MessageFaultsTest, SerializedMessagesAreHit) {
  Publisher<UInt64> publisher(sender_, "/drop_take");
  Subscription<UInt64> subscription(receiver_, "/drop_take");
  wait_for_match(publisher, subscription);
  FaultTable::of("/drop_take").seen = 0;
  UInt64 message;
  for (message.data = 1; message.data <= 3; ++message.data) {
    publisher.publish(message);
  }
  EXPECT_EQ(rmw_publisher_wait_for_all_acked(publisher.handle, rmw_test::kPatience), RMW_RET_OK);
  rmw_serialized_message_t bytes = rmw_get_zero_initialized_serialized_message();
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  ASSERT_EQ(rmw_serialized_message_init(&bytes, 0, &allocator), RCUTILS_RET_OK);
  const auto* const type = rosidl_typesupport_cpp::get_message_type_support_handle<UInt64>();
  std::vector<std::uint64_t> taken;
  bool is_taken = true;
  while (is_taken) {
    ASSERT_EQ(rmw_take_serialized_message(subscription.handle, &bytes, &is_taken, nullptr), RMW_RET_OK);
    if (is_taken) {
      ASSERT_EQ(rmw_deserialize(&bytes, type, &message), RMW_RET_OK);
      taken.push_back(message.data);
    }
  }
  EXPECT_THAT(taken, ElementsAre(1, 3));
  EXPECT_EQ(rmw_serialized_message_fini(&bytes), RCUTILS_RET_OK);
}
#endif

}  // namespace
