#include "bench/measure/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "dspm/base/system/read_file.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

class TemporaryDirectory {
 public:
  TemporaryDirectory() : path_((fs::temp_directory_path() / "dspm-bench-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("cannot make a temporary directory " + path_);
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::string operator/(const char* name) const { return (fs::path(path_) / name).string(); }

 private:
  std::string path_;
};

[[noreturn]] void become_dspm(const std::vector<std::string>& arguments, const std::string& errors) {
  const int file = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0 || dup2(file, STDERR_FILENO) < 0) _exit(126);
  std::vector<char*> words{const_cast<char*>(DSPM_BINARY)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(DSPM_BINARY, words.data());
  _exit(127);
}

/// The number after the first occurrence of that key in the JSON.
double number_in(std::string_view json, const char* key) {
  const std::size_t at = json.find(fmt::format("\"{}\":", key));
  if (at == json.npos) throw std::runtime_error(fmt::format("dspm's statistics lack {}", key));
  return std::strtod(std::string(json.substr(json.find(':', at) + 1, 40)).c_str(), nullptr);
}

}  // namespace

ChildReport run_dspm(std::vector<std::string> arguments) {
  const TemporaryDirectory directory;
  const std::string statistics = directory / "stats.json", errors = directory / "errors.txt";
  arguments.insert(arguments.end(),
                   {"--quiet", "--stats=" + statistics, "--outfile=" + (directory / "image.####.exr")});
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start another process");
  if (child == 0) become_dspm(arguments, errors);
  int status = 0;
  if (waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("dspm failed: " + read_file(errors));
  const std::string json = read_file(statistics);
  return {.seconds = number_in(json, "seconds"),
          .peak_bytes = number_in(json, "peak_bytes"),
          .tree_bytes = number_in(json, "tree_bytes"),
          .integrator_bytes = number_in(json, "integrator_bytes")};
}

}  // namespace dspm
