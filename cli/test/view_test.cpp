// SPDX-License-Identifier: MIT
// The server of the page, asked as a browser would and as somebody would who should not; and `banyan view`.
#include "page_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "banyan/record/file.hpp"
#include "started_program.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

class View : public StartedProgram {
 protected:
  void SetUp() override {
    StartedProgram::SetUp();
    write("page/index.html", "<!doctype html>the page");
    write("page/assets/main.js", "1");
    write("page/assets/worker.mjs", "2");
    write("page/assets/live.wasm", "3");
    write("page/assets/look.css", "4");
    write("page/deep/index.html", "deep");
    write("secret.txt", "secret");
    fs::create_symlink(home_ / "secret.txt", home_ / "page/link.txt");
    fs::create_directory_symlink(home_, home_ / "page/up");
    for (int k = 0; k < 1'000'000; ++k) bytes_.push_back(static_cast<char>(k * 7 + k / 251));
    write("run.mcap", bytes_);
    write("scenarios/b.toml", "# text\ndescription = \"one\"\n[targets]\ncount = 2\nradius_m = 1.5\n");
    write("scenarios/a.toml", "name = \"first\"\n[targets]\ncount = 2\nradius_m = 1.5\n");
    write("scenarios/wrong.toml", "[swarm\n");
    write("scenarios/notes.md", "no scenario");
    fs::create_directory(home_ / "scenarios/folder.toml");
    ::mkfifo((home_ / "scenarios/pipe.toml").c_str(), 0600);
  }
  void serve(bool recording = true, const std::string& scenario = "", std::chrono::milliseconds patience = 5s) {
    const PageContent content{path("page"), recording ? path("run.mcap") : "", scenario, path("scenarios")};
    server_.emplace(content, 0, patience);
  }
  // A connection that has sent this and no more.
  [[nodiscard]] int visitor(const std::string& begin) const {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int bytes = 4096;  // as little as the system allows
    ::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    EXPECT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::send(socket, begin.data(), begin.size(), MSG_NOSIGNAL), static_cast<ssize_t>(begin.size()));
    return socket;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (home_ / name).string(); }
  httplib::Result get(const std::string& what, const httplib::Headers& headers = {}) {
    return httplib::Client("127.0.0.1", server_->port()).Get(what, headers);
  }
  // On a busy machine, too; two hundred who are waited for one after the other take longer.
  httplib::Result patient_get(const std::string& what) {
    httplib::Client client("127.0.0.1", server_->port());
    client.set_read_timeout(60);
    return client.Get(what);
  }
  httplib::Result range(const std::string& bytes) { return get("/file", {{"Range", "bytes=" + bytes}}); }
  // What httplib's client would not send as it is.
  std::string raw(const std::string& request, const std::string& after_the_answer = "") {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    std::string answer;
    if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0 &&
        ::send(socket, request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size())) {
      std::array<char, 4096> piece;
      bool sent = after_the_answer.empty();
      for (ssize_t got = 0; (got = ::recv(socket, piece.data(), piece.size(), 0)) > 0;) {
        answer.append(piece.data(), static_cast<std::size_t>(got));
        if (!std::exchange(sent, true))
          (void)::send(socket, after_the_answer.data(), after_the_answer.size(), MSG_NOSIGNAL);
      }
    }
    ::close(socket);
    return answer;
  }
  std::string raw_get(const std::string& target) {
    return raw("GET " + target + " HTTP/1.1\r\nHost: localhost:" + std::to_string(server_->port()) +
               "\r\nConnection: close\r\n\r\n");
  }

  std::string bytes_;
  std::optional<PageServer> server_;
};

