// The subjects that the generator makes. Each has a source file of its own, which says how the thing is built, and into
// which files and in which units it is written.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace dspm {

void make_hall(const std::filesystem::path& directory);
void make_animal(const std::filesystem::path& directory);
void make_mirror_ball(const std::filesystem::path& directory);
void make_glass_ball(const std::filesystem::path& directory);
void make_agave(const std::filesystem::path& directory);
void make_water(const std::filesystem::path& directory);
void make_pool(const std::filesystem::path& directory);
void make_coffee_pot(const std::filesystem::path& directory);
void make_tableware(const std::filesystem::path& directory);
void make_chair(const std::filesystem::path& directory);
void make_studio(const std::filesystem::path& directory);
void make_lamp(const std::filesystem::path& directory);
void make_diamond(const std::filesystem::path& directory);
void make_sky(const std::filesystem::path& directory);
void make_wood(const std::filesystem::path& directory);
void make_fabrics(const std::filesystem::path& directory);

struct Subject {
  std::string_view name, sentence;
  void (*make)(const std::filesystem::path& directory);
};
std::span<const Subject> subjects();

}  // namespace dspm
