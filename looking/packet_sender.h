// Sends packets to a server without ever waiting for it: a thread connects and sends. A server that is not there, is
// slow or vanishes costs nothing but its pictures; it is tried again every few seconds.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace dspm {

class PacketSender {
 public:
  /// Throws std::runtime_error if no thread can be started.
  PacketSender(std::string host, std::string port);
  /// Gives the server some time for what is left, if it takes any of it.
  ~PacketSender();
  PacketSender(const PacketSender&) = delete;
  PacketSender& operator=(const PacketSender&) = delete;

  /// Counts the connections: another number means a server that knows nothing of what was sent. It is 0 if there was
  /// none so far.
  int connection() const { return connection_; }
  /// Returns whether it is connected and has sent everything.
  bool is_idle() const;
  /// Sends a packet, which is dropped if there is no connection, or another one.
  void send(std::string packet, int connection);
  /// Returns why there is no connection, once; empty if there is one, or if it has been reported.
  std::string take_fault();

 private:
  using Clock = std::chrono::steady_clock;
  void run();
  /// Returns a socket, or -1 with the fault set.
  int connected();
  void serve(int socket);
  bool ends() const { return ended_ && (queue_.empty() || Clock::now() > deadline_); }

  const std::string host_, port_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> queue_;
  std::string fault_, told_;
  Clock::time_point deadline_;
  std::atomic<int> connection_{0};
  bool is_connected_ = false;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace dspm
