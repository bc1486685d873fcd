// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/comparison_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

using compare::Change;
using compare::Kind;
using compare::Lone;

// "+2.00 ms", "-45.6 us"
std::string signed_duration(double ns) {
  return (ns < 0 ? "-" : "+") + format_duration(std::abs(ns));
}

std::string percent(double share) {
  return fmt::format("{:.6g} %", share * 100);
}

// In the order of Kind.
constexpr const char* kTitles[] = {"Callbacks", "Hops", "Chains", "Calls of services"};

bool is_incomplete(const compare::Runs& side) {
  return std::any_of(side.runs.begin(), side.runs.end(),
                     [](const compare::RunSummary& run) { return !run.remark.empty(); });
}

// "/trace: 412 events in 5.00 s, 37 events lost", "base.json: 3 runs"; a line more for each incomplete run of several.
std::string side_lines(const char* label, const compare::Runs& side, bool color) {
  const auto described = [&](const compare::RunSummary& run) {
    const std::string text = fmt::format("{} in {}", format_count(run.events, "event"),
                                         format_duration(static_cast<double>(run.duration_ns)));
    return run.remark.empty() ? text : text + ", " + styled(run.remark, Style::kBad, color);
  };
  if (side.runs.size() == 1) {
    return fmt::format("{}{}: {}\n", label, side.source, described(side.runs.front()));
  }
  std::string text = fmt::format("{}{}: {}\n", label, side.source, format_count(side.runs.size(), "run"));
  for (const compare::RunSummary& run : side.runs) {
    if (!run.remark.empty()) {
      text += fmt::format("{:11}{}: {}\n", "", run.directory, described(run));
    }
  }
  return text;
}

std::string plural(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string result_line(const ComparisonReport& report, bool color) {
  const compare::Comparison& comparison = report.comparison;
  std::set<std::pair<Kind, std::string>> changed;
  bool slower = false;
  for (const Change& change : comparison.changes) {
    changed.insert({change.kind, change.subject});
    slower = slower || change.is_slower();
  }
  if (changed.empty()) {
    std::set<std::pair<Kind, std::string>> likely;
    for (const Change& change : comparison.likely) {
      likely.insert({change.kind, change.subject});
    }
    return styled("no change holds", Style::kGood, color) +
           (likely.empty()
                ? ""
                : "; " + plural(likely.size(), "subject has", "subjects have") + " changed with less confidence");
  }
  return styled(plural(changed.size(), "subject has", "subjects have") + " changed",
                slower ? Style::kBad : Style::kGood, color) +
         fmt::format("; with a confidence of {} none of them by chance", percent(report.options.confidence));
}

// "40 of 50 callbacks take longer, the one in the middle by 31 %"
std::string overall_line(const compare::Overall& overall, bool color) {
  const bool slower = overall.ratio > 0;
  const std::string text = fmt::format("{} of {} callbacks take {}, the one in the middle by {:.3g} %",
                                       slower ? overall.slower : overall.callbacks - overall.slower, overall.callbacks,
                                       slower ? "longer" : "less time", std::abs(overall.ratio) * 100);
  return styled(text, slower ? Style::kBad : Style::kGood, color);
}

std::string head(const ComparisonReport& report, bool color) {
  const compare::Comparison& comparison = report.comparison;
  std::string text = side_lines("Before     ", report.before, color) + side_lines("After      ", report.after, color);
  text += fmt::format("Compared   {} in {}", plural(comparison.compared, "subject", "subjects"),
                      plural(comparison.tests, "test", "tests"));
  if (comparison.too_few_samples > 0) {
    text += fmt::format("; {} too few samples", plural(comparison.too_few_samples, "quantity has", "quantities have"));
  }
  if (comparison.undecided > 0) {
    text += fmt::format("; {} on which message comes last",
                        plural(comparison.undecided, "quantity depends", "quantities depend"));
  }
  text += fmt::format("\nResult     {}\n", result_line(report, color));
  if (comparison.overall) {
    text += "Overall    " + overall_line(*comparison.overall, color) + "\n";
  }
  const bool marked = std::any_of(comparison.changes.begin(), comparison.changes.end(),
                                  [](const Change& change) { return change.doubtful; });
  if (marked) {
    text += "           * events may be missing, so that the figures may be wrong\n";
  }
  const bool estimated = std::any_of(comparison.changes.begin(), comparison.changes.end(),
                                     [](const Change& change) { return change.estimated; });
  if (estimated) {
    text += "           ~ an estimate: a recording has no timestamps of publications\n";
  }
  return text;
}

// Subjects with their quantities, the subject with the largest change first.
std::string section(std::string title, const std::vector<const Change*>& all, const ReportOptions& options) {
  std::map<std::pair<Kind, std::string>, std::vector<const Change*>> by_subject;
  for (const Change* change : all) {
    by_subject[{change->kind, change->subject}].push_back(change);
  }
  if (by_subject.empty()) {
    return "";
  }
  const auto largest = [](const std::vector<const Change*>& changes) {
    double size = 0;
    for (const Change* change : changes) {
      size = std::max(size, std::abs(change->shift.estimate));
    }
    return size;
  };
  std::vector<std::pair<std::pair<Kind, std::string>, std::vector<const Change*>>> subjects(by_subject.begin(),
                                                                                            by_subject.end());
  std::stable_sort(subjects.begin(), subjects.end(),
                   [&](const auto& a, const auto& b) { return largest(a.second) > largest(b.second); });
  const std::size_t shown = options.top == 0 ? subjects.size() : std::min(options.top, subjects.size());
  if (shown < subjects.size()) {
    title += fmt::format(", {} of {}", shown, subjects.size());
  }
  std::string text = fmt::format("\n{}\n", styled(title, Style::kBold, options.color));
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [subject, changes] = subjects[i];
    text += "  " + shortened(subject.second, options.width - 2) + "\n";
    for (const Change* change : changes) {
      const std::string what = fmt::format("{}, {}{}{}", change->quantity, statistic_name(change->statistic),
                                           change->estimated ? " ~" : "", change->doubtful ? " *" : "");
      text += fmt::format("    {:30} {:>8} -> {:8} ", what, format_duration(change->before_ns),
                          format_duration(change->after_ns)) +
              styled(fmt::format("{:>9}", signed_duration(change->shift.estimate)),
                     change->is_slower() ? Style::kBad : Style::kGood, options.color) +
              fmt::format("  ({} to {})\n", signed_duration(change->shift.low), signed_duration(change->shift.high));
    }
    for (const Change* change : changes) {
      if (!change->cause.empty()) {
        text += "    " + change->cause + "\n";
        break;
      }
    }
    std::set<std::string> steps;
    for (const Change* change : changes) {
      steps.insert(change->changed_steps.begin(), change->changed_steps.end());
    }
    for (const std::string& step : steps) {
      text += "    through " + shortened(step, options.width - 12) + "\n";
    }
  }
  return text;
}

