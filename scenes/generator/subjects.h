// What the generator makes. Each subject is a file of its own, which says how the thing is built and in which files and
// units it ends; main.cpp lists them all.
#pragma once

#include <filesystem>

namespace dspm {

void make_hall(const std::filesystem::path& directory);
void make_animal(const std::filesystem::path& directory);
void make_mirror_ball(const std::filesystem::path& directory);
void make_glass_ball(const std::filesystem::path& directory);
void make_agave(const std::filesystem::path& directory);
void make_water(const std::filesystem::path& directory);
void make_coffee_pot(const std::filesystem::path& directory);
void make_tableware(const std::filesystem::path& directory);

}  // namespace dspm
