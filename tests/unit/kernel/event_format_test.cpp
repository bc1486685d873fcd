// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/kernel/event_format.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using tracing::kernel::EventField;
using tracing::kernel::EventFormat;
using tracing::kernel::parse_event_format;
using Kind = EventField::Kind;

constexpr const char* kCommon =
    "\tfield:unsigned short common_type;\toffset:0;\tsize:2;\tsigned:0;\n"
    "\tfield:int common_pid;\toffset:4;\tsize:4;\tsigned:1;\n\n";

TEST(EventFormat, OfASchedulerEventNamesThreadsAsLttngDoes) {
  const EventFormat format = parse_event_format(std::string("name: sched_switch\nID: 372\nformat:\n") + kCommon +
                                                "\tfield:char prev_comm[16];\toffset:8;\tsize:16;\tsigned:0;\n"
                                                "\tfield:pid_t prev_pid;\toffset:24;\tsize:4;\tsigned:1;\n"
                                                "\tfield:long prev_state;\toffset:32;\tsize:8;\tsigned:1;\n\n"
                                                "print fmt: \"prev_comm=%s\", REC->prev_comm\n");
  EXPECT_EQ(format.name, "sched_switch");
  EXPECT_EQ(format.id, 372);
  ASSERT_EQ(format.fields.size(), 3u) << "without the common ones";
  EXPECT_EQ(format.fields[0].name, "prev_comm");
  EXPECT_EQ(format.fields[0].kind, Kind::kText);
  EXPECT_EQ(format.fields[0].size, 16u);
  EXPECT_EQ(format.fields[1].name, "prev_tid");
  EXPECT_EQ(format.fields[1].kind, Kind::kInteger);
  EXPECT_EQ(format.fields[1].offset, 24u);
  EXPECT_TRUE(format.fields[1].is_signed);
  EXPECT_EQ(format.fields[2].size, 8u);
}

TEST(EventFormat, HasTextsArraysAndAddresses) {
  const EventFormat format = parse_event_format(
      "name: demo\nID: 7\nformat:\n"
      "\tfield:__data_loc char[] name;\toffset:12;\tsize:4;\tsigned:0;\n"
      "\tfield:unsigned long args[6];\toffset:16;\tsize:48;\tsigned:0;\n"
      "\tfield:void * ptr;\toffset:64;\tsize:8;\tsigned:0;\n"
      "\tfield:__data_loc u8[] bytes;\toffset:72;\tsize:4;\tsigned:0;\n"
      "\tfield:struct sockaddr address;\toffset:76;\tsize:16;\tsigned:0;\n");
  ASSERT_EQ(format.fields.size(), 3u) << "the last two are none of the kinds";
  EXPECT_EQ(format.fields[0].name, "name");
  EXPECT_EQ(format.fields[0].kind, Kind::kDynamicText);
  EXPECT_EQ(format.fields[1].name, "args");
  EXPECT_EQ(format.fields[1].kind, Kind::kIntegers);
  EXPECT_EQ(format.fields[1].element_size, 8u);
  EXPECT_EQ(format.fields[2].name, "ptr");
  EXPECT_TRUE(format.fields[2].hexadecimal);
}

TEST(EventFormat, SystemCallsHaveTheNamesOfLttng) {
  EXPECT_EQ(parse_event_format("name: sys_enter_openat\nID: 1\n").name, "syscall_entry_openat");
  EXPECT_EQ(parse_event_format("name: sys_exit_openat\nID: 2\n").name, "syscall_exit_openat");
}

TEST(EventFormat, EventsHaveTheNamesOfLttngWhereItHasOthers) {
  EXPECT_EQ(tracing::kernel::lttng_name("softirq_entry"), "irq_softirq_entry");
  EXPECT_EQ(tracing::kernel::lttng_name("hrtimer_expire_exit"), "timer_hrtimer_expire_exit");
  EXPECT_EQ(tracing::kernel::lttng_name("netif_receive_skb"), "net_if_receive_skb");
  EXPECT_EQ(tracing::kernel::lttng_name("mm_page_alloc"), "kmem_mm_page_alloc");
  EXPECT_EQ(tracing::kernel::lttng_name("kfree_skb"), "skb_kfree");
  EXPECT_EQ(tracing::kernel::lttng_name("cpu_frequency"), "power_cpu_frequency");
  EXPECT_EQ(tracing::kernel::lttng_name("net_dev_queue"), "net_dev_queue");
  EXPECT_EQ(tracing::kernel::lttng_name("irq_handler_entry"), "irq_handler_entry");
}

TEST(EventFormat, AnotherTextIsAnError) {
  EXPECT_THROW(parse_event_format("nothing of the kind"), std::runtime_error);
}

}  // namespace
