#include "dspm/base/system/number_file.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>

#include "dspm/base/system/plain_text.h"

namespace dspm {

std::vector<float> read_numbers(const std::filesystem::path& path) {
  std::istringstream file(read_text(path));
  std::vector<float> numbers;
  for (std::string line; std::getline(file, line);) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line.substr(0, line.find('#')));
    while (!(words >> std::ws).eof()) {
      float number = 0;
      if (!(words >> number)) throw std::runtime_error("it is not a list of numbers");
      numbers.push_back(number);
    }
  }
  return numbers;
}

}  // namespace dspm