TEST_F(View, ThePageIsServedWithTheTypesThatBrowsersInsistOn) {
  serve();
  EXPECT_EQ(server_->address(), "http://127.0.0.1:" + std::to_string(server_->port()) + "/?start");
  const std::vector<std::array<const char*, 3>> files{
      {"/", "<!doctype html>the page", "text/html; charset=utf-8"},
      {"/index.html?x=1", "<!doctype html>the page", "text/html; charset=utf-8"},
      {"/assets/main.js", "1", "text/javascript; charset=utf-8"},
      {"/assets/worker.mjs", "2", "text/javascript; charset=utf-8"},
      {"/assets/live.wasm", "3", "application/wasm"},
      {"/assets/look.css", "4", "text/css; charset=utf-8"},
      {"/deep/", "deep", "text/html; charset=utf-8"}};
  for (const auto& [what, body, type] : files) {
    const auto answer = get(what);
    ASSERT_TRUE(answer) << what;
    EXPECT_EQ(answer->status, 200) << what;
    EXPECT_EQ(answer->body, body) << what;
    EXPECT_EQ(answer->get_header_value("Content-Type"), type) << what;
    EXPECT_EQ(answer->get_header_value("X-Content-Type-Options"), "nosniff");
    // Isolated, or browsers would let the page have no threads.
    EXPECT_EQ(answer->get_header_value("Cross-Origin-Opener-Policy"), "same-origin");
    EXPECT_EQ(answer->get_header_value("Cross-Origin-Embedder-Policy"), "require-corp");
  }
  const auto head = httplib::Client("127.0.0.1", server_->port()).Head("/assets/live.wasm");
  ASSERT_TRUE(head);
  EXPECT_EQ(head->status, 200);
  EXPECT_EQ(head->get_header_value("Content-Length"), "1");
  EXPECT_EQ(get("/nothing.js")->status, 404);
  EXPECT_EQ(get("/assets")->status, 404);  // a folder without a page of its own
}

TEST_F(View, NothingOutsideThePageIsServed) {
  serve();
  for (const std::string target :
       {"/../secret.txt", "/%2e%2e/secret.txt", "/assets/../../secret.txt", "/assets/%2E%2E/%2e%2e/secret.txt",
        "/..%2fsecret.txt", "/..%5csecret.txt", "/link.txt", "/up/secret.txt", "/up/run.mcap", "//etc/passwd",
        "/%2fetc/passwd", "/page/../../secret.txt", "/secret.txt%00.html", "/./../secret.txt"}) {
    const std::string answer = raw_get(target);
    EXPECT_TRUE(has(answer, "HTTP/1.1 404") || has(answer, "HTTP/1.1 400")) << target << "\n" << answer;
    EXPECT_FALSE(has(answer, "secret\n") || has(answer, "\r\n\r\nsecret") || has(answer, "root:")) << target;
  }
  EXPECT_TRUE(has(raw_get("/assets/../index.html"), "the page"));
}

TEST_F(View, ARecordingIsReadByRanges) {
  serve();
  const auto whole = get("/file");
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->status, 200);
  EXPECT_EQ(whole->body, bytes_);
  EXPECT_EQ(whole->get_header_value("Accept-Ranges"), "bytes");
  EXPECT_EQ(whole->get_header_value_count("Accept-Ranges"), 1U);
  const auto expect = [&](const std::string& asked, std::size_t first, std::size_t last) {
    const auto answer = range(asked);
    ASSERT_TRUE(answer) << asked;
    EXPECT_EQ(answer->status, 206) << asked;
    EXPECT_EQ(answer->get_header_value("Content-Range"),
              "bytes " + std::to_string(first) + "-" + std::to_string(last) + "/1000000");
    EXPECT_TRUE(answer->body == bytes_.substr(first, last - first + 1)) << asked;
  };
  expect("0-7", 0, 7);
  expect("999999-999999", 999999, 999999);
  expect("500000-", 500000, 999999);
  expect("-100", 999900, 999999);
  expect("-5000000", 0, 999999);
  expect("300000-900000", 300000, 900000);       // longer than a piece
  expect("999990-99999999999", 999990, 999999);  // ends beyond the file
  for (const char* asked : {"1000000-", "1000000-1000005", "99999999999-", "-0"}) {
    const auto answer = range(asked);
    ASSERT_TRUE(answer) << asked;
    EXPECT_EQ(answer->status, 416) << asked;
    EXPECT_EQ(answer->get_header_value("Content-Range"), "bytes */1000000");
  }
  const auto several = range("0-3,8-9");  // as HTTP allows
  EXPECT_EQ(several->status, 200);
  EXPECT_EQ(several->body.size(), bytes_.size());
  for (const char* asked : {"abc", "7-3", "--4", "1-2-3"}) {
    const auto answer = range(asked);
    ASSERT_TRUE(answer) << asked;
    EXPECT_TRUE(answer->status == 416 || answer->body == bytes_) << asked << " " << answer->status;
  }
  httplib::Client client("127.0.0.1", server_->port());
  const auto head = client.Head("/file");
  EXPECT_EQ(head->status, 200);
  EXPECT_EQ(head->get_header_value("Content-Length"), "1000000");
  EXPECT_EQ(head->body, "");
}

