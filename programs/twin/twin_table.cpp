// SPDX-License-Identifier: Apache-2.0
#include "programs/twin/twin_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tracing/model/findings/quantity_text.hpp"

namespace twin_program {

namespace {

using tracing::format_duration;
using namespace tracing::twin;

constexpr std::size_t kNameWidth = 46;
constexpr const char* kKinds[] = {"callback", "hop", "call"};
constexpr const char* kTitles[] = {"Callbacks", "Ways of messages", "Calls of services"};

// Of a value beside the recorded one.
double error_of(std::int64_t value, std::int64_t recorded) {
  return recorded == 0 ? 0 : static_cast<double>(value - recorded) / static_cast<double>(recorded);
}

struct Row {
  FigureKey key;
  FigureSummary recorded;
  std::optional<FigureSummary> simulated;
  std::optional<FigureSummary> changed;
  std::optional<FigureSummary> run;
};

std::optional<FigureSummary> find(const Figures& figures, const FigureKey& key) {
  const auto found = figures.find(key);
  return found == figures.end() ? std::nullopt : std::optional(summary_of(found->second));
}

std::vector<Row> rows_of(const Comparison& comparison) {
  std::vector<Row> rows;
  for (const auto& [key, values] : comparison.recorded) {
    Row row{key, summary_of(values), find(comparison.simulated, key), std::nullopt, std::nullopt};
    if (comparison.changed) {
      row.changed = find(*comparison.changed, key);
    }
    if (comparison.run) {
      row.run = find(*comparison.run, key);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string short_name(const std::string& name) {
  if (name.size() <= kNameWidth) {
    return name;
  }
  const std::size_t half = (kNameWidth - 2) / 2;
  return name.substr(0, half) + ".." + name.substr(name.size() - (kNameWidth - 2 - half));
}

std::string times(const std::optional<FigureSummary>& of) {
  return of ? fmt::format("{:>8} {:>8}", format_duration(static_cast<double>(of->median_ns)),
                          format_duration(static_cast<double>(of->p99_ns)))
            : fmt::format("{:>8} {:>8}", "-", "-");
}

std::string errors(const std::optional<FigureSummary>& of, const FigureSummary& recorded) {
  const auto text = [](double error) {
    return std::abs(error) < 9.995 ? fmt::format("{:+.0f} %", 100 * error) : std::string("> 999 %");
  };
  return of ? fmt::format("{:>7} {:>7}", text(error_of(of->median_ns, recorded.median_ns)),
                          text(error_of(of->p99_ns, recorded.p99_ns)))
            : fmt::format("{:>7} {:>7}", "-", "-");
}

// How well a twin fits: of the rows that both have, the median of the errors, and how many are near enough.
struct Fit {
  std::size_t rows = 0;
  double median_error = 0;
  double p99_error = 0;
  std::size_t near_medians = 0;  // within 10 %
  std::size_t near_p99s = 0;     // within 25 %
};

Fit fit_of(const std::vector<Row>& rows, std::optional<FigureSummary> Row::*column) {
  Fit fit;
  std::vector<double> medians;
  std::vector<double> p99s;
  for (const Row& row : rows) {
    if (const auto& of = row.*column; of && row.recorded.count >= kEnoughRuns) {
      medians.push_back(std::abs(error_of(of->median_ns, row.recorded.median_ns)));
      p99s.push_back(std::abs(error_of(of->p99_ns, row.recorded.p99_ns)));
      fit.near_medians += medians.back() <= 0.10 ? 1 : 0;
      fit.near_p99s += p99s.back() <= 0.25 ? 1 : 0;
    }
  }
  fit.rows = medians.size();
  if (fit.rows > 0) {
    std::sort(medians.begin(), medians.end());
    std::sort(p99s.begin(), p99s.end());
    fit.median_error = medians[fit.rows / 2];
    fit.p99_error = p99s[fit.rows / 2];
  }
  return fit;
}

std::string fit_line(const std::string& what, const Fit& fit) {
  return fmt::format(
      "{}: error of the medians {:.0f} %, of the p99 {:.0f} %; {} of {} medians within 10 %, {} of {} p99 within 25 "
      "%, of those with {} runs or more\n",
      what, 100 * fit.median_error, 100 * fit.p99_error, fit.near_medians, fit.rows, fit.near_p99s, fit.rows,
      kEnoughRuns);
}

nlohmann::ordered_json times_json(const FigureSummary& of) {
  return {{"count", of.count}, {"p50_ns", of.median_ns}, {"p99_ns", of.p99_ns}};
}

nlohmann::ordered_json fit_json(const Fit& fit) {
  return {{"rows", fit.rows},
          {"p50_error", fit.median_error},
          {"p99_error", fit.p99_error},
          {"p50_within_10_percent", fit.near_medians},
          {"p99_within_25_percent", fit.near_p99s}};
}

}  // namespace

std::string table_of(const Comparison& comparison, std::size_t top) {
  std::vector<Row> rows = rows_of(comparison);
  const bool compares_run = comparison.run && !comparison.run_is_changed;
  std::string text;
  for (std::size_t kind = 0; kind < std::size(kTitles); ++kind) {
    std::vector<Row> part;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(part),
                 [&](const Row& row) { return static_cast<std::size_t>(row.key.kind) == kind; });
    if (part.empty()) {
      continue;
    }
    const std::size_t all = part.size();
    if (top > 0 && all > top) {
      std::stable_sort(part.begin(), part.end(),
                       [](const Row& left, const Row& right) { return left.recorded.p99_ns > right.recorded.p99_ns; });
      part.resize(top);
    }
    const std::string title =
        all == part.size() ? kTitles[kind] : fmt::format("{}, {} of {}", kTitles[kind], part.size(), all);
    text += fmt::format("\n{:<{}} {:>17}   {:>17} {:>15}", title, kNameWidth, "recorded", "simulated", "error");
    text += comparison.changed ? fmt::format("   {:>17}", "what if") : "";
    text += comparison.run ? fmt::format("   {:>17}", comparison.run_is_changed ? "run, what if" : "run") : "";
    text += compares_run ? fmt::format(" {:>15}", "error") : "";
    text += fmt::format("\n{:<{}} {:>8} {:>8}   {:>8} {:>8} {:>7} {:>7}", "", kNameWidth, "p50", "p99", "p50", "p99",
                        "p50", "p99");
    text += comparison.changed ? fmt::format("   {:>8} {:>8}", "p50", "p99") : "";
    text += comparison.run ? fmt::format("   {:>8} {:>8}", "p50", "p99") : "";
    text += compares_run ? fmt::format(" {:>7} {:>7}", "p50", "p99") : "";
    text += "\n";
    for (const Row& row : part) {
      text += fmt::format("{:<{}} {}   {} {}", short_name(row.key.name), kNameWidth, times(row.recorded),
                          times(row.simulated), errors(row.simulated, row.recorded));
      text += comparison.changed ? "   " + times(row.changed) : "";
      text += comparison.run ? "   " + times(row.run) : "";
      text += compares_run ? " " + errors(row.run, row.recorded) : "";
      text += "\n";
    }
  }
  text += "\n" + fit_line("Simulated as it was", fit_of(rows, &Row::simulated));
  if (compares_run) {
    text += fit_line("Run", fit_of(rows, &Row::run));
  }
  return text;
}

std::string json_of(const Comparison& comparison) {
  const std::vector<Row> rows = rows_of(comparison);
  nlohmann::ordered_json json;
  json["version"] = 1;
  json["left_out_ns"] = comparison.left_out_ns;
  json["figures"] = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json one = {{"kind", kKinds[static_cast<std::size_t>(row.key.kind)]},
                                  {"name", row.key.name},
                                  {"recorded", times_json(row.recorded)}};
    if (row.simulated) {
      one["simulated"] = times_json(*row.simulated);
    }
    if (row.changed) {
      one["what_if"] = times_json(*row.changed);
    }
    if (row.run) {
      one["run"] = times_json(*row.run);
    }
    json["figures"].push_back(std::move(one));
  }
  json["simulated_error"] = fit_json(fit_of(rows, &Row::simulated));
  if (comparison.run && !comparison.run_is_changed) {
    json["run_error"] = fit_json(fit_of(rows, &Row::run));
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace twin_program
