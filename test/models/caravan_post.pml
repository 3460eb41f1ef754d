/* SPDX-License-Identifier: MIT */
/* Caravan's call gradient: robot 0, and with two sources the last one, too, has an open post for a while, and dies or has none
   any more. Robots step in turn, and of each neighbour hear what it says, what it said a step ago, or nothing. Once nobody
   calls, nobody knows of a call after LONGEST rounds. */
#include "swarm.pml"

#ifndef COUNTS
#define COUNTS 3   /* rounds for which robot 0 calls, at most */
#endif
#ifndef SOURCES
#define SOURCES 1
#endif
#ifndef LONGEST
#define LONGEST 12
#endif
#ifndef LOSSES
#define LOSSES 3   /* packets that get lost, or come a step late */
#endif

#define is_calling c_expr { now.robot[now.me].calls }

c_decl {
\#include "caravan.h"
\#include "sizes.h"
\#include "graphs.h"
#define FIRST_COUNT 254  /* so that it wraps */
};
c_state "struct Post robot[ROBOTS]" "Global"
c_state "struct Post older[ROBOTS]" "Global"

byte me, missed, late, ends;  /* bits: of whom the one in turn hears nothing, or what is old; whether the call ends in its step */
short graph, graph_count;
byte counts_left = COUNTS, losses_left = LOSSES, rounds;  /* since the call has ended */
byte calls = SOURCES;  /* robots that call */
bool endless;

c_code {
  static int hears(int a, int b) { return a != b && (graphs[now.graph] >> edge_bit(a, b) & 1); }

  static void take_step(void) {
    const int me = now.me;
    const struct Post* heard[ROBOTS];
    int from[ROBOTS], count = 0;
    struct Post r = now.robot[me];
    for (int k = 0; k < ROBOTS; ++k)
      if (hears(me, k) && !now.robot[k].dead && !(now.missed >> k & 1)) heard[count] = now.late >> k & 1 ? &now.older[k] : &now.robot[k], from[count++] = k;
    if (now.ends > 0) --now.calls, r.calls = 0, r.dead = now.ends == 2;
    if (!r.dead) caravan_post_step(me, &r, heard, from, count);
    now.older[me] = now.robot[me];
    now.robot[me] = r;
    if (me == ROBOTS - 1 && now.calls == 0) {
      int known = 0;
      for (int k = 0; k < ROBOTS; ++k) known |= !now.robot[k].dead && now.robot[k].source != no_robot;
      now.rounds = known ? now.rounds + 1 : 0;
      if (now.rounds > LONGEST) now.endless = 1;
    }
    Printf("robot %d: call %d count %d hops %d silence %d%s%s\n", me, r.source, r.count, r.hops, r.silence, r.calls ? " calls" : "", r.dead ? " dead" : "");
  }
};

inline choose_fate(k) {
  if
  :: skip
  :: losses_left > 0 -> missed = missed | (1 << k); losses_left--
  :: losses_left > 0 -> late = late | (1 << k); losses_left--
  fi
}

active proctype swarm() {
  atomic {
    choose_graph(graph);
    c_code {
      memset(now.robot, 0, sizeof now.robot);
      for (int k = 0; k < ROBOTS; ++k) {
        struct Post* r = &now.robot[k];
        r->calls = k == 0 || (SOURCES == 2 && k == ROBOTS - 1);
        r->source = r->calls ? k : no_robot, r->count = r->calls ? FIRST_COUNT : 0, r->own_count = r->count, r->ended_source = no_robot;
        now.older[k] = *r;
      }
    }
  };
  do
  :: atomic {
    choose_fate((me + 1) % ROBOTS);
    choose_fate((me + 2) % ROBOTS);
#if ROBOTS > 3
    choose_fate((me + 3) % ROBOTS);
#endif
    if
    :: !is_calling
    :: is_calling && counts_left > 0 -> counts_left--
    :: is_calling -> ends = 1
    :: is_calling -> ends = 2
    fi;
    c_code { take_step(); };
    assert(!endless);
    missed = 0; late = 0; ends = 0;
    me = (me + 1) % ROBOTS
  }
  od
}