TEST_F(View, ARecordingMayGrowAndVanish) {
  serve();
  EXPECT_EQ(json::parse(get("/start.json")->body),
            json::parse(R"({"recording":{"name":"run.mcap","size":1000000,"url":"file"}})"));
  write("run.mcap", bytes_ + "more");
  EXPECT_EQ(range("1000000-")->body, "more");
  EXPECT_EQ(json::parse(get("/start.json")->body)["recording"]["size"], 1000004);
  write("run.mcap", "");
  EXPECT_EQ(get("/file")->status, 200);
  EXPECT_EQ(get("/file")->body, "");
  EXPECT_EQ(range("0-")->status, 416);
  fs::remove(home_ / "run.mcap");
  for (const char* what : {"/file", "/start.json"}) {
    const auto answer = get(what);
    EXPECT_EQ(answer->status, 404) << what;
    EXPECT_TRUE(has(answer->body, "run.mcap: cannot open: No such file or directory")) << answer->body;
  }
}

TEST_F(View, ARecordingIsServedWhileItIsWrittenAndUnderItsNameOnceItIsFinished) {
  serve();
  for (const char* given : {"new.mcap", "new.mcap.part"}) {
    fs::remove(home_ / "new.mcap");
    server_.emplace(PageContent{path("page"), path(given), "", path("scenarios")}, 0);
    EXPECT_EQ(get("/file")->status, 404);
    record::OutputFile file(path("new.mcap"));
    file.write("\x89MCAP0\r\n");
    file.flush();
    EXPECT_EQ(range("0-")->get_header_value("Banyan-Growing"), "1") << given;
    EXPECT_EQ(json::parse(get("/start.json")->body)["recording"]["name"], "new.mcap.part");
    file.write("and the rest, \x89MCAP0\r\n");
    file.commit();
    EXPECT_FALSE(range("0-")->has_header("Banyan-Growing")) << given;
    EXPECT_EQ(range("8-")->body, "and the rest, \x89MCAP0\r\n");
    EXPECT_EQ(json::parse(get("/start.json")->body)["recording"]["name"], "new.mcap");
  }
}

TEST_F(View, NobodyWritesARecordingThatWasLeft) {
  server_.emplace(PageContent{path("page"), path("left.mcap"), "", path("scenarios")}, 0);
  {
    record::OutputFile file(path("left.mcap"));
    file.keep_part();
    file.write("\x89MCAP0\r\n and no more");
    file.flush();
    fs::last_write_time(path("left.mcap.part"), fs::file_time_type::clock::now() - 1min);
    EXPECT_TRUE(get("/file")->has_header("Banyan-Growing"));  // it pauses
  }
  fs::last_write_time(path("left.mcap.part"), fs::file_time_type::clock::now() - 1min);
  EXPECT_FALSE(get("/file")->has_header("Banyan-Growing"));
  fs::last_write_time(path("left.mcap.part"), fs::file_time_type::clock::now());
  EXPECT_TRUE(get("/file")->has_header("Banyan-Growing"));  // somebody who knows nothing of our locks
}

TEST_F(View, OnlyItsOwnAddressIsAnswered) {
  serve();
  const std::string port = std::to_string(server_->port());
  const auto with_host = [&](const std::string& host) { return get("/start.json", {{"Host", host}})->status; };
  for (const std::string& host : {"127.0.0.1:" + port, "localhost:" + port, "[::1]:" + port})
    EXPECT_EQ(with_host(host), 200) << host;
  for (const std::string& host :
       {std::string("127.0.0.1"), std::string("localhost:1"), "evil.example:" + port, "localhost.evil.example:" + port,
        "127.0.0.1.nip.io:" + port, "localhost:" + port + "0", "192.168.0.1:" + port}) {
    EXPECT_EQ(with_host(host), 403) << host;
  }
  EXPECT_TRUE(has(raw("GET /start.json HTTP/1.1\r\nConnection: close\r\n\r\n"), " 403 "));
  EXPECT_TRUE(has(raw("GET /file HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"), " 403 "));
  httplib::Client client("127.0.0.1", server_->port());
  EXPECT_EQ(client.Post("/file", "x", "text/plain")->status, 405);
  EXPECT_EQ(client.Delete("/file")->status, 405);
}

