#include "dspm/looking/serve/edits.h"

#include <utility>

#include "dspm/base/system/cancellation.h"
#include "dspm/base/system/files_read.h"

namespace dspm {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks(40), kQuiet(30);

FileStamps stamps_of(const std::vector<std::string>& files) {
  FileStamps stamps;
  for (const std::filesystem::path file : files) {
    std::error_code error;
    const std::filesystem::path real = std::filesystem::canonical(file, error);
    if (!error) stamps[real] = stamp_of(real);
  }
  return stamps;
}

/// Stamps the files so far, and those that were read since.
FileStamps look_at(const FileStamps& known) {
  FileStamps now;
  for (const auto& [file, stamp] : known) now[file] = stamp_of(file);
  for (const auto& [file, digest] : files_read()) now.try_emplace(file, stamp_of(file));
  return now;
}

bool differ(const FileStamps& before, const FileStamps& now) {
  for (const auto& [file, stamp] : before)
    if (now.at(file) != stamp) return true;
  return false;
}

}  // namespace

Edits::Edits(LivePage& page, const std::vector<std::string>& scenes, Load load)
    : page_(page), load_(std::move(load)), stamps_(stamps_of(scenes)), thread_([this] { run(); }) {}

Edits::~Edits() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::unique_ptr<LoadedScene> Edits::take() {
  const std::lock_guard lock(mutex_);
  return std::move(loaded_);
}

void Edits::run() {
  const auto ends_within = [this](std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, time, [this] { return ended_; });
  };
  int camera_changes = 0;
  while (!ends_within(kBetweenLooks)) {
    const bool is_moved = page_.camera_changes() != camera_changes;
    camera_changes = page_.camera_changes();
    FileStamps now = look_at(stamps_);
    if (!differ(stamps_, now)) {
      stamps_ = std::move(now);
      if (is_moved) load();
      continue;
    }
    page_.reset_camera();  // what the file says is newer
    camera_changes = page_.camera_changes();
    // Editors write a file in several steps.
    for (bool is_quiet = false; !is_quiet && !ends_within(kQuiet);) {
      FileStamps later = look_at(now);
      is_quiet = !differ(now, later);
      now = std::move(later);
    }
    stamps_ = std::move(now);
    load();
  }
}

void Edits::load() {
  while (!try_to_load()) std::this_thread::sleep_for(kBetweenLooks);
}

bool Edits::try_to_load() {
  try {
    std::unique_ptr<LoadedScene> loaded = load_();
    {
      const std::lock_guard lock(mutex_);
      loaded_ = std::move(loaded);
    }
    page_.show_problem("");
    page_.restart();
  } catch (const Cancelled&) {  // by the edit before this one, else the run ends
    return !page_.is_restarting();
  } catch (const std::exception& error) {
    page_.show_problem(error.what());
  }
  return true;
}

}  // namespace dspm
