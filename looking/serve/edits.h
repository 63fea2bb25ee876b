// Edit and go on: watches the files of the scene, and loads it again on a thread of its own when one is saved.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dspm/base/system/file_stamp.h"
#include "dspm/looking/serve/live_page.h"
#include "dspm/session/load.h"

namespace dspm {

class Edits {
 public:
  /// Loads the scene; throws SceneError if it is not whole.
  using Load = std::function<std::unique_ptr<LoadedScene>()>;

  /// Must be made before the scene is read for the first time. Errors stand on the page. Once the scene has none, the
  /// run is asked to restart with it.
  Edits(LivePage& page, const std::vector<std::string>& scenes, Load load);
  ~Edits();
  Edits(const Edits&) = delete;
  Edits& operator=(const Edits&) = delete;

  /// Returns what was loaded since the last call; null if nothing was.
  std::unique_ptr<LoadedScene> take();

 private:
  void run();
  void load();
  /// Returns false if it was given up together with the iteration of a scene that is out of date by now.
  bool try_to_load();

  LivePage& page_;
  const Load load_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::unique_ptr<LoadedScene> loaded_;
  bool ended_ = false;
  FileStamps stamps_;  // of the files that are watched
  std::thread thread_;
};

}  // namespace dspm
