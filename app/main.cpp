#include <algorithm>

#include "dspm/app/command_line.h"
#include "dspm/app/run/last_words.h"
#include "dspm/base/system/standard_streams.h"
#include "dspm/base/system/thread_sanitizer.h"

#ifdef __SANITIZE_THREAD__
extern "C" const char* __tsan_default_suppressions() { return dspm::kNotJudged; }
#endif

int main(int count, char** arguments) {
  dspm::prepare_standard_streams();
  dspm::prepare_last_words();
  return dspm::end_as_meant(dspm::run_command_line({arguments + std::min(count, 1), arguments + count}));
}
