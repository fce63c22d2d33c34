// The language server: handles messages in order, answers from known data, and runs analyses in
// other threads.
#pragma once
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lsp/analysis.hpp"
#include "lsp/queue.hpp"
#include "lsp/rpc.hpp"
#include "lsp/view.hpp"
#include "lsp/workspace.hpp"

namespace deck::lsp {

class Server {
 public:
  using Clock = Queue::Clock;
  /// `schemas` must outlive the server.
  Server(Connection& connection, const SchemaSet& schemas, Settings settings);
  ~Server();
  /// Serves until the client exits or closes. 0: shutdown was requested before.
  int run();

 private:
  // ---- messages (server.cpp)
  void read_messages();
  bool enqueue(const std::string& content);
  void dispatch(const Json& message);
  Json answer(const std::string& method, const Json& params, const Json& id, bool& later);
  void notified(const std::string& method, const Json& params);
  void respond(const Json& id, Json result);
  void fail(const Json& id, int code, const std::string& message);
  void notify(const char* method, Json params);
  void request(const char* method, Json params);
  bool cancelled(const Json& id);
  Json initialize(const Json& params);
  std::optional<View> view_of(const Json& params);

  // ---- documents (server_documents.cpp)
  void did_open(const Json& params);
  void did_change(const Json& params);
  void did_close(const Json& params);
  void did_save(const Json& params);
  void files_changed(const Json& params);
  void execute_command(const Json& id, const Json& params);
  void gap_report(const Json& id, const Json& params);
  void open_gap_report(const Json& id, const Json& argument);
  /// Builds the page in another thread for `then`; without a page the request fails.
  void form_report(const Json& id, const View& view, std::vector<std::int64_t> only,
                   std::function<void(std::string html)> then);
  Json explain(const Json& params) const;
  void cursor_moved(const Json& params);

  // ---- findings (server_findings.cpp)
  void schedule(const std::string& path, bool now = false);
  void start_due();
  std::optional<Clock::time_point> next_due() const;
  void start_analysis(OpenDeck& deck);
  void start_geometry(OpenDeck& deck);
  std::vector<OpenDeck*> decks_with(const std::string& path);
  void publish(OpenDeck& deck);
  bool is_current(const OpenDeck& deck) const;
  Json with_others(const OpenDeck& deck, const std::string& path, const Json& own);
  Json finding(const OpenDeck& deck, const Finding& d) const;

  // ---- progress
  struct Progress {
    std::string token;
    std::atomic<bool> stop{false};
  };
  std::shared_ptr<Progress> begin_progress(const std::string& title);
  void report_progress(const Progress& progress, std::size_t done, std::size_t all);
  void end_progress(const std::shared_ptr<Progress>& progress);

  Connection& connection_;
  Queue queue_;
  Workspace workspace_;
  Client client_;
  bool initialized_ = false, shutdown_ = false, done_ = false;
  int next_id_ = 1;
  std::mutex cancelling_;
  std::set<std::string> cancelled_;  ///< ids as JSON text
  std::map<std::string, std::shared_ptr<Progress>> progresses_;
  std::map<std::string, std::shared_ptr<Progress>> reports_;  ///< by request id

  int delay_ms_ = 150;
  bool geometry_on_save_ = true;
  std::map<std::string, Clock::time_point> due_;  ///< decks to be analysed
  std::map<std::string, std::shared_ptr<std::atomic<bool>>> analysing_;
  std::map<std::string, std::shared_ptr<Progress>> examining_;
  std::string report_folder_;  ///< temporary folder for reports; removed at the end

  // Last members: destroyed first.
  std::unique_ptr<Worker> analyst_, geometer_;
};

}  // namespace deck::lsp
