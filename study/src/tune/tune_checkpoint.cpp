// SPDX-License-Identifier: MIT
// Two lines of JSON: what the checkpoint belongs to with a digest of the second line, and the state.
// Numbers are written with as many digits as it takes to read the same bits back.
#include "tune_checkpoint.hpp"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "banyan/record/file.hpp"
#include "banyan/version.hpp"
#include "hexadecimal.hpp"

namespace banyan::study {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* checkpoint_format = "banyan.tune-checkpoint";
constexpr int checkpoint_format_version = 1;

Json body_of(const Checkpoint& checkpoint) {
  Json islands = Json::array(), history = Json::array();
  for (const auto& island : checkpoint.islands)
    islands.push_back({{"points", island.points}, {"objectives", island.objectives}, {"algorithm", island.algorithm}});
  for (const auto& row : checkpoint.history)
    history.push_back(Json::array({row.island, row.generation, row.best, row.mean, row.worst, row.best_point}));
  return {{"generation", checkpoint.generation}, {"islands", islands}, {"history", history}};
}

Checkpoint from_body(const Json& body) {
  Checkpoint checkpoint;
  body.at("generation").get_to(checkpoint.generation);
  for (const auto& island : body.at("islands")) {
    auto& state = checkpoint.islands.emplace_back();
    island.at("points").get_to(state.points);
    island.at("objectives").get_to(state.objectives);
    island.at("algorithm").get_to(state.algorithm);
  }
  for (const auto& row : body.at("history")) {
    auto& entry = checkpoint.history.emplace_back();
    row.at(0).get_to(entry.island);
    row.at(1).get_to(entry.generation);
    row.at(2).get_to(entry.best);
    row.at(3).get_to(entry.mean);
    row.at(4).get_to(entry.worst);
    row.at(5).get_to(entry.best_point);
  }
  return checkpoint;
}

// Whether it can belong to this plan at all; the digests match already, but no file may crash the
// program.
bool plausible(const Checkpoint& checkpoint, const TunePlan& plan) {
  const std::size_t islands = plan.optimizer.islands;
  bool good = checkpoint.generation <= plan.optimizer.generations && checkpoint.islands.size() == islands &&
              checkpoint.history.size() == islands * (checkpoint.generation + 1ULL);
  for (const auto& row : checkpoint.history)
    good = good && row.island < islands && row.best_point.size() == plan.bounds.size();
  return good;
}

TuneError damaged(const std::string& path, const std::string& how) {
  return TuneError{path + ": the checkpoint is damaged (" + how +
                   "); start over with --force, or with another --out DIR"};
}

// The lines as they should be for this plan.
void check_owner(const std::string& path, const Json& head, const TunePlan& plan) {
  if (head.at("digest") != tune_digest(plan))
    throw TuneError(
        path +
        ": the checkpoint belongs to another tuning: the tune file, or a scenario that it names, was changed "
        "after it started. Undo the change to go on, or start over with --force or another --out DIR");
  const auto now = std::string(version) + " " + std::string(git_id());
  const auto then = head.at("version").get<std::string>() + " " + head.at("git").get<std::string>();
  if (now != then)
    throw TuneError(path + ": the checkpoint was written by banyan " + then + ", this is banyan " + now +
                    ": results may differ. Go on with the former, or start over with --force or another --out DIR");
}

}  // namespace

void save_checkpoint(const std::string& path, const TunePlan& plan, const Checkpoint& checkpoint) {
  const std::string body = body_of(checkpoint).dump();
  const Json head{{"format", checkpoint_format}, {"format_version", checkpoint_format_version},
                  {"version", version},          {"git", git_id()},
                  {"digest", tune_digest(plan)}, {"body", hexadecimal(digest_of(body))}};
  record::write_file(path, head.dump() + "\n" + body + "\n", record::Existing::replace);
}

std::optional<Checkpoint> load_checkpoint(const std::string& path, const TunePlan& plan) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    if (error) throw record::FileError(path, "cannot read", error.value());
    return std::nullopt;
  }
  const record::InputFile file(path);
  std::string text;
  if (!file.read(0, file.size(), text)) throw damaged(path, "it became shorter while it was read");
  const auto first = text.find('\n');
  if (first == std::string::npos || text.size() < first + 2 || text.back() != '\n')
    throw damaged(path, "its end is missing");
  const std::string body = text.substr(first + 1, text.size() - first - 2);
  try {
    const Json head = Json::parse(text.substr(0, first));
    if (head.at("format") != checkpoint_format || head.at("format_version") != checkpoint_format_version)
      throw damaged(path, "it is no checkpoint of this format");
    if (head.at("body") != hexadecimal(digest_of(body))) throw damaged(path, "its digest does not fit its content");
    check_owner(path, head, plan);
    auto checkpoint = from_body(Json::parse(body));
    if (!plausible(checkpoint, plan)) throw damaged(path, "its content contradicts itself");
    return checkpoint;
  } catch (const Json::exception& e) { throw damaged(path, e.what()); }
}

}  // namespace banyan::study
