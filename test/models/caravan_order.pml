/* SPDX-License-Identifier: MIT */
/* Caravan's order: nobody takes a parent that is not ahead, no pair (root, beat) falls back, and no chain of parents
   closes. Any robot may at any time be the cheapest parent there is, the parent may be forgotten, the root counts, and
   others claim to be root; what a robot hears of another is any of that robot's last values. Whatever has happened: once
   all hear their neighbours again, all hang on the newest root, on every connected graph. */
#include "swarm.pml"

#ifndef COUNTS
#define COUNTS 2
#endif
#ifndef CLAIMS
#define CLAIMS 1
#endif
#ifndef CALM
#define CALM 1      /* rounds of calm are looked at from each state */
#endif

/* What a robot may do. */
#define HEAR 1
#define COUNT 2
#define LOSE 3
#define CLAIM 4

c_decl {
\#include "caravan.h"
\#include "sizes.h"
\#include "graphs.h"
\#include "seen.h"
#define LAST 65535  /* counts begin there, so that they wrap */
#define CALM_ROUNDS 20
#define HEARD(k, copy) ((copy) == 0 ? &now.robot[k] : &now.older[k][(copy) - 1])
};
c_state "struct Place robot[ROBOTS]" "Global"
c_state "struct Place older[ROBOTS][COPIES]" "Global"

byte act, me, from, copy, likes;  /* the next step; 0 between steps */
byte counts_left = COUNTS, claims_left = CLAIMS;
bool cycle, behind, fell_back, orphan;

c_code {
  static unsigned calm_graph;
  static int hears_in_calm(int a, int b) { return a != b && (calm_graph >> edge_bit(a, b) & 1); }

  static int is_root(int k) { return now.robot[k].newest == k; }

  static int closes(const struct Place* robot, int k) {
    int at = robot[k].parent;
    for (int steps = 0; at != no_robot && steps <= ROBOTS; ++steps) at = robot[at].parent;
    return at != no_robot;
  }

  /* All hang on one root, within CALM_ROUNDS, on every connected graph. */
  static void judge(void) {
    if (!CALM || seen(0, now.robot, sizeof now.robot)) return;
    for (int g = 0; g < graph_total; ++g) {
      struct Place robot[ROBOTS];
      memcpy(robot, now.robot, sizeof robot);
      calm_graph = graphs[g];
      for (int k = 0; k < ROBOTS; ++k) caravan_place_order(k, &robot[k]);
      for (int round = 0; round < CALM_ROUNDS; ++round) caravan_round(ROBOTS, hears_in_calm, 0);
      for (int k = 0; k < ROBOTS; ++k) caravan_read_order(k, &robot[k]);
      for (int k = 0; k < ROBOTS; ++k) {
        if (robot[k].root != robot[0].root || robot[k].sequence != robot[0].sequence || robot[k].newest != robot[k].root) now.orphan = 1;
        if ((robot[k].parent == no_robot) != (robot[k].root == k)) now.orphan = 1;
        if (closes(robot, k)) now.cycle = 1;
      }
      if (now.orphan) {
        for (int k = 0; k < ROBOTS; ++k) Printf("  round %d: graph %x robot %d: root (%d, %d) newest (%d, %d) beat %d parent %d\n", CALM_ROUNDS,
          calm_graph, k, robot[k].sequence, robot[k].root, robot[k].newest_sequence, robot[k].newest, robot[k].beat, robot[k].parent);
        return;
      }
    }
  }

  static void become(struct Place next) {
    struct Place* old = &now.robot[now.me];
    if (memcmp(&next, old, sizeof next) == 0) return;
    if (caravan_compare(&next, old) < 0) now.fell_back = 1;
    for (int k = COPIES - 1; k > 0; --k) now.older[now.me][k] = now.older[now.me][k - 1];
    now.older[now.me][0] = *old;
    *old = next;
    Printf("robot %d: act %d (from %d copy %d likes %d): root (%d, %d) newest (%d, %d) beat %d parent %d\n", now.me, now.act, now.from, now.copy,
           now.likes, next.sequence, next.root, next.newest_sequence, next.newest, next.beat, next.parent);
    for (int k = 0; k < ROBOTS; ++k) {
      const struct Place* r = &now.robot[k];
      if (closes(now.robot, k)) now.cycle = 1;
      if (r->parent != no_robot && !caravan_is_ahead(r, &now.robot[r->parent])) now.behind = 1;
    }
    judge();
  }

  static void take_step(void) {
    const int me = now.me, from = now.from;
    struct Place r = now.robot[me];
    switch (now.act) {
      case HEAR:
        caravan_order_step(me, &r, from, HEARD(from, now.copy), r.parent == no_robot ? 0 : &now.robot[r.parent], now.likes);
        break;
      case COUNT:
        if (!is_root(me)) return;
        caravan_order_step(me, &r, no_robot, 0, 0, 0);
        break;
      case LOSE:
        if (r.parent == no_robot) return;
        caravan_order_lose(me, &r);
        break;
      case CLAIM:
        if (is_root(me) || r.newest == no_robot || now.claims_left == 0) return;
        --now.claims_left;
        caravan_order_claim(me, &r);
        become(r);
        return;
    }
    /* A root counts in each of its rounds. */
    if (r.newest == me) {
      if (now.counts_left == 0) return;
      --now.counts_left;
    }
    become(r);
  }
};

active proctype swarm() {
  c_code {
    find_graphs();
    memset(now.robot, 0, sizeof now.robot);
    for (int k = 0; k < ROBOTS; ++k) {
      now.robot[k].root = now.robot[k].newest = now.robot[k].parent = no_robot;
      if (k == 0) now.robot[k].root = now.robot[k].newest = 0, now.robot[k].sequence = now.robot[k].newest_sequence = LAST, now.robot[k].beat = LAST;
      for (int c = 0; c < COPIES; ++c) now.older[k][c] = now.robot[k];
    }
  };
  do
  :: atomic {
    choose(me);
    if
    :: choose_other(from); choose_copy(copy); act = HEAR;
       if :: likes = 0 :: likes = 1 fi
    :: act = COUNT
    :: act = LOSE
    :: act = CLAIM
    fi;
    c_code { take_step(); };
    assert(!cycle);
    assert(!behind);
    assert(!fell_back);
    assert(!orphan);
    act = 0; me = 0; from = 0; copy = 0; likes = 0
  }
  od
}
