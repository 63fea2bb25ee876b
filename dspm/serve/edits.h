// Edit and go on: watches the files of the scene, and loads it again on a thread of its own when one is saved.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dspm/serve/live_page.h"
#include "dspm/session/load.h"
#include "dspm/system/file_stamp.h"

namespace dspm {

class Edits {
 public:
  /// Throws SceneError if the scene is not whole.
  using Load = std::function<std::unique_ptr<LoadedScene>()>;

  /// To be made before the scene is read for the first time. Errors stand on the page. Once the scene has none, the run
  /// is asked to restart with it.
  Edits(LivePage& page, const std::vector<std::string>& scenes, Load load);
  ~Edits();
  Edits(const Edits&) = delete;
  Edits& operator=(const Edits&) = delete;

  /// What was loaded since; null: nothing.
  std::unique_ptr<LoadedScene> take();

 private:
  void run();
  void load();
  /// False: it was given up together with the iteration of a scene that is outdated by now.
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
