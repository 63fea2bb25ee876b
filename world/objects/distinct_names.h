// Distinct names for things that have none, or the same: "sphere", "sphere.2", "sphere.3".
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace dspm {

class DistinctNames {
 public:
  /// Returns the index of the new name.
  int add(const std::string& wanted) {
    std::string name = wanted;
    for (int& count = counts_[wanted]; !taken_.insert(name).second;) name = wanted + "." + std::to_string(++count + 1);
    all_.push_back(std::move(name));
    return static_cast<int>(all_.size()) - 1;
  }
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::map<std::string, int> counts_;  // of numbers given
  std::set<std::string> taken_;
  std::vector<std::string> all_;
};

}  // namespace dspm
