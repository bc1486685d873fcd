// SPDX-License-Identifier: Apache-2.0
// Processes of one recording that have equal ids: one after the other, or in two containers.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing {
namespace {

using testing::TemporaryDirectory;
using testing::Thread;
using testing::TraceWriter;

constexpr ros2::Handle kHeap = 0x5555'5555'0000;
constexpr ros2::Handle kOtherHeap = 0x5612'3456'0000;
constexpr ros2::Handle kMapped = 0x7f12'3456'0000;
constexpr std::int64_t kPeriod = 1'000'000;

class ProcessReuse : public ::testing::Test {
 protected:
  explicit ProcessReuse(TraceWriter::Options options = {}) : writer_(directory_.path(), options) {}

  template <class Struct>
  void write(const Thread& thread, const Struct& event) {
    writer_.write(0, ++now_, thread, event);
  }
  void write_context(const Thread& thread, ros2::Handle heap) { write(thread, ros2::RclInit{heap, "8.2.0"}); }
  // A node with a timer, whose handles are near to that of the context.
  void write_node(const Thread& thread, ros2::Handle heap, const std::string& name) {
    write(thread, ros2::RclNodeInit{heap + 1, heap + 2, name, "/"});
    write(thread, ros2::RclTimerInit{heap + 3, kPeriod});
    write(thread, ros2::RclcppTimerCallbackAdded{heap + 3, heap + 4});
    write(thread, ros2::RclcppTimerLinkNode{heap + 3, heap + 1});
  }
  void write_run(const Thread& thread, ros2::Handle heap) {
    write(thread, ros2::CallbackStart{heap + 4, false});
    write(thread, ros2::CallbackEnd{heap + 4});
  }

  TraceResults results() {
    writer_.finish();
    TraceAnalysis analysis;
    TraceReader(directory_.path()).read(analysis);
    return analysis.finish();
  }
  // "PROCESS[PLACE] /NODE RUNS" of each callback.
  static std::vector<std::string> callbacks(const TraceResults& results) {
    std::vector<std::string> texts;
    for (const CallbackResult& callback : results.ros2.callbacks) {
      const ProcessResult& process = results.overview.processes.at(callback.process);
      texts.push_back(process.name + "[" + std::to_string(callback.process) + "] " + callback.node + " " +
                      std::to_string(callback.durations.count));
    }
    return texts;
  }
  using Texts = std::vector<std::string>;

 private:
  TemporaryDirectory directory_;
  TraceWriter writer_;
  std::int64_t now_ = 0;
};

constexpr Thread kNode{71, 71, "node", 0};

TEST_F(ProcessReuse, AProcessThatGetsTheIdOfAnEndedOneIsAnother) {
  for (const auto& [heap, name] : {std::pair(kHeap, "first"), std::pair(kOtherHeap, "second")}) {
    write_context(kNode, heap);
    write_node(kNode, heap, name);
    write_run(kNode, heap);
  }
  const TraceResults results = this->results();
  ASSERT_EQ(results.overview.processes.size(), 2u);
  EXPECT_EQ(results.overview.processes[0].vpid, 71);
  EXPECT_EQ(results.overview.processes[1].vpid, 71);
  EXPECT_EQ(results.overview.processes[0].events, 7u);
  EXPECT_EQ(callbacks(results), (Texts{"node[0] /first 1", "node[1] /second 1"}));
}

TEST_F(ProcessReuse, AProgramOfAnotherNameIsAnotherProcessWhereverItsContextIs) {
  write_context(kNode, kHeap);
  write_node(kNode, kHeap, "first");
  const Thread other{71, 71, "other", 0};
  write_context(other, kHeap + 0x100);
  write_node(other, kHeap + 0x100, "second");
  write_run(other, kHeap + 0x100);
  const TraceResults results = this->results();
  ASSERT_EQ(results.overview.processes.size(), 2u);
  EXPECT_EQ(results.overview.processes[0].name, "node");
  EXPECT_EQ(results.overview.processes[1].name, "other");
}

TEST_F(ProcessReuse, AProcessMayHaveSeveralContexts) {
  for (const ros2::Handle heap : {kHeap, kHeap + 0x10000, kMapped, kHeap}) {
    write_context(kNode, heap);
  }
  EXPECT_EQ(results().overview.processes.size(), 1u);
}

// Nothing tells which of the two an event belongs to. But its handles do.
TEST_F(ProcessReuse, ProcessesOfTwoContainersKeepTheirObjects) {
  write_context(kNode, kHeap);
  write_node(kNode, kHeap, "first");
  write_context(kNode, kOtherHeap);
  write_node(kNode, kOtherHeap, "second");
  write_run(kNode, kHeap);
  write_run(kNode, kOtherHeap);
  EXPECT_EQ(callbacks(results()), (Texts{"node[0] /first 1", "node[1] /second 1"}));
}

class ProcessReuseWithNamespaces : public ProcessReuse {
 protected:
  ProcessReuseWithNamespaces() : ProcessReuse({.pid_ns = true}) {}
};

TEST_F(ProcessReuseWithNamespaces, TheContextPidNsKeepsContainersApart) {
  const Thread first{1, 1, "first", 4026532001};
  const Thread second{1, 1, "second", 4026532002};
  for (const auto& [thread, heap] : {std::pair(first, kHeap), std::pair(second, kOtherHeap)}) {
    write_context(thread, heap);
    write_node(thread, heap, std::string(thread.procname));
  }
  write_run(first, kHeap);
  write_run(second, kOtherHeap);
  write_run(first, kHeap);
  const TraceResults results = this->results();
  ASSERT_EQ(results.overview.processes.size(), 2u);
  EXPECT_EQ(callbacks(results), (Texts{"first[0] /first 2", "second[1] /second 1"}));
  EXPECT_EQ(results.overview.processes[0].events, 9u);
  EXPECT_EQ(results.overview.processes[1].events, 7u);
}

}  // namespace
}  // namespace tracing
