// SPDX-License-Identifier: MIT
// Stands in for threads.cpp where there are no threads: however many are asked for, the caller is
// the only one. Worlds come out the same (docs/determinism.md).
#include <cstdlib>

#include "banyan/world/threads.hpp"

namespace banyan::world {

struct Executor::Team {};
void Executor::End::operator()(Team*) const {}  // there never is one

Executor::Executor(int) : threads_(1) {}
Executor::~Executor() = default;
void Executor::run(std::size_t, Call, void*) { std::abort(); }  // parallel_for() is for one thread inline

}  // namespace banyan::world
