// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/output_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/timeline/time_window.hpp"
#include "tracing/show/export/analysis_model.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"
#include "tracing/show/page/page.hpp"
#include "tracing/show/report/read_system.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

namespace {

namespace fs = std::filesystem;

std::int64_t absolute(const std::optional<TimeBound>& bound, std::int64_t first_ns, std::int64_t otherwise) {
  return !bound ? otherwise : bound->since_first ? first_ns + bound->ns : bound->ns;
}

std::unique_ptr<AnalysisModelWriter> model_writer(const OutputFiles& files) {
  if (files.analysis_model.empty()) {
    return nullptr;
  }
  return std::make_unique<AnalysisModelWriter>(files.analysis_model, [&files](std::int64_t first_ns) {
    AnalysisModelWriter::Window window;
    if (files.from) {
      window.begin_ns = absolute(files.from, first_ns, 0);
    }
    if (files.to) {
      window.end_ns = absolute(files.to, first_ns, 0);
    }
    return window;
  });
}

TracedSystem read(const std::vector<fs::path>& directories, const OutputFiles& files,
                  const std::vector<ChainDefinition>& chains, std::size_t most_in_page) {
  const std::unique_ptr<AnalysisModelWriter> model = model_writer(files);
  TracedSystem system =
      read_system(directories, {.chains = chains,
                                .with_details = !files.csv.empty() || !files.sqlite.empty() || !files.otlp.empty(),
                                .with_analysis = files.needs_timeline(),
                                .processes = files.processes,
                                .all = files.all,
                                .most_records = files.is_page_alone() ? most_in_page : 0,
                                .beside = model.get()});
  if (model) {
    model->finish();
  }
  return system;
}

void choose_window(TracedSystem& system, const OutputFiles& files) {
  if (!files.from && !files.to) {
    return;
  }
  timeline::Timeline& timeline = system.timeline;
  const std::int64_t first_ns = system.first_event_ns;
  const std::int64_t begin_ns = absolute(files.from, first_ns, timeline.begin_ns);
  timeline::keep_window(timeline, begin_ns, absolute(files.to, first_ns, timeline.end_ns + 1));
}

void write_page(const TracedSystem& system, OutputFile& file) {
  write_html_page(system, [&file](std::string_view part) { file.write(part); });
}

// Returns what is to be told beside the size.
std::string write_page(const TracedSystem& system, const fs::path& path, const PageLimit& limit) {
  OutputFile file(path);
  std::string note;
  const timeline::Timeline& whole = system.timeline;
  const std::int64_t end_ns = timeline::end_of_first(whole, limit.records);
  if (end_ns < whole.end_ns) {
    note = fmt::format(", the first {} of {}", format_duration(static_cast<double>(end_ns - whole.begin_ns)),
                       format_duration(static_cast<double>(whole.end_ns - whole.begin_ns)));
    TracedSystem copy = limit.alone == nullptr ? system : TracedSystem();
    TracedSystem& part = limit.alone == nullptr ? copy : *limit.alone;
    timeline::keep_window(part.timeline, whole.begin_ns, end_ns);
    write_page(part, file);
  } else {
    write_page(system, file);
  }
  file.finish();
  return note;
}

// A form of another tool, which is complete.
template <void (*kExport)(const TracedSystem&, const fs::path&)>
std::string write_whole(const TracedSystem& system, const fs::path& file, const PageLimit&) {
  kExport(system, file);
  return "";
}

const OutputForm kForms[] = {
    {"--html", "FILE", "Write a page for a browser: graph, time chart, plots, chains; with --diff: both runs",
     &OutputFiles::html, write_page},
    {"--perfetto", "FILE", "Write what ui.perfetto.dev reads (JSON of Chrome's trace events)", &OutputFiles::perfetto,
     write_whole<export_perfetto>},
    {"--csv", "DIR", "Write tables as CSV files to a directory", &OutputFiles::csv, write_whole<export_csv>},
    {"--sql", "FILE", "Write tables as an SQLite database", &OutputFiles::sqlite, write_whole<export_sqlite>},
    {"--otlp", "FILE", "Write chains as traces of OpenTelemetry (JSON of OTLP)", &OutputFiles::otlp,
     write_whole<export_otlp>},
    {"--analysis-model", "DIR", "Write the tables of tracetools_analysis as CSV files to a directory",
     &OutputFiles::analysis_model, nullptr},
    {"--dot", "FILE", "Write the graph of nodes and topics for Graphviz", &OutputFiles::dot, write_whole<export_dot>},
    {"--svg", "FILE", "Write this graph as a picture, drawn by Graphviz", &OutputFiles::svg, write_whole<export_svg>},
};

}  // namespace

std::span<const OutputForm> output_forms() {
  return kForms;
}

bool OutputFiles::needs_timeline() const {
  return std::any_of(std::begin(kForms), std::end(kForms),
                     [this](const OutputForm& form) { return form.write != nullptr && !(this->*form.file).empty(); });
}

bool OutputFiles::is_page_alone() const {
  const auto others = std::count_if(std::begin(kForms), std::end(kForms), [this](const OutputForm& form) {
    return form.write != nullptr && form.file != &OutputFiles::html && !(this->*form.file).empty();
  });
  return !html.empty() && others == 0 && !from && !to;
}

WrittenFiles write_files(const std::vector<fs::path>& directories, const OutputFiles& files,
                         const std::vector<ChainDefinition>& chains, std::size_t most_in_page) {
  TracedSystem system = read(directories, files, chains, most_in_page);
  choose_window(system, files);
  WrittenFiles written;
  written.error = system.error;
  written.open = system.open;
  written.others = system.others;
  written.incomplete = incomplete_phrase(system.results.overview, system.verdict);
  const PageLimit limit{most_in_page, files.is_page_alone() ? &system : nullptr};
  const auto add_line = [&written](const fs::path& file, const std::string& note) {
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(file, failed);
    written.lines.push_back(failed ? file.string() : fmt::format("{}: {}{}", file.native(), format_size(size), note));
  };
  for (const OutputForm& form : kForms) {
    const fs::path& file = files.*form.file;
    if (form.write != nullptr && !file.empty()) {
      add_line(file, form.write(system, file, limit));
    }
  }
  if (!files.analysis_model.empty()) {
    add_line(files.analysis_model, "");
  }
  return written;
}

}  // namespace tracing
