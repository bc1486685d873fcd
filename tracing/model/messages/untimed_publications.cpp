// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/messages/untimed_publications.hpp"

#include <algorithm>
#include <functional>

namespace tracing {

namespace {

constexpr std::int64_t kTolerance = 2'000;        // ns: a write often takes so much less than all before it
constexpr std::int64_t kLongest = 1'000'000'000;  // ns: no write takes longer
constexpr std::int64_t kSoon = 10'000'000;        // ns: a message that is taken so soon is the newest one
constexpr std::int64_t kMostInaccurate = 20'000;  // ns: of the distance from the epoch that the tracer has measured
// How much longer than the least one a write usually takes at most, if there are others that it may be: nothing is
// known of the publisher; else so much, and so many times its mean.
constexpr std::int64_t kUsual = 200'000;      // ns
constexpr std::int64_t kUsualLeast = 20'000;  // ns
constexpr double kUsualTimes = 8;
constexpr double kWeight = 1.0 / 16;  // of a write in the mean

}  // namespace

// How many of the thread have begun by then.
std::size_t UntimedPublications::begun_by(const OfThread& sent, std::int64_t time_ns) {
  const auto later =
      std::partition_point(sent.begin(), sent.end(), [&](const Sent& one) { return one.begin_ns <= time_ns; });
  return static_cast<std::size_t>(later - sent.begin());
}

void UntimedPublications::add(const Publication& publication) {
  OfThread& sent = threads_[publication.thread];
  sent.push_back({publication, publication.rcl_ns != 0 ? publication.rcl_ns : publication.published_ns, kOpen});
  ++count_;
  if (sent.size() > most_) {
    sent.pop_front();
  }
}

void UntimedPublications::close(const Publication& publication, std::int64_t time_ns) {
  OfThread* const sent = threads_.find(publication.thread);
  if (sent != nullptr && !sent->empty() && sent->back().publication.number == publication.number) {
    sent->back().end_ns = time_ns;
  }
}

void UntimedPublications::add_candidate(OfThread& sent, std::size_t place, const SourceStamp& message,
                                        const SourceClock& clock) {
  const std::int64_t delay_ns = message.source_timestamp - sent[place].begin_ns;
  const std::int64_t after_least_ns = delay_ns - (clock.is_confirmed() ? clock.least_ns() : clock.offset_ns());
  if (after_least_ns > kLongest) {
    return;
  }
  found_.push_back({&sent, place, delay_ns, after_least_ns <= usual_ns(sent[place].publication.publisher)});
}

std::int64_t UntimedPublications::usual_ns(ObjectId publisher) const {
  const auto mean = means_.find(publisher);
  return mean == means_.end() ? kUsual : kUsualLeast + static_cast<std::int64_t>(kUsualTimes * mean->second);
}

void UntimedPublications::learn(ObjectId publisher, std::int64_t after_least_ns) {
  // A write that had to wait for a processor hardly counts.
  const double taken = static_cast<double>(std::min(after_least_ns, usual_ns(publisher)));
  const auto [mean, is_first] = means_.try_emplace(publisher, taken);
  mean->second += is_first ? 0 : kWeight * (taken - mean->second);
}

void UntimedPublications::find_by_clock(OfThread& sent, const SourceStamp& message, const SourceClock& clock) {
  const std::int64_t written_ns = message.source_timestamp - clock.least_ns();
  const std::size_t begun = begun_by(sent, written_ns + kTolerance);
  if (begun > 0 && std::min(sent[begun - 1].end_ns, message.taken_ns) >= written_ns) {
    add_candidate(sent, begun - 1, message, clock);
  }
}

void UntimedPublications::find_near(OfThread& sent, const SourceStamp& message, const SourceClock& clock) {
  const std::int64_t written_ns = message.source_timestamp - clock.offset_ns();
  std::size_t begun = begun_by(sent, std::min(written_ns + SourceClock::kUncertainty, message.taken_ns));
  while (begun > 0 && std::min(sent[begun - 1].end_ns, message.taken_ns) >= written_ns - SourceClock::kUncertainty) {
    add_candidate(sent, --begun, message, clock);
  }
}

void UntimedPublications::find_faster(OfThread& sent, const SourceStamp& message, const SourceClock& clock) {
  const std::int64_t least_ns =
      std::max(clock.least_ns() - SourceClock::kUncertainty, clock.offset_ns() - kMostInaccurate);
  const std::size_t before = begun_by(sent, message.source_timestamp - clock.least_ns() + kTolerance);
  std::size_t begun = begun_by(sent, std::min(message.source_timestamp - least_ns, message.taken_ns));
  while (begun > before) {
    add_candidate(sent, --begun, message, clock);
  }
}

std::optional<Publication> UntimedPublications::take(const SourceStamp& message, SourceClocks& clocks) {
  found_.clear();
  for (auto& [thread, sent] : threads_) {
    const SourceClock& clock = clocks.of(thread.process);
    clock.is_confirmed() ? find_by_clock(sent, message, clock) : find_near(sent, message, clock);
  }
  if (found_.empty()) {
    for (auto& [thread, sent] : threads_) {
      if (const SourceClock& clock = clocks.of(thread.process); clock.is_confirmed()) {
        find_faster(sent, message, clock);
      }
    }
  }
  if (found_.empty()) {
    learn_miss(message, clocks);
    return std::nullopt;
  }
  if (found_.size() > 1) {
    const auto is_usual = [](const Candidate& candidate) { return candidate.is_usual; };
    if (std::any_of(found_.begin(), found_.end(), is_usual)) {
      std::erase_if(found_, std::not_fn(is_usual));
    }
  }
  if (found_.size() != 1) {
    return std::nullopt;
  }
  const Candidate& only = found_.front();
  const Publication publication = (*only.thread)[only.place].publication;
  --count_;
  only.thread->erase(only.thread->begin() + static_cast<std::ptrdiff_t>(only.place));
  SourceClock& clock = clocks.of(publication.thread.process);
  clock.on_match(only.delay_ns);
  if (clock.is_confirmed()) {
    learn(publication.publisher, only.delay_ns - clock.least_ns());
  }
  return publication;
}

// If all publications are those of one process, its clock may have been set.
void UntimedPublications::learn_miss(const SourceStamp& message, SourceClocks& clocks) {
  ProcessId process = kNoProcess;
  const Sent* newest = nullptr;
  for (const auto& [thread, sent] : threads_) {
    if (process != kNoProcess && thread.process != process) {
      return;
    }
    process = thread.process;
    const std::size_t begun = begun_by(sent, message.taken_ns);
    if (begun > 0 && (newest == nullptr || sent[begun - 1].begin_ns > newest->begin_ns)) {
      newest = &sent[begun - 1];
    }
  }
  if (newest == nullptr || !clocks.have_one_clock(process, message.taking_process)) {
    return;
  }
  if (message.taken_ns - newest->begin_ns <= kSoon) {
    clocks.of(process).on_miss(message.source_timestamp - std::min(newest->end_ns, message.taken_ns),
                               message.source_timestamp - newest->begin_ns);
  }
}

std::optional<Publication> UntimedPublications::extract(std::uint64_t number) {
  for (auto& [thread, sent] : threads_) {
    const auto found =
        std::find_if(sent.rbegin(), sent.rend(), [&](const Sent& one) { return one.publication.number == number; });
    if (found != sent.rend()) {
      const Publication publication = found->publication;
      sent.erase(std::next(found).base());
      --count_;
      return publication;
    }
  }
  return std::nullopt;
}

}  // namespace tracing
