// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/compared_run.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "tracing/model/compare/run_recorder.hpp"
#include "tracing/model/compare/subject_names.hpp"
#include "tracing/model/timeline/time_window.hpp"
#include "tracing/show/page/page.hpp"
#include "tracing/show/report/launch_filter.hpp"
#include "tracing/show/report/output_files.hpp"
#include "tracing/show/report/read_system.hpp"
#include "tracing/show/report/recorded_facts.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

namespace {

namespace fs = std::filesystem;

// Says what the run lacks. `error`: why reading stopped early.
compare::RunSummary complete(compare::RunSummary run, const fs::path& directory, const TraceOverview& overview,
                             const RecordedVerdict& verdict, const std::string& error) {
  run.directory = directory.native();
  if (has_losses(overview, verdict)) {
    run.remark = loss_phrase(overview, verdict);
  }
  if (!error.empty()) {
    run.remark += (run.remark.empty() ? "" : ", ") + error;
  }
  if (!run.measurements.empty()) {
    return run;
  }
  throw std::runtime_error(
      fmt::format("{} has no callback, message or call of a service, so it can't be compared", run.directory));
}

}  // namespace

compare::RunSummary read_run(const std::vector<fs::path>& directories, bool all) {
  compare::RunRecorder recorder;
  TraceAnalysis analysis(&recorder);
  recorder.use(analysis.objects());
  TraceReader reader(directories, TraceReader::Clocks::kOne);
  LaunchFilter filter(reader, directories, analysis, all);
  std::string error;
  TraceResults results;
  try {
    reader.read(filter);
    results = analysis.finish();
  } catch (const TraceReadError& failure) {
    analysis.doubt_all();
    results = analysis.finish();
    if (results.overview.events == 0) {
      throw;
    }
    error = failure.what();
  }
  return complete(recorder.finish(analysis, results), directories.front(), results.overview, read_verdicts(directories),
                  error);
}

PagedRun read_run_for_page(const fs::path& directory, const std::vector<ChainDefinition>& chains, bool all) {
  compare::RunRecorder recorder;
  PagedRun run;
  TracedSystem system =
      read_system({directory}, {.chains = chains,
                                .all = all,
                                .also = &recorder,
                                .at_begin = [&](const ObjectModel& objects) { recorder.use(objects); },
                                .at_end =
                                    [&](const TraceAnalysis& analysis, const TraceResults& results) {
                                      run.summary = recorder.finish(analysis, results);
                                      const compare::SubjectNames names(analysis);
                                      for (ObjectId id = 0; id < analysis.objects().callbacks().size(); ++id) {
                                        run.page.names.callbacks.push_back(names.callback(id));
                                        run.page.names.steps.push_back(names.step(id));
                                      }
                                      for (ObjectId id = 0; id < analysis.objects().subscriptions().size(); ++id) {
                                        run.page.names.subscriptions.push_back(names.subscription(id));
                                      }
                                    }});
  for (const compare::Measurement& measurement : run.summary.measurements) {
    if (measurement.kind == compare::Kind::kChain) {
      run.page.names.chains.push_back(measurement.subject);
    }
  }
  run.summary = complete(std::move(run.summary), directory, system.results.overview, system.verdict, system.error);
  const timeline::Timeline& timeline = system.timeline;
  const std::int64_t end_ns = timeline::end_of_first(timeline, kMostInPage / 2);
  if (end_ns < timeline.end_ns) {
    timeline::keep_window(system.timeline, timeline.begin_ns, end_ns);
  }
  run.page.columns = page_columns(system.timeline);
  run.page.facts = page_facts(system);
  return run;
}

}  // namespace tracing
