// SPDX-License-Identifier: Apache-2.0
// Which callbacks, hops, chains and calls differ between two runs, or between a run and a baseline.
//
// docs/comparing_runs.md explains the method. In short: samples of one run resemble their neighbours, so that a test
// which took them as independent would find differences everywhere. Each run is therefore cut into blocks, and the
// values of the blocks (10th percentile, median, 90th percentile) are compared by a rank test. A ratio counts if it is
// larger than the least one that the user cares for, than what the run before differs within itself, than what other
// quantities of the sort differ between the runs, and, unless it is the 10th percentile of a callback's duration, than
// what the machine delays callbacks in either run and, unless both sides have several runs, than two other
// callbacks take. Probabilities are corrected for the number of tests. If a side has several runs, a difference must
// hold between every two of them; the work of callbacks, with four runs or more on both sides, between three quarters
// of the pairs (many_runs.hpp).
#pragma once

#include "tracing/model/compare/compare_options.hpp"
#include "tracing/model/compare/rank_test.hpp"
#include "tracing/model/compare/run_summary.hpp"

namespace tracing::compare {

struct Change {
  Kind kind = Kind::kCallback;
  std::string subject;
  std::string quantity;
  Statistic statistic = Statistic::kMedian;
  double before_ns = 0;
  double after_ns = 0;
  Shift shift;  // of the values of blocks, nanoseconds
  double probability = 1;
  bool doubtful = false;   // on either side
  bool estimated = false;  // likewise
  std::vector<std::string> changed_steps;
  std::string cause;

  bool is_slower() const { return shift.estimate > 0; }
  const char* kind_word() const { return kind_name(kind); }
  const char* statistic_word() const { return statistic_name(statistic); }
  double shift_ns() const { return shift.estimate; }
  double shift_low_ns() const { return shift.low; }
  double shift_high_ns() const { return shift.high; }

  static const Field<Change> kFields[];
};
inline constexpr Field<Change> Change::kFields[] = {
    {"kind", {&Change::kind_word, kKindNames}, ""},
    {"subject", &Change::subject, ""},
    {"quantity", &Change::quantity, ""},
    {"statistic", {&Change::statistic_word, kStatisticNames}, ""},
    {"before_ns", &Change::before_ns, ""},
    {"after_ns", &Change::after_ns, ""},
    {"shift_ns", &Change::shift_ns, "positive: slower"},
    {"shift_low_ns", &Change::shift_low_ns, ""},
    {"shift_high_ns", &Change::shift_high_ns, ""},
    {"probability", &Change::probability, "corrected for the number of tests"},
    {"doubtful", &Change::doubtful, "events may be missing"},
    {"estimated", &Change::estimated, "which publication a message is was found by its time"},
    {"changed_steps", &Change::changed_steps, "of a chain: its callbacks that have changed in the same direction"},
    {"cause", &Change::cause,
     "of the duration of a callback, from events of the kernel's scheduler; empty without them"},
};

// A subject that only one side has.
struct Lone {
  Kind kind = Kind::kCallback;
  std::string subject;

  bool operator==(const Lone&) const = default;
  const char* kind_word() const { return kind_name(kind); }

  static const Field<Lone> kFields[];
};
inline constexpr Field<Lone> Lone::kFields[] = {
    {"kind", {&Lone::kind_word, kKindNames}, ""},
    {"subject", &Lone::subject, ""},
};

// The median durations of all callbacks together, which also differ when the machine was slower.
struct Overall {
  std::size_t callbacks = 0;
  std::size_t slower = 0;
  double ratio = 0;

  static const Field<Overall> kFields[];
};
inline constexpr Field<Overall> Overall::kFields[] = {
    {"callbacks", &Overall::callbacks, ""},
    {"slower", &Overall::slower, "so many of them take longer"},
    {"ratio", &Overall::ratio, "of the callback in the middle: the shift as a part of the duration before"},
};

struct Comparison {
  std::vector<Change> changes;  // by kind, subject, quantity
  // Of subjects without a change: what holds if the runs differ half as much as they may, with a confidence of 90 %.
  std::vector<Change> likely;
  std::optional<Overall> overall;  // nullopt: no change of all callbacks together holds
  std::vector<Lone> gone;          // every run before has it, no run after
  std::vector<Lone> added;
  std::size_t compared = 0;  // subjects that both sides have
  std::size_t tests = 0;
  std::size_t too_few_samples = 0;  // quantities that both sides have, but not often enough
  // Quantities that depend on which message comes last, so that they can't be told from a few runs.
  std::size_t undecided = 0;
};

// Each side has at least one run. Results are in the order of kind, subject and quantity.
Comparison compare(const Runs& before, const Runs& after, const CompareOptions& options);

}  // namespace tracing::compare
