// SPDX-License-Identifier: Apache-2.0
// A RunScope for tests. It begins and ends a while after the request, and notes the times.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "launcher/visit/run_scope.hpp"

namespace launch {

using Diary = std::vector<std::string>;

class FakeScope : public RunScope {
 public:
  FakeScope(std::string name, bool fails, SourceRange origin, Diary& journal)
      : name_(std::move(name)), fails_(fails), origin_(std::move(origin)), journal_(journal) {}

  // Its end fails, too.
  void fail_at_end() { fails_at_end_ = true; }
  void want_records() { wants_records_ = true; }

  void begin(EventLoop& loop, Tell, Completion done) override {
    journal_.push_back("begin " + name_);
    timer_ = loop.after(std::chrono::milliseconds(10), [this, done = std::move(done)] {
      journal_.push_back((fails_ ? "failed " : "begun ") + name_);
      done(fails_ ? std::make_exception_ptr(std::runtime_error("no tracer")) : nullptr);
    });
  }
  void end(EventLoop& loop, Tell, Completion done) override {
    journal_.push_back("end " + name_ + (hurried_ ? " in a hurry" : ""));
    timer_ = loop.after(std::chrono::milliseconds(10), [this, done = std::move(done)] {
      journal_.push_back("ended " + name_);
      done(fails_at_end_ ? std::make_exception_ptr(std::runtime_error("no disk")) : nullptr);
    });
  }
  void hurry() override { hurried_ = true; }
  void prepare(ProcessSpec& spec) const override { spec.environment["SCOPES"] += name_; }
  bool wants_records() const override { return wants_records_; }
  void record(const LaunchRecord& record) override { records.push_back(record.name); }
  std::string kind() const override { return name_ == "trace" ? "trace" : "fake"; }
  std::vector<ShownSetting> describe() const override { return {{"name", name_}}; }
  std::vector<TimedStep> timing() const override { return {}; }
  const SourceRange& origin() const override { return origin_; }

  std::vector<std::string> records;  // the names of the records that it got

 private:
  std::string name_;
  bool fails_;
  SourceRange origin_;
  Diary& journal_;
  bool fails_at_end_ = false;
  bool wants_records_ = false;
  bool hurried_ = false;
  EventLoop::SourcePtr timer_;
};

}  // namespace launch
