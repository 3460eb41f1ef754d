/* SPDX-License-Identifier: MIT */
/* Who is root. Included by handover.pml, where the token passes from neighbour to neighbour, and by election.pml, where
   the root dies or falls silent and others claim it; both with the rules by which the roots of fragments settle it.
   What a robot hears of a neighbour is that one's newest value or an older one. Whatever has happened: when nothing more
   does, and everybody hears its neighbours, all of a connected piece soon know one root (docs/proofs.md). */
#include "swarm.pml"

#ifndef DEATHS
#define DEATHS 1
#endif

/* What a robot may do. */
#define HEAR 1
#define OFFER 2     /* SELECT ROOT: to the neighbour chosen, or an end of it */
#define NOBODY_NEARER 3
#define TOO_LATE 4
#define ADVANCE 5
#define CLAIM 6
#define DIE 7

c_decl {
\#include "rules.h"
\#include "graphs.h"
\#include "seen.h"
#define HEARD(k, copy) ((copy) == 0 ? &now.robot[k] : &now.older[k][(copy) - 1])
};
c_state "struct Token robot[ROBOTS]" "Global"
c_state "struct Token older[ROBOTS][COPIES]" "Global"

byte act, me, from, copy;  /* the next step; 0 between steps */
short graph, graph_count;
byte offers_left = OFFERS, lates_left = LATES, claims_left = CLAIMS, advances_left = ADVANCES, deaths_left = DEATHS;
bool two_roots, no_root, disagree;

c_code {
  static int hears(int a, int b) { return a != b && (graphs[now.graph] >> edge_bit(a, b) & 1); }

  static void become(struct Token next) {
    struct Token* old = &now.robot[now.me];
    if (memcmp(&next, old, sizeof next) == 0) return;
    for (int k = COPIES - 1; k > 0; --k) now.older[now.me][k] = now.older[now.me][k - 1];
    now.older[now.me][0] = *old;
    *old = next;
    Printf("robot %d: act %d (from %d): epoch %d phase %d token (%d, %d) size %d offers %d%s\n", now.me, now.act, now.from,
           next.epoch, next.phase, next.sequence, next.root, next.size, next.new_root, next.dead ? " dead" : "");
  }

  /* What the root counts: all those it reaches. */
  static int living_within_reach(int k) {
    unsigned living = 0;
    for (int j = 0; j < ROBOTS; ++j) living |= now.robot[j].dead ? 0 : 1U << j;
    return __builtin_popcount(reach(graphs[now.graph], k, living));
  }

  static int spent(char* budget) {
    if (*budget == 0) return 1;
    --*budget;
    return 0;
  }

  /* From here on nothing goes wrong any more: rounds in which all hear all their neighbours. */
  static void calm(struct Token* robot) {
    for (int round = 0; round < 4 * ROBOTS; ++round) {
      struct Token before[ROBOTS];
      memcpy(before, robot, sizeof before);
      for (int k = 0; k < ROBOTS; ++k)
        for (int j = 0; j < ROBOTS; ++j)
          if (hears(k, j) && !before[j].dead && !robot[k].dead) token_hear(k, &robot[k], j, &before[j]);
    }
  }

  static void judge(void) {
    if (seen((unsigned long long)now.graph ^ (now.deaths_left == DEATHS ? 1ULL << 20 : 0), now.robot, sizeof now.robot)) return;
    struct Token robot[ROBOTS];
    memcpy(robot, now.robot, sizeof robot);
    calm(robot);
    unsigned living = 0;
    for (int k = 0; k < ROBOTS; ++k) living |= robot[k].dead ? 0 : 1U << k;
    for (int k = 0; k < ROBOTS; ++k) {
      if (robot[k].dead) continue;
      const unsigned piece = reach(graphs[now.graph], k, living);
      int roots = 0;
      for (int j = 0; j < ROBOTS; ++j) {
        if (!(piece >> j & 1)) continue;
        roots += token_is_root(j, &robot[j]);
        if (robot[j].root != robot[k].root || robot[j].sequence != robot[k].sequence) now.disagree = 1;
      }
      if (roots > 1) now.two_roots = 1;
      /* Nobody has died and nobody is root: the token is lost. */
      if (roots == 0 && now.deaths_left == DEATHS) now.no_root = 1;
    }
  }

  static void take_step(void) {
    const int me = now.me, from = now.from;
    struct Token r = now.robot[me];
    const struct Token* heard = HEARD(from, now.copy);
    if (r.dead) return;
    switch (now.act) {
      case HEAR:
        if (hears(me, from)) token_hear(me, &r, from, heard);
        break;
      case OFFER:
        if (!hears(me, from) || !token_is_root(me, &r) || r.phase != select_root_phase || r.new_root != nobody_id) return;
        token_select_root(me, &r, from, heard, 0);
        if (r.new_root == nobody_id || spent(&now.offers_left)) return;
        break;
      case NOBODY_NEARER:
        if (!token_is_root(me, &r) || r.phase != select_root_phase || r.new_root != nobody_id) return;
        token_select_root(me, &r, nobody_id, 0, 0);
        break;
      case TOO_LATE:
        if (!token_is_root(me, &r) || r.phase != select_root_phase || r.new_root == nobody_id || spent(&now.lates_left)) return;
        token_select_root(me, &r, nobody_id, 0, 1);
        break;
      case ADVANCE:
        if (!token_is_root(me, &r) || r.phase == select_root_phase || spent(&now.advances_left)) return;
        token_advance(me, &r, living_within_reach(me));
        break;
      case CLAIM:
        if (token_is_root(me, &r) || r.worker || spent(&now.claims_left)) return;
        token_claim(me, &r);
        break;
      case DIE:
        if (spent(&now.deaths_left)) return;
        r.dead = 1;
        break;
    }
    become(r);
    judge();
  }
};

active proctype swarm() {
  atomic {
    choose_graph(graph);
    c_code {
      for (int k = 0; k < ROBOTS; ++k) {
        now.robot[k] = (struct Token){.epoch = 65535, .sequence = 65535, .phase = grow_tree, .root = 0, .new_root = nobody_id, .size = ROBOTS};
        /* The last one serves a target, and may not be root. */
        now.robot[k].worker = k == ROBOTS - 1;
        for (int c = 0; c < COPIES; ++c) now.older[k][c] = now.robot[k];
      }
    }
  };
  do
  :: atomic {
    choose(me);
    if
    :: choose_other(from); choose_copy(copy);
       if :: act = HEAR :: act = OFFER fi
    :: act = NOBODY_NEARER
    :: act = TOO_LATE
    :: act = ADVANCE
    :: act = CLAIM
    :: act = DIE
    fi;
    c_code { take_step(); };
    assert(!two_roots);
    assert(!disagree);
    assert(!no_root);
    act = 0; me = 0; from = 0; copy = 0
  }
  od
}
