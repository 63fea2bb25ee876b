// A small disk of its own, which can be full or read-only even for root: a tmpfs that only this process and its
// children see. Where the system lets nobody mount, tests have to skip.
#pragma once

#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace dspm::test {

class MountedDisk {
 public:
  /// Why there can be none; empty: there can.
  static const std::string& obstacle() {
    static const std::string reason = leave_others_mounts() ? "" : std::string("no mounts here: ") + strerror(errno);
    return reason;
  }

  /// At a new directory. To be asked first: obstacle().
  explicit MountedDisk(const std::filesystem::path& place) : place_(place) {
    std::filesystem::create_directory(place);
    if (mount("dspm-test", place.c_str(), "tmpfs", 0, kSize) != 0)
      throw std::runtime_error(std::string("cannot mount: ") + strerror(errno));
  }
  ~MountedDisk() { umount2(place_.c_str(), MNT_DETACH); }
  MountedDisk(const MountedDisk&) = delete;
  MountedDisk& operator=(const MountedDisk&) = delete;

  /// To the last byte.
  void fill() const {
    std::ofstream filler(filler_name(), std::ios::app);
    while (filler.put('x').flush()) {}
  }
  void make_room() const { std::filesystem::remove(filler_name()); }
  void make_read_only(bool read_only) const {
    const unsigned long flags = MS_REMOUNT | (read_only ? MS_RDONLY : 0);
    // Busy as long as somebody writes.
    while (mount(nullptr, place_.c_str(), nullptr, flags, kSize) != 0 && errno == EBUSY) usleep(1000);
  }

 private:
  static constexpr const char* kSize = "size=128k";
  std::filesystem::path filler_name() const { return place_ / "filler"; }

  /// Who is not root becomes the root of a user namespace.
  static bool leave_others_mounts() {
    const std::string user = std::to_string(geteuid()), group = std::to_string(getegid());
    if (unshare(geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    if (user != "0") {
      put_file("/proc/self/setgroups", "deny");
      put_file("/proc/self/uid_map", "0 " + user + " 1");
      put_file("/proc/self/gid_map", "0 " + group + " 1");
    }
    if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
    const TemporaryDirectory trial;
    const std::string place = (trial / "").string();
    return mount("dspm-test", place.c_str(), "tmpfs", 0, kSize) == 0 && umount(place.c_str()) == 0;
  }

  std::filesystem::path place_;
};

}  // namespace dspm::test