// What a page elsewhere hides in the body of a request that is refused is no request.
TEST_F(View, NothingComesAfterARefusal) {
  serve();
  const std::string hidden =
      "GET /start.json HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_->port()) + "\r\n\r\n";
  for (const char* head : {"POST / HTTP/1.1\r\nHost: evil.example", "BREW / HTTP/1.1\r\nHost: evil.example"}) {
    const auto answer =
        raw(std::string(head) + "\r\nContent-Length: " + std::to_string(hidden.size()) + "\r\n\r\n", hidden);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 4")) << answer;
    EXPECT_EQ(answer.find("HTTP/1.1", 1), std::string::npos) << answer;
    EXPECT_FALSE(has(answer, "recording")) << answer;
  }
}

// Two hundred that begin a request and do not go on are more than there is room for; the next one is answered.
TEST_F(View, SlowVisitorsDoNotKeepTheNextOneWaiting) {
  serve(true, "", 1h);
  std::vector<int> slow;
  slow.reserve(200);
  for (int k = 0; k < 200; ++k) slow.push_back(visitor("GET / HTTP/1.1\r\nX: "));
  for (int k = 0; k < 20; ++k) {
    const auto answer = patient_get("/assets/main.js");
    ASSERT_TRUE(answer) << k;
    EXPECT_EQ(answer->status, 200);
  }
  // Whoever has been there longest gave way, whoever came last is still there.
  pollfd first{slow.front(), POLLIN, 0};
  ASSERT_EQ(::poll(&first, 1, 60'000), 1);
  char byte = 0;
  EXPECT_LE(::recv(slow.front(), &byte, 1, 0), 0);
  EXPECT_EQ(::recv(slow.back(), &byte, 1, MSG_DONTWAIT), -1);
  EXPECT_EQ(errno, EAGAIN);
  server_.reset();  // ... and holds up nothing
  for (const int socket : slow) ::close(socket);
}

// Nor do those who ask and do not take the answer.
TEST_F(View, ReadersWhoDoNotReadDoNotKeepTheNextOneWaiting) {
  for (int k = 0; k < 10; ++k) bytes_ += bytes_.substr(0, 1'000'000);  // more than the system holds for a reader
  write("run.mcap", bytes_);
  serve();
  std::vector<int> slow;
  slow.reserve(150);
  const std::string ask = "GET /file HTTP/1.1\r\nHost: localhost:" + std::to_string(server_->port()) + "\r\n\r\n";
  for (int k = 0; k < 150; ++k) slow.push_back(visitor(ask));
  const auto answer = patient_get("/assets/main.js");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  server_.reset();
  for (const int socket : slow) ::close(socket);
}

TEST_F(View, ARequestThatComesByDropsHasNoEndlessTime) {
  serve(true, "", 300ms);
  const int slow = visitor("GET / HTTP/1.1\r\nX: ");
  bool over = false;
  for (int k = 0; k < 3000 && !over; ++k) {  // a byte every 10 ms, for half a minute
    (void)::send(slow, "x", 1, MSG_NOSIGNAL);
    std::this_thread::sleep_for(10ms);
    char byte = 0;
    const ssize_t got = ::recv(slow, &byte, 1, MSG_DONTWAIT);
    over = got == 0 || (got < 0 && errno != EAGAIN);
  }
  EXPECT_TRUE(over);
  ::close(slow);
}

TEST_F(View, FilesOfThePageAreServedWhole) {
  serve();
  for (const char* asked : {"bytes=0-999999", "bytes=0-,0-,0-", "bytes=2-3"}) {
    const auto answer = get("/assets/main.js", {{"Range", asked}});
    ASSERT_TRUE(answer) << asked;
    EXPECT_EQ(answer->status, 200) << asked;
    EXPECT_EQ(answer->body, "1") << asked;
    EXPECT_FALSE(answer->has_header("Content-Range")) << asked;
  }
}

TEST_F(View, ScenariosAndWhatToStartWith) {
  serve(false);
  EXPECT_EQ(json::parse(get("/start.json")->body), json::object());
  EXPECT_EQ(get("/file")->status, 404);
  const auto list = json::parse(get("/scenarios.json")->body);
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0]["name"], "first");
  EXPECT_EQ(list[1]["name"], "b");
  EXPECT_EQ(list[1]["description"], "one");
  EXPECT_EQ(list[1]["text"], read("scenarios/b.toml"));
  EXPECT_EQ(list[2]["name"], "wrong");
  serve(false, R"({"scenario":{}})");
  EXPECT_EQ(get("/start.json")->body, R"({"scenario":{}})");
}

