// SPDX-License-Identifier: Apache-2.0
// Whether a service is there and answers; or a managed node, which answers that it is in the state that it should be
// in.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "launcher/health/graph_watch.hpp"
#include "launcher/health/health_probe.hpp"
#include "launcher/health/processor_wait.hpp"

namespace launch {

class AnswerProbe final : public HealthProbe {
 public:
  // `service` is asked. `wanted` is the state that the answer has to tell; empty: any answer is good.
  AnswerProbe(GraphWatch graph, std::string service, std::string wanted, Duration timeout,
              ProcessorWait wait = ProcessorWait())
      : graph_(std::move(graph)),
        service_(std::move(service)),
        wanted_(std::move(wanted)),
        timeout_(timeout),
        wait_(std::move(wait)) {}

  void begin(pid_t pid) override;
  void end() override { graph_.end(); }
  Look look(Duration now, Duration passed) override;

 private:
  bool is_good() const { return found_ == ServiceFinding::kFound && (wanted_.empty() || state_ == wanted_); }
  std::string complaint() const;

  GraphWatch graph_;
  std::string service_;
  std::string wanted_;
  Duration timeout_;
  ProcessorWait wait_;
  pid_t pid_ = -1;
  std::optional<ServiceFinding> found_;
  std::string state_;
  bool has_news_ = false;  // since the last look
  Duration age_{0};        // since when it is not good, as far as it counts
};

}  // namespace launch
