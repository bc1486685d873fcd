// SPDX-License-Identifier: Apache-2.0
// Counters and histograms of what nodes do, from the begin of a recording on, for monitoring systems: OpenMetrics 1.0,
// https://prometheus.io/docs/specs/om/open_metrics_spec/. The memory grows with the number of objects.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tracing/decode/reader/trace_sink.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace tracing {

class LiveMetrics : public ExecutionSink, public TraceSink {
 public:
  LiveMetrics() : analysis_(this) {}
  LiveMetrics(const LiveMetrics&) = delete;  // the analysis tells this object what happens
  LiveMetrics& operator=(const LiveMetrics&) = delete;

  void on_event(const Event& event) override;
  void on_loss(const Loss& loss) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_message(const MessageFlow& message) override;

  // Families of metrics, without the line that ends an exposition.
  std::string text() const;

 private:
  // The upper bounds of the buckets, in nanoseconds; beyond the last one there is another bucket.
  static constexpr std::array<std::int64_t, 14> kBounds = {
      10'000,     100'000,    500'000,     1'000'000,   2'000'000,   5'000'000,     10'000'000,
      20'000'000, 50'000'000, 100'000'000, 200'000'000, 500'000'000, 1'000'000'000, 5'000'000'000};
  struct Histogram {
    std::array<std::uint64_t, kBounds.size() + 1> buckets{};
    std::int64_t sum_ns = 0;
    std::uint64_t count = 0;

    void add(std::int64_t took_ns);
    void add(const Histogram& other);
  };
  static Histogram& at(std::vector<Histogram>& histograms, ObjectId id);
  static void write(std::string& text, const char* name, const std::string& labels, const Histogram& histogram);

  TraceAnalysis analysis_;
  std::uint64_t events_ = 0;
  std::uint64_t lost_ = 0;            // that were counted
  std::vector<Histogram> callbacks_;  // duration, by ObjectId
  std::vector<Histogram> latencies_;  // publish to callback, by ObjectId of the subscription
};

}  // namespace tracing
