// SPDX-License-Identifier: MIT
#include "page_server.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/record/file.hpp"
#include "patient_server.hpp"
#include "terminal.hpp"

namespace banyan::cli {

namespace {

namespace fs = std::filesystem;
using httplib::Request;
using httplib::Response;
using json = nlohmann::ordered_json;

constexpr const char* host = "127.0.0.1";
constexpr std::uint64_t piece_bytes = std::uint64_t{1} << 18;
constexpr const char* plain = "text/plain; charset=utf-8";
constexpr const char* json_type = "application/json; charset=utf-8";

const char* type_of(const fs::path& file) {
  struct Type {
    std::string_view ending;
    const char* type;
  };
  static constexpr std::array<Type, 15> types{{{".html", "text/html; charset=utf-8"},
                                               {".js", "text/javascript; charset=utf-8"},
                                               {".mjs", "text/javascript; charset=utf-8"},
                                               {".css", "text/css; charset=utf-8"},
                                               {".wasm", "application/wasm"},
                                               {".json", json_type},
                                               {".map", json_type},
                                               {".webmanifest", "application/manifest+json"},
                                               {".svg", "image/svg+xml"},
                                               {".png", "image/png"},
                                               {".ico", "image/x-icon"},
                                               {".woff2", "font/woff2"},
                                               {".txt", plain},
                                               {".toml", plain},
                                               {".mcap", "application/octet-stream"}}};
  const std::string ending = file.extension();
  const auto found = std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.ending == ending; });
  return found == types.end() ? "application/octet-stream" : found->type;
}

std::optional<std::string> text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return in.good() || in.eof() ? std::optional(std::move(text)) : std::nullopt;
}

// The file below `folder` that a path of an address means; nothing if there is none or if it lies elsewhere,
// be it by "..", by an absolute name or by a symbolic link.
std::optional<fs::path> file_below(const fs::path& folder, const std::string& path) {
  if (path.find('\0') != std::string::npos || path.find('\\') != std::string::npos) return std::nullopt;
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return std::nullopt;
  fs::path file = fs::canonical(root / fs::path(path).relative_path(), error);
  if (!error && fs::is_directory(file, error)) file = fs::canonical(file / "index.html", error);
  if (error || !fs::is_regular_file(file, error) || error) return std::nullopt;
  const auto [end, ignored] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return end == root.end() ? std::optional(file) : std::nullopt;
}

std::string scenarios_json(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (fs::directory_iterator at(folder, ignored); !ignored && at != fs::directory_iterator(); at.increment(ignored)) {
    std::error_code odd;  // a folder of that name, a pipe without a writer
    if (at->path().extension() == ".toml" && at->is_regular_file(odd)) files.push_back(at->path());
  }
  std::sort(files.begin(), files.end());
  json list = json::array();
  for (const fs::path& file : files) {
    const auto text = text_of(file);
    if (!text) continue;
    // A scenario with faults is offered, too: the page shows them.
    const auto loaded = config::parse_configuration(file.filename(), *text, algorithms());
    const std::string name = loaded.ok() ? loaded.configuration.scenario.name : file.stem().string();
    list.push_back({{"name", name}, {"description", loaded.configuration.scenario.description}, {"text", *text}});
  }
  return list.dump(-1, ' ', false, json::error_handler_t::replace);
}

void say(Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text + "\n", plain);
}

// What a client asked for as bytes [first, last] of a file of `size` bytes. Several ranges are answered with
// the whole file, as HTTP allows.
struct Ranges {
  enum class Kind { whole, part, beyond } kind = Kind::whole;
  std::int64_t first = 0, last = 0;
};

