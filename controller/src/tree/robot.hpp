// SPDX-License-Identifier: MIT
// What the rooms of the tree share during one step: parameters, state, what was heard, and an
// index of the neighbour table that is made once per tick so that no room has to search it again.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/tree/params.hpp"
#include "banyan/controller/tree/state.hpp"

namespace banyan {

// Indices into the neighbour table, ascending.
struct IndexList {
  std::uint8_t size = 0;
  std::array<std::uint8_t, neighbor_capacity> items;  // the first `size` are valid
  void push(int k) noexcept { items[size++] = static_cast<std::uint8_t>(k); }
  [[nodiscard]] const std::uint8_t* begin() const noexcept { return items.data(); }
  [[nodiscard]] const std::uint8_t* end() const noexcept { return items.data() + size; }
};

// The larger things that a robot works with in a step. They lie beside it, since a chip reaches only its first 124
// bytes with short loads.
struct Workspace {
  explicit Workspace(const Inputs<Heard>& inputs) noexcept : carry(inputs.carry()) {}
  Carry carry;
  IndexList children;
  IndexList old_children;
};

// Those of the packets heard that say something that this robot did not know at the beginning of the step, in order.
// The others, most of them, only repeat what is known, and rules that follow gossip need not look at them.
struct NewsList {
  struct Iterator {
    const Heard* at;
    const Heard& operator*() const noexcept { return *at; }
    Iterator& operator++() noexcept {
      at = at->next_news;
      return *this;
    }
    friend bool operator==(Iterator, Iterator) noexcept = default;
  };
  Heard* first = nullptr;
  Heard* last = nullptr;
  void push(Heard& h) noexcept {
    h.next_news = nullptr;
    (last == nullptr ? first : last->next_news) = &h;
    last = &h;
  }
  [[nodiscard]] Iterator begin() const noexcept { return {first}; }
  [[nodiscard]] static Iterator end() noexcept { return {nullptr}; }
};

// What a robot knows of the tree's gossip, at the beginning of a step.
struct KnownOfTree {
  explicit KnownOfTree(const TreeState& self) noexcept
      : id(self.id), root(self.root), epoch(self.epoch), phase(self.phase) {}
  [[nodiscard]] bool lacks(const TreeMessage& m) const noexcept {
    return m.root != root || m.epoch != epoch || m.phase != phase || m.new_root == id;
  }
  RobotId id;
  RootToken root;
  Serial epoch;
  Phase phase;
};

// Longest link that may be relied on, of C: the next step might break a longer one.
inline constexpr float longest_link = 0.95F;

struct TreeRobot {
  TreeRobot(const TreeParams& params_, TreeState& self_, const Inputs<Heard>& inputs, Workspace& space) noexcept
      : params(params_),
        self(self_),
        heard(inputs.heard()),
        obstacles(inputs.obstacles()),
        carry(space.carry),
        elapsed_ticks(inputs.elapsed_ticks()),
        forget_ticks(whole(params_.liveness_rounds)),
        children(space.children),
        old_children(space.old_children) {
    self.tally.rejected += inputs.rejected();
  }

  const TreeParams& params;
  TreeState& self;
  const Vec2* target = nullptr;  // own frame, C; null unless a worker
  std::span<Heard> heard;
  NewsList news;
  std::span<const Vec2> obstacles;  // nearest point of each within the proximity sensor's reach, own frame, C
  const Carry& carry;               // from the frame at the last step into mine
  int elapsed_ticks;                // since the last step
  int loss_ticks = 0;               // how long lost packets may silence a living neighbour; 0: unknown
  int forget_ticks;                 // and one that matters to nobody: less where packets get lost many in a row
  bool is_tree_news = false;        // some of `news` is what KnownOfTree lacks
  bool carries_on = false;          // a connector that has lost the last robot below it, and stays one (healing)
  bool is_station = false;          // somebody else moves it, and it keeps what it holds

  // The index (tree_index.hpp)
  std::uint8_t call_hops = nobody_calls;  // the smallest among living neighbours
  std::uint8_t useful_children = 0;       // living children (by parent or old parent) that are not spares
  int parent = -1;                        // index of the parent in the table
  int old_parent = -1;
  int hold = -1;            // without a parent: what ties me to the others (healing/hold.hpp)
  IndexList& children;      // living neighbours that name me as parent
  IndexList& old_children;  // living neighbours that name me as old parent and not as parent

