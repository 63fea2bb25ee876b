// dspm_scenes makes the meshes of the scenes in scenes/, which are too large for the repository. The same files, byte
// by byte, on every run.
//   dspm_scenes [--out DIRECTORY] [subject ...]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

std::string subject_list() {
  std::string text = "Subjects:";
  for (const Subject& subject : subjects()) text += fmt::format("\n  {:<12}{}", subject.name, subject.sentence);
  return text;
}

void make(const std::vector<std::string>& names, const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  for (const Subject& subject : subjects()) {
    if (!names.empty() && std::find(names.begin(), names.end(), subject.name) == names.end()) continue;
    subject.make(directory);
    fmt::print("{}: {}\n", subject.name, subject.sentence);
  }
}

int run(int count, char** arguments) {
  CLI::App app("Makes the meshes that the scenes in scenes/ need.");
  std::string directory = "scenes/meshes";
  std::vector<std::string> names, known;
  for (const Subject& subject : subjects()) known.emplace_back(subject.name);
  app.add_option("--out", directory, "where the files go")->capture_default_str();
  app.add_option("subjects", names, "what to make; everything, if nothing is named")->check(CLI::IsMember(known));
  app.footer(subject_list());
  try {
    app.parse(count, arguments);
    make(names, directory);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "dspm_scenes: {}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace dspm

int main(int count, char** arguments) { return dspm::run(count, arguments); }
