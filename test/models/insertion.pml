/* SPDX-License-Identifier: MIT */
/* A spare joins an edge: robot 0 is the parent, robot 1 the owner, the others are spares that all want the edge. In turn each
   robot takes a step of TICKS ticks in which it hears the others as they are or as they were a step ago, or for a while
   nothing of one of them; spares die. The edge is given to one at a time; the owner never hangs on a robot that hangs on nobody;
   and in the end, if a spare lives, one has joined. */
#include "swarm.pml"

#ifndef DEATHS
#define DEATHS 1
#endif
#ifndef TICKS
#define TICKS 5        /* so a copy is at most 10 ticks old */
#endif
#ifndef SILENCES
#define SILENCES 0     /* steps in which a robot does not hear another at all */
#endif

/* What a robot may do. */
#define STEP 1
#define DIE 2

c_decl {
\#include "rules.h"
\#include "sizes.h"
\#include "seen.h"
};
c_state "struct Insertion robot[ROBOTS]" "Global"
c_state "struct Insertion older[ROBOTS]" "Global"

byte turn, act, old1, old2, old3, old4, deaf, at_edge;
byte deaths_left = DEATHS, silences_left = SILENCES;
bool two_spares, torn, unserved;

c_code {
  static void step_of(struct Insertion* robot, const struct Insertion* seen_as, const struct Insertion* older, int me, unsigned olds, int deaf, int at_edge) {
    const struct Insertion* heard[ROBOTS];
    int from[ROBOTS], count = 0;
    for (int k = 0; k < ROBOTS; ++k) {
      if (k == me || k == deaf || (seen_as[k].dead && !(olds >> k & 1))) continue;
      heard[count] = olds >> k & 1 ? &older[k] : &seen_as[k];
      from[count++] = k;
    }
    /* Only the edge to robot 0 is too long. */
    insertion_step(me, &robot[me], heard, from, count, me == 1 && robot[1].parent == 0, at_edge, TICKS);
  }

  static int joined(const struct Insertion* robot) { return robot[1].parent >= 2; }

  static int serves_edge(const struct Insertion* robot) {
    struct Insertion now_[ROBOTS];
    memcpy(now_, robot, sizeof now_);
    for (int round = 0; round < 40; ++round) {
      struct Insertion before[ROBOTS];
      memcpy(before, now_, sizeof before);
      for (int k = 0; k < ROBOTS; ++k)
        if (!now_[k].dead) step_of(now_, before, before, k, 0, -1, 1);
      if (joined(now_)) return 1;
    }
    return 0;
  }

  static void judge(void) {
    int inserted = 0, living = 0;
    for (int k = 2; k < ROBOTS; ++k) {
      const struct Insertion* s = &now.robot[k];
      if (s->dead) continue;
      living += s->parent == nobody_id;
      inserted += s->parent == 0 && s->inserted_child == 1;
    }
    /* Two stand between the same two robots, and both believe that the owner is theirs. */
    if (inserted > 1) now.two_spares = 1;
    const signed char parent = now.robot[1].parent;
    if (parent != 0 && now.robot[parent].parent != 0) now.torn = 1;
    if (living > 0 && !joined(now.robot) && !seen(now.deaths_left, now.robot, sizeof now.robot) && !serves_edge(now.robot)) now.unserved = 1;
  }

  static void take_step(void) {
    const int me = now.turn;
    if (now.robot[me].dead) return;
    if (now.act == DIE) {
      if (me < 2 || now.deaths_left == 0 || joined(now.robot)) return;
      --now.deaths_left;
      now.robot[me].dead = 1;
      Printf("robot %d dies\n", me);
      return;
    }
    unsigned olds = 0;
    if (now.old1) olds |= 1U << (me + 1) % ROBOTS;
    if (now.old2) olds |= 1U << (me + 2) % ROBOTS;
    if (now.old3) olds |= 1U << (me + 3) % ROBOTS;
    if (now.old4) olds |= 1U << (me + 4) % ROBOTS;
    int deaf = -1;
    if (now.deaf > 0) {
      if (now.silences_left == 0) return;
      --now.silences_left;
      deaf = (me + now.deaf) % ROBOTS;
    }
    struct Insertion robot[ROBOTS];
    memcpy(robot, now.robot, sizeof robot);
    step_of(robot, now.robot, now.older, me, olds, deaf, now.at_edge);
    now.older[me] = now.robot[me];
    now.robot[me] = robot[me];
    Printf("robot %d: olds %d deaf %d: need %d state %d role %d parent %d grant %d request %d inserted child %d (ticks %d %d %d)\n", me, olds, deaf, robot[me].need,
           robot[me].spare_state, robot[me].role, robot[me].parent, robot[me].grant, robot[me].request, robot[me].inserted_child,
           robot[me].grant_ticks, robot[me].request_ticks, robot[me].ungranted_ticks);
    judge();
  }
};

active proctype swarm() {
  c_code {
    for (int k = 0; k < ROBOTS; ++k) {
      now.robot[k] = (struct Insertion){.role = k == 0 ? 3 : k == 1 ? 2 : 0, .parent = k == 1 ? 0 : nobody_id, .grant = nobody_id, .request = nobody_id, .inserted_child = nobody_id};
      now.older[k] = now.robot[k];
    }
  };
  do
  :: atomic {
    if
    :: if :: old1 = 0 :: old1 = 1 fi;
       if :: old2 = 0 :: old2 = 1 fi;
#if ROBOTS > 3
       if :: old3 = 0 :: old3 = 1 fi;
#endif
#if ROBOTS > 4
       if :: old4 = 0 :: old4 = 1 fi;
#endif
       if
       :: deaf = 0
       :: silences_left > 0 && turn > 0 ->
          if :: deaf = 1 :: deaf = 2
#if ROBOTS > 3
             :: deaf = 3
#endif
          fi
       fi;
       if :: at_edge = 0 :: at_edge = 1 fi;
       act = STEP
    :: deaths_left > 0 && turn >= 2 -> act = DIE
    fi;
    c_code { take_step(); };
    assert(!two_spares);
    assert(!torn);
    assert(!unserved);
    turn = (turn + 1) % ROBOTS;
    act = 0; old1 = 0; old2 = 0; old3 = 0; old4 = 0; deaf = 0; at_edge = 0
  }
  od
}
