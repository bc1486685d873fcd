// SPDX-License-Identifier: Apache-2.0
#include "launcher/testing/checks/trace_judges.hpp"
#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"

namespace launch {

tracing::TraceResults analyse_chains(const std::vector<std::filesystem::path>& directories,
                                     const std::optional<std::set<std::int64_t>>& pids,
                                     const std::vector<tracing::ChainDefinition>& chains) {
  tracing::TraceAnalysis analysis(nullptr, chains);
  tracing::TraceReader reader(directories, tracing::TraceReader::Clocks::kOne);
  while (const tracing::TraceItem item = reader.next()) {
    if (item.loss != nullptr) {
      analysis.on_loss(*item.loss);
    } else if (!pids || pids->contains(item.event->vpid.value_or(-1))) {
      analysis.on_event(*item.event);
    }
  }
  return analysis.finish();
}

std::int64_t percentile_of(const tracing::DurationSummary& summary, double percentile) {
  struct Kept {
    double percentile;
    std::int64_t value;
  };
  for (const Kept& kept : {Kept{50, summary.p50_ns}, Kept{90, summary.p90_ns}, Kept{99, summary.p99_ns},
                           Kept{99.9, summary.p999_ns}, Kept{99.99, summary.p9999_ns}}) {
    if (kept.percentile == percentile) {
      return kept.value;
    }
  }
  return summary.max_ns;
}

}  // namespace launch
