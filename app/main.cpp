// The command line: which task, and what the exit code is. 0 done, 1 scene or render error, 2 usage, 128 + signal.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/catalogue.h"
#include "app/driver.h"
#include "app/load.h"
#include "app/options.h"
#include "app/signals.h"
#include "app/standard_streams.h"
#include "core/errors.h"

namespace dspm {
namespace {

int run(const Options& options) {
  switch (options.task) {
    case Task::list: return print_data(list_plugins()), 0;
    case Task::describe: return print_data(describe_plugin(options.described)), 0;
    case Task::format: return print_data(formatted(options.scenes)), 0;
    case Task::list_variations: return print_data(variation_names(options)), 0;
    case Task::check: return check_scene(options);
    case Task::render: return render_scene(options);
  }
  return 0;
}

int run_or_inform(const std::vector<std::string>& arguments) {
  try {
    return run(parse_options(arguments));
  } catch (const Information& information) {
    print_data(information.text);
    return 0;
  }
}

int run_and_report(const std::vector<std::string>& arguments) {
  const auto say = [](const std::string& what) { print_message(fmt::format("dspm: {}\n", what)); };
  try {
    return run_or_inform(arguments);
  } catch (const UsageError& error) {
    say(error.what());
    return 2;
  } catch (const SceneError& error) {
    print_message(error.what());
  } catch (const std::bad_alloc&) {
    say("out of memory");
  } catch (const std::length_error&) {  // so much that no allocation is even tried
    say("out of memory");
  } catch (const std::exception& error) {
    say(error.what());
  }
  return InterruptRequests::exit_code(1);
}

}  // namespace
}  // namespace dspm

int main(int count, char** arguments) {
  dspm::prepare_standard_streams();
  return dspm::run_and_report({arguments + std::min(count, 1), arguments + count});
}
