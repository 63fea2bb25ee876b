#include "dspm/base/system/graphics_cards.h"

#include <algorithm>
#include <fstream>
#include <map>

namespace dspm {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries(const fs::path& folder) {
  std::error_code none;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// Returns the first word of a file, or an empty string.
std::string word_in(const fs::path& path) {
  std::ifstream file(path);
  std::string word;
  file >> word;
  return word;
}

/// Returns what follows "Model:".
std::string model_in(const fs::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("Model:")) return line.substr(std::min(line.find_first_not_of(" \t", 6), line.size()));
  return "";
}

bool is_display(const fs::path& device) { return word_in(device / "class").starts_with("0x03"); }

}  // namespace

std::vector<std::string> graphics_cards(const fs::path& root) {
  static const std::map<std::string, std::string> kMakers = {
      {"0x1002", "AMD"}, {"0x10de", "NVIDIA"}, {"0x8086", "Intel"}};
  std::vector<std::string> cards;
  for (const fs::path& card : entries(root / "proc/driver/nvidia/gpus"))
    if (const std::string model = model_in(card / "information"); !model.empty()) cards.push_back(model);
  const bool has_nvidias_driver = !cards.empty();
  for (const fs::path& device : entries(root / "sys/bus/pci/devices")) {
    const auto maker = kMakers.find(word_in(device / "vendor"));
    if (maker == kMakers.end() || !is_display(device) || (has_nvidias_driver && maker->second == "NVIDIA")) continue;
    cards.push_back(maker->second + " " + word_in(device / "device"));
  }
  return cards;
}

}  // namespace dspm