std::string lone_section(const char* title, const std::vector<Lone>& lone, const ReportOptions& options) {
  if (lone.empty()) {
    return "";
  }
  const std::size_t shown = options.top == 0 ? lone.size() : std::min(options.top, lone.size());
  std::string heading = title;
  if (shown < lone.size()) {
    heading += fmt::format(", {} of {}", shown, lone.size());
  }
  std::string text = fmt::format("\n{}\n", styled(heading, Style::kBold, options.color));
  for (std::size_t i = 0; i < shown; ++i) {
    text += fmt::format("  {:9} {}\n", kind_name(lone[i].kind), shortened(lone[i].subject, options.width - 12));
  }
  return text;
}

bool has_slower(const ComparisonReport& report) {
  const std::vector<Change>& changes = report.comparison.changes;
  return std::any_of(changes.begin(), changes.end(), [](const Change& one) { return one.is_slower(); });
}

bool has_faster(const ComparisonReport& report) {
  const std::vector<Change>& changes = report.comparison.changes;
  return std::any_of(changes.begin(), changes.end(), [](const Change& one) { return !one.is_slower(); });
}

struct FailWord {
  const char* word;
  bool (*applies)(const ComparisonReport& report);
};
constexpr FailWord kFailWords[] = {
    {"slower", has_slower},
    {"faster", has_faster},
    {"changed", [](const ComparisonReport& report) { return !report.comparison.changes.empty(); }},
    {"overall",
     [](const ComparisonReport& report) { return report.comparison.overall && report.comparison.overall->ratio > 0; }},
    {"gone", [](const ComparisonReport& report) { return !report.comparison.gone.empty(); }},
    {"new", [](const ComparisonReport& report) { return !report.comparison.added.empty(); }},
    {"incomplete",
     [](const ComparisonReport& report) { return is_incomplete(report.before) || is_incomplete(report.after); }},
};

}  // namespace

const std::vector<std::string>& fail_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> list;
    for (const FailWord& one : kFailWords) {
      list.emplace_back(one.word);
    }
    return list;
  }();
  return words;
}

std::vector<std::string> failures(const ComparisonReport& report, const std::set<std::string>& fail_on) {
  std::vector<std::string> failed;
  for (const FailWord& one : kFailWords) {
    if (fail_on.contains(one.word) && one.applies(report)) {
      failed.emplace_back(one.word);
    }
  }
  return failed;
}

std::string comparison_text(const ComparisonReport& report, const std::vector<std::string>& failed,
                            const ReportOptions& options) {
  std::string text = head(report, options.color);
  for (const Kind kind : {Kind::kCallback, Kind::kHop, Kind::kChain, Kind::kCall}) {
    std::vector<const Change*> of_kind;
    for (const Change& change : report.comparison.changes) {
      if (change.kind == kind) {
        of_kind.push_back(&change);
      }
    }
    text += section(kTitles[static_cast<std::size_t>(kind)], of_kind, options);
  }
  std::vector<const Change*> likely;
  for (const Change& change : report.comparison.likely) {
    likely.push_back(&change);
  }
  text += section("Likely, with less confidence", likely, options);
  text += lone_section("Only before", report.comparison.gone, options) +
          lone_section("Only after", report.comparison.added, options);
  if (!failed.empty()) {
    text += "\n" + styled(fmt::format("Fails on {}", fmt::join(failed, ", ")), Style::kBad, options.color) + "\n";
  }
  return text;
}

}  // namespace tracing
