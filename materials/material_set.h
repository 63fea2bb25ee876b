// The materials that another one names, such as those of a mix.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace dspm {

class Material;

class MaterialSet {
 public:
  static const MaterialSet& none() {
    static const MaterialSet empty;
    return empty;
  }

  void add(std::string name, std::shared_ptr<const Material> material) {
    by_name_[std::move(name)] = std::move(material);
  }
  /// Returns null if no material has that name.
  std::shared_ptr<const Material> find(std::string_view name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
  }

 private:
  std::map<std::string, std::shared_ptr<const Material>, std::less<>> by_name_;
};

}  // namespace dspm