TEST_F(View, ATakenPortIsSaid) {
  serve();
  try {
    const PageServer second(PageContent{path("page"), "", "", path("scenarios")}, server_->port());
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.exit_code, exit_lost);
    EXPECT_TRUE(has(error.what(), "port " + std::to_string(server_->port()))) << error.what();
    EXPECT_TRUE(has(error.what(), "it is taken")) << error.what();
  }
}

// ------------------------------------------------------------------------------- the command itself

class ViewCommand : public View {
 protected:
  // Starts `banyan view` with the page, waits for its address and gives the answer to /start.json.
  json started(Arguments arguments, int signal = SIGTERM, int input = -1) {
    arguments.insert(arguments.begin(), "view");
    fs::remove(home_ / "stdout.txt");
    const pid_t child = start(
        arguments,
        {.environment = {{"BANYAN_PAGE", path("page")}, {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}, .input = input});
    std::string said;
    for (int k = 0; k < 1000 && !said.ends_with('\n'); ++k) {
      std::this_thread::sleep_for(10ms);
      said = read("stdout.txt");
    }
    json answer;
    if (const auto colon = said.find(':', std::string_view("http:").size()); colon != std::string::npos) {
      httplib::Client client("127.0.0.1", std::stoi(said.substr(colon + 1)));
      if (const auto got = client.Get("/start.json")) answer = json::parse(got->body, nullptr, false);
    }
    ::kill(child, signal);
    const auto outcome = finish(child);
    EXPECT_EQ(outcome.code, 128 + signal) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("http://127.0.0.1:")) << outcome.out;
    said_ = outcome.out;
    return answer;
  }

  std::string said_;  // by the last that was started
};

