// SPDX-License-Identifier: Apache-2.0
// <resources max_memory="…" max_processor_time="…"/>
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>

#include "launcher/testing/checks/check.hpp"

namespace launch {

namespace {

constexpr std::uint64_t kKibibyte = 1024;

double processor_time(const rusage& usage) {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string memory_text(std::uint64_t bytes) {
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (kKibibyte * kKibibyte));
}

class ResourceCheck final : public Check {
 public:
  explicit ResourceCheck(const Expectation& expectation)
      : Check(expectation), expected_(std::get<ExpectedResources>(expectation.what)) {}

  // It is judged at the end of the process, whatever ends it.
  bool is_waited_for() const override { return false; }

  void on_process(const ProcessEvent& event) override {
    const auto* const exited = std::get_if<ProcessExited>(&event.what);
    if (exited == nullptr || !concerns(event.spec, event.label)) {
      return;
    }
    judged_ = true;
    const auto memory = static_cast<std::uint64_t>(exited->exit.usage.ru_maxrss) * kKibibyte;
    if (expected_.memory && memory > *expected_.memory) {
      fail({fmt::format("{} has used too much memory", event.label), expectation().where,
            fmt::format("at most {}", memory_text(*expected_.memory)), memory_text(memory)});
    }
    const double time = processor_time(exited->exit.usage);
    if (expected_.processor_time && time > std::chrono::duration<double>(*expected_.processor_time).count()) {
      fail({fmt::format("{} has used too much processor time", event.label), expectation().where,
            fmt::format("at most {:.3f} s", std::chrono::duration<double>(*expected_.processor_time).count()),
            fmt::format("{:.3f} s", time)});
    }
  }

 protected:
  std::optional<Failure> verdict(const std::string&) override {
    if (judged_) {
      return std::nullopt;
    }
    return Failure{fmt::format("what {} uses is not known", subject_of(expectation())), expectation().where,
                   "the end of the process", "no such process has ended"};
  }

 private:
  ExpectedResources expected_;
  bool judged_ = false;
};

}  // namespace

std::unique_ptr<Check> make_resource_check(const Expectation& expectation) {
  return std::make_unique<ResourceCheck>(expectation);
}

}  // namespace launch
