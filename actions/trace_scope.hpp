// A trace session around a run: started before the first process, finished after the last one has gone.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "launcher/core/run_scope.hpp"
#include "tracing/session/tracer.hpp"

namespace launch {

class TraceScope : public RunScope {
 public:
  // Below `prefix` stand bin/launch, which ends the session of a killed launcher, and lib/launch/launch-report, which
  // describes a finished trace in one line.
  TraceScope(tracing::TraceConfig config, std::unique_ptr<tracing::Tracer> tracer, std::string prefix,
             SourceRange origin);
  ~TraceScope() override;

  void begin(EventLoop& loop, Tell tell, Completion done) override;
  void end(EventLoop& loop, Tell tell, Completion done) override;
  void hurry() override { hurry_ = true; }
  std::vector<std::string> clean_up_command() const override;
  void prepare(ProcessSpec& spec) const override;
  std::string kind() const override { return "trace"; }
  std::vector<ScopeSetting> describe() const override;
  std::vector<TimedStep> timing() const override;
  const SourceRange& origin() const override { return origin_; }

 private:
  // Runs `work` on a thread of its own, then `finished` on the loop's. The tracer's calls block.
  void in_background(EventLoop& loop, std::function<void()> work, std::function<void(std::exception_ptr)> finished);
  void tell_result(const Tell& tell) const;

  tracing::TraceConfig config_;
  std::unique_ptr<tracing::Tracer> tracer_;
  std::string prefix_;
  SourceRange origin_;
  std::vector<std::string> preload_;
  tracing::SetupReport setup_;
  tracing::LossAccount losses_;
  std::string summary_;
  std::atomic<bool> hurry_ = false;
  std::thread worker_;
};

}  // namespace launch
