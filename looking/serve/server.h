// The page's web server: its files, the state and the log as server-sent events, pictures, and orders. It has
// threads of its own, which never hold up the one that renders.
#pragma once

#include <memory>
#include <string>

#include "dspm/looking/serve/access.h"
#include "dspm/looking/serve/board.h"
#include "dspm/looking/serve/gallery.h"
#include "dspm/looking/serve/orders.h"

namespace dspm {

class Server {
 public:
  /// Throws std::runtime_error if it cannot listen there.
  Server(const ServeAddress& address, Gallery& gallery, Board& board, Orders& orders);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dspm
