// The graphics cards that the system knows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dspm {

/// Returns a name each, such as "NVIDIA H100 PCIe" or "AMD 0x744c" (the number of the device). `root` is that of the
/// file system. [Linux, sysfs-bus-pci; NVIDIA's driver, "The /proc Filesystem Interface"]
std::vector<std::string> graphics_cards(const std::filesystem::path& root = "/");

}  // namespace dspm
