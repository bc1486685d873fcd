// SPDX-License-Identifier: Apache-2.0
// `launch top`: a full-screen view of a running launch.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "base/environment/own_environment.hpp"
#include "launcher/control/control_client.hpp"
#include "launcher/control/process_usage.hpp"
#include "launcher/language/exit_code_filter.hpp"
#include "programs/command_line/subcommand.hpp"
#include "programs/launch/command_functions.hpp"
#include "programs/launch/remote/on_option.hpp"
#include "programs/launch/steer/process_text.hpp"
#include "programs/launch/top/top_rows.hpp"
#include "programs/launch/top/top_screen.hpp"
#include "programs/watch/node_watch.hpp"

namespace launch {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using TopJson = ControlClient::Json;

constexpr milliseconds kPeriod{1000};
constexpr milliseconds kRedraw{100};  // lines of a log come at most so often

constexpr const char* kTableKeys = "s start  x stop  r restart  k signal  l log  t nodes  / filter  o sort  q quit";
constexpr const char* kLogKeys = "up/down scroll  / search  s start  x stop  r restart  q back";
constexpr const char* kNodesKeys = "up/down scroll  / search  t back";

class Top {
 public:
  Top(ControlClient launch, bool shows_nodes) : launch_(std::move(launch)) {
    if (shows_nodes) {
      show_nodes();
    }
  }

  // Returns when the user quits or the launch ends.
  void run();
  bool launch_ended() const { return launch_.ended(); }
  // The nodes' report, if they were watched. Ends the watching.
  std::string end() { return nodes_ ? nodes_->end() : std::string(); }

 private:
  enum class Prompt { kNone, kFilter, kSearch, kSignal };

  void update();
  void take_events();
  void draw();
  void show_nodes();
  void press(int key);
  void press_in_nodes(int key);
  void press_in_prompt(int key);
  void move(int key);
  void ask(const char* what, const std::string& signal = {});
  void open(Prompt prompt) {
    prompt_ = prompt;
    view_.input.clear();
  }
  std::string selected() const { return view_.rows.empty() ? std::string() : view_.rows[view_.selected].name; }