Ranges ranges_of(const httplib::Ranges& asked, std::uint64_t size) {
  if (asked.size() != 1) return {};
  const auto end = static_cast<std::int64_t>(size);
  auto [first, last] = asked.front();
  if (first < 0) {  // the last so many bytes
    if (last <= 0 || end == 0) return {Ranges::Kind::beyond, 0, 0};
    return {Ranges::Kind::part, std::max<std::int64_t>(0, end - last), end - 1};
  }
  if (first >= end || (last >= 0 && last < first)) return {Ranges::Kind::beyond, 0, 0};
  return {Ranges::Kind::part, first, last < 0 ? end - 1 : std::min<std::int64_t>(last, end - 1)};
}

// A recording that is not finished, and that somebody still writes. One that was not made by us has no lock.
bool is_growing(const record::InputFile& file) {
  constexpr std::string_view magic = "\x89MCAP0\r\n";
  constexpr double lately_s = 5.0;
  std::string end;
  const bool finished =
      file.size() >= 2 * magic.size() && file.read(file.size() - magic.size(), magic.size(), end) && end == magic;
  return !finished && (file.is_being_written() || file.unchanged_s() < lately_s);
}

constexpr std::string_view part = ".part";

// A recording that is being written has another name than when it is finished.
std::shared_ptr<record::InputFile> open_either(const std::string& recording) {
  try {
    return std::make_shared<record::InputFile>(recording);
  } catch (const record::FileError& error) {
    std::error_code ignored;
    if (error.error_number() != ENOENT || !fs::exists(other_name(recording), ignored)) throw;
  }
  return std::make_shared<record::InputFile>(other_name(recording));
}

}  // namespace

std::string other_name(const std::string& recording) {
  if (recording.ends_with(part)) return recording.substr(0, recording.size() - part.size());
  return recording + std::string(part);
}

struct PageServer::Impl {
  Impl(PageContent what, std::chrono::milliseconds patience) : content(std::move(what)), server(patience) {}

  PageContent content;
  PatientServer server;
  int port = 0;
  std::atomic<bool> ending = false;
  std::thread thread;

  void bind(int wanted);
  void add_routes();
  [[nodiscard]] bool is_ours(const Request& request) const;
  void page(const Request& request, Response& response) const;
  void file(const Request& request, Response& response) const;
  void start(Response& response) const;
  [[nodiscard]] std::shared_ptr<record::InputFile> open_recording(Response& response) const;
};

void PageServer::Impl::bind(int wanted) {
  // httplib would share a port with a process that has it already (SO_REUSEPORT).
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_tcp_nodelay(true);
  errno = 0;
  if (wanted == 0) port = server.bind_to_any_port(host);
  else if (server.bind_to_port(host, wanted)) port = wanted;
  if (port > 0) return server.lengthen_queue();
  const std::string name = wanted == 0 ? "no port" : "port " + std::to_string(wanted);
  const std::string why = errno == EADDRINUSE ? "it is taken; leave out --port and one that is free is found"
                                              : std::string(std::strerror(errno));
  throw CommandError(exit_lost, name + " of this machine can be used: " + why);
}

// A foreign page could have its host name resolved to this machine and read what we serve: its requests carry
// its name, not ours (DNS rebinding).
bool PageServer::Impl::is_ours(const Request& request) const {
  const std::string given = request.get_header_value("Host");
  constexpr std::array names{"127.0.0.1", "localhost", "[::1]"};
  return std::any_of(names.begin(), names.end(), [&](const char* name) {
    return given == std::string(name) + ":" + std::to_string(port) || (port == 80 && given == name);
  });
}

void PageServer::Impl::add_routes() {
  // Opener and embedder policy isolate the page from all others: only then do browsers let it have threads.
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Cross-Origin-Embedder-Policy", "require-corp"},
                              {"Cache-Control", "no-cache"}});
  server.set_pre_routing_handler([this](const Request& request, Response& response) {
    using Result = httplib::Server::HandlerResponse;
    if (!is_ours(request)) {
      say(response, 403, "This server answers its own machine only, under the address that it printed.");
      return Result::Handled;
    }
    // Of a recording only; file() checks them. The request is httplib's own variable, constant for handlers.
    if (request.path != "/file") const_cast<Request&>(request).ranges.clear();
    if (request.method == "GET" || request.method == "HEAD") return Result::Unhandled;
    say(response, 405, "This server only answers GET and HEAD.");
    return Result::Handled;
  });
  server.Get("/start.json", [this](const Request&, Response& response) { start(response); });
  server.Get("/scenarios.json", [this](const Request&, Response& response) {
    response.set_content(scenarios_json(content.scenarios), json_type);
  });
  server.Get("/file", [this](const Request& request, Response& response) { file(request, response); });
  server.Get(".*", [this](const Request& request, Response& response) { page(request, response); });
}

