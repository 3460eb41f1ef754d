/* SPDX-License-Identifier: MIT */
/* One task, first served by robot 0: its worker dies, or is only not heard of for long, and spares take the task over.
   When nothing more happens a living robot serves it, and one alone; a first worker that lives is not replaced for good. */
#include "swarm.pml"

#ifndef DEATHS
#define DEATHS 1
#endif
#ifndef SUSPICIONS
#define SUSPICIONS 2   /* successors that give up a worker that lives */
#endif
#ifndef LAG
#define LAG 20         /* a successor knows a count at most so far behind the newest that anybody knows */
#endif
#ifndef BEATS
#define BEATS (30 / ROBOTS) /* ticks of a step */
#endif
#define FARTHEST 120   /* a count so far behind is as good as one still farther behind */

/* What a robot may do. */
#define STEP 1      /* hears nobody */
#define HEAR 2
#define SUCCEED 3   /* has not heard of the worker for too long */
#define DIE 4

c_decl {
\#include "rules.h"
\#include "graphs.h"
\#include "seen.h"
#define HEARD(k, copy) ((copy) == 0 ? &now.robot[k] : &now.older[k][(copy) - 1])
};
c_state "struct Service robot[ROBOTS]" "Global"
c_state "struct Service older[ROBOTS][COPIES]" "Global"

byte act, me, from, copy;  /* the next step; 0 between steps */
short graph, graph_count;
byte suspicions_left = SUSPICIONS, deaths_left = DEATHS;
bool two_holders, no_holder, replaced;

c_code {
  static int hears(int a, int b) { return a != b && (graphs[now.graph] >> edge_bit(a, b) & 1); }

  /* Only the differences of counts matter: the newest is 0, and none is farther behind than FARTHEST. */
  static void normalise(void) {
    int any = 0;
    unsigned short newest = 0;
    for (int k = 0; k < ROBOTS; ++k)
      if (now.robot[k].known && (!any || service_ahead_by(now.robot[k].beat, newest) > 0)) newest = now.robot[k].beat, any = 1;
    for (int k = 0; k < ROBOTS; ++k)
      for (int c = 0; c <= COPIES; ++c) {
        struct Service* s = HEARD(k, c);
        if (!s->known) { s->beat = 0; continue; }
        const int behind = service_ahead_by(newest, s->beat);
        s->beat = (unsigned short)-(behind > FARTHEST ? FARTHEST : behind);
      }
  }

  static void become(struct Service next) {
    struct Service* old = &now.robot[now.me];
    for (int k = COPIES - 1; k > 0; --k) now.older[now.me][k] = now.older[now.me][k - 1];
    now.older[now.me][0] = *old;
    *old = next;
    normalise();
    Printf("robot %d: act %d (from %d copy %d): holder %d count %d%s%s\n", now.me, now.act, now.from, now.copy, next.holder, now.robot[now.me].beat,
           next.serving ? " serves" : "", next.dead ? " dead" : "");
  }

  /* Rounds in which all hear all their neighbours; late in it, spares that have not heard of a living worker succeed it. */
  static void calm(struct Service* robot) {
    int age[ROBOTS];
    memset(age, 0, sizeof age);
    for (int round = 0; round < 60; ++round) {
      struct Service before[ROBOTS];
      memcpy(before, robot, sizeof before);
      for (int k = 0; k < ROBOTS; ++k) {
        if (robot[k].dead) continue;
        const int silent = age[k] > 3 * ROBOTS + k;  /* one is nearest to the target */
        int stepped = 0;
        for (int j = 0; j < ROBOTS; ++j)
          if (hears(k, j) && !before[j].dead) service_step(k, &robot[k], j, &before[j], stepped++ ? 0 : BEATS, 0);
        if (!stepped) service_step(k, &robot[k], nobody_id, 0, BEATS, 0);
        if (silent && !robot[k].serving && robot[k].beat == before[k].beat) service_step(k, &robot[k], nobody_id, 0, BEATS, 1);
        age[k] = robot[k].beat == before[k].beat ? age[k] + 1 : 0;
      }
#ifdef SHOW_CALM
      for (int k = 0; k < ROBOTS; ++k) Printf("  round %d: robot %d: holder %d count %d%s\n", round, k, robot[k].holder, robot[k].beat, robot[k].dead ? " dead" : robot[k].serving ? " serves" : "");
#endif
    }
  }

  static void judge(void) {
    if (seen((unsigned long long)now.graph, now.robot, sizeof now.robot)) return;
    struct Service robot[ROBOTS];
    memcpy(robot, now.robot, sizeof robot);
    calm(robot);
    unsigned living = 0;
    for (int k = 0; k < ROBOTS; ++k) living |= robot[k].dead ? 0 : 1U << k;
    for (int k = 0; k < ROBOTS; ++k) {
      if (robot[k].dead) continue;
      const unsigned piece = reach(graphs[now.graph], k, living);
      int holders = 0, known = 0;
      for (int j = 0; j < ROBOTS; ++j) holders += (piece >> j & 1) && robot[j].serving, known += (piece >> j & 1) && robot[j].known;
      if (holders > 1) now.two_holders = 1;
      if (holders == 0 && known > 0) now.no_holder = 1;
    }
    if (!robot[0].dead && !robot[0].serving) now.replaced = 1;
  }

  static void take_step(void) {
    const int me = now.me, from = now.from;
    struct Service r = now.robot[me];
    if (r.dead) return;
    switch (now.act) {
      case STEP:
        if (!r.serving) return;
        service_step(me, &r, nobody_id, 0, BEATS, 0);
        break;
      case HEAR:
        if (!hears(me, from)) return;
        service_step(me, &r, from, HEARD(from, now.copy), BEATS, 0);
        break;
      case SUCCEED:
        if (r.serving || !r.known || r.holder == nobody_id || service_ahead_by(0, r.beat) > LAG) return;
        if (!now.robot[r.holder].dead) {
          if (now.suspicions_left == 0) return;
          --now.suspicions_left;
        }
        service_step(me, &r, nobody_id, 0, BEATS, 1);
        break;
      case DIE:
        if (now.deaths_left == 0) return;
        --now.deaths_left;
        r.dead = 1;
        break;
    }
    if (memcmp(&r, &now.robot[me], sizeof r) == 0) return;
    become(r);
    judge();
  }
};

active proctype swarm() {
  atomic {
    choose_graph(graph);
    c_code {
      for (int k = 0; k < ROBOTS; ++k) {
        now.robot[k] = (struct Service){.beat = 0, .holder = k == 0 ? 0 : nobody_id, .known = k == 0, .serving = k == 0};
        for (int c = 0; c < COPIES; ++c) now.older[k][c] = now.robot[k];
      }
    }
  };
  do
  :: atomic {
    choose(me);
    if
    :: choose_other(from); choose_copy(copy); act = HEAR
    :: act = STEP
    :: act = SUCCEED
    :: act = DIE
    fi;
    c_code { take_step(); };
    assert(!two_holders);
    assert(!no_holder);
    assert(!replaced);
    act = 0; me = 0; from = 0; copy = 0
  }
  od
}
