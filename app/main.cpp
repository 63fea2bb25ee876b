#include <algorithm>

#include "app/command_line.h"
#include "app/last_words.h"
#include "app/standard_streams.h"
#include "core/thread_sanitizer.h"

#ifdef __SANITIZE_THREAD__
extern "C" const char* __tsan_default_suppressions() { return dspm::kNotJudged; }
#endif

int main(int count, char** arguments) {
  dspm::prepare_standard_streams();
  dspm::prepare_last_words();
  return dspm::run_command_line({arguments + std::min(count, 1), arguments + count});
}
