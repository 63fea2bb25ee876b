// Runs dspm itself, as a user does, in a directory of its own; and other programs there.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace dspm::test {

using Arguments = std::vector<std::string>;

inline Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Outcome {
  int code;  // exit code; -signal where a signal ended it
  std::string out, err;
  double peak_bytes, cpu_seconds;  // by the kernel's account
};

/// A run of the program in `directory`; standard input is the file "input" there, or empty.
class Process {
 public:
  /// Standard output and standard error go to these files; empty: they are closed. `prepare` is called in the process
  /// that is to become dspm.
  Process(const TemporaryDirectory& directory, const std::vector<std::string>& arguments,
          const std::string& out = "out.txt", const std::string& err = "err.txt",
          const std::function<void()>& prepare = {})
      : directory_(directory), out_(out), err_(err) {
    child_ = fork();
    if (child_ == 0) become(arguments, prepare);
  }

  void send(int signal) const { kill(child_, signal); }
  /// A limit of the running process, "soft".
  void limit(__rlimit_resource resource, rlim_t value) const {
    rlimit limits{};
    prlimit(child_, resource, nullptr, &limits);
    limits.rlim_cur = value;
    prlimit(child_, resource, &limits, nullptr);
  }

  /// Of the running process; 0: it has ended.
  std::size_t resident_bytes() const {
    std::ifstream status("/proc/" + std::to_string(child_) + "/status");
    for (std::string word; status >> word;)
      if (std::size_t kilobytes = 0; word == "VmRSS:" && status >> kilobytes) return 1024 * kilobytes;
    return 0;
  }

  Outcome wait() const {
    int status = 0;
    rusage usage{};
    wait4(child_, &status, 0, &usage);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return {code, contents(directory_ / "out.txt"), contents(directory_ / "err.txt"),
            1024. * static_cast<double>(usage.ru_maxrss), seconds(usage.ru_utime) + seconds(usage.ru_stime)};
  }

 private:
  static double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  }
  [[noreturn]] void become(const std::vector<std::string>& arguments, const std::function<void()>& prepare) const {
    if (chdir((directory_ / "").c_str()) != 0) _exit(126);
    redirect(std::filesystem::exists("input") ? "input" : "/dev/null", O_RDONLY, 0);
    redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, 1);
    redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, 2);
    std::vector<char*> words{const_cast<char*>(DSPM_BINARY)};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    if (prepare) prepare();
    execv(DSPM_BINARY, words.data());
    _exit(127);
  }
  static void redirect(const std::string& path, int flags, int descriptor) {
    if (path.empty()) {
      close(descriptor);
      return;
    }
    const int file = open(path.c_str(), flags, 0644);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(125);
    close(file);
  }

  const TemporaryDirectory& directory_;
  std::string out_, err_;
  pid_t child_;
};

inline Outcome run(const TemporaryDirectory& directory, const std::vector<std::string>& arguments) {
  return Process(directory, arguments).wait();
}

/// Runs dspm with a limit on its address space.
inline Outcome run_below(const TemporaryDirectory& directory, double bytes, const Arguments& arguments) {
  return Process(directory, arguments, "out.txt", "err.txt",
                 [bytes] {
                   const rlimit limit{static_cast<rlim_t>(bytes), RLIM_INFINITY}, no_core{0, 0};
                   setrlimit(RLIMIT_AS, &limit);
                   setrlimit(RLIMIT_CORE, &no_core);
                 })
      .wait();
}

/// Runs a shell's command in the directory. Returns its exit code, -signal where a signal ended it; what it says is in
/// out.txt and err.txt unless it redirects that.
inline int shell(const TemporaryDirectory& directory, const std::string& command) {
  const std::string place = "cd '" + (directory / "").string() + "' && { ";
  const int status = std::system((place + command + "\n} > out.txt 2> err.txt").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Within half a minute.
inline bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}
inline bool appears(const std::filesystem::path& path) {
  return comes_true([&] { return std::filesystem::exists(path); });
}
/// On standard error.
inline bool says(const TemporaryDirectory& directory, const std::string& words) {
  return comes_true([&] { return contents(directory / "err.txt").find(words) != std::string::npos; });
}

/// Three frames of 12 x 8 pixels: a ball that moves under a spherical lamp.
inline const std::string kTinyScene = R"(
Frames 3 "float fps" 25
Integrator "dsppm" "string indirect" "photons" "integer iterations" 2 "integer photons" 200 "integer seed" 5
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 12 "integer yresolution" 8 "string filename" "tiny.exr"
WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [5 5 5]
    Translate 0 2 -1
    Shape "sphere" "float radius" 0.3
  AttributeEnd
  Material "diffuse" "rgb reflectance" [.7 .6 .5]
  AttributeBegin
    Translate 0 0 30
    Shape "sphere" "float radius" 29
  AttributeEnd
  DynamicBegin "ball"
    Keyframe 1  Translate -1 0 0
    Keyframe 3  Translate 1 0 0
    KeyframeEnd
    Shape "sphere" "float radius" 0.4
  DynamicEnd
)";

inline constexpr const char* kTinyImages[] = {"tiny.0001.exr", "tiny.0002.exr", "tiny.0003.exr"};

/// The tiny scene with other text in place of `from`.
inline std::string tiny_scene(const std::string& from, const std::string& to) {
  std::string scene = kTinyScene;
  return scene.replace(scene.find(from), from.size(), to);
}

/// Holds the tiny scene as tiny.dsc.
class TinyDirectory : public TemporaryDirectory {
 public:
  TinyDirectory() { put_file(*this / "tiny.dsc", kTinyScene); }
  bool has(const std::string& name) const { return std::filesystem::exists(*this / name); }
};

/// Runs dspm on the directory's tiny.dsc.
inline Outcome run_tiny(const TemporaryDirectory& directory, const Arguments& more) {
  return run(directory, Arguments{"tiny.dsc"} + more);
}

}  // namespace dspm::test