TEST_F(ViewCommand, TakesARecordingAScenarioOrNothing) {
  write("small.toml", "# mine\n[swarm]\nrobots = 8\n[targets]\ncount = 2\nradius_m = 1.5\n");
  ASSERT_EQ(run({"run", "small.toml", "-q", "--out", "o"}).code, 0);
  EXPECT_EQ(started({"o/run.mcap"})["recording"]["size"], fs::file_size(home_ / "o/run.mcap"));
  write("cut.mcap.part", read("o/run.mcap").substr(0, 5000));
  EXPECT_EQ(started({"cut.mcap", "--wait"})["recording"]["name"], "cut.mcap.part");
  EXPECT_EQ(started({"cut.mcap.part"}, SIGINT)["recording"]["name"], "cut.mcap.part");
  EXPECT_EQ(
      started({"small.toml", "--set", "radio.loss=0.25", "--seed", "7"}),
      json({{"scenario",
             {{"name", "small.toml"}, {"text", read("small.toml")}, {"overrides", {"radio.loss=0.25", "seed=7"}}}}}));
  EXPECT_EQ(started({}), json::object());
  const int input = ::open(path("small.toml").c_str(), O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(started({"-"}, SIGTERM, input)["scenario"]["text"], read("small.toml"));
  ::close(input);
  // Files on the command line are nothing that a page could read: what it gets is what they come to.
  write("more.toml", "[radio]\nloss = 0.125\n");
  const json laid = started({"small.toml", "--with", "more.toml"});
  EXPECT_EQ(laid["scenario"]["overrides"], json::array());
  EXPECT_TRUE(has(laid["scenario"]["text"], "loss = 0.125")) << laid;
  const json earlier = started({"o/run.json"});
  EXPECT_EQ(earlier["scenario"]["name"], "run.json");
  EXPECT_EQ(earlier["scenario"]["text"], read("o/run.json"));
}

// The page reads what is behind the #; wherever the link was copied, nothing is asked of that server.
TEST_F(ViewCommand, OpensALinkHere) {
  const std::string experiment =
      "#scenario=three-targets&seed=7&do=50:{%22kind%22:%22die%22,%22robot%22:4}&t=12&view=0,1,60&robot=3";
  EXPECT_EQ(started({"https://example.org/elsewhere/" + experiment}), json::object());
  EXPECT_TRUE(said_.ends_with("/?start" + experiment + "\n")) << said_;
  EXPECT_EQ(started({"#three-targets"}), json::object());
  EXPECT_TRUE(said_.ends_with("/?start#three-targets\n")) << said_;
}

// One that stays in the foreground is not waited for, neither at the beginning nor at the end.
TEST_F(ViewCommand, OpensABrowserOnADesktopOnly) {
  write("bin/xdg-open", "#!/bin/sh\necho \"$1\" >'" + path("opened") + "'\nexec sleep 3\n");
  fs::permissions(home_ / "bin/xdg-open", fs::perms::owner_all);
  const std::string programs = path("bin") + ":/usr/bin:/bin";
  const auto visit = [&](const Arguments& arguments, const std::string& display) {
    fs::remove(home_ / "opened");
    const pid_t child =
        start(arguments,
              {.environment = {
                   {"BANYAN_PAGE", path("page")}, {"PATH", programs}, {"DISPLAY", display}, {"WAYLAND_DISPLAY", ""}}});
    std::this_thread::sleep_for(1s);
    const auto begin = std::chrono::steady_clock::now();
    ::kill(child, SIGINT);
    const auto outcome = finish(child);
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 2500ms);
    return std::pair{outcome.out, exists("opened") ? read("opened") : ""};
  };
  const auto [address, opened] = visit({"view"}, ":7");
  EXPECT_EQ(opened, address);
  EXPECT_EQ(visit({"view", "--no-open"}, ":7").second, "");
  EXPECT_EQ(visit({"view"}, "").second, "");
}

TEST_F(ViewCommand, RefusesInWords) {
  write("small.toml", "[targets]\ncount = 2\nradius_m = 1.5\n");
  write("bad.toml", "[radio]\nloss = 2\n");
  const auto refuse = [&](Arguments arguments, int code, const std::string& reason) {
    arguments.insert(arguments.begin(), "view");
    const auto outcome = finish(start(arguments, {.environment = {{"BANYAN_PAGE", path("page")}}}));
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_TRUE(has(outcome.err, reason)) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  refuse({"bad.toml"}, 2, "bad.toml:2: error: radio.loss: is 2");
  refuse({"small.toml", "--set", "radio.los=1"}, 2, "--set radio.los=1: error: radio.los: there is no such key");
  refuse({"missing.toml"}, 2, "missing.toml: error: there is no such file");
  refuse({"missing.mcap"}, 1, "missing.mcap: cannot open: No such file or directory");
  refuse({"run.mcap"}, 1, "run.mcap: is not an MCAP file");
  refuse({"run.mcap", "--set", "radio.loss=0"}, 2, "a recording cannot be changed");
  refuse({"#three-target"}, 2, "did you mean three-targets?");
  refuse({"#scenario=three-targets&do=50:{%22kind%22:%22die%22,%22robot%22:99}"}, 2, "there is no robot 99");
  refuse({"#recording=run.mcap"}, 2, "the link shows a recording");
  refuse({"#three-targets", "--seed", "7"}, 2, "a link carries its own changes");
  refuse({"small.toml", "--port", "70000"}, 2, "--port");
  refuse({"small.toml", "--scenarios", "nowhere"}, 2, "nowhere: there is no such folder");
  refuse({"small.toml", "--page", "scenarios"}, 1, "scenarios: the page is not there (no index.html)");
  serve();
  refuse({"small.toml", "--port", std::to_string(server_->port())}, 1, "it is taken");
}

}  // namespace
}  // namespace banyan::cli
