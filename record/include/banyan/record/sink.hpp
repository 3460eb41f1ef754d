// SPDX-License-Identifier: MIT
// Who is told of a run while it goes on: what is kept of it (output_formats.hpp), and the page that shows it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "banyan/measure/metrics.hpp"
#include "banyan/world/world.hpp"

namespace banyan::record {

// How a run ended.
struct RunEnd {
  measure::Run run;
  measure::Tick last;        // all zero if there was no step
  bool interrupted = false;  // stopped from outside before the mission had ended
};

// Told of the start before the first step, of every tick after its step, and of the end unless the run is
// thrown away. A sink overrides what it needs, and throws if it cannot go on.
class Sink {
 public:
  virtual ~Sink() = default;

  virtual void start(const world::World& world);
  virtual void tick(const world::World& world, const measure::Tick& tick);
  virtual void finish(const world::World& world, const RunEnd& end);
  // Whether the tick that `world` has just done is to be observed with lambda_2 itself, which takes time.
  [[nodiscard]] virtual bool wants_fiedler(const world::World& world) const;
  // The file in which what it has been told so far stays if it is thrown away unfinished; "": nothing stays.
  [[nodiscard]] virtual std::string rest() const;

 protected:
  Sink() = default;
  Sink(Sink&&) = default;
  Sink& operator=(Sink&&) = default;
};

// Several as one. If one fails, it is closed and what it said is kept: it costs neither the run nor the others.
class Sinks final : public Sink {
 public:
  struct Failure {
    std::string path;
    std::string text;  // begins with the path
    std::string rest;  // Sink::rest()
  };
  void add(std::string path, std::unique_ptr<Sink> sink);
  [[nodiscard]] const std::vector<Failure>& failures() const noexcept { return failures_; }  // in their order
  [[nodiscard]] std::vector<std::string> rests() const;  // of those that have not failed

  void start(const world::World& world) override;
  void tick(const world::World& world, const measure::Tick& tick) override;
  void finish(const world::World& world, const RunEnd& end) override;
  [[nodiscard]] bool wants_fiedler(const world::World& world) const override;

 private:
  struct Member {
    std::string path;
    std::unique_ptr<Sink> sink;  // none once it has failed
  };
  template <class Call> void tell(const Call& call);

  std::vector<Member> members_;
  std::vector<Failure> failures_;
};

}  // namespace banyan::record
