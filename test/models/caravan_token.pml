/* SPDX-License-Identifier: MIT */
/* Caravan's tokens: the root's, held by robot 0 at first, and a target's, held by the last one. Holders die, or are only
   not heard of for long, give up, hand their token over, put the target off, leave it; who is tied to a silent one tells
   that the place is vacant; others take it, or another target. What a robot hears is any of a robot's last values.
   When nothing more happens each piece of the living has one root and one holder of the target, as far as there are spares. */
#include "swarm.pml"

#ifndef DEATHS
#define DEATHS 1
#endif
#ifndef SUSPICIONS
#define SUSPICIONS 1   /* tokens taken from holders that live */
#endif
#ifndef HANDOVERS
#define HANDOVERS 0
#endif
#ifndef GIVE_UPS
#define GIVE_UPS 0
#endif
#ifndef VACANCIES
#define VACANCIES 0    /* told by whoever is tied to the holder */
#endif
#ifndef PUT_OFFS
#define PUT_OFFS 0
#endif
#ifndef VAIN_DRIVES
#define VAIN_DRIVES 0  /* the holder leaves the target to others; not with HANDOVERS, where it may come to be there after all */
#endif
#ifndef OTHERS
#define OTHERS 0       /* robots that take another target */
#endif
#ifndef CLAIMS
#define CLAIMS 2       /* robots that become root */
#endif
#ifndef THERE
#define THERE (-1)     /* the robot that stands at the target */
#endif
#ifndef BEATS
#define BEATS 20       /* rounds of a step */
#endif
#define FARTHEST 120   /* a count so far behind is as good as one still farther behind */

/* What a robot may do. */
#define STEP 1        /* hears nobody */
#define HEAR 2
#define HEAR_OFFER 3  /* of a root that runs low */
#define HAND 4        /* the target, to a spare that it hears */
#define CLAIM 5       /* the root has been silent for too long */
#define SUCCEED 6     /* so has the target's holder, or it has none */
#define GIVE_UP 7
#define DIE 8
#define MISS 9        /* the target's holder, to whom it is tied, has been silent for too long */
#define WAIT_IN_VAIN 10
#define DRIVE_IN_VAIN 11
#define TAKE_ANOTHER 12

c_decl {
\#include "caravan.h"
\#include "sizes.h"
\#include "graphs.h"
\#include "seen.h"
#define FIRST (ROBOTS - 1)
#define CALM_ROUNDS 70  /* nobody moves; in more than 100 a holder has driven in vain */
#define HEARD(k, copy) ((copy) == 0 ? &now.robot[k] : &now.older[k][(copy) - 1])
};
c_state "struct Holding robot[ROBOTS]" "Global"
c_state "struct Holding older[ROBOTS][COPIES]" "Global"

byte act, me, from, copy;  /* the next step; 0 between steps */
short graph, graph_count;
byte deaths_left = DEATHS, suspicions_left = SUSPICIONS, handovers_left = HANDOVERS, give_ups_left = GIVE_UPS, claims_left = CLAIMS;
byte vacancies_left = VACANCIES, put_offs_left = PUT_OFFS, vain_drives_left = VAIN_DRIVES;
byte others_left = OTHERS;
byte tried;  /* a bit for each robot that has driven to the target in vain */
bool two_roots, no_root, disagree, two_holders, no_holder, revived, tries_again;

