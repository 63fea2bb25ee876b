#include <algorithm>

#include "app/command_line.h"
#include "app/standard_streams.h"

int main(int count, char** arguments) {
  dspm::prepare_standard_streams();
  return dspm::run_command_line({arguments + std::min(count, 1), arguments + count});
}