void PageServer::Impl::page(const Request& request, Response& response) const {
  const auto path = file_below(content.page, request.path);
  const auto text = path ? text_of(*path) : std::nullopt;
  if (!text) return say(response, 404, "There is no such file in the page.");
  response.set_content(*text, type_of(*path));
}

// Opened again for every request: it may have grown, been finished, replaced or removed.
std::shared_ptr<record::InputFile> PageServer::Impl::open_recording(Response& response) const {
  if (content.recording.empty()) {
    say(response, 404, "No recording was given.");
    return nullptr;
  }
  try {
    return open_either(content.recording);
  } catch (const record::FileError& error) {
    say(response, error.error_number() == ENOENT ? 404 : 500, error.what());
    return nullptr;
  }
}

void PageServer::Impl::file(const Request& request, Response& response) const {
  const auto input = open_recording(response);
  if (!input) return;
  if (is_growing(*input)) response.set_header("Banyan-Growing", "1");  // the page asks again for what comes
  const Ranges ranges = ranges_of(request.ranges, input->size());
  // httplib cuts the ranges out by itself, but believes that they lie within the file.
  auto& asked = const_cast<Request&>(request).ranges;
  asked.clear();
  if (ranges.kind == Ranges::Kind::beyond) {
    response.set_header("Content-Range", "bytes */" + std::to_string(input->size()));
    return say(response, 416, "The recording has " + std::to_string(input->size()) + " bytes only.");
  }
  if (ranges.kind == Ranges::Kind::part) asked.emplace_back(ranges.first, ranges.last);
  response.set_header("Accept-Ranges", "bytes");
  if (input->size() == 0) return response.set_content("", "application/octet-stream");
  response.set_content_provider(
      input->size(), "application/octet-stream",
      [this, input, piece = std::string()](std::size_t offset, std::size_t length, httplib::DataSink& sink) mutable {
        if (ending) return false;
        try {
          // Cut short meanwhile: the connection ends, and the client sees that bytes are missing.
          if (!input->read(offset, std::min<std::uint64_t>(length, piece_bytes), piece)) return false;
        } catch (const record::FileError&) { return false; }
        return sink.write(piece.data(), piece.size());
      });
}

void PageServer::Impl::start(Response& response) const {
  if (content.recording.empty()) {
    return response.set_content(content.scenario.empty() ? "{}" : content.scenario, json_type);
  }
  const auto input = open_recording(response);
  if (!input) return;
  const json start = {
      {"recording", {{"name", fs::path(input->path()).filename().string()}, {"size", input->size()}, {"url", "file"}}}};
  response.set_content(start.dump(-1, ' ', false, json::error_handler_t::replace), json_type);
}

PageServer::PageServer(PageContent content, int port, std::chrono::milliseconds patience)
    : impl_(std::make_unique<Impl>(std::move(content), patience)) {
  impl_->bind(port);
  impl_->add_routes();
  impl_->thread = std::thread([server = &impl_->server] { server->listen_after_bind(); });
  // stop() before the server runs would be lost.
  while (!impl_->server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

PageServer::~PageServer() {
  impl_->ending = true;
  impl_->server.stop();
  impl_->thread.join();
}

int PageServer::port() const noexcept { return impl_->port; }
std::string PageServer::address() const {
  return std::string("http://") + host + ":" + std::to_string(impl_->port) +
         "/?start";  // the page asks for /start.json
}

}  // namespace banyan::cli