c_code {
  static int hears(int a, int b) { return a != b && (graphs[now.graph] >> edge_bit(a, b) & 1); }

  static int spent(char* budget) {
    if (*budget == 0) return 1;
    --*budget;
    return 0;
  }

  /* Only the differences of counts matter: the newest is 0, and none is farther behind than FARTHEST. */
  static void normalise(void) {
    unsigned short newest = now.robot[0].beat;
    for (int k = 1; k < ROBOTS; ++k)
      if (caravan_ahead_by(now.robot[k].beat, newest) > 0) newest = now.robot[k].beat;
    for (int k = 0; k < ROBOTS; ++k)
      for (int c = 0; c <= COPIES; ++c) {
        const int behind = caravan_ahead_by(newest, HEARD(k, c)->beat);
        HEARD(k, c)->beat = (unsigned short)-(behind > FARTHEST ? FARTHEST : behind);
      }
  }

  static void show(const char* what, int k, const struct Holding* r) {
    Printf("%s %d: root (%d, %d) holder %d count %d%s%s%s%s%s\n", what, k, r->sequence, r->root, r->holder, r->beat, r->serving ? " serves" : "",
           r->reached ? " there" : "", r->unfit ? " unfit" : "", r->busy ? " busy" : "", r->dead ? " dead" : "");
  }

  static void judge(void) {
    /* After any of these another one may hold it, too, that has not been told to give it up. */
    const int undisturbed = now.deaths_left == DEATHS && now.suspicions_left == SUSPICIONS && now.put_offs_left == PUT_OFFS &&
                            now.vain_drives_left == VAIN_DRIVES;
    const unsigned long long past = (unsigned long long)now.give_ups_left << 20 ^ (unsigned long long)now.tried << 24 ^
                                    (unsigned long long)undisturbed << 30;
    if (seen((unsigned long long)now.graph ^ past, now.robot, sizeof now.robot)) return;
    struct Holding robot[ROBOTS];
    memcpy(robot, now.robot, sizeof robot);
    unsigned dead = 0;
    int gone = now.give_ups_left < GIVE_UPS;
    for (int k = 0; k < ROBOTS; ++k) {
      dead |= robot[k].dead << k;
      if (robot[k].serving && !robot[k].dead) gone = 0;
      caravan_place_token(k, &robot[k], FIRST, THERE);
    }
    for (int round = 0; round < CALM_ROUNDS; ++round) {
      caravan_round(ROBOTS, hears, dead);
#ifdef SHOW_CALM
      for (int k = 0; k < ROBOTS; ++k) caravan_read_token(k, &robot[k], FIRST), show("  round robot", k, &robot[k]);
#endif
    }
    for (int k = 0; k < ROBOTS; ++k) {
      caravan_read_token(k, &robot[k], FIRST);
      if (robot[k].serving && !now.robot[k].serving && (now.tried >> k & 1)) now.tries_again = 1;
    }
    for (int k = 0; k < ROBOTS; ++k) {
      if (dead >> k & 1) continue;
      const unsigned piece = reach(graphs[now.graph], k, ~dead & ((1U << ROBOTS) - 1));
      int roots = 0, holders = 0, free = 0, fit = 0, given_up = 0;
      for (int j = 0; j < ROBOTS; ++j) {
        if (!(piece >> j & 1)) continue;
        const int is_root = robot[j].root == j, is_free = !is_root && !robot[j].serving && !robot[j].busy;
        roots += is_root, holders += robot[j].serving, free += is_free;
        /* Who joins a worker of another target to the root is not free, either. */
        fit += is_free && caravan_is_spare(j) && !(now.tried >> j & 1);
        given_up |= robot[j].holder == no_robot && now.give_ups_left < GIVE_UPS;
        if (robot[j].root != robot[k].root || robot[j].sequence != robot[k].sequence) now.disagree = 1;
      }
      if (roots > 1) now.two_roots = 1;
      if (roots == 0 && free > 0) now.no_root = 1;
      if (holders > 1) now.two_holders = 1;
      if (holders == 0 && fit > 0 && !given_up) now.no_holder = 1;
      /* Nobody held it any more when all was well again. */
      if (holders > 0 && gone && undisturbed) now.revived = 1;
    }
  }

  static void take_step(void) {
    const int me = now.me, from = now.from;
    struct Holding r = now.robot[me];
    const struct Holding* heard = HEARD(from, now.copy);
    struct Events events = {.beats = BEATS};
    if (r.dead) return;
    switch (now.act) {
      case STEP:
        if (!r.serving) return;
        caravan_token_step(me, &r, no_robot, 0, events, FIRST, THERE);
        break;
      case HEAR_OFFER:
        if (heard->root != from || heard->dead || !hears(me, from) || spent(&now.handovers_left)) return;
        events.offered = 1;
        caravan_token_step(me, &r, from, heard, events, FIRST, THERE);
        break;
      case HEAR:
        if (!hears(me, from)) return;
        caravan_token_step(me, &r, from, heard, events, FIRST, THERE);
        break;
      case HAND:
        if (!r.serving || !hears(me, from) || spent(&now.handovers_left)) return;
        events.leaving = 1;
        caravan_token_step(me, &r, from, heard, events, FIRST, THERE);
        break;
      case CLAIM:
        if (r.root == me || r.serving || spent(&now.claims_left)) return;
        if (!now.robot[r.root].dead && spent(&now.suspicions_left)) return;
        events.root_silent = 1;
        caravan_token_step(me, &r, no_robot, 0, events, FIRST, THERE);
        break;
      case SUCCEED:
        if (r.serving || r.root == me || r.holder == no_robot) return;
        if (r.holder >= 0 && !now.robot[r.holder].dead && spent(&now.suspicions_left)) return;
        events.holder_silent = 1;
        caravan_token_step(me, &r, no_robot, 0, events, FIRST, THERE);
        break;
      case GIVE_UP:
        if (!r.serving || spent(&now.give_ups_left)) return;
        events.gives_up = 1;
        caravan_token_step(me, &r, no_robot, 0, events, FIRST, THERE);
        break;
      case MISS:
        if (r.serving || r.holder < 0 || !hears(me, r.holder) || spent(&now.vacancies_left)) return;
        if (!now.robot[r.holder].dead && spent(&now.suspicions_left)) return;
        events.child_silent = 1;
        caravan_token_step(me, &r, no_robot, 0, events, FIRST, THERE);
        break;
      case WAIT_IN_VAIN:
        if (!r.serving || spent(&now.put_offs_left)) return;
        events.waits_in_vain = 1;
        caravan_token_step(me, &r, no_robot, 0, events, FIRST, THERE);
        break;
      case DRIVE_IN_VAIN:
        if (!r.serving || spent(&now.vain_drives_left)) return;
        events.drives_in_vain = 1;
        now.tried |= 1 << me;
        caravan_token_step(me, &r, no_robot, 0, events, FIRST, THERE);
        break;
      case TAKE_ANOTHER:
        if (r.serving || r.root == me || r.busy || spent(&now.others_left)) return;
        r.busy = 1;
        break;
      case DIE:
        if (spent(&now.deaths_left)) return;
        r.dead = 1;
        break;
    }
    struct Holding* old = &now.robot[me];
    if (r.serving && !old->serving && (now.tried >> me & 1)) now.tries_again = 1;
    if (memcmp(&r, old, sizeof r) == 0) return;
    for (int k = COPIES - 1; k > 0; --k) now.older[me][k] = now.older[me][k - 1];
    now.older[me][0] = *old;
    *old = r;
    normalise();
    Printf("robot %d: act %d (from %d copy %d)", me, now.act, from, now.copy);
    show("", me, old);
    judge();
  }
};

