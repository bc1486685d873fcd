// SPDX-License-Identifier: Apache-2.0
// The faults of the process of a test of rmw, as a launcher would write them. A process reads its faults once.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rmw_message_faults/fault_table.hpp"

namespace rmw_test {

using rmw_message_faults::Fault;
using rmw_message_faults::Kind;
using rmw_message_faults::Side;
using rmw_message_faults::Table;

// Whether the layer for other middlewares (fault_layer) applies the faults, instead of the rmw of this stack.
#ifdef RMW_FAULT_LAYER_UNDER_TEST
constexpr bool kIsLayer = true;
#else
constexpr bool kIsLayer = false;
#endif

struct Asked {
  const char* topic;
  Kind kind;
  Side side = Side::kPublish;
  std::uint64_t first = 1;
  std::uint64_t every = 1;
  std::uint64_t count = 1;
  std::chrono::nanoseconds delay{0};
  const char* node = "";
};

class FaultTable : public testing::Environment {
 public:
  // Each topic or service once.
  explicit FaultTable(std::vector<Asked> asked) : asked_(std::move(asked)) {}

  void SetUp() override {
    char name[] = "/tmp/message_faults_test.XXXXXX";
    ASSERT_NE(::mkdtemp(name), nullptr);
    directory_ = name;
    path_ = directory_ + "/table";
    const std::size_t size = Table::size_for(asked_.size());
    const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_EQ(::ftruncate(file, static_cast<off_t>(size)), 0);
    void* const memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ASSERT_NE(memory, MAP_FAILED);
    ::close(file);
    table = new (memory) Table{Table::kMagic, sizeof(Fault), asked_.size()};
    std::string numbers;
    for (std::size_t i = 0; i < asked_.size(); ++i) {
      const Asked& asked = asked_[i];
      Fault& fault = *std::construct_at(table->faults() + i);
      fault.kind = asked.kind;
      fault.side = asked.side;
      std::copy_n(asked.topic, std::string(asked.topic).size(), fault.topic);
      std::copy_n(asked.node, std::string(asked.node).size(), fault.node);
      fault.first = asked.first;
      fault.every = asked.every;
      fault.count = asked.count;
      fault.delay = asked.delay.count();
      fault.seed = i;
      fault.is_armed = fault.topic == std::string("/unarmed") ? 0 : 1;
      numbers += fault.topic == std::string("/other_process") ? "" : std::to_string(i + 1) + ",";
    }
    ASSERT_EQ(::mkfifo((path_ + ".wake").c_str(), 0600), 0);
    wake = ::open((path_ + ".wake").c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    ::setenv(kIsLayer ? "RMW_FAULT_LAYER" : "RMW_MESSAGE_FAULTS", (numbers + ":" + path_).c_str(), 1);
  }
  void TearDown() override {
    ::unlink((path_ + ".wake").c_str());
    ::unlink(path_.c_str());
    ::rmdir(directory_.c_str());
  }

  static Fault& of(std::string_view topic) {
    return *std::find_if(table->faults(), table->faults() + table->count,
                         [&](const Fault& fault) { return fault.topic == topic; });
  }

  static inline Table* table = nullptr;
  static inline int wake = -1;

 private:
  std::vector<Asked> asked_;
  std::string directory_;
  std::string path_;
};

}  // namespace rmw_test