  ControlClient launch_;
  TopScreen screen_;
  TopRows model_;
  TopView view_;
  TopJson about_;
  Prompt prompt_ = Prompt::kNone;
  TopSort sort_ = TopSort::kOrder;
  std::string filter_;
  std::string search_;
  std::string shown_log_;  // the process whose lines are shown
  std::size_t count_ = 0;
  std::unique_ptr<NodeWatch> nodes_;  // from the first time on that they are shown
  bool shows_nodes_ = false;
  bool quit_ = false;
};

void Top::run() {
  launch_.ask({{"do", "output"}});
  steady_clock::time_point next = steady_clock::now();
  while (!quit_ && !launch_.ended()) {
    if (steady_clock::now() >= next) {
      update();
      next = steady_clock::now() + kPeriod;
    }
    draw();
    const auto left = std::chrono::ceil<milliseconds>(next - steady_clock::now());
    pollfd waits[] = {{STDIN_FILENO, POLLIN, 0}, {launch_.fd(), POLLIN, 0}};
    // Keys are answered at once; what the launch tells waits a little, so that a flood does not draw all the time.
    if (::poll(waits, 1, static_cast<int>(std::clamp(left, milliseconds(0), kRedraw).count())) > 0 &&
        (waits[0].revents & (POLLHUP | POLLERR)) != 0) {
      return;  // the terminal has gone
    }
    take_events();
    if (nodes_) {
      nodes_->update();
    }
    for (int key; (key = screen_.key()) != TopScreen::kNone && !quit_;) {
      if (prompt_ != Prompt::kNone) {
        press_in_prompt(key);
      } else {
        shows_nodes_ ? press_in_nodes(key) : press(key);
      }
    }
  }
}

void Top::update() {
  TopJson answer = launch_.ask("ps");
  add_usage(answer["processes"]);
  model_.update(answer["processes"], steady_clock::now());
  count_ = answer["processes"].size();
  about_ = std::move(answer);
}

void Top::take_events() {
  constexpr int kMost = 20'000;  // then keys have their turn
  for (int i = 0; i < kMost; ++i) {
    const std::optional<TopJson> event = launch_.next(milliseconds(0));
    if (!event) {
      return;
    }
    if (event->value("event", "") == "output") {
      model_.add_line(event->value("process", ""), event->value("line", ""));
    }
  }
}

void Top::draw() {
  const std::string before = selected();
  view_.rows = model_.rows(filter_, sort_);
  // The selection stays with its process.
  const auto same =
      std::find_if(view_.rows.begin(), view_.rows.end(), [&](const TopRow& row) { return row.name == before; });
  if (same != view_.rows.end()) {
    view_.selected = static_cast<std::size_t>(same - view_.rows.begin());
  }
  view_.selected = std::min(view_.selected, view_.rows.empty() ? 0 : view_.rows.size() - 1);
  const double age = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count() -
                     about_["launch"]["started"].get<double>();
  view_.heading = fmt::format("launch {}: {}, {} for {}, {} processes, {:.0f} % CPU, {}", launch_.pid(),
                              files_of(about_), about_["launch"]["state"].get<std::string>(), duration_text(age),
                              count_, model_.cpu(), memory_text(model_.memory()));
  if (!filter_.empty() && view_.message.empty()) {
    view_.message = fmt::format("only '{}', Escape shows all", filter_);
  }
  view_.title.clear();
  if (!shown_log_.empty()) {
    view_.title = "Output of " + shown_log_ + (search_.empty() ? "" : fmt::format(", only lines with '{}'", search_));
    view_.lines = model_.lines(shown_log_, search_);
    view_.scrolled = std::min(view_.scrolled, view_.lines.size());
  }
  view_.keys = shown_log_.empty() ? kTableKeys : kLogKeys;
  view_.from_beginning = shows_nodes_;
  if (shows_nodes_) {
    nodes_->set_width(screen_.width());
    view_.title = "What the nodes do" + (search_.empty() ? "" : fmt::format(", only rows with '{}'", search_));
    view_.lines = nodes_->lines_with(search_);
    view_.scrolled = std::min(view_.scrolled, view_.lines.size());
    view_.keys = kNodesKeys;
  }
  view_.prompt = prompt_ == Prompt::kFilter   ? "show only names or states with: "
                 : prompt_ == Prompt::kSearch ? "show only lines with: "
                 : prompt_ == Prompt::kSignal ? "signal for " + selected() + ": "
                                              : "";
  screen_.draw(view_);
}

void Top::show_nodes() {
  if (!nodes_) {
    nodes_ = std::make_unique<NodeWatch>();
  }
  shows_nodes_ = true;
  search_.clear();
  view_.scrolled = 0;
}

void Top::press_in_nodes(int key) {
  view_.message.clear();
  if (key == 't' || key == 'q' || key == TopScreen::kEscape) {
    shows_nodes_ = false;
    search_.clear();
  } else if (key == '/') {
    open(Prompt::kSearch);
  } else {
    move(key);
  }
}

void Top::press(int key) {
  const bool log = !shown_log_.empty();
  view_.message.clear();
  switch (key) {
    case 'q':
    case TopScreen::kEscape:
      quit_ = !log && key == 'q';
      if (!log && key != 'q') {
        filter_.clear();
      }
      shown_log_.clear();
      break;
    case 's':
      ask("start");
      break;
    case 'x':
      ask("stop");
      break;
    case 'r':
      ask("restart");
      break;
    case 'k':
      open(Prompt::kSignal);
      break;
    case '/':
      open(log ? Prompt::kSearch : Prompt::kFilter);
      break;
    case 'o': {
      constexpr const char* kNames[] = {"order of start", "name", "CPU", "memory", "restarts", "lines"};
      sort_ = sort_ == TopSort::kLines ? TopSort::kOrder : static_cast<TopSort>(static_cast<int>(sort_) + 1);
      view_.message = fmt::format("sorted by {}", kNames[static_cast<int>(sort_)]);
      break;
    }
    case 't':
      shown_log_.clear();
      show_nodes();
      break;
    case 'l':
    case TopScreen::kEnter:
      if (!log) {
        shown_log_ = selected();
        search_.clear();
        view_.scrolled = 0;
      }
      break;
    default:
      move(key);
  }
}

void Top::move(int key) {
  const bool lines = shows_nodes_ || !shown_log_.empty();
  const bool log = lines && !view_.from_beginning;
  const std::size_t page = screen_.height();
  const bool up = key == TopScreen::kUp || key == TopScreen::kPageUp || key == TopScreen::kHome;
  const bool down = key == TopScreen::kDown || key == TopScreen::kPageDown || key == TopScreen::kEnd;
  std::size_t step = key == TopScreen::kUp || key == TopScreen::kDown ? 1 : page;
  std::size_t& position = lines ? view_.scrolled : view_.selected;
  const std::size_t last = lines ? view_.lines.size() : view_.rows.empty() ? 0 : view_.rows.size() - 1;
  if (key == TopScreen::kHome || key == TopScreen::kEnd) {
    step = last;
  }
  // A log is counted from its end.
  if ((log && up) || (!log && down)) {
    position = std::min(position + step, last);
  } else if ((log && down) || (!log && up)) {
    position -= std::min(step, position);
  }
}

void Top::press_in_prompt(int key) {
  if (key == TopScreen::kEscape) {
    prompt_ = Prompt::kNone;
  } else if (key == TopScreen::kBackspace) {
    if (!view_.input.empty()) {
      view_.input.pop_back();
    }
  } else if (key == TopScreen::kEnter) {
    const Prompt done = std::exchange(prompt_, Prompt::kNone);
    if (done == Prompt::kFilter) {
      filter_ = view_.input;
    } else if (done == Prompt::kSearch) {
      search_ = view_.input;
    } else if (const int number = signal_number(view_.input); number != 0) {
      ask("signal", std::to_string(number));
    } else {
      view_.message = fmt::format("there is no signal '{}'", view_.input);
    }
  } else if (key >= ' ' && key < TopScreen::kUp && key < 256) {
    view_.input += static_cast<char>(key);
  }
}

void Top::ask(const char* what, const std::string& signal) {
  const std::string process = shown_log_.empty() ? selected() : shown_log_;
  if (process.empty()) {
    return;
  }
  TopJson request{{"do", what}, {"processes", {process}}};
  if (!signal.empty()) {
    request["signal"] = signal;
  }
  try {
    const TopJson outcome = launch_.ask(request);
    view_.message =
        outcome["refused"].empty() ? fmt::format("{} {}", what, process) : outcome["refused"][0].get<std::string>();
  } catch (const ControlError& error) {
    view_.message = error.what();
  }
  if (!launch_.ended()) {
    update();
  }
}

}  // namespace

int top_command(const std::vector<std::string>& words) {
  std::string wanted;
  Subcommand command("launch top", "Shows the processes of a running launch on the whole screen, and steers them.");
  bool shows_nodes = false;
  command.take_flag("--trace", shows_nodes,
                    "begin with what the nodes do, as the key t shows it: rates, latencies, missed periods, losses");
  command.take_text("--launch", wanted, kLaunchHelp);
  describe_on_option(command);
  if (const auto exit_code = command.parse(words)) {
    return *exit_code;
  }
  if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDOUT_FILENO) == 0) {
    throw ControlError("needs a terminal", "'launch ps' prints a table");
  }
  ControlClient launch = choose_launch(own_environment(), wanted);
  const pid_t pid = launch.pid();
  bool ended = false;
  std::string report;
  {
    Top top(std::move(launch), shows_nodes);
    try {
      top.run();
    } catch (const ControlError&) {
      if (!top.launch_ended()) {
        throw;
      }
    }
    ended = top.launch_ended();
    report = top.end();
  }
  fmt::print("{}", report);
  if (ended) {
    fmt::print("launch {} has ended\n", pid);
  }
  return 0;
}

}  // namespace launch