active proctype swarm() {
  atomic {
    choose_graph(graph);
    c_code {
      memset(now.robot, 0, sizeof now.robot);
      for (int k = 0; k < ROBOTS; ++k) {
        now.robot[k].sequence = 65535, now.robot[k].root = 0, now.robot[k].holder = FIRST, now.robot[k].serving = k == FIRST;
        for (int c = 0; c < COPIES; ++c) now.older[k][c] = now.robot[k];
      }
    }
  };
  do
  :: atomic {
    choose(me);
    if
    :: choose_other(from); choose_copy(copy);
       if
       :: act = HEAR
       :: act = HEAR_OFFER
       :: act = HAND
       fi
    :: act = STEP
    :: act = CLAIM
    :: act = SUCCEED
    :: act = GIVE_UP
    :: act = DIE
#if VACANCIES
    :: act = MISS
#endif
#if PUT_OFFS
    :: act = WAIT_IN_VAIN
#endif
#if OTHERS
    :: act = TAKE_ANOTHER
#endif
#if VAIN_DRIVES
    :: act = DRIVE_IN_VAIN
#endif
    fi;
    c_code { take_step(); };
    assert(!two_roots);
    assert(!no_root);
    assert(!disagree);
    assert(!two_holders);
    assert(!no_holder);
    assert(!revived);
    assert(!tries_again);
    act = 0; me = 0; from = 0; copy = 0
  }
  od
}
