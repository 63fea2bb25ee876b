// The command line: which task, and what the exit code is. 0 done, 1 scene or render error, 2 usage, 128 + signal.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

#include "app/catalogue.h"
#include "app/driver.h"
#include "app/load.h"
#include "app/options.h"
#include "app/signals.h"
#include "core/errors.h"

namespace dspm {
namespace {

int run(const Options& options) {
  switch (options.task) {
    case Task::list: return fmt::print("{}", list_plugins()), 0;
    case Task::describe: return fmt::print("{}", describe_plugin(options.described)), 0;
    case Task::format: return fmt::print("{}", formatted(options.scenes)), 0;
    case Task::list_variations: return fmt::print("{}", variation_names(options)), 0;
    case Task::check: return check_scene(options);
    case Task::render: return render_scene(options);
  }
  return 0;
}

int run_and_report(const std::vector<std::string>& arguments) {
  try {
    return run(parse_options(arguments));
  } catch (const Information& information) {
    fmt::print("{}", information.text);
    return 0;
  } catch (const UsageError& error) {
    fmt::print(stderr, "dspm: {}\n", error.what());
    return 2;
  } catch (const SceneError& error) {
    fmt::print(stderr, "{}", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "dspm: out of memory\n");
  } catch (const std::length_error&) {  // so much that no allocation is even tried
    fmt::print(stderr, "dspm: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "dspm: {}\n", error.what());
  }
  return InterruptRequests::exit_code(1);
}

}  // namespace
}  // namespace dspm

int main(int count, char** arguments) { return dspm::run_and_report({arguments + 1, arguments + count}); }
