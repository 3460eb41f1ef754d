/* SPDX-License-Identifier: MIT */
/* Caravan's promises: robot 0 is root; 1 and 2 choose freely among all robots whom to hang on, and lose packets. With two
   roots robot 2 is one of its own at first. Who has heard that another names it guards that link until the other one names
   it no more, or has been silent for the lease; and guards whom it names itself. A promise that stands beside a new parent
   ends only by agreement or with its lease. With four robots the last one is a second way to robot 0.
   They step in turn. */
#include "swarm.pml"

#ifndef ROOTS
#define ROOTS 1
#endif
#ifndef LOSSES
#define LOSSES 3     /* packets that get lost */
#endif
#ifndef BRIDGE
#define BRIDGE 0     /* 1: robot 2 is in range of robot 1 alone */
#endif
#ifndef FARTHEST
#define FARTHEST 6   /* a beat so far behind is as good as one still farther behind */
#endif

c_decl {
\#include "caravan.h"
\#include "sizes.h"
#define FORGOTTEN 255
#define LEASE_OVER (caravan_lease + 1)
};
c_state "struct End robot[ROBOTS]" "Global"
c_state "unsigned char silence[ROBOTS][ROBOTS]" "Global"  /* for so many rounds the first has not heard the second */
c_state "unsigned char told[ROBOTS][ROBOTS]" "Global"     /* the first has heard that the second names it, and that one still does */

byte me, missed, near;  /* the one in turn; bits: of whom it hears nothing; who is near it */
byte losses_left = LOSSES;
bool unguarded, careless, dropped;

c_code {
  static int names(int a, int b) { return now.robot[a].parent == b || now.robot[a].other == b; }

  static signed char behind(signed char beat, int newest) { return beat - newest < -FARTHEST ? -FARTHEST : beat - newest; }

  static void normalise(void) {
    int newest = now.robot[0].beat;
    for (int k = 1; k < ROBOTS; ++k) newest = now.robot[k].beat > newest ? now.robot[k].beat : newest;
    for (int k = 0; k < ROBOTS; ++k) {
      now.robot[k].beat = behind(now.robot[k].beat, newest);
      for (int j = 0; j < ROBOTS; ++j) if (now.robot[k].of[j].age != FORGOTTEN) now.robot[k].of[j].beat = behind(now.robot[k].of[j].beat, newest);
    }
  }

  static void take_step(void) {
    const int me = now.me;
    const struct End* heard[ROBOTS];
    int from[ROBOTS], count = 0;
    const struct End before = now.robot[me];
    struct End r = before;
    for (int k = 0; k < ROBOTS; ++k) {
      if (k == me) continue;
      if (now.missed >> k & 1 || (BRIDGE && (me == 2 || k == 2) && me + k != 3)) {
        if (now.silence[me][k] < LEASE_OVER) ++now.silence[me][k];
        continue;
      }
      heard[count] = &now.robot[k], from[count++] = k;
      now.silence[me][k] = 0;
      now.told[me][k] = names(k, me);
    }
    caravan_promise_step(me, &r, heard, from, count, now.near);
    now.robot[me] = r;
    Printf("robot %d: missed %x near %d: root (%d, %d) newest %d beat %d parent %d other %d (%d)\n", me, now.missed, now.near, r.sequence, r.root, r.newest,
           r.beat, r.parent, r.other, r.other_rounds);
    for (int k = 0; k < ROBOTS; ++k)
      if (k != me && !names(me, k)) now.told[k][me] = 0;
    const int old = before.other;
    if (old != no_robot && !names(me, old)) {
      const int agreed = now.silence[me][old] == 0 && now.robot[old].root == before.root && now.robot[old].sequence == before.sequence;
      if (!agreed && now.silence[me][old] <= caravan_lease) now.dropped = 1;
    }
    for (int a = 0; a < ROBOTS; ++a)
      for (int b = 0; b < ROBOTS; ++b) {
        if (a == b || now.silence[a][b] > caravan_lease) continue;
        if (now.told[a][b] && !caravan_is_promised(a, &now.robot[a], b)) now.unguarded = 1;
        if (names(a, b) && !caravan_is_promised(a, &now.robot[a], b)) now.careless = 1;
      }
    normalise();
  }
};

inline choose_fate(k) {
  if
  :: skip
  :: losses_left > 0 -> missed = missed | (1 << k); losses_left--
  fi
}

active proctype swarm() {
  c_code {
    memset(now.robot, 0, sizeof now.robot);
    for (int k = 0; k < ROBOTS; ++k) {
      struct End* r = &now.robot[k];
      r->root = r->newest = r->parent = r->other = no_robot;
      for (int j = 0; j < 4; ++j) r->of[j] = (struct Remembered){.age = FORGOTTEN, .parent = no_robot, .other = no_robot, .root = no_robot};
      for (int j = 0; j < ROBOTS; ++j) now.silence[k][j] = LEASE_OVER, now.told[k][j] = 0;
      if (k == 0 || (k == 2 && ROOTS == 2)) r->root = r->newest = k, r->sequence = r->newest_sequence = k == 0 ? 2 : 1;
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
    :: me == 0 || me == 3 -> near = 0
    :: me == 1 || me == 2 -> near = 0
    :: me == 1 || me == 2 -> near = 3 - me
#if ROBOTS > 3
    :: me == 1 || me == 2 -> near = 3
#endif
    fi;
    c_code { take_step(); };
    assert(!unguarded);
    assert(!careless);
    assert(!dropped);
    missed = 0; near = 0;
    me = (me + 1) % ROBOTS
  }
  od
}