  // The parent, old or new, and its index.
  void set_parent(int k) noexcept { self.parent = table().id(k), parent = k; }
  void set_old_parent(int k) noexcept { self.old_parent = table().id(k), old_parent = k; }
  void drop_parent() noexcept { self.parent = nobody, parent = -1; }
  void drop_old_parent() noexcept { self.old_parent = nobody, old_parent = -1; }
  // What was the parent becomes the old one. A robot without a parent keeps an old one: it is its only tie to the tree.
  void retire_parent() noexcept {
    if (self.parent != nobody) self.old_parent = self.parent, old_parent = parent;
    drop_parent();
  }

  // To a count of the ticks since something happened: those since the last step. It stays at its largest value.
  void add_elapsed(std::uint16_t& ticks) const noexcept {
    ticks = static_cast<std::uint16_t>(std::min(ticks + elapsed_ticks, UINT16_MAX));
  }

  // What is new of the tree's own gossip is among it, at most ticks nothing.
  [[nodiscard]] NewsList news_of_tree() const noexcept { return is_tree_news ? news : NewsList{}; }
  [[nodiscard]] const TreeTable& table() const noexcept { return self.neighbors; }
  [[nodiscard]] bool is_root() const noexcept { return self.root.id == self.id; }
  // I, and longer where packets are lost.
  [[nodiscard]] int liveness_ticks() const noexcept { return std::max(whole(params.liveness_rounds), loss_ticks); }
  // How long a connector waits for a child; one that has just chosen it may not have been heard yet.
  // A silent one counts as alive for long where packets get lost many in a row.
  [[nodiscard]] int patience_ticks() const noexcept {
    constexpr int sooner_in_bursts = 6;  // loss_ticks is the longest row of losses, and most are far shorter
    return std::max(whole(params.connector_rounds), has_bursts() ? loss_ticks / sooner_in_bursts : loss_ticks);
  }
  // The longest edge a robot may choose (protocol 2, row 4).
  [[nodiscard]] float parent_range() const noexcept { return params.ideal_distance - params.parent_margin; }
  // A point, relative to me, that the sender has written for me in its edge frame. False if it was not
  // heard in the tick before: what it wrote refers to where both were then, and over a distance a bearing that
  // is a tick old makes an error of a tenth of C.
  [[nodiscard]] bool read_point(const Heard& h, Coordinate x, Coordinate y, Vec2& point) const noexcept {
    if (h.before == Vec2{}) return false;
    point = carry.point({}) + from_edge_frame({x.value(), y.value()}, carry.vector(h.before));
    return true;
  }
  // Neighbour k is at the other end of an edge of mine, old or new.
  [[nodiscard]] bool is_tree_neighbor(int k) const noexcept {
    const TreeStanding& m = table().message(k);
    return k == parent || k == old_parent || m.parent == self.id || m.old_parent == self.id;
  }
  // Index of the robot that vectors of the census go to (up_of); -1 if it is not in the table.
  [[nodiscard]] int up() const noexcept { return self.parent != nobody ? parent : old_parent; }
  // I hear it, but it does not hear me.
  [[nodiscard]] bool is_deaf(int k) const noexcept {
    return table().deaf_ticks[static_cast<std::size_t>(k)] > deaf_after_ticks;
  }
  // It has passed me over since it last named me, or since it became my neighbour: it may not hear me.
  [[nodiscard]] bool may_be_deaf(int k) const noexcept {
    const int ticks = table().deaf_ticks[static_cast<std::size_t>(k)];
    return ticks != 0 && ticks != never_heard_ticks;
  }
  // We hear each other, as far as I know: only such a neighbour can be a parent or a hold.
  [[nodiscard]] bool is_linked(int k) const noexcept { return table().alive(k) && !is_deaf(k); }
  // Packets get lost many in a row (healing/loss.cpp).
  [[nodiscard]] bool has_bursts() const noexcept { return loss_ticks > forget_ticks; }
  // And it has heard me of late: only such a neighbour is taken as parent or hold, since it is to stay near.
  [[nodiscard]] bool is_sure(int k) const noexcept {
    return has_bursts() ? table().age(k) <= forget_ticks && table().deaf_ticks[static_cast<std::size_t>(k)] == 0
                        : is_linked(k);
  }
  [[nodiscard]] bool parent_alive() const noexcept { return parent >= 0 && is_linked(parent); }
  [[nodiscard]] bool old_parent_alive() const noexcept { return old_parent >= 0 && is_linked(old_parent); }
};

}  // namespace banyan
