// The evaluation: measures section by section and writes the figures into docs/results.md, a reduced run into
// out/results.md. Each section is a process of its own, so that none sees the memory of another, and its block is
// written as soon as it is measured.
//   evaluate [--quick] [--print] [words]          sections whose names contain one of the words, by default all
//   evaluate --scene FILE [-D name=value] [words]  the sections that fit any scene, on standard output
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>

#include "bench/measure/run.h"
#include "bench/report/document.h"
#include "bench/report/machine.h"
#include "bench/report/progress.h"
#include "bench/sections/section.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/read_file.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  Setup setup;
  bool print = false;  // on standard output instead of the document
  std::vector<std::string> words;
};

fs::path document(const Setup& setup) {
  return fs::path(DSPM_SOURCE_DIR) / (setup.quick ? "out/results.md" : "docs/results.md");
}

/// A reduced run starts from the prose alone: figures of different runs do not belong together.
void begin_document(const Setup& setup) {
  if (!setup.quick) return;
  std::string text = read_file(fs::path(DSPM_SOURCE_DIR) / "docs/results.md");
  for (const std::string& name : block_names(text)) text = with_block(text, name, "\nNot measured in this run.\n");
  fs::create_directories(document(setup).parent_path());
  write_file(document(setup), text);
}

/// Plots are files next to the document, written before it shows them.
void write(const Section& section, const Findings& findings, const Setup& setup) {
  const fs::path target = document(setup), plots = target.parent_path() / "plots";
  fs::create_directories(plots);
  for (const PlotFile& plot : findings.plots) write_file(plots / (plot.name + ".svg"), plot.svg);
  write_file(target, with_block(read_file(target), section.name, findings.text));
}

Findings measure(const Section& section, const Setup& setup) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Findings findings;
  try {
    findings = section.measure(setup);
  } catch (const Skipped& why) {
    findings.text = fmt::format("SKIPPED: {}.\n", why.what());
  }
  const auto seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  findings.text = fmt::format("\n{}\n*Measured {} in {:.0f} s with {} threads{}.*\n", findings.text, date_and_commit(),
                              seconds, thread_count(), setup.quick ? ", a reduced run" : "");
  return findings;
}

/// In the child process: the exit code.
int run(const Section& section, const Arguments& arguments) {
  say("{}: {}", section.name, section.sentence);
  try {
    const Findings findings = measure(section, arguments.setup);
    if (arguments.print) {
      fmt::print("## {}\n{}\n", section.name, findings.text);
    } else {
      write(section, findings, arguments.setup);
    }
    return std::fflush(stdout);
  } catch (const std::exception& error) {
    say("{} failed: {}", section.name, error.what());
    return 1;
  }
}

int run_apart(const Section& section, const Arguments& arguments) {
  const pid_t child = fork();
  if (child < 0) return say("cannot start another process"), 1;
  if (child == 0) _exit(run(section, arguments));
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) say("{} ended by signal {}", section.name, WTERMSIG(status));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

bool asked_for(const Section& section, const std::vector<std::string>& words) {
  return words.empty() || std::any_of(words.begin(), words.end(), [&](const std::string& word) {
           return std::string_view(section.name).find(word) != std::string_view::npos;
         });
}

std::string section_list() {
  std::string text = "Sections:";
  for (const Section& section : sections()) text += fmt::format("\n  {:<10} {}", section.name, section.sentence);
  text += "\nSections with --scene:";
  for (const Section& section : scene_sections()) text += fmt::format("\n  {:<10} {}", section.name, section.sentence);
  return text;
}

int evaluate(const Arguments& arguments) {
  std::vector<Section> chosen;
  for (const Section& section : arguments.setup.scene.empty() ? sections() : scene_sections())
    if (asked_for(section, arguments.words)) chosen.push_back(section);
  if (chosen.empty()) return fmt::print(stderr, "no section's name contains one of the words\n{}\n", section_list()), 2;
  if (!arguments.print) begin_document(arguments.setup);
  int failed = 0;
  for (const Section& section : chosen) failed += run_apart(section, arguments) != 0;
  if (!arguments.print) say("the figures are in {}", document(arguments.setup).string());
  if (failed > 0) say("{} sections failed", failed);
  return failed > 0;
}

}  // namespace
}  // namespace dspm

int main(int count, char** values) {
  dspm::Arguments arguments;
  CLI::App app("Measures dspm as docs/results.md describes, and writes the figures there.", "./dev bench");
  app.add_flag("--quick", arguments.setup.quick, "a reduced run of a few minutes, into out/results.md");
  app.add_flag("--print", arguments.print, "write to standard output instead");
  const auto scene = app.add_option("--scene", arguments.setup.scene, "measure this scene, on standard output");
  app.add_option("-D", arguments.setup.defines, "name=value for the scene's text")
      ->allow_extra_args(false)
      ->needs(scene);
  app.add_option("words", arguments.words, "sections whose names contain one of them; none: all");
  app.footer(dspm::section_list());
  CLI11_PARSE(app, count, values);
  if (!arguments.setup.scene.empty()) arguments.print = true;
  return dspm::evaluate(arguments);
}
